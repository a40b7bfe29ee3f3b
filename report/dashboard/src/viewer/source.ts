// What a view's pixel files have given so far: planes are asked for while rendering, and the page renders again once
// they are there.
import type { ReactiveControllerHost } from "lit";

import { reasonOf } from "../data/reason";
import type { Plane } from "../data/chunk";
import { readDisplayTable, type Display } from "../data/display";
import { loadChunk, loadPlane } from "../data/pixels";
import type { Head } from "../data/page";
import type { View } from "../data/types";

/** There, on its way, or why it will not come. */
export type Loaded<T> = { value: T } | { waiting: true } | { message: string };
const kWaiting = { waiting: true } as const;

export function valueOf<T>(loaded: Loaded<T>): T | null {
  return "value" in loaded ? loaded.value : null;
}
export function messageOf<T>(loaded: Loaded<T>): string {
  return "message" in loaded ? loaded.message : "";
}

/** How the report displays linear values: the display setting, by its table where it is no formula. */
export async function loadDisplay(report: Head): Promise<Display> {
  const name = report.settings.find((setting) => setting.name === "display")?.value ?? "sRGB";
  if (name === "sRGB" || name === "raw") return { kind: name };
  if (report.displayTable === "") throw new Error(`this report has no table for its display transform "${name}"`);
  const chunk = await loadChunk(report.displayTable);
  return { kind: "table", table: readDisplayTable(chunk, await loadPlane(report.displayTable, "table")) };
}

export class PixelSource {
  private view: View | null = null;
  private report: Head | null = null;
  private planes = new Map<string, Loaded<Plane>>(); // by file and name
  private asked = new Set<string>(); // in this rendering
  private shownDisplay: Loaded<Display> = kWaiting;

  constructor(private readonly host: ReactiveControllerHost) {}

  /** What the next planes are of. */
  show(report: Head, view: View): void {
    if (this.report !== report) {
      this.report = report;
      this.shownDisplay = kWaiting;
      this.settle(loadDisplay(report), (loaded) => {
        if (this.report === report) this.shownDisplay = loaded;
      });
    }
    if (this.view === view) return;
    this.view = view;
    this.planes = new Map();
  }

  get display(): Loaded<Display> {
    return this.shownDisplay;
  }

  /** A plane of the view's colour file; asks for it where it is not there. */
  color(name: string): Loaded<Plane> {
    return this.plane(this.view?.pixels.color ?? "", name);
  }

  /** A plane of its terms file, which leaves out what is black in both paths. */
  term(name: string): Loaded<Plane> {
    return this.plane(this.view?.pixels.terms ?? "", name);
  }

  /** Lets go of what was not asked for since the last call, so that only what is shown stays in memory. */
  dropUnused(): void {
    for (const key of this.planes.keys()) if (!this.asked.has(key)) this.planes.delete(key);
    this.asked = new Set();
  }

  private plane(file: string, name: string): Loaded<Plane> {
    if (file === "")
      return { message: `This report was written without ${name.includes(".") ? "term images" : "pixel values"}.` };
    const key = file + "\n" + name;
    this.asked.add(key);
    const known = this.planes.get(key);
    if (known !== undefined) return known;
    this.planes.set(key, kWaiting);
    const planes = this.planes;
    this.settle(this.load(file, name), (loaded) => {
      if (planes.has(key)) planes.set(key, loaded);
    });
    return kWaiting;
  }

  private async load(file: string, name: string): Promise<Plane> {
    const view = this.view;
    if (file === view?.pixels.terms && !(await loadChunk(file)).planes.some((plane) => plane.name === name))
      throw new Error("This term is black in both paths.");
    const plane = await loadPlane(file, name);
    if (view !== null && (plane.width !== view.width || plane.height !== view.height))
      throw new Error(`${file} is ${plane.width} x ${plane.height}, but its view is ${view.width} x ${view.height}`);
    return plane;
  }

  private settle<T>(promise: Promise<T>, take: (loaded: Loaded<T>) => void): void {
    promise
      .then(
        (value) => take({ value }),
        (error: unknown) => take({ message: reasonOf(error) }),
      )
      .finally(() => this.host.requestUpdate());
  }
}
