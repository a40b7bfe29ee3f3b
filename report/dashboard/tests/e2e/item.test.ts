// What an open item says above its pictures and in its numbers: why, what would help, what is accepted, and the limits.
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import type { Report } from "../../src/data/types";
import { changedData, hashOfItem, openReport, removeChanged, settle, startBrowser } from "./browser";

let browser: Browser;
let folder = "";
const kReason = "mean FLIP 0.302 is above 0.200; 95th percentile of FLIP 0.557 is above 0.500; mean exposure difference -1.25 EV is beyond ±0.50 EV";

/** The first material fails, another preset would help it; the second one passes, because its budget accepts NaN. */
function change(report: Report): void {
  Object.assign(report, { suite: "nightly" });
  const [first, second] = report.scenes[0]!.views[0]!.materials;
  const { figures } = first!;
  Object.assign(first!, { verdict: "fail", reason: kReason, attribution: { flip: 0.3, terms: [{ term: "skySpecular", flip: 0.1 }] } });
  figures!.metrics["bias.ev"] = -0.28;
  first!.checks = [{ metric: "bias.ev", regress: false, value: -0.28, warn: 0.25, fail: 0.5, verdict: "warn", note: "" }];
  const then = { ...figures!, metrics: { ...figures!.metrics, "flip.mean": 0.075 } };
  first!.whatIf = ["one", "two"].map((preset) => ({ preset, words: `with ${preset}: FLIP 0.075 instead of 0.302, -0.02 EV instead of -0.28 EV, pass`, verdict: "pass", reason: "", figures: then }));
  Object.assign(second!, { verdict: "pass", reason: "", accepted: "2 of 900 pixels are NaN or infinite (reason: known)" });
  second!.figures!.nonFinite = 2;
}

beforeAll(async () => {
  folder = changedData("real", change);
  browser = await startBrowser();
});
afterAll(async () => {
  removeChanged();
  await browser.close();
});

const kScreens = [
  ["1440x900", { width: 1440, height: 900 }],
  ["390x844", { width: 390, height: 844 }],
] as const;

describe.each(kScreens)("an item at %s", (_name, viewport) => {
  const open = async (hash: string): Promise<Page> => {
    const { page } = await openReport(browser, folder, hash, { viewport });
    await page.waitForSelector("parity-item h2, .list .row");
    return page;
  };

  it("with other presets is as high as the window", async () => {
    const page = await open(hashOfItem("real"));
    await page.waitForSelector(".what-ifs li");
    await settle(page);
    expect(await page.evaluate(() => document.documentElement.scrollHeight - innerHeight)).toBe(0);
    expect((await page.textContent(".what-ifs li >> nth=0"))!.match(/pass/g)).toHaveLength(1);
    await expect.poll(() => page.textContent(".what-ifs li >> nth=0")).toContain("\u22120.02 EV instead of \u22120.28 EV");
  });

  it("says the reason in full, the cause and what would help above the pictures", async () => {
    const page = await open(hashOfItem("real"));
    await page.waitForSelector("parity-pane .stage");
    const bottoms = await page.evaluate(() => [".reason", ".cause", ".would-help"].map((each) => document.querySelector(`.item-head ${each}`)!.getBoundingClientRect().bottom));
    const top = await page.evaluate(() => document.querySelector("parity-pane .stage")!.getBoundingClientRect().top);
    for (const bottom of bottoms) expect(bottom).toBeLessThan(top);
    await expect.poll(() => page.textContent(".item-head .reason")).toBe(kReason.replace("-1.25", "\u22121.25"));
    expect(await page.evaluate(() => { const reason = document.querySelector(".item-head .reason")!; return [reason.scrollWidth - reason.clientWidth, reason.scrollHeight - reason.clientHeight]; })).toEqual([0, 0]);
    await expect.poll(() => page.textContent(".item-head .would-help")).toBe("Would help: preset one (FLIP 0.075, pass)");
  });

  it("has limits and their verdict beside its numbers, and says where its commands run", async () => {
    const page = await open(`${hashOfItem("real")}&tab=numbers`);
    const text = await page.locator(".numbers tr", { hasText: "bias.ev" }).textContent();
    expect(text).toContain("\u22120.28 EV");
    expect(text).toMatch(/warn\s+warns beyond ±0.25 EV, fails beyond ±0.50 EV/);
    const numbers = await page.innerText("parity-numbers");
    expect(numbers).toContain("in the folder where parity ran");
    expect(numbers).toContain("in the folder of this report");
  });

  it("does not pass plainly where its budget accepts something", async () => {
    const page = await open(hashOfItem("real", 1));
    await expect.poll(() => page.textContent("#item-title .badge")).toContain("pass (accepted)");
    await expect.poll(() => page.textContent(".item-head p.accepted")).toContain("2 of 900 pixels are NaN");
    await expect.poll(() => page.textContent(".facts")).toMatch(/2 of [\d,]+ pixels are NaN or infinite/);
  });

  it("has its cause and what is accepted in the list, whose lines do not overlap", async () => {
    const page = await open("#sort=order&ascending=true");
    const [first, second] = [page.locator(".list .row >> nth=0"), page.locator(".list .row >> nth=1")];
    await expect.poll(() => first.locator(".cell-cause b").isVisible()).toBe(true);
    await expect.poll(() => first.locator(".cell-cause").textContent()).toContain("with one 0.075");
    await expect.poll(() => second.locator(".cell-gravity").textContent()).toMatch(/pass \(accepted\).*2 pixels NaN/s);
    const overlaps = await first.evaluate((row) => {
      const boxes = [".cell-flip-mean", ".cell-bias", ".cell-cause"].map((each) => row.querySelector(each)!.getBoundingClientRect());
      const isOver = (a: DOMRect, b: DOMRect): boolean => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
      return boxes.some((a, i) => boxes.some((b, j) => i < j && isOver(a, b))) || row.scrollHeight > row.clientHeight;
    });
    expect(overlaps).toBe(false);
  });

  it("is of a suite that the head and the title name", async () => {
    const page = await open("");
    await expect.poll(() => page.textContent(".page-head .suite")).toBe("Suite nightly");
    expect(await page.title()).toMatch(/^parity: nightly: /);
  });
});
