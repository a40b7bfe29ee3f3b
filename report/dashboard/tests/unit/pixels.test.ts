import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

import { packValues } from "./pack";

/** As much of a document as loading a script needs: files by name, run when they are added. */
class FakeScript {
  src = "";
  private readonly listeners = new Map<string, () => void>();
  addEventListener(name: string, listener: () => void): void {
    this.listeners.set(name, listener);
  }
  fire(name: string): void {
    this.listeners.get(name)?.();
  }
  remove(): void {}
}

let files: Record<string, unknown>; // by address; undefined: there is no such file
let embedded: Record<string, string>;
let loads: string[];

function fakeDocument(): Record<string, unknown> {
  const document: Record<string, unknown> = {
    currentScript: null,
    createElement: () => new FakeScript(),
    querySelector: (selector: string) => {
      const file = /data-file="(.*)"/.exec(selector)?.[1] ?? "";
      return file in embedded ? { textContent: embedded[file] } : null;
    },
    head: {
      append: (script: FakeScript) => {
        loads.push(script.src);
        queueMicrotask(() => {
          if (!(script.src in files)) return script.fire("error");
          document["currentScript"] = script;
          if (files[script.src] !== null) globalThis.parityChunk?.(files[script.src]);
          document["currentScript"] = null;
          script.fire("load");
        });
      },
    },
  };
  return document;
}

function makeFile(file: string, value = 7): Record<string, unknown> {
  return {
    file,
    format: 2,
    width: 2,
    height: 1,
    planes: [{ name: "flip", kind: "unorm16", data: packValues([value, value + 1], 2, 1) }],
  };
}

async function load(): Promise<typeof import("../../src/data/pixels")> {
  vi.resetModules(); // nothing kept from the test before
  return import("../../src/data/pixels");
}

beforeEach(() => {
  files = {};
  embedded = {};
  loads = [];
  vi.stubGlobal("document", fakeDocument());
  vi.stubGlobal("CSS", { escape: (text: string) => text });
});
afterEach(() => vi.unstubAllGlobals());

describe("loading pixel files", () => {
  it("loads a file once, however often and whatever of it is asked for", async () => {
    files["pixels/a.js"] = makeFile("pixels/a.js");
    const { loadPlane } = await load();
    const planes = await Promise.all([loadPlane("pixels/a.js", "flip"), loadPlane("pixels/a.js", "flip")]);
    expect([...planes[0].values]).toEqual([7, 8]);
    expect(planes[1]).toBe(planes[0]);
    expect(await loadPlane("pixels/a.js", "flip")).toBe(planes[0]);
    expect(loads).toEqual(["pixels/a.js"]);
  });

  it("keeps apart files that load at the same time", async () => {
    files["pixels/a.js"] = makeFile("pixels/a.js", 1);
    files["pixels/b.js"] = makeFile("pixels/b.js", 5);
    const { loadPlane } = await load();
    const planes = await Promise.all([loadPlane("pixels/a.js", "flip"), loadPlane("pixels/b.js", "flip")]);
    expect(planes.map((plane) => plane.values[0])).toEqual([1, 5]);
  });

  it("says what is missing, empty or another file's, and tries again when asked again", async () => {
    files["pixels/empty.js"] = null;
    files["pixels/other.js"] = makeFile("pixels/a.js");
    const { loadChunk } = await load();
    await expect(loadChunk("pixels/gone.js")).rejects.toThrow("pixels/gone.js is missing or cannot be read");
    await expect(loadChunk("pixels/empty.js")).rejects.toThrow("holds no pixel values");
    await expect(loadChunk("pixels/other.js")).rejects.toThrow("another file");
    files["pixels/gone.js"] = makeFile("pixels/gone.js");
    expect((await loadChunk("pixels/gone.js")).width).toBe(2);
  });

  it("runs no script from elsewhere", async () => {
    const { loadChunk } = await load();
    for (const file of ["https://a.example/x.js", "//a.example/x.js", "pixels/../../x.js", "x.js", "pixels/x.html", ""])
      await expect(loadChunk(file)).rejects.toThrow("is not a file of this report's pixels");
    expect(loads).toEqual([]);
  });

  it("escapes what would end a path", async () => {
    files["pixels/a%23b%20%3Fc.js"] = makeFile("pixels/a#b ?c.js");
    const { loadChunk } = await load();
    expect((await loadChunk("pixels/a#b ?c.js")).width).toBe(2);
  });

  it("takes the copy in the page of a report in one file", async () => {
    embedded["pixels/a.js"] = JSON.stringify(makeFile("pixels/a.js"));
    embedded["pixels/b.js"] = "{";
    const { loadChunk, loadPlane } = await load();
    expect([...(await loadPlane("pixels/a.js", "flip")).values]).toEqual([7, 8]);
    await expect(loadChunk("pixels/b.js")).rejects.toThrow("is not JSON");
    expect(loads).toEqual([]);
  });

  it("lets go of what was used longest ago once files are many", async () => {
    const { loadChunk } = await load();
    const names = ["a", "b", "c", "d"].map((name) => `pixels/${name}.js`);
    for (const name of names)
      files[name] = { ...makeFile(name), planes: [{ name: "flip", kind: "unorm16", data: "A".repeat(30 * 2 ** 20) }] };
    for (const name of names.slice(0, 3)) await loadChunk(name); // 90 of 96 MiB
    await loadChunk(names[0]!);
    await loadChunk(names[3]!); // b goes
    await loadChunk(names[0]!);
    expect(loads).toEqual(names);
    await loadChunk(names[1]!);
    expect(loads).toEqual([...names, names[1]]);
  });
});
