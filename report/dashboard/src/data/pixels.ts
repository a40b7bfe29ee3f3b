// Loads pixel files when they are asked for, and keeps a few.
import { checkChunk, decodePlane, type Chunk, type Plane } from "./chunk";
import { once, RecentlyUsed } from "./recently_used";
import { loadScriptFile } from "./script_file";

const kMaxPackedBytes = 96 * 2 ** 20; // of files as they were loaded
const kMaxPlaneBytes = 160 * 2 ** 20; // of unpacked planes, besides those in use

const chunks = new RecentlyUsed<string, Chunk>(kMaxPackedBytes);
const planes = new RecentlyUsed<string, Plane>(kMaxPlaneBytes);
const loadingChunks = new Map<string, Promise<Chunk>>();
const loadingPlanes = new Map<string, Promise<Plane>>();

/** A pixel file of the report by its path there. Rejects in words: missing, damaged, of another format. */
export function loadChunk(file: string): Promise<Chunk> {
  const kept = chunks.get(file);
  if (kept !== undefined) return Promise.resolve(kept);
  return once(loadingChunks, file, async () => {
    const chunk = checkChunk(await loadScriptFile(file, "pixels"), file);
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
