// A report made with --history: standings in the list, and the tab that says what earlier runs say of a row.
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { EarlierRun, EarlierRuns, RowTrend, SceneTrends } from "../../src/data/history";
import type { Report } from "../../src/data/types";
import { violations } from "./axe";
import { changedData, hashOfItem, openReport, realProblems, removeChanged, startBrowser, type AddedHistory } from "./browser";

const kRuns: EarlierRun[] = Array.from({ length: 30 }, (_, i) => {
  const day = new Date(Date.UTC(2026, 9, 25 + i)).toISOString();
  return { name: `${day.slice(0, 10)}.json.gz`, started: day, commit: `${(0x10e2b14a + 977 * i).toString(16)}5531`, verdict: i < 18 ? "pass" : "fail" };
});
const kHistory: EarlierRuns = { format: 1, suite: "nightly", branch: "main", runs: kRuns };

/** Of the third material of the first scene: it fails for 12 nights, and one night did not have it. */
function trendOf(report: Report): RowTrend {
  const material = report.scenes[0]!.views[0]!.materials[2]!;
  const now = material.figures!.metrics["flip.mean"]!;
  return {
    figures: { "bias.ev": [[0, 29, -0.1]], "flip.mean": [[0, 9, 0.12], [11, 17, 0.14], [18, 18, 0.31], [19, 29, now]] },
    verdicts: [[0, 9, "pass"], [11, 17, "warn"], [18, 29, "fail"]],
    changes: [
      { run: 11, kind: "changed", cause: "build", metric: "flip.mean", before: 0.12, after: 0.14, figures: 3 },
      { run: 18, kind: "regressed", cause: "asset", metric: "flip.mean", before: 0.14, after: 0.31, figures: 9 },
      { run: 19, kind: "changed", cause: "", metric: "flip.mean", before: 0.31, after: now, figures: 2 },
    ],
    approved: { run: 17, images: report.scenes[0]!.views[0]!.materials[1]!.crops },
  };
}

const kNightly: AddedHistory = { history: kHistory, rows: { 2: { standing: "still", nights: 12 }, 1: { standing: "flaky", nights: 2 }, 0: { standing: "fixed" } }, trends: {} };

let browser: Browser;
let folder = "";

beforeAll(async () => {
  const trends: Record<number, SceneTrends> = {};
  folder = changedData("real", (report) => {
    const materials = report.scenes[0]!.views[0]!.materials;
    Object.assign(materials[2]!.budget, { owner: "characters" });
    trends[0] = { views: [materials.map((_, i) => (i === 2 ? trendOf(report) : null))] };
  }, { ...kNightly, trends });
  browser = await startBrowser();
});
afterAll(async () => {
  removeChanged();
  await browser.close();
});

describe.each([["1280x900", { width: 1280, height: 900 }], ["390x844", { width: 390, height: 844 }]] as const)("a report with a history at %s", (_name, viewport) => {
  const open = async (hash: string): Promise<{ page: Page; problems: () => string[] }> => {
    const opened = await openReport(browser, folder, hash, { viewport });
    return { page: opened.page, problems: () => realProblems(opened) };
  };

  it("says in its head and its list how rows stand, and filters by that", async () => {
    const { page, problems } = await open("#sort=order&ascending=true");
    expect((await page.innerText(".since")).replace(/\s+/g, " ")).toMatch(/^Since the last run of main: .*1 fixed, 1 still failing, 1 flaky/);
    await page.click(".since a.still");
    await expect.poll(() => page.locator(".list .row").count()).toBe(1);
    await expect.poll(() => page.innerText(".list .row .standing")).toBe(viewport.width < 760 ? "12 nights" : "failing for 12 nights");
    await expect.poll(() => page.textContent(".list .row .owner")).toBe("owner characters");
    expect(await page.evaluate(() => { const row = document.querySelector(".list .row")!; return row.scrollHeight - row.clientHeight; })).toBeLessThanOrEqual(0);
    expect(problems()).toEqual([]);
    expect(await violations(page)).toEqual([]);
  });

  it("has a tab with the figures, the changes and the approved pictures of a row", async () => {
    const { page, problems } = await open(`${hashOfItem("real", 2)}&tab=history`);
    await page.waitForSelector("parity-run-chart canvas");
    await expect.poll(() => page.textContent(".standing-line")).toContain("failing for 12 nights");
    await expect.poll(() => page.textContent(".trend-head")).toMatch(/^Fails for 12 nights, since 2026-11-12 \(\w{12}\); cause: asset\./);
    const [newest, , oldest] = await page.locator("parity-history section", { hasText: "Changes" }).locator("tbody tr").allInnerTexts();
    expect(newest).toMatch(/^2026-11-13.*not known$/s);
    expect(oldest).toMatch(/^2026-11-05.*changed.*0.120 → 0.140 and 2 more.*build$/s);
    await expect.poll(() => page.locator(".approved img").count()).toBe(6);
    await page.focus("parity-run-chart .plot");
    await page.keyboard.press("ArrowLeft");
    await expect.poll(() => page.textContent(".chart-at")).toMatch(/^this run: 0\.\d{3}$/);
    await page.selectOption("parity-history select", "bias.ev");
    await expect.poll(() => page.innerText("parity-history .approve .command code")).toMatch(/^parity approve \. --scene materials --view auto --material 'brushed steel' --owner WHO/);
    expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
    expect(problems()).toEqual([]);
    expect(await violations(page)).toEqual([]);
  });

  it("says of a row that no run has that none has it", async () => {
    const { page } = await open(`${hashOfItem("real", 3)}&tab=history`);
    await expect.poll(() => page.textContent(".trend-head")).toBe("No earlier run has this row.");
  });
});

it("has no such tab without a history", async () => {
  const { page } = await openReport(browser, changedData("real", (report) => void Object.assign(report, { suite: "nightly" })), `${hashOfItem("real", 2)}&tab=history`);
  await page.waitForSelector("parity-item h2");
  expect(await page.locator("#tab-history").count()).toBe(0);
  await expect.poll(() => page.getAttribute("#tab-compare", "aria-selected")).toBe("true");
});
