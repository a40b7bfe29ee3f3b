// A report's page in a new headless Chromium with an empty cache, and what it takes.
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

/** Opens the report of this folder, until it can be used. times: ms until it was painted and until it can be used. */
export async function openReport(folder) {
  const browser = await chromium.launch({ executablePath: process.env.PARITY_CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-background-networking"] });
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
  page.on("pageerror", (error) => console.error(String(error)));
  await page.goto(pathToFileURL(join(resolve(folder), "index.html")).href);
  await page.waitForFunction(() => performance.getEntriesByName("parity-interactive").length > 0 && performance.getEntriesByName("first-contentful-paint").length > 0);
  const times = await page.evaluate(() => ({
    paint: performance.getEntriesByName("first-contentful-paint")[0].startTime,
    interactive: performance.getEntriesByName("parity-interactive")[0].startTime,
  }));
  return { browser, page, times };
}

/** Of the page's process, MB; the browser's own code, which all processes share, counts too. */
export async function residentMegabytes(browser) {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  const sizes = processInfo
    .filter((each) => each.type === "renderer")
    .map((each) => Number(/VmRSS:\s+(\d+) kB/.exec(readFileSync(`/proc/${each.id}/status`, "utf8"))?.[1] ?? 0) / 1024);
  return Math.max(...sizes);
}
