// Pixels that are black in both pictures, or white in both: no difference can be seen there.
import type { Figures } from "./types";

/** From this share of a row's pixels on it is a warning (kNotableClipping in report/report.h). */
export const kNotableClipping = 0.05;

/** "34.2 % white, 1.0 % black", the larger first; "" where it is not worth a warning. */
export function clippingText(figures: Figures | null): string {
  const parts = [
    { share: figures?.clippedWhite ?? 0, color: "white" },
    { share: figures?.clippedBlack ?? 0, color: "black" },
  ];
  if (parts.reduce((sum, { share }) => sum + share, 0) < kNotableClipping) return "";
  return parts
    .filter(({ share }) => share > 0)
    .sort((a, b) => b.share - a.share)
    .map(({ share, color }) => `${(100 * share).toFixed(1)} % ${color}`)
    .join(", ");
}
