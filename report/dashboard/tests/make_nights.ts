// A history of nights as `parity history page` writes it, made by numbers that are the same each time.
import type { Night, NightChange, Nights, Trend, TrendChange, ValueSpan, VerdictSpan } from "../src/data/history";
import { kKinds, type Kind } from "../src/data/nights";
import type { Verdict } from "../src/data/types";

/** Numbers in [0, 1) that look like chance (mulberry32). */
function makeRandom(seed: number): () => number {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const kCauses = ["asset", "build", "environment", "request", "build, driver", "bake", ""];
const kMachines = ["AMD EPYC 7763", "Intel Xeon Platinum 8370C"];
const four = (value: number): number => Number(value.toPrecision(4));

/** So many hexadecimal digits, as of a digest. */
function digitsOf(seed: number, count: number): string {
  const random = makeRandom(seed);
  return Array.from({ length: count }, () => Math.floor(16 * random()).toString(16)).join("");
}

export function makeNight(place: number, fields: Partial<Night> = {}): Night {
  const started = new Date(Date.UTC(2025, 9, 20 + place, 3, 0, 12)).toISOString().replace(/\.\d+Z/, "Z");
  return {
    name: `${started.replace(/[-:]/g, "")}-${digitsOf(5000 + place, 12)}`,
    started,
    commit: digitsOf(place + 1, 40),
    verdict: "pass",
    rows: 5000,
    failed: 0,
    warned: 0,
    isComplete: true,
    isWhole: true,
    isFirst: place === 0,
    version: "0.9.0",
    build: digitsOf(1000 + Math.floor(place / 9), 64),
    device: "llvmpipe (LLVM 15.0.6, 256 bits)",
    machine: kMachines[0] ?? "",
    cpuS: 600,
    wallS: 80,
    scenes: 640,
    cachedScenes: 0,
    worst: { row: "Sponza/north/Lion", flip: 0.2144 },
    meanFlip: 0.031,
    events: {},
    changes: [],
    ...fields,
  };
}

/** So many nights, of each of which `share` of the rows changes. */
export function makeNights(nights: number, rows: number, share = 0.01): Nights {
  const random = makeRandom(7);
  const runs = Array.from({ length: nights }, (_, place) => {
    const onXeon = random() < 0.3, cached = place === 0 ? 0 : Math.floor(640 * (0.4 + 0.5 * random()));
    return makeNight(place, { machine: kMachines[onXeon ? 1 : 0] ?? "", cachedScenes: cached, cpuS: four((onXeon ? 820 : 640) * (1 - cached / 640) * (place > nights / 2 ? 1.2 : 1)), rows, isComplete: random() > 0.02, isWhole: place === 0 || random() > 0.03 });
  });
  const values = Array.from({ length: rows }, () => 0.01 + 0.12 * random() ** 2);
  const spans: ValueSpan[][] = values.map(() => []), verdicts: VerdictSpan[][] = values.map(() => []), changes: TrendChange[][] = values.map(() => []);
  const verdictOf = (value: number): Verdict => (value > 0.1 ? "fail" : value > 0.07 ? "warn" : "pass");
  const nameOf = (row: number): string => [`Scene ${String(Math.floor(row / 20)).padStart(3, "0")}`, `view ${Math.floor(row / 5) % 4}`, ["Chrome", "Glass (thin)", "Lacquered wood", "Skin", "Velvet"][row % 5]].join("/");
  const starts = values.map(() => 0), verdictStarts = values.map(() => 0);
  const close = (row: number, end: number, isOther: boolean): void => {
    const value = values[row] ?? 0;
    spans[row]?.push([starts[row] ?? 0, end, four(value)]);
    starts[row] = end + 1;
    if (!isOther) return;
    verdicts[row]?.push([verdictStarts[row] ?? 0, end, verdictOf(value)]);
    verdictStarts[row] = end + 1;
  };
  runs.forEach((night, place) => {
    const listed: NightChange[] = [], events: Record<string, number> = {};
    for (let row = 0; place > 0 && night.isWhole && row < rows; ++row) {
      if (random() >= share * (place % 30 === 0 ? 6 : 1)) continue;
      const before = values[row] ?? 0, after = Math.max(0.002, before * (0.75 + 0.52 * random()));
      const was = verdictOf(before), is = verdictOf(after), luck = random();
      const kind: Kind = luck < 0.004 ? "nondeterministic" : luck < 0.007 ? "crashed" : was !== "fail" && is === "fail" ? "regressed" : was === "fail" && is !== "fail" ? "fixed" : luck > 0.99 ? "new" : "changed";
      close(row, place - 1, was !== is);
      values[row] = after;
      const change: TrendChange = { run: place, kind, cause: kind === "nondeterministic" ? "" : (kCauses[Math.floor(random() * kCauses.length)] ?? ""), metric: kind === "new" ? "" : "flip.mean", before: kind === "new" ? null : four(before), after: kind === "new" ? null : four(after), figures: kind === "new" ? 0 : 1 + Math.floor(random() * 10) };
      changes[row]?.push(change);
      listed.push({ ...change, row: nameOf(row) });
      events[kind] = (events[kind] ?? 0) + 1;
    }
    listed.sort((a, b) => kKinds.indexOf(a.kind) - kKinds.indexOf(b.kind));
    const worst = values.reduce((best, value, row) => (value > (values[best] ?? 0) ? row : best), 0);
    const failed = values.filter((each) => verdictOf(each) === "fail").length, warned = values.filter((each) => verdictOf(each) === "warn").length;
    Object.assign(night, { events, changes: listed.slice(0, 60), failed, warned, verdict: failed > 0 ? "fail" : warned > 0 ? "warn" : "pass", worst: { row: nameOf(worst), flip: four(values[worst] ?? 0) }, meanFlip: four(values.reduce((sum, each) => sum + each, 0) / rows) });
  });
  values.forEach((_, row) => close(row, nights - 1, true));
  const trends = spans.map((each, row): [string, Trend] => [nameOf(row), { figures: { "flip.p95": each.map(([first, last, value]) => [first, last, four(2.4 * (value ?? 0))]), "flip.mean": each }, verdicts: verdicts[row] ?? [], changes: changes[row] ?? [] }]);
  return {
    format: 1,
    version: "0.9.0",
    suite: "nightly",
    branch: "main",
    statistics: { "flip.mean": { better: "lower" }, "flip.p95": { better: "lower" }, psnr: { better: "higher" }, "bias.ev": { better: "near zero" } },
    runs,
    rows: Object.fromEntries(trends.filter(([, trend]) => trend.changes.length > 0)),
    timings: nights < 20 ? [] : [{ scene: "Scene 003", machine: kMachines[0] ?? "", run: Math.floor(nights / 2), beforeMs: 812, nowMs: 974 }, { scene: "Scene 011", machine: kMachines[1] ?? "", run: Math.floor(nights / 3), beforeMs: 2210, nowMs: 1830 }],
  };
}

/** The page as report/data_page.cpp writes it, as far as the script relies on it. */
export function nightsPage(nights: unknown): string {
  const json = (typeof nights === "string" ? nights : JSON.stringify(nights)).replaceAll("<", "\\u003c");
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'self' file:; style-src 'self' file:; img-src 'self' file: data: blob:; base-uri 'none'; form-action 'none'"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>parity history: nights</title>
<link rel="icon" href="data:,"/>
<link rel="stylesheet" href="dashboard.css"/>
<script defer="" src="dashboard.js"></script>
</head>
<body>
<main id="app"><header class="first"><h1>Nights</h1></header></main>
<script type="application/json" id="nights">${json}</script>
</body>
</html>
`;
}
