// The details of a scene, as report.json and run.json have them: loaded when one of its rows is opened, and kept for a
// while.
import type { SceneTrends } from "./history";
import { once, RecentlyUsed } from "./recently_used";
import { loadScriptFile } from "./script_file";
import { trendsOf } from "./row_trend";
import type { AgainCommand, Scene } from "./types";

export interface SceneDetails {
  scene: Scene;
  again: AgainCommand[]; // of its views
  history: SceneTrends | null; // of its rows over the runs; null: none is known
}

const kFormat = 1;
const kKept = 16;

const scenes = new RecentlyUsed<number, SceneDetails>(kKept);
const loading = new Map<number, Promise<SceneDetails>>();

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null;
}

/** What a file hands over, checked. name: that the list has for the scene. Throws Error in words. */
export function checkScene(value: unknown, file: string, name: string): SceneDetails {
  if (!isObject(value)) throw new Error(`${file} holds no scene`);
  if (value["format"] !== kFormat) throw new Error(`${file} has format ${String(value["format"])}, but this page reads format ${kFormat}`);
  const scene = value["scene"];
  if (value["file"] !== file || !isObject(scene)) throw new Error(`${file} holds no scene, or that of another file`);
  if (scene["name"] !== name) throw new Error(`${file} is of another report: it holds the scene ${String(scene["name"]).slice(0, 200)}`);
  if (!Array.isArray(scene["views"])) throw new Error(`${file} is damaged: its scene has no views`);
  const { again, history } = value;
  return { scene: scene as unknown as Scene, again: Array.isArray(again) ? (again as AgainCommand[]) : [], history: trendsOf(history) };
}

/** The scene at that place of the report, if it is there already. */
export function keptScene(place: number): SceneDetails | null {
  return scenes.get(place) ?? null;
}

/** The scene at that place of the report. Rejects in words: missing, damaged, of another report. */
export function loadScene(place: number, name: string): Promise<SceneDetails> {
  const kept = keptScene(place);
  if (kept !== null) return Promise.resolve(kept);
  return once(loading, place, async () => {
    const file = `scenes/${place}.js`;
    const details = checkScene(await loadScriptFile(file, "scenes"), file, name);
    scenes.set(place, details, 1);
    return details;
  });
}
