// The details of a scene come from its file when one of its rows is opened.
import { rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";

import { changedReport, closePages, hashOfItem, openReport, readReport, realProblems, removeChanged, reportFolder, settle, startBrowser } from "./browser";

let browser: Browser;
beforeAll(async () => (browser = await startBrowser()));
afterAll(async () => browser.close());
afterEach(removeChanged);

const scenesOf = (requests: readonly string[]): string[] => requests.filter((url) => url.includes("/scenes/")).map((url) => basename(url));
const notice = (page: Page): Promise<string | null> => page.textContent("parity-item .notice.error");

describe("the details of a scene", () => {
  it("are not asked for by the list", async () => {
    const opened = await openReport(browser, reportFolder("many"));
    await opened.page.waitForSelector(".list .row");
    await settle(opened.page);
    expect(scenesOf(opened.requests)).toEqual([]);
  });

  it("are asked for once, when a row of the scene is opened, with those of the rows beside it", async () => {
    const opened = await openReport(browser, reportFolder("many"), `${hashOfItem("many", 9, 3, 4)}&sort=order&ascending=true`);
    await opened.page.waitForSelector("parity-item .checks");
    await expect.poll(() => scenesOf(opened.requests).sort()).toEqual(["3.js", "4.js"]); // its last row in the list
    await opened.page.keyboard.press("ArrowDown");
    await expect.poll(() => opened.page.textContent("parity-item .item-head .place")).toContain("Scene 5");
    await opened.page.waitForSelector("parity-item .checks");
    await opened.page.keyboard.press("ArrowUp");
    await expect.poll(() => opened.page.textContent("parity-item .item-head .place")).toContain("Scene 4");
    await settle(opened.page);
    expect(scenesOf(opened.requests).sort()).toEqual(["3.js", "4.js"]);
    expect(opened.problems).toEqual([]);
  });

  it("in a report in one file are in it", async () => {
    const opened = await openReport(browser, reportFolder("single"), hashOfItem("single", 0, 1));
    await opened.page.waitForSelector("parity-item .checks");
    expect(scenesOf(opened.requests)).toEqual([]);
    expect(opened.problems).toEqual([]);
  });

  it("say the time of the scene", async () => {
    const { page } = await openReport(browser, reportFolder("real"), `${hashOfItem("real")}&tab=numbers`);
    await page.waitForSelector("parity-numbers");
    await expect.poll(() => page.innerText("parity-numbers")).toMatch(/Time of this scene\s+[\d.]+ s/);
  });

  it("that are missing, damaged or another report's leave the list and the head of the item, and say so", async () => {
    const folder = changedReport("many", (html) => html.replace("<title>", "<title>changed "));
    const [scene] = readReport("many").scenes;
    const cases: [string, (file: string) => void, RegExp][] = [
      ["missing", (file) => rmSync(file), /scenes\/0\.js is missing or cannot be read/],
      ["damaged", (file) => writeFileSync(file, "parityScene({"), /scenes\/0\.js/],
      ["empty", (file) => writeFileSync(file, ""), /scenes\/0\.js holds no scene/],
      ["another's", (file) => writeFileSync(file, `parityScene(${JSON.stringify({ file: "scenes/0.js", format: 1, scene: { ...scene, name: "Sofa" } })})`), /of another report: it holds the scene Sofa/],
      ["without the view", (file) => writeFileSync(file, `parityScene(${JSON.stringify({ file: "scenes/0.js", format: 1, scene: { ...scene, views: [] } })})`), /does not have it/],
    ];
    for (const [what, spoil, words] of cases) {
      rmSync(join(folder, "scenes", "0.js"), { force: true });
      spoil(what === "missing" ? join(folder, "scenes", "1.js") : join(folder, "scenes", "0.js"));
      const opened = await openReport(browser, folder, hashOfItem("many"));
      await opened.page.waitForSelector("parity-item .notice.error");
      expect(await notice(opened.page), what).toMatch(words);
      await expect.poll(() => opened.page.textContent("#item-title"), { message: what }).toContain("Material 1");
      await opened.page.keyboard.press("Escape");
      await opened.page.waitForSelector(".list .row");
      if (what !== "damaged") expect(realProblems(opened), what).toEqual([]);
      await closePages();
    }
  });
});
