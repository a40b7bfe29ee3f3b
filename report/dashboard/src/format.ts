// Numbers as people read them: the digits and units that the report names for each figure.
import type { Figures, Statistic } from "./data/types";

const kMinus = "\u2212";

/** A fixed number of digits, with a real minus; "–" where it is not known. */
export function fixed(value: number | null | undefined, digits: number): string {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  const text = Math.abs(value).toFixed(digits);
  return (value < 0 && Number(text) !== 0 ? kMinus : "") + text;
}

export function signed(value: number | null | undefined, digits: number): string {
  const text = fixed(value, digits);
  return value !== null && value !== undefined && value > 0 && Number(text) !== 0 ? "+" + text : text;
}

/** "0.142", "31.4 dB", "+0.31 EV", "32.5 %"; "identical" for the infinite PSNR of equal pictures. */
export function figure(value: number | null | undefined, statistic: Statistic | undefined): string {
  if (value === null && statistic?.better === "higher") return "identical";
  if (value === null || value === undefined) return "–";
  if (!statistic) return fixed(value, 4);
  if (statistic.unit === "%") return fixed(value * 100, statistic.digits) + " %";
  const small = statistic.unit === "" && value !== 0 && Math.abs(value) < 0.5 * 10 ** -statistic.digits;
  if (small) return value.toExponential(1).replace("-", kMinus).replace("e" + kMinus, "e-");
  const text = statistic.better === "near zero" ? signed(value, statistic.digits) : fixed(value, statistic.digits);
  return statistic.unit === "" ? text : `${text} ${statistic.unit}`;
}

/** One of these figures; that of pixels which are not finite is not known, and none of them is identical. */
export function figureIn(figures: Figures | null | undefined, name: string, statistics: Record<string, Statistic>): string {
  if (!figures) return "–";
  const value = figures.metrics[name];
  return figure(value === null && figures.nonFinite > 0 ? undefined : value, statistics[name]);
}

/** A difference of two figures, always signed. */
export function change(value: number | null | undefined, statistic: Statistic | undefined): string {
  if (value === null || value === undefined) return "–";
  const share = statistic?.unit === "%";
  const text = signed(share ? value * 100 : value, statistic?.digits ?? 4);
  return statistic && statistic.unit !== "" ? `${text} ${statistic.unit}` : text;
}

/** So many significant digits: "0.0123", "1.2e-7"; "NaN" for null, which is what JSON has in its place. */
export function significant(value: number | null | undefined, digits: number): string {
  if (value === undefined) return "–";
  return value === null ? "NaN" : String(Number(value.toPrecision(digits))).replaceAll("-", kMinus);
}

/** "1,234,567" */
export function count(value: number): string {
  return value.toLocaleString("en-US");
}

/** "12.3 s", "450 ms" */
export function duration(timeMs: number | null): string {
  if (timeMs === null) return "–";
  return timeMs >= 1000 ? `${(timeMs / 1000).toFixed(1)} s` : `${timeMs.toFixed(timeMs < 10 ? 1 : 0)} ms`;
}
