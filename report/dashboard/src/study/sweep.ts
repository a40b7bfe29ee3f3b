// A sweep of `parity bench`: what to conclude, then its scenes.
import { html, nothing, type TemplateResult } from "lit";

import { wordsOf, type Bench, type Conclusions, type Purchase, type Ratio, type Sweep } from "../data/bench";
import { countOf } from "../data/wording";
import { fixed, significant, signed } from "../format";
import { help } from "../help";
import { copyable, definitions } from "../parts";
import { sceneParts } from "./scene";
import { table } from "./table";

const list = (texts: readonly string[]): TemplateResult => html`<ul class="notes">${texts.map((each) => html`<li><bdi>${each}</bdi></li>`)}</ul>`;

const kVerdictClass = { slower: "fail", faster: "pass", "the same": "" } as const;

function comparedPart({ compared }: Conclusions): TemplateResult | typeof nothing {
  if (!compared) return nothing;
  return html`<section><h2>Comparison with the earlier sweep</h2>
    <p class="sub">Ratio of the time now to the earlier time, with an interval of ${fixed(100 * compared.confidence, 2)} % confidence (95 % for all together).</p>
    ${compared.notes.length > 0 ? list(compared.notes) : nothing}
    <details ?open=${compared.variants.some((each) => each.verdict !== "the same")}><summary>${countOf(compared.variants.length, "settings")}</summary>
    ${table<Ratio>("Comparison with the earlier sweep", compared.variants, [
      { label: "setting", isText: true, value: (each) => each.id },
      { label: "scene", isText: true, value: (each) => each.scene },
      { label: "ratio", value: (each) => each.ratio, show: (each) => fixed(each.ratio, 3) },
      { label: "from", value: (each) => each.low, show: (each) => fixed(each.low, 3) },
      { label: "to", value: (each) => each.high, show: (each) => fixed(each.high, 3) },
      { label: "verdict", isText: true, value: (each) => each.verdict, show: ({ verdict }) => (verdict === "the same" ? verdict : html`<span class="badge ${kVerdictClass[verdict]}">${verdict}</span>`) },
      { label: "FLIP before", value: (each) => each.flipBefore, show: (each) => significant(each.flipBefore, 4) },
      { label: "FLIP now", value: (each) => each.flipNow, show: (each) => significant(each.flipNow, 4) },
    ])}</details></section>`;
}

function budgetPart({ budget, cheapest }: Conclusions): TemplateResult | typeof nothing {
  const [figure, limit] = Object.entries(budget ?? {})[0] ?? [];
  if (figure === undefined || !cheapest) return nothing;
  return html`<section><h2>Fastest setting with ${figure} ≤ ${limit}</h2>
    ${table("Fastest settings within the budget", cheapest, [
      { label: "scene", isText: true, value: (each) => each.scene },
      { label: "path", isText: true, value: (each) => each.path },
      { label: "setting", isText: true, value: (each) => each.setting ?? "none" },
    ], (each) => (each.scene === "all" ? "plain" : ""))}</section>`;
}

function purchasePart({ purchases, figure, against }: Conclusions): TemplateResult | typeof nothing {
  if (purchases.length === 0) return nothing;
  return html`<section><h2>Error saved by a millisecond</h2>
    <p class="sub">Each row changes one knob from the faster value to the slower one. Figures are medians over the scenes: ms of device time for a million surface samples, and ${figure} against ${wordsOf(against)}. A minus means that the change costs time and makes the error larger. If the quartiles of the two times overlap in most scenes, the time counts as 1 % of the default's time.</p>
    ${table<Purchase>("Error saved by a millisecond", purchases, [
      { label: "knob", isText: true, value: (each) => `${each.path} ${each.knob}` },
      { label: "from", isText: true, value: (each) => each.from },
      { label: "to", isText: true, value: (each) => each.to },
      { label: "ms", value: (each) => each.msPerMillionSamples, show: (each) => fixed(each.msPerMillionSamples, 2) },
      { label: "error saved", value: (each) => each.error, show: (each) => signed(each.error, 5) },
      { label: "error saved a ms", value: (each) => each.errorPerMs, show: (each) => `${(each.errorPerMs ?? 0) > 0 ? "+" : ""}${significant(each.errorPerMs, 2)}` },
      { label: "scenes with distinct times", value: (each) => each.timeIsCertainIn, show: (each) => `${fixed(100 * each.timeIsCertainIn, 0)} %` },
    ])}</section>`;
}

function runPart({ machine, rounds, commandLine }: Bench): TemplateResult {
  return html`<section>${definitions([
    ["Processor", machine.processor],
    ["Device", `${machine.device} (${machine.deviceKind}, driver ${machine.driver})`],
    ["Threads, SIMD", `${machine.threads}, ${machine.simd}`],
    ["Times", `medians of ${countOf(rounds, "rounds")} in random order, without compilation`],
  ])}${copyable(commandLine, "the command of this sweep")}</section>`;
}

export function sweepParts({ bench, plots }: Sweep): TemplateResult {
  const c = bench.conclusions;
  return html`${runPart(bench)}${comparedPart(c)}${budgetPart(c)}${purchasePart(c)}
    ${c.notes.length === 0 ? nothing : html`<section><h2>Limits of the conclusions</h2>${list(c.notes)}</section>`}
    <section><h2>Dominated in every scene ${help("pareto")}</h2>
      <p class="sub">Another setting of the same path is at least as fast and as good in every scene (${c.figure}).</p>
      ${c.dominatedEverywhere.length === 0 ? html`<p>None.</p>` : list(c.dominatedEverywhere)}</section>
    ${bench.scenes.map((scene, index) => html`<section><h2><bdi>${scene.scene}</bdi></h2>
      ${"failure" in scene ? html`<p class="notice error">${scene.failure}</p>` : sceneParts(scene, plots[index] ?? [], c)}</section>`)}`;
}
