// What the panel "What would help" shows of an explanation: lengths of bars, differences of cost, errors by quantity.
import { short } from "./card";
import type { Limit } from "./overview";
import { roundUp } from "./scale";
import type { ApproximationEffect, CardInput, Check, ErrorMask, ErrorRange, ExplainedSet, Explanation, MaterialCard } from "./types";
import { typeset } from "./wording";

const kLeastSign = 0.001; // of mean FLIP: what is nearer to 0 has no sign to speak of
const kHalfGap = 0.06; // beside each bar of a tenth, as a share of the tenth

/** The approximation that adds most; null: none adds anything. */
export function mainApproximation({ approximations }: Explanation): ApproximationEffect | null {
  const [first] = approximations;
  return first && first.share >= kLeastSign ? first : null;
}

/** "formulas=refit + capture=fp16" */
export function nameOfSet({ changes }: Pick<ExplainedSet, "changes">): string {
  return changes.length === 0 ? "nothing" : changes.join(" + ");
}

/** The set that is advised; null: none. */
export function advisedSet({ sets, advised }: Explanation): ExplainedSet | null {
  return advised > 0 ? (sets[advised] ?? null) : null;
}

/** The limits of mean FLIP, and what the budget would say of this value. */
export function limitAt(flip: number, checks: readonly Check[]): Limit {
  const metric = "flip.mean";
  const check = checks.find((each) => each.metric === metric && !each.regress);
  if (!check) return { metric, warn: null, fail: null, verdict: "not judged" };
  const { warn, fail } = check;
  return { metric, warn, fail, verdict: fail !== null && flip > fail ? "fail" : warn !== null && flip > warn ? "warn" : "pass" };
}

/** "+12 %", "−3 %", "0 %" */
export function costChange(operations: number, today: number): string {
  if (!(today > 0)) return "–";
  const change = 100 * (operations / today - 1);
  return typeset(`${change > 0 ? "+" : ""}${change.toFixed(0)} %`);
}

/** "62 %"; "0.4 %" of what is less than one. */
export function percent(share: number): string {
  const value = 100 * share;
  return `${value.toFixed(value > 0 && value < 1 ? 1 : 0)} %`;
}

/** Whether the change by itself does the opposite of what it does among the others. */
export function isOtherWay({ alone, share }: ApproximationEffect): boolean {
  return alone * share < 0 && Math.min(Math.abs(alone), Math.abs(share)) > kLeastSign;
}

/** Where a bar lies, in percent of the width that all share. */
export interface Span {
  left: number;
  width: number;
}

export interface SignedScale {
  zero: number; // in percent
  spanOf(value: number): Span;
}

/** One scale for these values, with zero on it: what is below lies to the left of it. */
export function signedScale(values: readonly number[]): SignedScale {
  const least = Math.min(0, ...values), most = Math.max(0, ...values);
  const size = most - least || 1;
  const place = (value: number): number => (100 * (value - least)) / size;
  return { zero: place(0), spanOf: (value) => ({ left: place(Math.min(value, 0)), width: (100 * Math.abs(value)) / size }) };
}

/** The errors of one quantity; the tenths without pixels are missing. */
export interface RangeGroup {
  quantity: ErrorRange["quantity"];
  ranges: ErrorRange[];
}

/** By quantity, in the order of the report. */
export function groupRanges(ranges: readonly ErrorRange[]): RangeGroup[] {
  const groups = new Map<ErrorRange["quantity"], ErrorRange[]>();
  for (const range of ranges) groups.set(range.quantity, [...(groups.get(range.quantity) ?? []), range]);
  return [...groups].map(([quantity, each]) => ({ quantity, ranges: each }));
}

/** What a full bar means. */
export function topOfRanges({ ranges }: RangeGroup): number {
  return roundUp(Math.max(0, ...ranges.flatMap(({ pixels, flip }) => [pixels, flip]))) || 1;
}

/** The two bars of a tenth, side by side; quantities go from 0 to 1. */
export function barsOfRange({ from, to }: ErrorRange): { pixels: Span; flip: Span } {
  const half = (to - from) / 2;
  const span = (left: number): Span => ({ left: 100 * (left + kHalfGap * half), width: 100 * (1 - 2 * kHalfGap) * half });
  return { pixels: span(from), flip: span(from + half) };
}

/** "0.3 to 0.4" */
export function rangeName({ from, to }: ErrorRange): string {
  return `${short(from)} to ${short(to)}`;
}

/** "Most of it from 0.3 to 0.4: 62 % of the FLIP, on 20 % of the pixels." */
export function describeRanges({ ranges }: RangeGroup): string {
  const [first] = ranges;
  if (first && ranges.length === 1) return `All of its pixels lie from ${rangeName(first)}.`;
  const most = ranges.reduce<ErrorRange | null>((best, each) => (best && best.flip >= each.flip ? best : each), null);
  return most ? `Most of it from ${rangeName(most)}: ${percent(most.flip)} of the FLIP, on ${percent(most.pixels)} of the pixels.` : "";
}

export interface MaskedTexture {
  mask: ErrorMask;
  input: CardInput;
  picture: string; // of the texture, below the mask
}

/** The masks whose texture the card shows. */
export function maskedTextures(masks: readonly ErrorMask[], card: MaterialCard | null): MaskedTexture[] {
  return masks.flatMap((mask) => {
    const input = card?.inputs.find(({ name }) => name === mask.input);
    const picture = input?.texture?.picture ?? "";
    return input && picture !== "" ? [{ mask, input, picture }] : [];
  });
}
