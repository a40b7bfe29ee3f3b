// bench.json of `parity bench`, as far as the page plots it: time against error of every setting.

export interface BenchPoint {
  name: string; // path and setting
  path: string;
  timeMs: number; // of the device, median
  low: number;
  high: number;
  error: number;
  dominated: boolean;
}
export interface BenchScene {
  name: string;
  points: BenchPoint[];
}
export interface Bench {
  figure: string; // "flip.mean"
  against: string; // "reference" or "highend"
  scenes: BenchScene[];
}

type Json = Record<string, unknown>;
const objectOf = (value: unknown): Json => (typeof value === "object" && value !== null ? (value as Json) : {});
const listOf = (value: unknown): unknown[] => (Array.isArray(value) ? value : []);
const numberOf = (value: unknown): number => (typeof value === "number" && Number.isFinite(value) ? value : NaN);

/** null where it is no bench, or has nothing that can be plotted. */
export function parseBench(value: unknown): Bench | null {
  const conclusions = objectOf(objectOf(value)["conclusions"]);
  const figure = typeof conclusions["figure"] === "string" ? conclusions["figure"] : "flip.mean";
  const against = typeof conclusions["against"] === "string" ? conclusions["against"] : "highend";
  const scenes: BenchScene[] = [];
  for (const each of listOf(objectOf(value)["scenes"])) {
    const scene = objectOf(each);
    const points: BenchPoint[] = [];
    for (const one of listOf(scene["variants"])) {
      const variant = objectOf(one);
      const device = objectOf(objectOf(variant["timeMs"])["device"]);
      const error = objectOf(objectOf(variant["error"])[against === "reference" ? "truth" : "highend"]);
      const point: BenchPoint = {
        name: `${String(variant["path"])} ${String(variant["name"])}`,
        path: String(variant["path"]),
        timeMs: numberOf(device["median"]),
        low: numberOf(device["low"]),
        high: numberOf(device["high"]),
        error: numberOf(error[figure]),
        dominated: variant["dominated"] === true,
      };
      if (Number.isFinite(point.timeMs) && Number.isFinite(point.error)) points.push(point);
    }
    if (points.length > 0) scenes.push({ name: String(scene["scene"]), points });
  }
  return scenes.length > 0 ? { figure, against, scenes } : null;
}
