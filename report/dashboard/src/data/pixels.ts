// Loads pixel files when they are asked for, and keeps a few: scripts that hand their values to a global function, so
// that it works from a folder without a server.
import { checkChunk, decodePlane, type Chunk, type Plane } from "./chunk";
import { embeddedText, relativeUrl } from "./embedded";

declare global {
  var parityChunk: ((chunk: unknown) => void) | undefined;
}

const kMaxPackedBytes = 96 * 2 ** 20; // of files as they were loaded
const kMaxPlaneBytes = 160 * 2 ** 20; // of unpacked planes, besides those in use

/** Kept by last use until a sum of sizes is reached; the last one always stays. */
class RecentlyUsed<T> {
  private readonly items = new Map<string, { value: T; size: number }>();
  private total = 0;
  constructor(private readonly limit: number) {}

  get(key: string): T | undefined {
    const item = this.items.get(key);
    if (item === undefined) return undefined;
    this.items.delete(key);
    this.items.set(key, item);
    return item.value;
  }

  set(key: string, value: T, size: number): void {
    this.delete(key);
    this.items.set(key, { value, size });
    this.total += size;
    for (const oldest of this.items.keys()) {
      if (this.total <= this.limit || oldest === key) break;
      this.delete(oldest);
    }
  }

  private delete(key: string): void {
    this.total -= this.items.get(key)?.size ?? 0;
    this.items.delete(key);
  }
}

const chunks = new RecentlyUsed<Chunk>(kMaxPackedBytes);
const planes = new RecentlyUsed<Plane>(kMaxPlaneBytes);
const loadingChunks = new Map<string, Promise<Chunk>>();
const loadingPlanes = new Map<string, Promise<Plane>>();
const handedOver = new WeakMap<Element, unknown>(); // by the script that did

function receive(value: unknown): void {
  if (document.currentScript !== null) handedOver.set(document.currentScript, value);
}

function runScript(file: string): Promise<Chunk> {
  globalThis.parityChunk = receive;
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = relativeUrl(file);
    script.addEventListener("load", () => {
      script.remove();
      try {
        resolve(checkChunk(handedOver.get(script), file));
      } catch (error) {
        reject(error instanceof Error ? error : new Error(String(error)));
      }
    });
    script.addEventListener("error", () => {
      script.remove();
      reject(new Error(`${file} is missing or cannot be read`));
    });
    document.head.append(script);
  });
}

async function readChunk(file: string): Promise<Chunk> {
  if (!/^pixels\/[^\\]+\.js$/.test(file) || file.split("/").includes(".."))
    throw new Error(`${file} is not a pixel file of this report`);
  const text = embeddedText(file, "application/json");
  if (text === null) return runScript(file);
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw new Error(`${file} is damaged: it is not JSON`);
  }
  return checkChunk(value, file);
}

/** Runs `make` unless the same is under way. */
function once<T>(running: Map<string, Promise<T>>, key: string, make: () => Promise<T>): Promise<T> {
  let promise = running.get(key);
  if (promise === undefined) {
    promise = make().finally(() => running.delete(key));
    running.set(key, promise);
  }
  return promise;
}

/** A pixel file of the report by its path there. Rejects in words: missing, damaged, of another format. */
export function loadChunk(file: string): Promise<Chunk> {
  const kept = chunks.get(file);
  if (kept !== undefined) return Promise.resolve(kept);
  return once(loadingChunks, file, async () => {
    const chunk = await readChunk(file);
    chunks.set(
      file,
      chunk,
      chunk.planes.reduce((sum, plane) => sum + plane.data.length, 0),
    );
    return chunk;
  });
}

/** One plane of a pixel file, unpacked. Rejects in words. */
export function loadPlane(file: string, name: string): Promise<Plane> {
  const key = file + "\n" + name;
  const kept = planes.get(key);
  if (kept !== undefined) return Promise.resolve(kept);
  return once(loadingPlanes, key, async () => {
    const plane = await decodePlane(await loadChunk(file), name);
    planes.set(key, plane, plane.values.byteLength);
    return plane;
  });
}
