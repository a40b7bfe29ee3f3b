// A run of `parity stress`: what is new, what is known, every function's figures, maps of errors, scenes.
import { html, nothing, type TemplateResult } from "lit";

import { causesOf, type Cause, type Column as Side, type Finding, type Stress, type StressFunction, type StressTimes } from "../data/stress";
import { countOf } from "../data/wording";
import { count, significant } from "../format";
import { help } from "../help";
import { copyable } from "../parts";
import "./error_map";
import { table, type Column } from "./table";

function unexpectedCard(finding: Finding): TemplateResult {
  return html`<article class="finding">
    <p><b>${finding.subject}</b> ${finding.place} <span class="badge fail">✕ unexpected</span> ${finding.fault}${finding.count > 0 ? `, ${countOf(finding.count, "times")}` : ""}</p>
    ${finding.region === "" ? nothing : html`<p>The table expected it where ${finding.region}: ${finding.reason}</p>`}
    ${finding.example === "" ? nothing : html`<p class="aside">Worst: ${finding.example}</p>`}
    ${copyable(`parity stress ${finding.reproduce}`, `the command for ${finding.subject}`)}
  </article>`;
}

function knownPart(stress: Stress): TemplateResult | typeof nothing {
  if (stress.expected === 0) return nothing;
  const total = ({ findings }: Cause): number => findings.reduce((sum, each) => sum + each.count, 0);
  const first = ({ findings }: Cause): Finding | undefined => findings[0];
  return html`<section><h2>Known</h2>
    ${table<Cause>("Known findings", causesOf(stress.findings), [
      { label: "subject", isText: true, value: (each) => each.subject, show: (each) => html`<b>${each.subject}</b>` },
      { label: "finding", isText: true, value: (each) => each.fault },
      { label: "region and reason", isText: true, value: (each) => each.region, show: (each) => html`<div class="why">${each.region}. ${first(each)?.reason}</div>` },
      { label: "rows or pixels", value: total, show: (each) => each.findings.map((one) => html`<div>${one.place}: ${count(one.count)}</div>`) },
      { label: "worst of the first place", isText: true, value: (each) => first(each)?.example, show: (each) => html`<small class="why">${first(each)?.example}</small>` },
      { label: "repeat", isText: true, value: (each) => first(each)?.reproduce, show: (each) => html`<code class="why">${first(each)?.reproduce}</code>` },
    ])}</section>`;
}

function mapsPart(functions: readonly StressFunction[]): TemplateResult | typeof nothing {
  const mapped = functions.filter((each) => each.mapAxes);
  if (mapped.length === 0) return nothing;
  const maps = ({ columns }: StressFunction): Side[] => columns.filter((each) => each.side === "cpu" && each.precision !== "fp64" && each.map);
  return html`<section><h2>Errors over roughness and cosine</h2>
    <p class="sub">Largest error against fp64 at the same inputs, relative to the value (or to the scale in the table), from 1e−8 (black) to 1 and more (light).</p>
    <div class="maps">${mapped.map((each) => html`<figure><figcaption>${each.name}</figcaption>
      <div class="pair">${maps(each).map((side) => html`<div><parity-error-map .map=${side.map} .axes=${each.mapAxes} .label=${`${each.name}, ${side.side} ${side.precision}`}></parity-error-map><small>${side.side} ${side.precision}</small></div>`)}</div>
    </figure>`)}</div></section>`;
}

interface FunctionRow {
  name: string;
  side: Side;
}

function functionsPart(functions: readonly StressFunction[]): TemplateResult | typeof nothing {
  const rows = functions.flatMap(({ name, columns }) => columns.map((side): FunctionRow => ({ name, side })));
  if (rows.length === 0) return nothing;
  const faults = Object.keys(rows.find(({ side }) => side.faults)?.side.faults ?? {});
  const number = (label: string, value: (side: Side) => number | null | undefined): Column<FunctionRow> => ({ label, value: ({ side }) => value(side), show: ({ side }) => (value(side) === undefined ? "" : significant(value(side), 3)) });
  return html`<section><h2>Functions</h2>
    ${table<FunctionRow>("Functions", rows, [
      { label: "function", isText: true, value: (row) => row.name, show: (row) => html`<b>${row.name}</b>` },
      { label: "side", isText: true, value: ({ side }) => `${side.side} ${side.precision}`, show: ({ side }) => html`<span class="whole">${side.side} ${side.precision}</span>` },
      { label: "rows", value: ({ side }) => side.rows, show: ({ side }) => (side.rows === undefined ? "" : count(side.rows)) },
      ...faults.map((fault): Column<FunctionRow> => ({
        label: fault,
        value: ({ side }) => side.faults?.[fault]?.rows,
        show: ({ side }) => {
          const found = side.faults?.[fault];
          return !found ? "" : found.rows === 0 ? "·" : html`<span class=${found.unexpected > 0 ? "unexpected" : ""}>${count(found.rows)}</span>`;
        },
      })),
      { ...number("error 99.9 %", (side) => side.p999Error), topic: "stressError" },
      number("error max", (side) => side.maxError),
      { ...number("device ulp", (side) => side.maxUlps), topic: "ulp" },
      { label: "outside, not finite", value: ({ side }) => side.outsideNotFinite, show: ({ side }) => (side.outside === undefined ? "" : `${count(side.outsideNotFinite ?? 0)} of ${count(side.outside)}`) },
      { label: "worst error at", isText: true, value: ({ side }) => side.worstError?.at ?? side.skipped, show: ({ side }) => (side.skipped === null ? html`<code class="why">${side.worstError?.at ?? ""}</code>` : `skipped: ${side.skipped}`) },
    ])}</section>`;
}

function scenesPart({ scenes, findings }: Stress): TemplateResult | typeof nothing {
  if (scenes.length === 0) return nothing;
  const found = (name: string, expected: boolean): number => findings.filter((each) => each.subject === name && each.expected === expected).length;
  const verdict = (name: string): unknown => {
    const known = found(name, true), unknown = found(name, false);
    return unknown > 0 ? html`<span class="badge fail">✕ ${unknown} unexpected</span>` : known > 0 ? `✓, ${known} expected` : "✓";
  };
  return html`<section><h2>Scenes</h2>
    ${table("Scenes", scenes, [
      { label: "scene", isText: true, value: (scene) => scene.name, show: (scene) => html`<b>${scene.name}</b>` },
      { label: "expected result", isText: true, value: (scene) => scene.wants },
      { label: "result", isText: true, value: (scene) => found(scene.name, false), show: (scene) => verdict(scene.name) },
    ])}</section>`;
}

const seconds = (timeMs: number | undefined): string => (timeMs === undefined ? "" : ` (${(timeMs / 1000).toFixed(0)} s)`);

export function stressParts(stress: Stress, times: StressTimes | null): TemplateResult {
  const unexpected = stress.findings.filter((each) => !each.expected);
  return html`<section>
      ${stress.functions.length === 0 ? nothing : html`<p>${countOf(stress.functions.length, "functions")}, ${countOf(stress.points, "points")} each on the CPU, ${count(stress.devicePoints)} on the device, in addition to special values${seconds(times?.functionsMs)}.</p>`}
      ${stress.scenes.length === 0 ? nothing : html`<p>${countOf(stress.scenes.length, "scenes")} rendered twice by every path, with the validation layers${seconds(times?.rendersMs)}.</p>`}
      ${stress.failure === null ? nothing : html`<p class="notice error" role="alert">Stopped early: ${stress.failure}</p>`}
      ${stress.fp16Skipped === null ? nothing : html`<p class="caution">Skipped: fp16 on the device: ${stress.fp16Skipped}</p>`}
    </section>
    <section><h2>New ${help("unexpected")}</h2>${unexpected.length === 0 ? html`<p>None.</p>` : unexpected.map(unexpectedCard)}</section>
    ${knownPart(stress)}${mapsPart(stress.functions)}${functionsPart(stress.functions)}${scenesPart(stress)}`;
}
