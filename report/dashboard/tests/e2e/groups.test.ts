// Groups, changes since a baseline, and links that hold both.
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { Change } from "../../src/data/types";
import { changedData, hashOfItem, openReport, readReport, removeChanged, reportFolder, startBrowser } from "./browser";
import { rowsOf } from "../pack_overview";

let browser: Browser;
beforeAll(async () => (browser = await startBrowser()));
afterAll(async () => {
  removeChanged();
  await browser.close();
});

/** What the first materials of each view were in the baseline. */
function beforeOf(place: number, verdict: string): Change | null {
  const change = (verdictThen: Change["verdict"], flip: number): Change => ({ new: false, verdict: verdictThen, notComparable: "", changes: { "flip.mean": flip } });
  switch (place) {
    case 0: return change(verdict === "fail" ? "pass" : "fail", verdict === "fail" ? 0.1 : -0.1);
    case 1: return change(verdict as Change["verdict"], 0.02);
    case 2: return change(verdict as Change["verdict"], -0.02);
    case 3: return { new: true, verdict: null, notComparable: "", changes: {} };
    case 4: return { new: false, verdict: "pass", notComparable: "size: 1 instead of 2", changes: {} };
    default: return change(verdict as Change["verdict"], 0);
  }
}

/** "many" held against a baseline. */
function withBaseline(): string {
  return changedData("many", (report) => {
    report.baseline = { source: "before.json", version: "0", device: "d", common: 450, notComparable: 50, gone: [], error: "" };
    for (const view of report.scenes.flatMap((scene) => scene.views))
      view.materials.forEach((material, i) => (material.baseline = beforeOf(i, material.verdict)));
  });
}

const shown = (page: Page): Promise<string | null> => page.textContent(".shown");
const waitForShown = (page: Page, count: number): Promise<void> => expect.poll(() => shown(page)).toBe(`${count} of 500 rows`);

describe("since a baseline", () => {
  const rows = rowsOf(readReport("many")).filter((row) => row.kind === "material");
  const failing = (place: number): number => rows.filter((row) => row.material === place && row.verdict === "fail").length;
  const failsNow = failing(0);
  const newFailures = failsNow + failing(3) + failing(4); // also of what the baseline does not have, or has under other conditions

  it("the headline counts new failures and what is fixed, and leads to them", async () => {
    const { page, problems } = await openReport(browser, withBaseline());
    const text = (await page.innerText(".since")).replace(/\s+/g, " ");
    expect(text).toContain(`+${newFailures} new failure`);
    expect(text).toContain(`${50 - failsNow} fixed`);
    expect(text).toContain("50 not in the baseline, 50 not comparable");
    await page.click(".since a.new");
    await waitForShown(page, newFailures);
    expect(page.url()).toContain("changes=new");
    await expect.poll(() => page.textContent(".list .row >> nth=0")).toContain("new failure");
    expect(problems).toEqual([]);
  });

  it("filters and a column tell what is worse or better", async () => {
    const { page } = await openReport(browser, withBaseline());
    await page.click(".chips.changes .chip.better");
    await waitForShown(page, 50 + 50 - failsNow);
    await expect.poll(() => page.textContent(".list .row >> nth=0 >> .cell-change")).toMatch(/−0\.\d/);
    await page.click(".chips.changes .chip.better");
    await page.click(".chips.changes .chip.not-comparable");
    await waitForShown(page, 50);
    await expect.poll(() => page.getAttribute(".list .row .tag.not-comparable >> nth=0", "title")).toBe("size: 1 instead of 2");
    await page.click(".chips.changes .chip.not-comparable");
    await page.click("button.sort:has-text('Change')");
    await expect.poll(() => page.textContent(".list .row >> nth=0 >> .cell-change")).toContain("+0.1");
  });

  it("is silent where there is none", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    expect(await page.locator(".since, .chips.changes, .cell-change").count()).toBe(0);
  });
});

describe("groups", () => {
  it("by cause have totals and the worst offenders as links; totals only fold the rows", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    await page.selectOption("select.grouping", "cause");
    await page.waitForSelector(".row.group");
    await page.click(".fold-all");
    await expect.poll(() => page.locator(".list .row:not(.group)").count()).toBe(0);
    const rows = rowsOf(readReport("many")).filter((row) => row.kind === "material" && row.cause?.term === "skySpecular");
    const head = page.locator(".row.group", { hasText: "skySpecular" });
    await expect.poll(() => head.textContent()).toContain(`${rows.length} rows`);
    const worst = await head.locator(".worst a").first().textContent();
    await head.locator(".worst a").first().click();
    await page.waitForSelector("parity-item h2");
    expect(worst).toContain((await page.textContent("parity-item h2 bdi"))!);
  });

  it("open and close one by one, and their rows are stepped through in their order", async () => {
    const { page } = await openReport(browser, reportFolder("many"), "#group=scene&sort=name&ascending=true");
    await page.waitForSelector(".row.group");
    const lines = async (): Promise<number> => Number(await page.getAttribute(".list", "aria-rowcount"));
    expect(await lines()).toBe(511);
    await page.click(".row.group button >> nth=0");
    await expect.poll(lines).toBe(461);
    await page.keyboard.press("Escape");
    await page.keyboard.press("j");
    await page.waitForSelector("parity-item h2");
    await expect.poll(() => page.textContent("parity-item .item-head .place")).toContain("Scene 1 ");
  });

  it("are in the head of the page, too: what failed or warned, by cause", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    await expect.poll(() => page.locator(".causes li").count()).toBeGreaterThan(1);
    await page.click(".causes a.all");
    await page.waitForSelector(".row.group");
    expect(page.url()).toContain("group=cause");
  });
});

describe("what a row says", () => {
  it("names the scene of a view, and what each picture shows", async () => {
    const { page } = await openReport(browser, reportFolder("many"), "#list=views&sort=order&ascending=true");
    await page.waitForSelector(".list .row");
    await expect.poll(() => page.textContent(".list .row .name >> nth=0")).toBe("Scene 1 · view 1");
    await expect.poll(() => page.locator(".list .row >> nth=0 >> .labelled small").allTextContents()).toEqual(["High-end", "Mobile", "FLIP"]);
  });

  it("has bars on one scale, which the head of the column says", async () => {
    const { page } = await openReport(browser, reportFolder("many"), "#sort=flip.mean");
    await page.waitForSelector(".list .row");
    const most = Number(await page.textContent(".list-head .cell-flip-mean .scale span:last-child"));
    const bars = await page.locator(".list .row .cell-flip-mean").evaluateAll((cells) =>
      cells.map((cell) => [Number(cell.querySelector(".value")!.textContent), cell.querySelector(".fill")!.getBoundingClientRect().width / cell.querySelector(".bar")!.clientWidth] as const));
    for (const [value, share] of bars) expect(share, String(value)).toBeCloseTo(value / most, 1);
  });
});

describe("a link", () => {
  it("holds scene, view, material, tab, group and filters by their names", async () => {
    const hash = `${hashOfItem("many", 2, 3, 1)}&tab=terms&group=material&verdicts=fail%2Cpass%2Cwarn&query=material&sort=flip.p95`;
    const { page } = await openReport(browser, reportFolder("many"), hash);
    await page.waitForSelector("parity-item h2");
    const said = (url: string): URLSearchParams => new URLSearchParams(new URL(url).hash.slice(1));
    expect(Object.fromEntries(said(page.url()))).toMatchObject({ scene: "Scene 4", view: "view 2", material: "Material 163", tab: "terms", group: "material" });
    await page.keyboard.press("j");
    await expect.poll(() => said(page.url()).get("material")).not.toBe("Material 163");
    for (const key of ["tab", "group", "verdicts", "query", "sort"]) expect(said(page.url()).get(key), key).toBe(new URLSearchParams(hash.slice(1)).get(key));
    const { page: other } = await openReport(browser, reportFolder("many"), new URL(page.url()).hash);
    await other.waitForSelector("parity-item h2");
    await expect.poll(() => other.textContent("parity-item h2 bdi")).toBe(await page.textContent("parity-item h2 bdi"));
    await expect.poll(() => other.inputValue("#search")).toBe("material");
  });

  it("to what this report does not have says so", async () => {
    const { page } = await openReport(browser, reportFolder("many"), "#scene=Scene+1&view=view+1&material=Gone");
    await expect.poll(() => page.textContent(".notice.error")).toContain("Scene 1 · view 1 · Gone");
  });
});
