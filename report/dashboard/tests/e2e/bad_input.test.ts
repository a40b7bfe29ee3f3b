import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";

import { changedReport, openReport, readReport, realProblems, removeChanged, reportFolder, startBrowser } from "./browser";

let browser: Browser;
beforeAll(async () => (browser = await startBrowser()));
afterAll(async () => browser.close());
afterEach(removeChanged);

/** Whether anything that a name holds was run. */
const isBroken = (page: Page): Promise<unknown> => page.evaluate(() => (window as unknown as { broken?: number }).broken);

describe("names that try to break out", () => {
  it("are shown as they are in the list, each row apart", async () => {
    const opened = await openReport(browser, reportFolder("evil"), "#sort=order&ascending=true");
    const { page } = opened;
    await page.waitForSelector(".list .row");
    const names = new Set<string>();
    for (let top = 0; top < 6000; top += 400) {
      await page.evaluate(async (at) => {
        (document.querySelector(".list-scroll") as HTMLElement).scrollTo(0, at);
        await new Promise((done) => requestAnimationFrame(done)); // after the event of the scrolling, which draws the rows
      }, top);
      for (const name of await page.locator(".list .row .name").allTextContents()) names.add(name);
    }
    for (const name of ["<script>window.broken = 1</script>", "🎨🧑‍🎨 emoji", "خشب لامع", "(no name)", "twice", "x".repeat(10000)]) expect(names.has(name), name.slice(0, 40)).toBe(true);
    await expect.poll(() => page.textContent(".notices"), { message: "what the run survived" }).toContain("flaky crash: a worker crashed with");
    expect(await isBroken(page)).toBeUndefined();
    expect(realProblems(opened)).toEqual([]);
  });

  it("are harmless in every tab of every item, also without any picture", async () => {
    const opened = await openReport(browser, reportFolder("evil"), "#sort=order&ascending=true");
    const { page } = opened;
    await page.waitForSelector(".list .row");
    const count = Number(await page.getAttribute(".list", "aria-rowcount")) - 1;
    expect(count).toBeGreaterThan(16);
    for (let i = 0; i < count; ++i) {
      await page.keyboard.press("ArrowDown");
      for (const key of ["t", "n", "c"]) await page.keyboard.press(key);
      await page.waitForSelector("parity-item h2");
      await page.waitForSelector(".item-panel > [role=status]", { state: "detached" }); // its details are there
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      expect(wide, `item ${i} is wider than the page`).toBeLessThanOrEqual(0);
    }
    await expect.poll(() => page.textContent("parity-item .place")).toBe(`${count} of ${count}`);
    expect(await isBroken(page)).toBeUndefined();
    expect(realProblems(opened)).toEqual([]);
  });

  it("are told apart where two are called alike", async () => {
    const { page } = await openReport(browser, reportFolder("evil"), "#query=twice");
    await page.waitForSelector(".list .row");
    const links = await page.locator(".list .row .name").evaluateAll((all) => all.map((each) => (each as HTMLAnchorElement).href));
    expect(new Set(links).size).toBe(2);
  });
});

describe("figures that are not known", () => {
  it("are dashes or words, never NaN, and the item opens", async () => {
    const opened = await openReport(browser, reportFolder("broken"), "#sort=order&ascending=true");
    const { page } = opened;
    await page.waitForSelector(".list .row");
    const count = Number(await page.getAttribute(".list", "aria-rowcount")) - 1;
    expect(count).toBe(3);
    for (let i = 0; i < count; ++i) {
      await page.keyboard.press("ArrowDown");
      for (const key of ["n", "t", "c"]) {
        await page.keyboard.press(key);
        await page.waitForSelector(key === "n" ? "parity-numbers" : key === "t" ? "parity-terms" : "parity-viewer");
        const text = (await page.innerText("parity-item")).replace(/pixels? (that )?(is|are) NaN or infinite/g, "");
        expect(text).not.toMatch(/NaN|undefined|Infinity|\[object/);
      }
    }
    expect(realProblems(opened)).toEqual([]);
  });

  it("are no bare tokens in the page's data", () => {
    for (const name of ["broken", "evil", "empty"]) {
      const html = readFileSync(join(reportFolder(name), "index.html"), "utf8");
      const block = /<script type="application\/json" id="report">([\s\S]*?)<\/script>/.exec(html)?.[1] ?? "";
      const { scenes, ...head } = readReport(name);
      expect(JSON.parse(block)).toEqual(head);
      scenes.forEach((scene, i) => {
        const script = readFileSync(join(reportFolder(name), "scenes", `${i}.js`), "utf8");
        expect(JSON.parse(/^parityScene\((.*)\);\n$/s.exec(script)?.[1] ?? "")).toMatchObject({ file: `scenes/${i}.js`, scene });
      });
    }
  });
});

describe("reports that are not as expected", () => {
  it("of no rows: say so, and nothing breaks", async () => {
    const opened = await openReport(browser, reportFolder("empty"));
    await expect.poll(() => opened.page.textContent("h1")).toContain("Nothing was compared");
    await expect.poll(() => opened.page.textContent(".nothing")).toContain("Nothing");
    await opened.page.keyboard.press("ArrowDown");
    expect(await opened.page.locator("parity-item").count()).toBe(0);
    expect(opened.problems).toEqual([]);
  });

  it("of another schema version: are refused in words that name both", async () => {
    const folder = changedReport("empty", (html) => html.replace(/"schema":\s*\d+/, '"schema":99'));
    const opened = await openReport(browser, folder);
    await expect.poll(() => opened.page.textContent(".failure")).toMatch(/schema version 99.*version \d+\./s);
    expect(opened.problems).toEqual([]);
  });

  it("with damaged or missing data: say so", async () => {
    const damaged = changedReport("empty", (html) => html.replace(/(id="report">)\{/, "$1{,"));
    expect(await (await openReport(browser, damaged)).page.textContent(".failure")).toContain("damaged");
    const none = changedReport("empty", (html) => html.replace('id="report"', 'id="other"'));
    expect(await (await openReport(browser, none)).page.textContent(".failure")).toContain("no report");
    const run = changedReport("broken", (html) => html.replace(/(id="run">)\{/, "$1{,"));
    const opened = await openReport(browser, run);
    await opened.page.waitForSelector(".list .row");
    expect(opened.problems).toEqual([]);
  });

  it("with a hash that makes no sense: show the overview", async () => {
    const opened = await openReport(browser, reportFolder("broken"), "#scene=7&view=9&material=3&zoom=NaN&mode=evil&sort=%3Cb%3E");
    await opened.page.waitForSelector(".list .row");
    expect(await opened.page.locator("parity-item").count()).toBe(0);
    expect(opened.problems).toEqual([]);
  });
});
