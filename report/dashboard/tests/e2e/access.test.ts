import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { violations } from "./axe";
import { changedReport, hashOfItem, openReport, removeChanged, reportFolder, settle, startBrowser } from "./browser";

let browser: Browser;
beforeAll(async () => (browser = await startBrowser()));
afterAll(async () => {
  removeChanged();
  await browser.close();
});

const kPages = [
  ["the overview", "many", ""],
  ["the views", "many", "#list=views"],
  ["an item compared", "real", hashOfItem("real", 0)],
  ["its slider", "real", hashOfItem("real", 0) + "&mode=slider"],
  ["its FLIP map", "real", hashOfItem("real", 0) + "&mode=flip&threshold=0.1"],
  ["its pixels", "real", hashOfItem("real", 0) + "&pixelX=128&pixelY=128"],
  ["its terms", "real", hashOfItem("real", 0) + "&tab=terms"],
  ["its numbers", "real", hashOfItem("real", 0) + "&tab=numbers"],
  ["names that try to break out", "evil", ""],
  ["what is neither passed nor failed", "states", ""],
  ["a clipped material", "states", hashOfItem("states", 2)],
  ["a material of which only the base layer is judged", "states", hashOfItem("states", 4)],
  ["a report of nothing", "empty", ""],
  ["a sweep", "sweep", ""],
  ["a stress run", "stress", ""],
] as const;

describe("axe-core finds nothing serious in", () => {
  it.each(kPages)("%s", async (_what, report, hash) => {
    const { page } = await openReport(browser, reportFolder(report), hash);
    await settle(page);
    expect(await violations(page)).toEqual([]);
    // In the dark: only what the scheme decides.
    await page.emulateMedia({ colorScheme: "dark" });
    expect(await page.evaluate(() => matchMedia("(prefers-color-scheme: dark)").matches)).toBe(true);
    expect(await violations(page, ["color-contrast"])).toEqual([]);
  });
});

describe("a report that cannot be shown", () => {
  it("says so to everyone", async () => {
    const { page } = await openReport(browser, changedReport("empty", (html) => html.replace(/"schema":\s*\d+/, '"schema":99')));
    await expect.poll(() => page.getAttribute(".failure", "role")).toBe("alert");
    expect(await violations(page)).toEqual([]);
  });
});

describe("on a phone", () => {
  it.each(kPages)("%s is no wider than the screen, and what scrolls is reached by keys", async (_what, report, hash) => {
    const { page } = await openReport(browser, reportFolder(report), hash, { viewport: { width: 360, height: 740 }, hasTouch: true });
    await settle(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
    expect(await violations(page, ["scrollable-region-focusable"])).toEqual([]);
  });
});

describe("by keyboard alone", () => {
  it("every control of the overview is reached by Tab, and shows its focus", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    const reached = new Set<string>();
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press("Tab");
      const { what, outlined } = await page.evaluate(() => {
        const focused = document.activeElement as HTMLElement;
        return { what: `${focused.tagName} ${focused.className} ${focused.id}`, outlined: getComputedStyle(focused).outlineStyle !== "none" };
      });
      reached.add(what.split(" ")[0] === "A" ? "A" : what);
      if (what.startsWith("BODY")) break;
      expect(outlined, what).toBe(true);
    }
    for (const what of ["INPUT  search", "A"]) expect([...reached].some((each) => each.startsWith(what)), what).toBe(true);
    expect([...reached].filter((each) => each.startsWith("BUTTON chip")).length).toBeGreaterThan(1);
    expect([...reached].some((each) => each.startsWith("BUTTON sort"))).toBe(true);
  });

  it("goes to the title of what is opened, and back to its row", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    await page.focus(".list .row a.name >> nth=2");
    const name = await page.textContent(".list .row a.name >> nth=2");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.activeElement?.id === "item-title");
    await page.keyboard.press("Escape");
    await page.waitForFunction((text) => document.activeElement?.textContent === text, name);
  });

  it("a ? says what a number means, and Escape puts it away", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    await page.focus("button.help[data-help=mean]");
    await page.keyboard.press("Enter");
    await expect.poll(() => page.textContent(".help-bubble:not([hidden])")).toContain("mean of FLIP");
    await page.keyboard.press("Escape");
    await page.waitForSelector(".help-bubble", { state: "hidden" });
    expect(await page.locator("button.help:not([aria-label])").count()).toBe(0);
  });
});

describe("on paper", () => {
  it.each([["many", ""], ["many", "#group=scene"], ["real", hashOfItem("real", 0)]])("%s %s fits A4 and keeps the names of columns and groups", async (report, hash) => {
    const { page } = await openReport(browser, reportFolder(report), hash);
    await page.emulateMedia({ media: "print" });
    await page.setViewportSize({ width: 794, height: 1123 });
    await settle(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(794);
    if (hash === "" || hash.startsWith("#group")) await expect.poll(() => page.isVisible(".list-head .sort >> nth=0")).toBe(true);
    if (hash.startsWith("#group")) await expect.poll(() => page.isVisible(".row.group button >> nth=0")).toBe(true);
  });

  it("the overview prints its rows in full, without controls", async () => {
    const { page } = await openReport(browser, reportFolder("many"), "#sort=order&ascending=true");
    await page.emulateMedia({ media: "print" });
    await page.waitForFunction(() => document.querySelectorAll(".list .row").length === 500);
    expect(await page.isVisible("#search")).toBe(false);
    const pdf = await page.pdf({ format: "A4" });
    expect(pdf.toString("latin1").match(/\/Type\s*\/Page\b/g)?.length ?? 0).toBeGreaterThan(20);
  });
});
