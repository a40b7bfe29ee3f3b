// One scene of a sweep: pictures and tables of its settings. A report's item shows it, too.
import { html, nothing, type TemplateResult } from "lit";

import { errorsOf, wordsOf, type Against, type Bench, type Conclusions, type Figure, type MeasuredScene, type Plot, type Region, type Spread, type Stage, type Sweep, type Variant } from "../data/bench";
import { countOf } from "../data/wording";
import { fixed, significant } from "../format";
import "./pareto";
import { table, type Column } from "./table";

const idOf = (variant: Variant): string => `${variant.path}: ${variant.name}`;

const kSetting: Column<Variant> = {
  label: "setting",
  isText: true,
  value: idOf,
  show: (variant) => html`${idOf(variant)}${variant.dominated ? html` <small>dominated</small>` : variant.stage === "storage" ? nothing : html` <small class="on-front">on the front</small>`}`,
};

function spreadColumns(label: string, of: (variant: Variant) => Spread | undefined): Column<Variant>[] {
  return [
    { label, value: (variant) => of(variant)?.median, show: (variant) => fixed(of(variant)?.median, 2) },
    { label: "quartiles", value: (variant) => of(variant)?.low, show: (variant) => `${fixed(of(variant)?.low, 2)}–${fixed(of(variant)?.high, 2)}` },
  ];
}

function timeColumns(stage: Stage): Column<Variant>[] {
  if (stage === "storage") return [];
  if (stage === "preparation") return spreadColumns("prepare ms", (variant) => variant.prepareMs);
  const number = (label: string, digits: number, value: (variant: Variant) => number | undefined): Column<Variant> => ({ label, value, show: (variant) => fixed(value(variant), digits) });
  return [
    ...spreadColumns("device ms", (variant) => variant.timeMs?.device),
    number("wall", 2, (variant) => variant.timeMs?.wall.median),
    number("CPU", 2, (variant) => variant.timeMs?.cpu.median),
    number("compile", 0, (variant) => variant.timeMs?.compile),
    number("operations", 0, (variant) => variant.cost.operations),
    number("fetches", 1, (variant) => variant.cost.fetches),
    number("samplers", 0, (variant) => variant.cost.samplers),
  ];
}

const kFigures: readonly (readonly [Figure, string])[] = [["flip.mean", "FLIP"], ["flip.p95", "p95"], ["relmse", "relMSE"]];

function errorColumns(against: Against): Column<Variant>[] {
  const figure = (region: Region, name: Figure) => errorsOf(region, against)?.[name];
  return kFigures.map(([name, label]) => ({
    label,
    group: `against ${wordsOf(against)}`,
    value: (variant) => figure(variant.error, name),
    show: (variant) => significant(figure(variant.error, name), 4),
  }));
}

function variantTable(scene: MeasuredScene, stage: Stage, { against, figure }: Conclusions): TemplateResult | typeof nothing {
  const variants = scene.variants.filter((variant) => variant.stage === stage), first = scene.variants[0]?.path;
  if (variants.length === 0 || first === undefined) return nothing;
  const nonFinite = ({ error }: Variant) => errorsOf(error, first)?.nonFinite;
  return html`<h3>Settings of each path: ${stage}</h3>
    ${stage === "storage" ? nothing : html`<p class="sub">On the front: no other setting of the same path${stage === "preparation" ? ", of the same knob," : ""} is both faster and better, by ${figure} against ${wordsOf(against)}.</p>`}
    ${table(`Settings, ${stage}`, variants, [
    kSetting,
    ...timeColumns(stage),
    ...(variants.some((variant) => variant.error.truth) ? errorColumns("truth") : []),
    ...errorColumns(first),
    { label: "NaN", value: nonFinite, show: (variant) => nonFinite(variant) || "" },
  ], (variant) => (variant.name === "default" ? "plain" : variant.dominated ? "dominated" : ""))}`;
}

/** The figure that is judged by, of every material by every setting. */
function materialTable(scene: MeasuredScene, { against, figure }: Conclusions): TemplateResult | typeof nothing {
  const names = scene.variants[0]?.materials.map((region) => region.name ?? "") ?? [];
  if (names.length === 0) return nothing;
  const of = (variant: Variant, index: number): number | null | undefined => {
    const region = variant.materials[index];
    return region && errorsOf(region, against)?.[figure];
  };
  return html`<details><summary>${figure} by material</summary>
    ${table("By material", scene.variants, [kSetting, ...names.map((label, index): Column<Variant> => ({ label, value: (variant) => of(variant, index), show: (variant) => significant(of(variant, index), 4) }))])}
  </details>`;
}

const pictures = (plots: readonly Plot[], stage: Stage): TemplateResult => html`<div class="pictures">${plots.filter((plot) => plot.stage === stage).map(({ svg }) => html`<parity-pareto .svg=${svg}></parity-pareto>`)}</div>`;

/** All that is known of a scene by the place it has in the sweep. */
export function sceneParts(scene: MeasuredScene, plots: readonly Plot[], conclusions: Conclusions): TemplateResult {
  return html`<p class="sub">environment <bdi>${scene.environment}</bdi>, sun ${scene.sun}; ${scene.width}×${scene.height}, ${countOf(scene.pixels, "surface samples")}${scene.truthError > 0 ? `; the error of the truth is ${significant(100 * scene.truthError, 2)} % (median pixel)` : ""}</p>
    ${pictures(plots, "shading")}${variantTable(scene, "shading", conclusions)}
    ${pictures(plots, "preparation")}${variantTable(scene, "preparation", conclusions)}
    ${variantTable(scene, "storage", conclusions)}
    ${materialTable(scene, conclusions)}
    ${scene.skipped.length === 0 ? nothing : html`<p class="sub">Not measured, because the scene does not need it:</p><ul class="notes">${scene.skipped.map((each) => html`<li>${each}</li>`)}</ul>`}`;
}

const namesOf = (bench: Bench): TemplateResult[] => bench.scenes.map(({ scene }, index) => html`${index > 0 ? ", " : ""}<bdi>${scene}</bdi>`);

/** What a sweep that goes with a report has of that view: a bench of a suite names a scene with several views "scene, view". */
export function sceneNamed({ bench, plots }: Sweep, name: string, view: string): TemplateResult {
  const place = (wanted: string): number => bench.scenes.findIndex((each) => each.scene === wanted);
  const index = place(name) >= 0 ? place(name) : place(`${name}, ${view}`);
  const scene = bench.scenes[index];
  if (!scene || "failure" in scene) return html`<p class="aside">This bench does not have the scene <bdi>${name}</bdi>; it has ${namesOf(bench)}.</p>`;
  return sceneParts(scene, plots[index] ?? [], bench.conclusions);
}
