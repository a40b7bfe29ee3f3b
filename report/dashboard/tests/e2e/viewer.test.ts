import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { checkChunk, decodePlane } from "../../src/data/chunk";
import type { Report } from "../../src/data/types";
import { closePages, hashOfItem, openReport, readReport, reportFolder, settle, startBrowser } from "./browser";

let browser: Browser;
beforeAll(async () => (browser = await startBrowser()));
afterAll(async () => browser.close());

const hashOf = (page: Page): URLSearchParams => new URLSearchParams(new URL(page.url()).hash.slice(1));
// The page writes its state into the URL some time after a key or a click: later on a busy machine.
const waitForState = (page: Page, key: string, value: string | null): Promise<void> =>
  expect.poll(() => hashOf(page).get(key)).toBe(value);
const pressedMode = (page: Page): Promise<string | null> => page.textContent(".modes button[aria-pressed=true]");

async function openItem(report: string, hash = ""): Promise<{ page: Page; problems: string[]; requests: string[] }> {
  const opened = await openReport(browser, reportFolder(report), hashOfItem(report) + hash);
  await opened.page.waitForSelector("parity-pane .world");
  return opened;
}

/** The values of the view have come: what is not the item's material is covered, and the view fits the material. */
async function waitForValues(page: Page): Promise<void> {
  await page.waitForSelector("parity-picture.cover");
  await settle(page);
}

/** Mode buttons follow the state at once, the URL a moment later. */
async function waitForMode(page: Page, name: string): Promise<void> {
  await page.waitForFunction((text) => document.querySelector(".modes button[aria-pressed=true]")?.textContent?.trim() === text, name);
}

/** The pixels of a PNG that the page holds, as a browser reads them. */
async function pixelsOf(base64: string, places: readonly (readonly [number, number])[]): Promise<number[][]> {
  const page = await browser.newPage();
  const values = await page.evaluate(
    async ({ data, at }) => {
      const image = new Image();
      image.src = "data:image/png;base64," + data;
      await image.decode();
      const canvas = document.createElement("canvas");
      canvas.width = image.width;
      canvas.height = image.height;
      const context = canvas.getContext("2d")!;
      context.drawImage(image, 0, 0);
      return at.map(([x, y]) => [...context.getImageData(x, y, 1, 1).data].slice(0, 3));
    },
    { data: base64, at: places as [number, number][] },
  );
  await page.close();
  return values;
}

describe("the comparison", () => {
  it("has every mode by key and by button, and the URL says which", async () => {
    const { page, problems } = await openItem("real");
    for (const [key, name, mode] of [["s", "Slider", "slider"], ["s", "Side by side", null], ["o", "Onion skin", "onion"], ["d", "Difference", "difference"], ["h", "FLIP map", "flip"]] as const) {
      await page.keyboard.press(key);
      await waitForMode(page, name);
      await waitForState(page, "mode", mode);
    }
    for (const name of ["Side by side", "Slider", "Onion skin", "Flicker", "Difference", "FLIP map"]) {
      await page.click(`.modes button:has-text("${name}")`);
      expect((await pressedMode(page))?.trim()).toBe(name);
      await page.waitForSelector("parity-pane .world");
    }
    expect(problems).toEqual([]);
  });

  it("flickers while F is held, and shows one of both by the arrows", async () => {
    const { page } = await openItem("real");
    const label = (): Promise<string | null> => page.textContent("parity-pane figcaption strong");
    await page.keyboard.down("f");
    await page.waitForFunction(() => document.querySelector("parity-pane figcaption strong")?.textContent === "Mobile");
    await page.keyboard.up("f");
    await page.waitForFunction(() => document.querySelector("parity-pane figcaption strong")?.textContent === "High-end");
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction(() => document.querySelector("parity-pane figcaption strong")?.textContent === "Mobile");
    await page.keyboard.press("ArrowLeft");
    await page.waitForFunction(() => document.querySelector("parity-pane figcaption strong")?.textContent === "High-end");
    expect(await label()).toBe("High-end");
  });

  it("moves all panes together by wheel, drag and keys, and comes back by 0", async () => {
    const { page } = await openItem("real");
    const places = (): Promise<string[]> => page.locator("parity-pane .world").evaluateAll((all) => all.map((each) => (each as HTMLElement).style.transform));
    await waitForValues(page);
    const before = await places();
    const box = await page.locator("parity-pane .stage").first().boundingBox();
    if (!box) throw new Error("a pane");
    await page.mouse.move(box.x + box.width / 3, box.y + box.height / 3);
    await page.mouse.wheel(0, -400);
    await expect.poll(async () => (await places())[0]).not.toBe(before[0]);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 4 });
    await page.mouse.up();
    await settle(page);
    const moved = await places();
    expect(moved.length).toBe(3);
    expect(new Set(moved).size).toBe(1);
    expect(moved[0]).not.toBe(before[0]);
    await expect.poll(() => Number(hashOf(page).get("zoom"))).toBeGreaterThan(1);
    await page.mouse.move(5, 5);
    await page.keyboard.press("0");
    await expect.poll(places).toEqual(before);
  });

  it("exposes both pictures from their unclipped values", async () => {
    const { page } = await openItem("real");
    const shot = (): Promise<Buffer> => page.locator("parity-pane .stage").first().screenshot();
    await waitForValues(page);
    const before = await shot();
    for (let i = 0; i < 8; ++i) await page.keyboard.press("[");
    await waitForState(page, "exposure", "-2");
    await expect.poll(() => page.textContent("output[for=viewer-exposure]")).toContain("2");
    await expect.poll(async () => (await shot()).equals(before)).toBe(false);
    await page.keyboard.press("0");
    await waitForState(page, "exposure", null);
  });

  it("says how many pixels a threshold leaves, fewer the higher it is", async () => {
    const share = async (threshold: number): Promise<number> => {
      const { page } = await openItem("real", `&mode=flip&threshold=${threshold}`);
      await waitForValues(page); // until then it is the share of all pixels
      const text = (await page.textContent("output[for=viewer-threshold]")) ?? "";
      await closePages();
      return Number(/([\d.]+) %/.exec(text)?.[1]);
    };
    const [low, high] = [await share(0.02), await share(0.2)];
    expect(low).toBeGreaterThan(high);
    expect(low).toBeLessThanOrEqual(100);
  });
});

describe("what is painted from values", () => {
  it("is there again when the same is asked for again", async () => {
    const { page } = await openItem("real");
    await waitForValues(page);
    const shot = (): Promise<Buffer> => page.locator("parity-pane .stage").first().screenshot();
    const isAs = (picture: Buffer) => async (): Promise<boolean> => (await shot()).equals(picture);
    const plain = await shot();
    await page.keyboard.press("]");
    await expect.poll(isAs(plain)).toBe(false);
    await settle(page);
    const first = await shot();
    await page.keyboard.press("[");
    await expect.poll(isAs(plain)).toBe(true);
    await page.keyboard.press("]");
    await expect.poll(isAs(first)).toBe(true);
  });
});

describe("a pixel's values", () => {
  it("are those of the pictures, for both paths (sRGB, one file)", async () => {
    const html = readFileSync(join(reportFolder("single"), "index.html"), "utf8");
    const report = JSON.parse(readFileSync(join(reportFolder("single"), "report.json"), "utf8")) as Report;
    const images = report.scenes[0]!.views[0]!.images;
    const pngOf = (path: string): string => new RegExp(`data-file="${path.replaceAll(".", "\\.")}"[^>]*>([^<]+)<`).exec(html)?.[1]?.trim() ?? "";
    const places = [[128, 128], [60, 90], [200, 70], [97, 180], [3, 3]] as const;
    const expected = { "High-end": await pixelsOf(pngOf(images.reference), places), Mobile: await pixelsOf(pngOf(images.test), places) };
    for (const [i, [x, y]] of places.entries()) {
      const { page } = await openItem("single", `&pixelX=${x}&pixelY=${y}`);
      for (const name of ["High-end", "Mobile"] as const) {
        const values = page.locator(`.inspector tbody tr:has(th:has-text("${name}")) td:last-child span`);
        await expect.poll(async () => (await values.allTextContents()).map(Number), { message: `${name} at ${x}, ${y}` }).toEqual(expected[name][i]);
      }
      await closePages();
    }
  });

  it("are within two steps of the pictures where a table stands for the display transform (ACES)", async () => {
    const folder = reportFolder("real");
    const report = JSON.parse(readFileSync(join(folder, "report.json"), "utf8")) as Report;
    expect(report.displayTable).toBe("pixels/display.js");
    const png = readFileSync(join(folder, report.scenes[0]!.views[0]!.images.reference)).toString("base64");
    const places = [[128, 128], [60, 90], [200, 70]] as const;
    const expected = await pixelsOf(png, places);
    for (const [i, [x, y]] of places.entries()) {
      const { page } = await openItem("real", `&pixelX=${x}&pixelY=${y}`);
      const spans = page.locator(".inspector tbody tr:has(th:has-text('High-end')) td:last-child span");
      await spans.first().waitFor();
      const values = (await spans.allTextContents()).map(Number);
      values.forEach((value, channel) => expect(Math.abs(value - expected[i]![channel]!)).toBeLessThanOrEqual(2));
      await closePages();
    }
  });

  it("are pinned by a click, moved by arrow keys, and hold the terms of both paths", async () => {
    const { page, problems } = await openItem("real");
    await waitForValues(page);
    await page.locator("parity-pane .stage").first().click({ position: { x: 150, y: 150 } });
    await expect.poll(() => hashOf(page).get("pixelX")).not.toBeNull();
    const x = Number(hashOf(page).get("pixelX"));
    await page.keyboard.press("ArrowRight");
    await waitForState(page, "pixelX", String(x + 1));
    await page.click(".inspector summary");
    await page.waitForSelector(".inspector details tbody tr");
    await expect.poll(() => page.textContent(".inspector details")).toMatch(/reflections of the environment/);
    expect(problems).toEqual([]);
  });
});

describe("FLIP", () => {
  const readPlane = async (file: string, name: string): Promise<Uint16Array> => {
    const script = readFileSync(join(reportFolder("real"), file), "utf8");
    const chunk = checkChunk(JSON.parse(script.slice(script.indexOf("(") + 1, script.lastIndexOf(")"))), file);
    return (await decodePlane(chunk, name)).values;
  };

  it("of a material's view is the material's own, of a whole view that of the whole pictures", async () => {
    const view = readReport("real").scenes[1]!.views[0]!;
    const planes = await Promise.all(["material", "materialFlip", "flip"].map((name) => readPlane(view.pixels.color, name)));
    const [material, own, whole] = planes as [Uint16Array, Uint16Array, Uint16Array];
    // Where the two tell most apart, of all pixels that show a material.
    let at = 0;
    for (let i = 0; i < own.length; ++i)
      if (material[i] !== 0 && Math.abs(own[i]! - whole[i]!) > Math.abs(own[at]! - whole[at]!)) at = i;
    expect(Math.abs(own[at]! - whole[at]!) / 65535).toBeGreaterThan(0.01);
    const [x, y] = [at % view.width, Math.floor(at / view.width)];
    for (const [place, plane] of [[material[at]! - 1, own], [-1, whole]] as const) {
      const { page } = await openReport(browser, reportFolder("real"), `${hashOfItem("real", place, 1)}&pixelX=${x}&pixelY=${y}&mode=flip`);
      const expected = (plane[at]! / 65535).toFixed(3);
      await expect.poll(() => page.textContent(".pixel-head")).toMatch(new RegExp(`FLIP\\s+${expected}`));
      await expect.poll(() => page.locator("parity-pane .note").allTextContents()).toEqual(place < 0 ? [] : ["by material"]);
      const counted = material.reduce((sum, each) => sum + Number(place < 0 ? each !== 0 : each === place + 1), 0);
      const mean = plane.reduce((sum, value, i) => sum + ((place < 0 ? material[i] !== 0 : material[i] === place + 1) ? value : 0), 0) / counted / 65535;
      const text = (): Promise<string | null> => page.textContent(".histogram p.aside");
      await expect.poll(text).toContain(`${counted.toLocaleString("en-US")} pixels`);
      expect(await text()).toContain(`mean ${mean.toFixed(3)}`);
      await closePages();
    }
  });
});

describe("a report of some materials only", () => {
  it("knows no FLIP of pixels that were not compared", async () => {
    const report = readReport("restricted");
    expect(report.scenes[0]!.views[0]!.materials.map((each) => each.name)).toEqual(["gold"]);
    const flipAt = async (x: number, y: number): Promise<string> => {
      const { page } = await openItem("restricted", `&pixelX=${x}&pixelY=${y}`);
      await waitForValues(page);
      const text = (await page.textContent(".pixel-head")) ?? "";
      await closePages();
      return /FLIP\s+(\S+)/.exec(text)?.[1] ?? "";
    };
    expect(await flipAt(3, 3)).toBe("–");
    expect(await flipAt(12, 72)).toMatch(/^0\.\d/);
  });
});

describe("terms and numbers", () => {
  it("say in words and by bars which term is the cause, and show both paths' terms", async () => {
    const { page, problems } = await openItem("real", "&tab=compare");
    await page.keyboard.press("t");
    await page.waitForSelector("table.attribution tbody tr");
    await expect.poll(() => page.textContent("table.attribution tbody tr:first-child")).toContain("none");
    await page.waitForFunction(() => document.querySelectorAll("parity-term-image canvas").length >= 2);
    await page.click(".term h4 a >> nth=0");
    await page.waitForSelector("parity-viewer");
    expect(hashOf(page).get("term")).not.toBeNull();
    expect(problems).toEqual([]);
  });

  it("give the command that shows one material again", async () => {
    const { page } = await openItem("real", "&tab=compare");
    await page.keyboard.press("n");
    await page.waitForSelector(".command code");
    const commands = await page.locator(".command code").allTextContents();
    expect(commands.some((each) => each.includes(" diff builtin:materials") && each.includes("--material"))).toBe(true);
    await expect.poll(() => page.textContent("parity-numbers")).toMatch(/skipped/i);
    await expect.poll(() => page.textContent("parity-numbers")).toContain("does not have the scene materials");
  });

  it("plot the bench of the scene that is shown", async () => {
    const { page, problems } = await openReport(browser, reportFolder("real"), `${hashOfItem("real", 5, 1)}&tab=numbers`);
    await page.waitForSelector("parity-pareto svg .dot");
    await expect.poll(() => page.getAttribute("parity-pareto svg", "aria-label")).toContain("2 settings");
    await page.goto(`${page.url().split("#")[0]}${hashOfItem("real", 5)}&tab=numbers`);
    await page.waitForSelector("parity-pareto svg", { state: "detached" });
    expect(problems).toEqual([]);
  });
});
