import { describe, expect, it } from "vitest";

import type { Approval, Statistic } from "../../src/data/types";
import { approvalText } from "../../src/item/checks";

const approval: Approval = { origin: "approvals.toml:3", state: "holds", value: 0.142, slack: 0.002, until: "2026-12-03", daysLeft: 8, owner: "characters", reason: "refit (#481)", words: "" };
const statistic: Statistic = { label: "mean FLIP", unit: "", digits: 3, better: "lower" };

describe("an approval", () => {
  it("says up to what it holds, by whom, until when and why", () => {
    expect(approvalText(approval, statistic)).toBe("approved up to 0.144, by characters, until 2026-12-03 (8 days left): refit (#481)");
    expect(approvalText({ ...approval, daysLeft: 0 }, statistic)).toContain("(the last day)");
    expect(approvalText({ ...approval, daysLeft: -1, state: "expired", words: "it expired" }, statistic)).toContain("(1 day ago): refit (#481); it expired");
    expect(approvalText({ ...approval, state: "lapsed", words: "other inputs" }, statistic)).toMatch(/^approval does not hold, by characters/);
  });

  it("holds down to a figure of which more is better, and on both sides of 0", () => {
    expect(approvalText({ ...approval, value: 40, slack: 1 }, { ...statistic, unit: "dB", digits: 1, better: "higher" })).toMatch(/^approved down to 39.0 dB/);
    expect(approvalText({ ...approval, value: -0.3, slack: 0.01 }, { ...statistic, unit: "EV", digits: 2, better: "near zero" })).toMatch(/^approved up to ±0.31 EV/);
  });
});
