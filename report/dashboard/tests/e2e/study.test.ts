import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { Nights } from "../../src/data/history";
import { makeNights, nightsPage } from "../make_nights";
import { openReport, reportFolder, settle, startBrowser } from "./browser";

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
    await expect.poll(() => page.innerText("parity-study")).toContain("<img src=x");
    expect(await page.innerText("parity-study")).not.toMatch(/undefined|\[object/);
    expect(requests.length).toBe(1);
    expect(problems).toEqual([]);
    expect(readFileSync(join(reportFolder(name), "index.html"), "utf8")).not.toContain("</script></svg>");
  });

  it("changes its colours by a key, and prints without controls but with the heads of its tables", async () => {
    const { page } = await openReport(browser, reportFolder(name));
    await page.keyboard.press("l");
    await expect.poll(() => page.getAttribute("html", "data-theme")).toBe("dark");
    await page.emulateMedia({ media: "print" });
    expect(await page.isVisible(".head-buttons")).toBe(false);
    await expect.poll(() => page.isVisible("parity-table thead .sort >> nth=0")).toBe(true);
  });
});

describe("a sweep", () => {
  it("shows pictures against the truth and the high-end default, of preparation, and tables of each stage", async () => {
    const { page } = await openReport(browser, reportFolder("sweep"));
    await expect.poll(() => page.locator("parity-pareto svg").count()).toBe(2 * 3 - 2 + 2 * 0 + 1 + 1);
    for (const label of ["Settings, shading", "Settings, preparation", "Settings, storage", "Error saved by a millisecond", "Fastest settings within the budget", "Comparison with the earlier sweep"])
      await expect.poll(() => page.locator(`[aria-label="${label}"]`).count(), { message: label }).toBeGreaterThan(0);
    await expect.poll(() => page.textContent(".notice.error")).toContain("<img");
    await expect.poll(() => page.textContent('[aria-label="Comparison with the earlier sweep"]')).toContain("slower");
  });

  it("says which settings are on the front of their path", async () => {
    const { page } = await openReport(browser, reportFolder("sweep"));
    await expect.poll(() => page.locator("h3", { hasText: "Settings of each path: shading" }).count()).toBeGreaterThan(0);
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
    await expect.poll(() => picture.locator(".plot-hover").textContent()).toMatch(/mobile: .* ms, 0\.\d+/);
    await picture.locator("input").nth(1).uncheck();
    expect(await picture.locator("circle.dot.path-1").first().isVisible()).toBe(false);
    await expect.poll(() => picture.locator("circle.dot.path-0").first().isVisible()).toBe(true);
  });
});

describe("a stress run", () => {
  it("shows what is new with its command, what is known, maps, functions and scenes", async () => {
    const { page } = await openReport(browser, reportFolder("stress"));
    await expect.poll(() => page.textContent("h1")).toMatch(/fail.*6 unexpected, 1 expected finding/s);
    await expect.poll(() => page.locator(".finding .command code").first().textContent()).toContain("parity stress --");
    expect(await namesIn(page, "Known findings")).toEqual(["scene"]);
    expect(await namesIn(page, "Functions")).toContain("planted");
    await expect.poll(() => page.textContent('[aria-label="Functions"]')).toContain("skipped: a device without shaderFloat16");
    await expect.poll(() => page.textContent('[aria-label="Scenes"]')).toContain("✓, 1 expected");
    const painted = page.locator('canvas[aria-label="planted, cpu fp16"]');
    expect(await painted.evaluate((canvas: HTMLCanvasElement) => canvas.getContext("2d")!.getImageData(12, 2, 1, 1).data[3])).toBe(255);
    await painted.hover();
    await expect.poll(() => page.locator(".map-x", { hasText: ":" }).textContent()).toMatch(/^0\.\d\d, 0\.\d\d: /);
  });
});

describe("nightly runs", () => {
  const folders: string[] = [];
  afterAll(() => folders.forEach((each) => rmSync(each, { recursive: true, force: true })));

  /** The folder of a page of these nights, with the script and the style of a report. */
  function folderOf(nights: unknown): string {
    const folder = mkdtempSync(join(tmpdir(), "parity-nights-"));
    folders.push(folder);
    for (const file of ["dashboard.js", "dashboard.css"]) copyFileSync(join(reportFolder("empty"), file), join(folder, file));
    writeFileSync(join(folder, "index.html"), nightsPage(nights));
    return folder;
  }

  /** 400 nights and 500 rows, one of them named to break out. */
  function evilNights(): Nights {
    const nights = makeNights(400, 500, 0.01), evil = '<img src=x onerror="window.broken = 1">';
    const last = nights.runs.at(-1)!, trend = Object.values(nights.rows)[0]!;
    const change = { run: 399, kind: "regressed", cause: evil, metric: "flip.mean", before: 0.1763, after: 0.2, figures: 11 } as const;
    const changes = [{ ...change, row: evil }, ...last.changes];
    return { ...nights, rows: { ...nights.rows, [evil]: { ...trend, changes: [...trend.changes, change] } }, runs: [...nights.runs.slice(0, -1), { ...last, events: { ...last.events, regressed: 1, changed: 70 }, changes, commit: "1b2c3d4e5f60718293a4b5c6d7e8f90112233445" }] };
  }

  it("show charts, the last night, its changes with causes, and lead to a row and back", async () => {
    const { page, problems, requests } = await openReport(browser, folderOf(evilNights()));
    await expect.poll(() => page.textContent("h1")).toMatch(/nightly, main: 400 nights; last: 1 new failure, \d+ failing/);
    await expect.poll(() => page.locator("parity-night-chart canvas").count()).toBe(3);
    await expect.poll(() => page.locator('[aria-label="Nights"] tbody tr').count()).toBe(30);
    await page.click("text=Show all 400");
    await expect.poll(() => page.locator('[aria-label="Nights"] tbody tr').count()).toBe(400);

    const changes = page.locator('[aria-label="Changes of the night"] tbody tr');
    await expect.poll(() => changes.first().innerText()).toMatch(/<img src=x.*regressed.*flip\.mean 0\.1763 → 0\.2 worse.*10 figures.*<img/s);
    await expect.poll(() => page.textContent("parity-night")).toMatch(/And \d+ more, which this page does not list/);
    await page.click(".chip.kind-regressed");
    await expect.poll(() => changes.count()).toBe(1);
    await changes.first().locator("a").click();
    await page.waitForSelector("parity-night-row parity-run-chart canvas");
    await expect.poll(() => page.textContent("parity-night-row h3")).toContain("<img src=x");
    expect(new URL(page.url()).hash).toMatch(/^#night=.*&row=/);
    await page.selectOption("parity-night-row select", "flip.p95");
    expect(new URL(page.url()).hash).toMatch(/&figure=flip\.p95$/);
    await page.reload();
    await page.waitForSelector("parity-night-row parity-run-chart canvas");
    await expect.poll(() => page.inputValue("parity-night-row select")).toBe("flip.p95");

    await page.waitForFunction(() => document.activeElement?.matches("parity-night-row h3")); // it takes the focus a frame later
    await page.keyboard.press("/");
    await page.keyboard.type("chrome 003");
    for (const name of await page.locator(".night-row-list a").allTextContents()) expect(name).toMatch(/003.*Chrome/);
    expect(await page.evaluate(() => (window as unknown as { broken?: number }).broken)).toBeUndefined();
    expect(await page.innerText("parity-study")).not.toMatch(/undefined|\[object|NaN/);
    expect(await page.locator("img").count()).toBe(0);
    expect([problems, requests.filter((url) => !/(index\.html|dashboard\.(js|css))(#|$)/.test(url))]).toEqual([[], []]);
  });

  it("choose the night that is clicked, and are no wider than a phone", async () => {
    const { page, problems } = await openReport(browser, folderOf(makeNights(400, 500, 0.01)), "", { viewport: { width: 390, height: 800 } });
    await settle(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    const before = await page.textContent("parity-night h2");
    const readouts = (): Promise<string[]> => page.locator(".night-readout").allTextContents();
    const last = await readouts();
    const box = (await page.locator("parity-night-chart .u-over").first().boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + 20);
    await expect.poll(readouts).not.toEqual(last);
    const pointed = await readouts();
    expect(new Set(pointed.map((each) => each.slice(0, 10))).size, "one cursor for all charts").toBe(1);
    await page.mouse.click(box.x + box.width / 2, box.y + 20);
    await page.waitForFunction((text) => document.querySelector("parity-night h2")?.textContent !== text, before);
    await expect.poll(() => page.textContent("parity-night h2")).toContain(pointed[0]!.slice(0, 10));
    expect(problems).toEqual([]);
  });

  it("that are none, one, or of another format are words", async () => {
    const text = async (nights: unknown): Promise<string> => (await openReport(browser, folderOf(nights))).page.innerText("#app");
    expect(await text(makeNights(0, 10))).toContain("no nights yet");
    expect(await text(makeNights(1, 10))).toContain("nothing to draw yet");
    expect(await text({ format: 2 })).toContain("this page reads format 1");
  });
});
