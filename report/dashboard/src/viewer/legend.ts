// The scales of what panes show in colours that are no picture's: FLIP maps, differences, luminance.
import { html, nothing, type TemplateResult } from "lit";

import { bandColors, kLeastEv, kMostEv } from "../data/false_color";
import { magmaCss } from "../data/magma";
import { help, type Topic } from "../help";
import type { Legend } from "./arrange";
import { styleText } from "./style_text";

const kStops = 32;
const kMagma = `linear-gradient(to right, ${Array.from({ length: kStops + 1 }, (_, i) => magmaCss(i / kStops)).join(", ")})`;
const kGreys = "linear-gradient(to right, #010101, #808080, #ffffff)";

interface Tick {
  at: number; // 0..1 of the bar
  text: string;
}

interface Scale {
  kind: Legend["kind"];
  name: string;
  topic: Topic;
  note: string; // beside the name: what the range is
  gradient: string;
  ticks: Tick[];
  words: string; // the scale in a sentence, for whoever does not see it
  cut?: number; // 0..1 of the bar: grey below it
}

/** A number without needless zeros. */
function plain(value: number): string {
  return String(Number(value.toPrecision(2)));
}

function signedText(value: number, unit = ""): string {
  return `${value > 0 ? "+" : value < 0 ? "\u2212" : ""}${plain(Math.abs(value))}${unit}`;
}

/** "range 0 to 0.3, automatic" */
export function rangeText(from: string, to: string, isAuto: boolean): string {
  return `range ${from} to ${to}, ${isAuto ? "automatic" : "fixed"}`;
}

function flipScale({ most, threshold, isAuto }: Legend & { kind: "flip" }): Scale {
  const note = rangeText("0", plain(most), isAuto);
  const last = most < 1 ? "≥ " : "";
  return {
    kind: "flip",
    name: "FLIP",
    topic: "magma",
    note,
    gradient: kMagma,
    ticks: [0, 0.5, 1].map((at) => ({ at, text: (at === 1 ? last : "") + plain(at * most) })),
    words: `FLIP from 0 (black, identical) to ${plain(most)}${most < 1 ? " and above" : ""} (bright yellow), ${note}${threshold > 0 ? `; grey below the threshold ${threshold.toFixed(2)}` : ""}`,
    ...(threshold > 0 ? { cut: Math.min(threshold / most, 1) } : {}),
  };
}

function differenceScale({ steps, test, base, isAuto }: Legend & { kind: "difference" }): Scale {
  const [low, high] = [signedText(-steps), signedText(steps)];
  const note = rangeText(low, `${high} of 255`, isAuto);
  return {
    kind: "difference",
    name: "Difference",
    topic: "differenceLegend",
    note,
    gradient: kGreys,
    ticks: [
      { at: 0, text: `${low}: ${test} darker` },
      { at: 0.5, text: "0: equal" },
      { at: 1, text: `${high}: brighter` },
    ],
    words: `Difference of the displayed values, ${test} minus ${base}: from ${low} (black, darker) over 0 (grey, equal) to ${high} (white, brighter), ${note}`,
  };
}

function luminanceScale(): Scale {
  const colors = bandColors();
  const bands = colors.map((color, i) => `${color} ${(100 * i) / colors.length}% ${(100 * (i + 1)) / colors.length}%`);
  const span = kMostEv - kLeastEv;
  const evs = Array.from({ length: span / 2 + 1 }, (_, i) => kLeastEv + 2 * i);
  return {
    kind: "luminance",
    name: "Luminance",
    topic: "falseColor",
    note: "EV from middle grey, 18 % of white",
    gradient: `linear-gradient(to right, ${bands.join(", ")})`,
    ticks: evs.map((ev) => ({ at: (ev - kLeastEv) / span, text: signedText(ev) })),
    words: `Luminance in EV steps from middle grey, 18 % of white as exposed: from ${kLeastEv} EV (dark blue; black below) over 0 (green) to +${kMostEv} EV (dark red; white above)`,
  };
}

function scaleOf(legend: Legend): Scale {
  switch (legend.kind) {
    case "flip":
      return flipScale(legend);
    case "difference":
      return differenceScale(legend);
    case "luminance":
      return luminanceScale();
  }
}

function percent(share: number): string {
  return `${100 * share}%`;
}

function tickClass(at: number): string {
  return at <= 0 ? "tick at-start" : at >= 1 ? "tick at-end" : "tick";
}

export function legendView(legend: Legend): TemplateResult {
  const { kind, name, topic, note, gradient, ticks, words, cut } = scaleOf(legend);
  return html`<div class="legend ${kind}">
    <p class="legend-name"><b>${name}</b>${help(topic)} <span class="note">${note}</span></p>
    <div class="legend-scale" role="img" aria-label=${words}>
      <div class="legend-bar" .style=${styleText({ background: gradient })}>
        ${cut === undefined
          ? nothing
          : html`<i class="alike" .style=${styleText({ width: percent(cut) })}></i
              ><i class="cut" .style=${styleText({ left: percent(cut) })}></i>`}
      </div>
      ${ticks.map(({ at, text }) => html`<span class=${tickClass(at)} .style=${styleText({ left: percent(at) })}>${text}</span>`)}
    </div>
  </div>`;
}

/** One of each kind, in the order of the panes. */
export function legendsOf(panes: readonly { legend: Legend | null }[]): Legend[] {
  const legends = panes.flatMap(({ legend }) => (legend === null ? [] : [legend]));
  return legends.filter((legend, i) => legends.findIndex((each) => each.kind === legend.kind) === i);
}
