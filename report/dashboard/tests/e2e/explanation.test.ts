// What would help an opened material: the panel above its card, and the line in the item's head.
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { ErrorRange, Explanation, Report } from "../../src/data/types";
import { makeExplanation } from "../unit/sample";
import { violations } from "./axe";
import { changedData, hashOfItem, openReport, removeChanged, settle, startBrowser, type Opened } from "./browser";

const kTextured = 2; // brushed steel, whose roughness has a texture
let browser: Browser;
let folder = "";

const range = (quantity: ErrorRange["quantity"], from: number, pixels: number, flip: number): ErrorRange => ({ quantity, from, to: from + 0.1, pixels, flip });

/** Any picture of the report stands for those that --explain adds. */
function explain(report: Report): void {
  const { materials } = report.scenes[0]!.views[0]!;
  const ranges = [range("roughness", 0.2, 0.3, 0.6), range("roughness", 0.3, 0.7, 0.4), range("N.V", 0.9, 1, 1)];
  const { crops } = materials[kTextured]!;
  const explanation: Explanation = makeExplanation({ picture: crops.reference, ranges, masks: [{ input: "roughness", picture: crops.flip, texels: 0.12 }] });
  materials[kTextured]!.explanation = explanation;
  materials[0]!.explanation = { words: "", failure: "too many lights", advice: [], approximations: [], sets: [], advised: 0, picture: "", ranges: [], masks: [] };
}

beforeAll(async () => {
  folder = changedData("real", explain);
  browser = await startBrowser();
});
afterAll(async () => {
  removeChanged();
  await browser.close();
});

describe.each([
  ["1440x900", { width: 1440, height: 900 }],
  ["390x844", { width: 390, height: 844 }],
])("what would help at %s", (_name, viewport) => {
  const open = async (material: number): Promise<Opened> => {
    const opened = await openReport(browser, folder, hashOfItem("real", material), { viewport });
    await opened.page.waitForSelector("parity-viewer");
    return opened;
  };

  it("stands above the card, with its advice, pictures, sets and approximations", async () => {
    const { page, problems } = await open(kTextured);
    await page.waitForSelector(".explanation");
    expect(await page.evaluate(() => [...document.querySelectorAll(".item-panel > section")].map((each) => each.className))).toEqual(["checks", "explanation", "material-card"]);
    await expect.poll(() => page.textContent(".explanation .advice")).toContain("mobile-parallax=on: mean FLIP 0.090 instead of 0.445");
    await expect.poll(() => page.locator(".explained-pictures figcaption").allTextContents()).toEqual(["High-end", "Mobiletoday, FLIP 0.445", "mobile-parallax=onFLIP 0.090"]);
    await expect.poll(() => page.textContent(".explained-sets tr.advised")).toMatch(/mobile-parallax=on advised.*0\.090.*476.*\+13 %/s);
    const rows = page.locator(".approximations tbody tr");
    await expect.poll(() => rows.nth(0).textContent()).toMatch(/\+0\.387.*\+0\.355/s);
    await expect.poll(() => rows.nth(1).textContent()).toContain("alone the other way");
    expect(await rows.nth(2).textContent()).not.toContain("alone the other way");
    const [fill, zero] = await rows.nth(2).locator(".bar >> nth=0").locator(".fill, .zero").evaluateAll((parts) => parts.map((each) => each.getBoundingClientRect()));
    expect(fill!.right).toBeLessThanOrEqual(zero!.right);
    expect(problems).toEqual([]);
  });

  it("shows where the error lies, and marks it on the texture", async () => {
    const { page } = await open(kTextured);
    await page.waitForSelector(".error-places");
    await expect.poll(() => page.locator(".error-range figcaption b").allTextContents()).toEqual(["Roughness", "N.V"]);
    await expect.poll(() => page.getAttribute(".range-plot >> nth=0", "aria-label")).toContain("from 0.2 to 0.3: 60 % of the FLIP, on 30 % of the pixels");
    await expect.poll(() => page.textContent(".error-mask")).toContain("marked: 12 % of the texels hold half of the FLIP");
    await settle(page);
    const sizes = await page.locator(".masked img").evaluateAll((images) => images.map((each) => { const { x, y, width, height } = each.getBoundingClientRect(); return [x, y, width, height]; }));
    expect(sizes[1]).toEqual(sizes[0]);
  });

  it("names the approximation in the head, and fits the screen in reach of everyone", async () => {
    const { page } = await open(kTextured);
    await page.waitForSelector(".explanation");
    await expect.poll(() => page.textContent(".item-head .approximation")).toContain("Approximation: captures without parallax (0.387 of FLIP 0.445)");
    await settle(page);
    expect(await page.evaluate(() => [document.documentElement.scrollWidth - innerWidth, document.querySelector("#panel")!.scrollWidth - document.querySelector("#panel")!.clientWidth])).toEqual([0, 0]);
    expect(await violations(page)).toEqual([]);
    await page.emulateMedia({ colorScheme: "dark" });
    expect(await violations(page, ["color-contrast"])).toEqual([]);
  });

  it("says why there is no explanation, and nothing of what was not asked", async () => {
    const { page } = await open(0);
    await expect.poll(() => page.textContent(".explanation")).toMatch(/What would help\s*Not explained: too many lights/);
    expect(await page.locator(".item-head .approximation").count()).toBe(0);
    const { page: other } = await open(1);
    await other.waitForSelector(".material-card");
    expect(await other.locator(".explanation").count()).toBe(0);
  });
});
