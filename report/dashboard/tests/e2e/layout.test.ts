// What is in sight without scrolling, on a desktop's screen and on a phone's.
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { closePages, hashOfItem, openReport, reportFolder, settle, startBrowser } from "./browser";

let browser: Browser;
beforeAll(async () => (browser = await startBrowser()));
afterAll(async () => browser.close());

const kScreens = [
  ["1440x900", { width: 1440, height: 900 }],
  ["390x844", { width: 390, height: 844 }],
] as const;

/** What of these elements is out of the window or cut by what scrolls around them; [] if all of it is in sight. */
function outOfSight(page: Page, selectors: readonly string[]): Promise<string[]> {
  return page.evaluate((all) => {
    const hidden: string[] = [];
    for (const selector of all) {
      const elements = [...document.querySelectorAll<HTMLElement>(selector)];
      if (elements.length === 0) hidden.push(`no ${selector}`);
      for (const element of elements) {
        const box = element.getBoundingClientRect();
        const within = (outer: { left: number; top: number; right: number; bottom: number }): boolean =>
          box.left >= outer.left - 1 && box.top >= outer.top - 1 && box.right <= outer.right + 1 && box.bottom <= outer.bottom + 1;
        const isCut = ((): boolean => {
          for (let outer = element.parentElement; outer !== null && outer !== document.documentElement; outer = outer.parentElement)
            if (getComputedStyle(outer).overflowY !== "visible" && !within(outer.getBoundingClientRect())) return true;
          return !within({ left: 0, top: 0, right: innerWidth, bottom: innerHeight });
        })();
        if (box.width === 0 || box.height === 0 || isCut)
          hidden.push(`${selector} ${[box.left, box.top, box.right, box.bottom].map(Math.round).join(" ")}`);
      }
    }
    return hidden;
  }, selectors);
}

/** The share of the window that the panes' pictures have. */
function shareOfPictures(page: Page): Promise<number> {
  return page.evaluate(() => {
    const boxes = [...document.querySelectorAll(".stage")].map((each) => each.getBoundingClientRect());
    return boxes.reduce((sum, box) => sum + box.width * box.height, 0) / (innerWidth * innerHeight);
  });
}

describe.each(kScreens)("an item at %s", (_name, viewport) => {
  const open = async (hash = "", report = "real"): Promise<Page> => {
    const { page } = await openReport(browser, reportFolder(report), hashOfItem(report) + hash, { viewport });
    await page.waitForSelector("parity-pane .world");
    await settle(page);
    return page;
  };

  it.each([
    ["side", ["parity-pane .stage", ".legend.flip .tick"]],
    ["slider", ["parity-pane .stage", ".stage .grip", "#viewer-split"]],
    ["onion", ["parity-pane .stage", "#viewer-opacity"]],
    ["flicker", ["parity-pane .stage", ".tools .hold"]],
    ["difference", ["parity-pane .stage", ".legend.difference .tick"]],
    ["flip", ["parity-pane .stage", ".legend.flip .tick"]],
  ] as const)("has pictures, controls and legend in sight: %s", async (mode, selectors) => {
    const page = await open(`&mode=${mode}`);
    expect(await outOfSight(page, [...selectors, ".tools", "#item-title", "[role=tab]"])).toEqual([]);
    expect(await page.evaluate(() => [document.documentElement.scrollHeight - innerHeight, document.documentElement.scrollWidth - innerWidth])).toEqual([0, 0]);
  });

  it("gives the pictures more room than all else on a phone, and a good part of a desktop's screen", async () => {
    const page = await open("&mode=slider");
    expect(await shareOfPictures(page)).toBeGreaterThan(viewport.width < 760 ? 0.55 : 0.4);
  });

  it("has both legends in sight where pictures have false colours", async () => {
    const page = await open("&falseColor=true");
    expect(await outOfSight(page, ["parity-pane .stage", ".legend.luminance .tick", ".legend.flip .tick"])).toEqual([]);
  });

  it("folds and unfolds the tool bar, and the pictures take what it leaves", async () => {
    const page = await open("&exposure=1&mode=slider");
    const height = async (): Promise<number> => (await page.locator(".panes").boundingBox())?.height ?? 0;
    const isFolded = (): Promise<string | null> => page.getAttribute(".tools .fold", "aria-expanded");
    if ((await isFolded()) === "true") await page.click(".tools .fold");
    await page.waitForSelector("#viewer-more", { state: "hidden" });
    await expect.poll(() => page.textContent(".tools .fold")).toContain("(1)"); // the exposure is not as at first
    const folded = await height();
    await page.click(".tools .fold");
    await page.waitForSelector("#viewer-more", { state: "visible" });
    expect(await isFolded()).toBe("true");
    await expect.poll(height).toBeLessThan(folded);
  });

  it("scrolls to its values and its budget by keys, and another item starts at its top", async () => {
    const page = await open();
    const top = (): Promise<number> => page.evaluate(() => document.querySelector("#panel")!.scrollTop);
    await page.keyboard.press("PageDown");
    await expect.poll(top).toBeGreaterThan(100);
    expect((await outOfSight(page, ["#item-title", "[role=tab]"]))).toEqual([]);
    await page.keyboard.press("j");
    await expect.poll(top).toBe(0);
  });

  it("is no wider than its place in any tab", async () => {
    const page = await open();
    for (const key of ["c", "t", "n"]) {
      await page.keyboard.press(key);
      await settle(page);
      expect(await page.evaluate(() => { const panel = document.querySelector("#panel")!; return panel.scrollWidth - panel.clientWidth; }), key).toBe(0);
    }
  });
});

describe("the row of the open item", () => {
  const openRow = ".row.open";

  it("is in sight in the list, wherever the item is, and by keys", async () => {
    for (const place of [0, 37, 499]) {
      const { page } = await openReport(browser, reportFolder("many"), `${hashOfItem("many", place % 10, Math.floor(place / 50), Math.floor((place % 50) / 10))}&sort=order&ascending=true`, { viewport: { width: 1440, height: 900 } });
      await page.waitForSelector(openRow);
      await expect.poll(() => outOfSight(page, [openRow])).toEqual([]);
      for (let i = 0; i < 12; ++i) await page.keyboard.press(place === 499 ? "k" : "j");
      await expect.poll(async () => (await page.locator(openRow).count()) === 1 && (await outOfSight(page, [openRow])).length === 0).toBe(true);
      await closePages();
    }
  });

  it("stays in sight where the window gets smaller", async () => {
    const { page } = await openReport(browser, reportFolder("many"), `${hashOfItem("many", 9)}&sort=order&ascending=true`, { viewport: { width: 1440, height: 900 } });
    await page.waitForSelector(openRow);
    await page.setViewportSize({ width: 1100, height: 520 });
    await expect.poll(() => outOfSight(page, [openRow])).toEqual([]);
  });

  it("is in sight where a link leads to a view and does not say which list", async () => {
    const { page } = await openReport(browser, reportFolder("many"), hashOfItem("many", -1, 7, 2), { viewport: { width: 1440, height: 900 } });
    await page.waitForSelector(openRow);
    await expect.poll(() => outOfSight(page, [openRow])).toEqual([]);
    await expect.poll(() => page.textContent(`${openRow} .name`)).toBe("Scene 8 · view 3");
  });

  it("is in sight in a group that was folded", async () => {
    const { page } = await openReport(browser, reportFolder("many"), `${hashOfItem("many", 9, 9, 4)}&group=scene&folded=true&sort=order&ascending=true`, { viewport: { width: 1440, height: 900 } });
    await page.waitForSelector(openRow);
    await expect.poll(() => outOfSight(page, [openRow])).toEqual([]);
    await expect.poll(() => page.getAttribute(".list", "aria-rowcount")).toBe(String(1 + 10 + 50)); // the other groups stay folded
  });
});
