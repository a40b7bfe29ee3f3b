// Which machines ran the nights, and what the nights cost there.
import type { Night, Nights } from "./history";

export interface Machine {
  machine: string;
  device: string;
  build: string;
  nights: number;
  first: Night;
  last: Night;
  cpuS: number | null; // median of the nights of which it is known
}

function medianOf(values: readonly number[]): number | null {
  const ordered = [...values].sort((a, b) => a - b), middle = ordered.length >> 1;
  const upper = ordered[middle];
  if (upper === undefined) return null;
  return ordered.length % 2 === 1 ? upper : (upper + (ordered[middle - 1] ?? upper)) / 2;
}

/** Each machine with each device and build that it had, the one used last first. */
export function machinesOf(runs: readonly Night[]): Machine[] {
  const groups = new Map<string, Night[]>();
  for (const night of runs) {
    const key = JSON.stringify([night.machine, night.device, night.build]);
    const nights = groups.get(key);
    if (nights) nights.push(night);
    else groups.set(key, [night]);
  }
  const machines = [...groups.values()].map((nights): Machine => {
    const first = nights[0] as Night, last = nights.at(-1) as Night;
    return { machine: first.machine, device: first.device, build: first.build, nights: nights.length, first, last, cpuS: medianOf(nights.flatMap((each) => each.cpuS ?? [])) };
  });
  const place = new Map(runs.map((each, index) => [each, index]));
  return machines.sort((a, b) => (place.get(b.last) ?? 0) - (place.get(a.last) ?? 0));
}

export type Step = Nights["timings"][number];

/** "+12 %": how much slower; null where that cannot be said. */
export const shareOf = ({ beforeMs, nowMs }: Step): number | null => (beforeMs > 0 ? nowMs / beforeMs - 1 : null);

/** The newest first, and of one night the largest. */
export function stepsOf(timings: readonly Step[]): Step[] {
  return [...timings].sort((a, b) => b.run - a.run || Math.abs(b.nowMs - b.beforeMs) - Math.abs(a.nowMs - a.beforeMs));
}
