import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { openReport, reportFolder, startBrowser } from "./browser";

let browser: Browser;
beforeAll(async () => (browser = await startBrowser()));
afterAll(async () => browser.close());

/** The first cells of a table, by its label. */
const namesIn = (page: Page, label: string): Promise<string[]> => page.locator(`[aria-label="${label}"] tbody th`).allTextContents();

describe.each(["sweep", "stress"])("the page of a %s", (name) => {
  it("asks for nothing, runs nothing that a name holds, and has no problem", async () => {
    const { page, problems, requests } = await openReport(browser, reportFolder(name));
    expect(await page.evaluate(() => (window as unknown as { broken?: number }).broken)).toBeUndefined();
    expect(await page.locator("img").count()).toBe(0);
    expect(await page.innerText("parity-study")).toContain("<img src=x");
    expect(await page.innerText("parity-study")).not.toMatch(/undefined|\[object/);
    expect(requests.length).toBe(1);
    expect(problems).toEqual([]);
    expect(readFileSync(join(reportFolder(name), "index.html"), "utf8")).not.toContain("</script></svg>");
  });

  it("changes its colours by a key, and prints without controls but with the heads of its tables", async () => {
    const { page } = await openReport(browser, reportFolder(name));
    await page.keyboard.press("l");
    expect(await page.getAttribute("html", "data-theme")).toBe("dark");
    await page.emulateMedia({ media: "print" });
    expect(await page.isVisible(".head-buttons")).toBe(false);
    expect(await page.isVisible("parity-table thead .sort >> nth=0")).toBe(true);
  });
});

describe("a sweep", () => {
  it("shows pictures against the truth and the high-end default, of preparation, and tables of each stage", async () => {
    const { page } = await openReport(browser, reportFolder("sweep"));
    expect(await page.locator("parity-pareto svg").count()).toBe(2 * 3 - 2 + 2 * 0 + 1 + 1);
    for (const label of ["Settings, shading", "Settings, preparation", "Settings, storage", "Error saved by a millisecond", "Fastest settings within the budget", "Comparison with the earlier sweep"])
      expect(await page.locator(`[aria-label="${label}"]`).count(), label).toBeGreaterThan(0);
    expect(await page.textContent(".notice.error")).toContain("<img");
    expect(await page.textContent('[aria-label="Comparison with the earlier sweep"]')).toContain("slower");
  });

  it("says which settings are on the front of their path", async () => {
    const { page } = await openReport(browser, reportFolder("sweep"));
    expect(await page.locator("h3", { hasText: "Settings of each path: shading" }).count()).toBeGreaterThan(0);
    const rows = page.locator('[aria-label="Settings, shading"]').first().locator("tbody tr");
    for (const text of await rows.locator("th").allTextContents()) expect(text).toMatch(/(dominated|on the front)$/);
  });

  it("sorts its settings up, down and back", async () => {
    const { page } = await openReport(browser, reportFolder("sweep"));
    const first = page.locator('[aria-label="Settings, shading"]').first();
    const times = async (): Promise<number[]> => (await first.locator("tbody tr td:nth-child(2)").allTextContents()).map(Number);
    const before = await times();
    const rising = [...before].sort((a, b) => a - b);
    const head = first.locator("button.sort", { hasText: "device ms" });
    for (const expected of [rising, [...rising].reverse(), before]) {
      await head.press("Enter");
      expect(await times()).toEqual(expected);
    }
  });

  it("says which setting is pointed at, and hides a path", async () => {
    const { page } = await openReport(browser, reportFolder("sweep"));
    const picture = page.locator("parity-pareto").first();
    await picture.locator("circle.dot.path-1").last().hover({ force: true });
    expect(await picture.locator(".plot-hover").textContent()).toMatch(/mobile: .* ms, 0\.\d+/);
    await picture.locator("input").nth(1).uncheck();
    expect(await picture.locator("circle.dot.path-1").first().isVisible()).toBe(false);
    expect(await picture.locator("circle.dot.path-0").first().isVisible()).toBe(true);
  });
});

describe("a stress run", () => {
  it("shows what is new with its command, what is known, maps, functions and scenes", async () => {
    const { page } = await openReport(browser, reportFolder("stress"));
    expect(await page.textContent("h1")).toMatch(/fail.*6 unexpected, 1 expected finding/s);
    expect(await page.locator(".finding .command code").first().textContent()).toContain("parity stress --");
    expect(await namesIn(page, "Known findings")).toEqual(["scene"]);
    expect(await namesIn(page, "Functions")).toContain("planted");
    expect(await page.textContent('[aria-label="Functions"]')).toContain("skipped: a device without shaderFloat16");
    expect(await page.textContent('[aria-label="Scenes"]')).toContain("✓, 1 expected");
    const painted = page.locator('canvas[aria-label="planted, cpu fp16"]');
    expect(await painted.evaluate((canvas: HTMLCanvasElement) => canvas.getContext("2d")!.getImageData(12, 2, 1, 1).data[3])).toBe(255);
    await painted.hover();
    expect(await page.locator(".map-x", { hasText: ":" }).textContent()).toMatch(/^0\.\d\d, 0\.\d\d: /);
  });
});
