// Files of the report that are loaded when they are asked for: scripts that hand their value to a global function, so
// that it works from a folder without a server; or blocks of the page itself (a report in one file).
import { embeddedText, relativeUrl } from "./embedded";

declare global {
  var parityChunk: ((value: unknown) => void) | undefined; // pixels/*.js
  var parityScene: ((value: unknown) => void) | undefined; // scenes/*.js
}

const handedOver = new WeakMap<Element, unknown>(); // by the script that did

function receive(value: unknown): void {
  if (document.currentScript !== null) handedOver.set(document.currentScript, value);
}

function runScript(file: string): Promise<unknown> {
  globalThis.parityChunk = receive;
  globalThis.parityScene = receive;
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = relativeUrl(file);
    script.addEventListener("load", () => {
      script.remove();
      resolve(handedOver.get(script));
    });
    script.addEventListener("error", () => {
      script.remove();
      reject(new Error(`${file} is missing or cannot be read`));
    });
    document.head.append(script);
  });
}

/** The value of a file in that folder of the report, unchecked; undefined: it hands over none. Rejects in words. */
export async function loadScriptFile(file: string, folder: "pixels" | "scenes"): Promise<unknown> {
  if (!new RegExp(`^${folder}/[^\\\\]+\\.js$`).test(file) || file.split("/").includes(".."))
    throw new Error(`${file} is not a file of this report's ${folder}`);
  const text = embeddedText(file, "application/json");
  if (text === null) return runScript(file);
  try {
    return JSON.parse(text);
  } catch {
    throw new Error(`${file} is damaged: it is not JSON`);
  }
}
