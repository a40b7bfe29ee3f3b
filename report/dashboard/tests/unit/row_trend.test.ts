import { describe, expect, it } from "vitest";

import type { EarlierRun, RowTrend, TrendChange } from "../../src/data/history";
import { failsSince, figuresOf, rowTrendOf, trendSentence } from "../../src/data/row_trend";
import { changeWords } from "../../src/data/trends";

const runs: EarlierRun[] = ["19", "20", "21", "22"].map((day, i) => ({ name: `${i}.json.gz`, started: `2026-11-${day}T00:00:00Z`, commit: `c${i}`, verdict: "fail" }));
const regressed: TrendChange = { run: 2, kind: "regressed", cause: "asset", metric: "flip.mean", before: 0.1, after: 0.3, figures: 2 };
const trend: RowTrend = { figures: { psnr: [], "flip.mean": [[0, 1, 0.1], [2, 3, 0.3]] }, verdicts: [[0, 1, "pass"], [2, 2, "fail"], [3, 3, "error"]], changes: [{ ...regressed, kind: "changed", cause: "build" }, regressed] };
const failing = { standing: "still", nights: 3, verdict: "fail" } as const;

describe("what the runs say of a row", () => {
  it("is found by its place: a view's materials, then its whole image", () => {
    const other: RowTrend = { ...trend, changes: [] };
    const trends = { views: [[trend, null, other]] };
    expect(rowTrendOf(trends, 0, 0, 2)).toBe(trend);
    expect(rowTrendOf(trends, 0, 1, 2)).toBeNull();
    expect(rowTrendOf(trends, 0, -1, 2)).toBe(other);
    expect(rowTrendOf(trends, 3, 0, 2)).toBeNull();
    expect(rowTrendOf(null, 0, 0, 2)).toBeNull();
  });

  it("begins with mean FLIP", () => {
    expect(figuresOf(trend)).toEqual(["flip.mean", "psnr"]);
    expect(figuresOf({ ...trend, figures: { psnr: [] } })).toEqual(["psnr"]);
  });

  it("knows since when it fails: with whatever failing verdict", () => {
    expect(failsSince(trend.verdicts)).toBe(2);
    expect(failsSince([[0, 3, "pass"]])).toBe(-1);
    expect(failsSince([])).toBe(-1);
  });

  it("says in a sentence how long it fails, since which run, and why", () => {
    expect(trendSentence(failing, trend, runs)).toBe("Fails for 3 nights, since 2026-11-21 (c2); cause: asset.");
    expect(trendSentence({ ...failing, nights: 0 }, { ...trend, verdicts: [[0, 3, "fail"]] }, runs)).toBe("Fails since the first run that is known, 2026-11-19 (c0).");
    expect(trendSentence({ ...failing, standing: "flaky" }, trend, runs)).toMatch(/^Flaky: .* Fails for 3 nights/);
    expect(trendSentence({ ...failing, standing: "new", nights: 1 }, { ...trend, verdicts: [[0, 3, "pass"]] }, runs)).toBe("Fails since this run: it did not fail before, in the run of 2026-11-22 (c3).");
    expect(trendSentence({ ...failing, standing: "new", nights: 1 }, { ...trend, verdicts: [] }, runs)).toBe("Fails since this run: no earlier run has a verdict of it.");
  });

  it("says what became of a row that does not fail", () => {
    expect(trendSentence({ standing: "fixed", nights: 0, verdict: "pass" }, trend, runs)).toBe("Does not fail any more: it failed before, in the run of 2026-11-22 (c3).");
    const fine: RowTrend = { ...trend, verdicts: [[0, 3, "pass"]] };
    expect(trendSentence({ standing: "", nights: 0, verdict: "pass" }, fine, runs)).toBe("Last change: 2026-11-21 (c2), regressed, cause: asset.");
    expect(trendSentence({ standing: "", nights: 0, verdict: "pass" }, { ...fine, changes: [] }, runs)).toBe("Has not changed in the runs that are known.");
    expect(changeWords(regressed)).toBe("regressed, cause: asset");
    expect(changeWords({ ...regressed, cause: "" })).toBe("regressed");
  });
});
