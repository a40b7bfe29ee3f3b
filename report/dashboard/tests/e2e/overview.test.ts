import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it, vi } from "vitest";

import { closePages, hashOfItem, openReport, readReport, reportFolder, settle, startBrowser } from "./browser";
import { rowsOf } from "../pack_overview";

let browser: Browser;
beforeAll(async () => (browser = await startBrowser()));
afterAll(async () => browser.close());

describe("the overview of 500 materials", () => {
  it("says the verdict and lists what failed first, from a folder, asking for nothing outside of it", async () => {
    const opened = await openReport(browser, reportFolder("many"));
    const { page } = opened;
    await expect.poll(() => page.textContent("h1")).toContain("over budget");
    await expect.poll(() => page.getAttribute(".list", "aria-rowcount")).toBe("501");
    const first = await page.textContent(".list .row >> nth=0");
    expect(first).toContain("fail");
    const root = new URL(".", page.url()).href;
    expect(opened.requests.filter((url) => !url.startsWith(root) && !url.startsWith("data:"))).toEqual([]);
    expect(opened.problems).toEqual([]);
  });

  it("finds the materials of which no path models every part, and says so in the list and in the item", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    await page.fill("#search", "base layer clearcoat");
    await page.waitForFunction(() => document.querySelector(".shown")?.textContent === "50 of 500 rows");
    const badges = await page.locator(".list .row").evaluateAll((rows) => rows.map((row) => row.querySelectorAll(".badge.base-layer").length));
    expect(new Set(badges)).toEqual(new Set([1]));
    await page.click(".list .row .name >> nth=0");
    await page.waitForSelector("parity-item h2 .badge.base-layer");
    await expect.poll(() => page.textContent("parity-item .facts")).toContain("No path models these parts: clearcoat, sheen");
  });

  it("says which lights mobile drops from a material, and from a view, and what they do", async () => {
    const { page } = await openReport(browser, reportFolder("many"), `${hashOfItem("many")}&tab=terms`);
    await page.waitForSelector(".dropped-lights tbody tr");
    await expect.poll(() => page.locator(".dropped-lights tbody th").allTextContents()).toEqual(["lamp 2", "lamp 1"]);
    await expect.poll(() => page.textContent(".dropped-lights tbody tr >> nth=0")).toContain("0.250");
    const { page: view } = await openReport(browser, reportFolder("many"), `${hashOfItem("many", -1)}&tab=terms`);
    await view.waitForSelector(".dropped-lights tbody tr");
    await expect.poll(() => view.textContent(".dropped-lights tbody tr >> nth=1")).toContain("Material 2 0.031, Material 1 0.020");
    await expect.poll(() => view.textContent(".dropped-lights details")).toContain("lamp 4");
  });

  it("finds by words, filters by verdict and cause, and says how many are left", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    const caused = rowsOf(readReport("many")).filter((row) => row.cause?.term === "skySpecular").length;
    expect(caused).toBeGreaterThan(10);
    await page.fill("#search", "skyspec material");
    await page.waitForFunction((count) => document.querySelector(".shown")?.textContent === `${count} of 500 rows`, caused);
    await page.fill("#search", "");
    await page.keyboard.press("Escape");
    await page.keyboard.press("8");
    await page.waitForFunction(() => document.querySelector(".shown")?.textContent?.includes(" of 500"));
    await expect.poll(() => page.textContent(".list .row >> nth=0")).toContain("pass");
    await page.keyboard.press("1");
    await page.selectOption("text=Cause >> select", "skySpecular");
    await page.waitForFunction(() => document.querySelector(".shown")?.textContent?.includes(" of 500"));
    await expect.poll(() => page.textContent(".list .row >> nth=0")).toContain("skySpecular");
  });

  it("sorts by a column, both ways", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    const top = async (): Promise<number> => Number(await page.textContent(".list .row >> nth=0 >> .cell-flip-mean .value"));
    await page.click("button.sort:has-text('Mean FLIP')");
    await page.waitForSelector("[aria-sort=descending]:has-text('Mean FLIP')");
    const most = await top();
    await page.click("button.sort:has-text('Mean FLIP')");
    await page.waitForSelector("[aria-sort=ascending]:has-text('Mean FLIP')");
    expect(most).toBeGreaterThan(0.29);
    expect(await top()).toBeLessThan(0.01);
  });

  it("lists views, and opens one", async () => {
    const { page } = await openReport(browser, reportFolder("many"));
    await page.click(".lists button:has-text('Views')");
    await expect.poll(() => page.getAttribute(".list", "aria-rowcount")).toBe("51");
    // On a busy machine the rows may be drawn anew between the press and the release of a click.
    await vi.waitFor(
      async () => {
        if (!(await page.isVisible("parity-item h2"))) await page.click(".list .row .name >> nth=0", { timeout: 10000 });
        await page.waitForSelector("parity-item h2", { timeout: 10000 });
      },
      { timeout: 50000 },
    );
    expect(page.url()).toContain("list=views");
  });

  it("keeps what is shown in the URL: a link shows it to others, and back goes back", async () => {
    const { page } = await openReport(browser, reportFolder("many"), "#query=Material+117&sort=name&ascending=true");
    await expect.poll(() => page.inputValue("#search")).toBe("Material 117");
    await page.click(".list .row .name >> nth=0");
    await page.waitForSelector("parity-item h2");
    const title = await page.textContent("parity-item h2");
    expect(title).toContain("Material 117");
    const { page: other } = await openReport(browser, reportFolder("many"), new URL(page.url()).hash);
    await expect.poll(() => other.textContent("parity-item h2")).toBe(title);
    await page.goBack();
    await page.waitForSelector("parity-item", { state: "detached" });
    await expect.poll(() => page.inputValue("#search")).toBe("Material 117");
  });

  it("goes through the items by keys, shows tabs, and comes back", async () => {
    const { page } = await openReport(browser, reportFolder("many"), "#sort=order&ascending=true");
    const title = async (): Promise<string | null> => page.textContent("parity-item h2 bdi");
    await page.keyboard.press("ArrowDown");
    await page.waitForSelector("parity-item h2");
    expect(await title()).toBe("Material 1");
    await page.keyboard.press("j");
    await page.waitForFunction(() => document.querySelector("parity-item h2 bdi")?.textContent === "Material 2");
    await page.keyboard.press("ArrowUp");
    await page.waitForFunction(() => document.querySelector("parity-item h2 bdi")?.textContent === "Material 1");
    await page.keyboard.press("n");
    await page.waitForSelector("parity-numbers table");
    await expect.poll(() => page.textContent("parity-numbers")).toContain("no local lights");
    await page.keyboard.press("t");
    await page.waitForSelector("parity-terms");
    await page.keyboard.press("?");
    await page.waitForSelector("dialog#shortcuts[open]");
    await page.keyboard.press("Escape");
    await page.waitForSelector("dialog#shortcuts:not([open])", { state: "attached" });
    await page.keyboard.press("Escape");
    await page.waitForSelector("parity-item", { state: "detached" });
  });
});

describe("what is neither a plain pass nor a plain failure", () => {
  const open = async (material: number, tab = ""): Promise<string> => {
    const { page, problems } = await openReport(browser, reportFolder("states"), hashOfItem("states", material) + tab);
    await page.waitForSelector("parity-item h2");
    await settle(page);
    const text = await page.innerText("parity-item");
    expect(problems).toEqual([]);
    await closePages();
    return text;
  };

  it("stands between warnings and passes, each with a filter and a key of its own", async () => {
    const { page } = await openReport(browser, reportFolder("states"));
    const badges = page.locator(".list .row .cell-gravity .badge:not(.base-layer)");
    expect((await badges.allTextContents()).map((each) => each.replace(/^[^a-z]+/, ""))).toEqual(["warn", "warn", "not judged", "too small", "pass", "pass"]);
    expect((await page.locator(".chip").allTextContents()).map((each) => each.trim())).toEqual(["All 6", "Warned 2", "Not judged 1", "Too small 1", "Passed 2"]);
    for (const [key, name] of [["5", "panel"], ["6", "speck"]] as const) {
      await page.keyboard.press(key);
      await page.waitForFunction(() => document.querySelector(".shown")?.textContent === "1 of 6 rows");
      await expect.poll(() => page.textContent(".list .row .name")).toBe(name);
      await page.keyboard.press("1");
      await page.waitForFunction(() => document.querySelector(".shown")?.textContent === "6 rows");
    }
  });

  it("says how many pixels are too few, and that no check counts", async () => {
    const text = await open(1);
    expect(text).toMatch(/12 pixels, fewer than min_pixels = 64/);
    expect(text).toMatch(/no check counts/);
  });

  it("says what is clipped in both pictures, of a material and of a view, with its share", async () => {
    expect(await open(2)).toMatch(/Clipped in both pictures: 80.0 % white\?/);
    expect(await open(-1)).toContain("30.0 % black, 2.0 % white");
    expect(await open(0)).not.toContain("Clipped");
  });

  it("has the clipped shares among the numbers", async () => {
    expect(await open(3, "&tab=numbers")).toMatch(/white in both pictures\s+12.5 %/);
  });

  it("says which check could not be judged, and why", async () => {
    const text = await open(5);
    expect(text).toMatch(/not judged/);
    expect(text).toMatch(/too dark to measure a difference of exposure/);
  });

  it("shows the whole pictures' FLIP map where a material's own has no values, and says so", async () => {
    const words = "of the whole pictures; the own map of each material needs pixel values";
    expect(await open(0)).toContain(words);
    expect(await open(-1)).not.toContain("the own map of each material needs pixel values");
  });
});

describe("5,000 rows", () => {
  it("keep only those in sight in the page, wherever one scrolls", async () => {
    const { page, problems } = await openReport(browser, reportFolder("huge"), "#sort=order&ascending=true");
    await page.waitForSelector(".list .row");
    await expect.poll(() => page.getAttribute(".list", "aria-rowcount")).toBe("5001");
    for (const share of [0.5, 1, 0]) {
      await page.evaluate((at) => {
        const list = document.querySelector(".list-scroll") as HTMLElement;
        list.scrollTop = at * list.scrollHeight;
      }, share);
      const expected = share === 1 ? "Material 5000" : share === 0 ? "Material 1" : "Material 2500";
      await page.waitForFunction((name) => [...document.querySelectorAll(".list .row .name")].some((each) => each.textContent === name), expected);
      expect(await page.locator(".list .row").count()).toBeLessThan(40);
    }
    expect(problems).toEqual([]);
  });
});
