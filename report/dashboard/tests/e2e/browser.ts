// Reports opened in real headless Chromium, from a folder, without a server.
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium, type Browser, type BrowserContextOptions, type Page } from "playwright-core";

import type { EarlierRuns, SceneTrends } from "../../src/data/history";
import { kDefaultState, toHash } from "../../src/data/state";
import type { Report } from "../../src/data/types";
import { packOverview, rowsOf, type OverRuns } from "../pack_overview";

const kPrograms = [process.env["PARITY_CHROMIUM"] ?? "", "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

/** Debian's chromium, or the program that PARITY_CHROMIUM names. */
export function chromiumProgram(): string {
  const found = kPrograms.find((each) => each !== "" && existsSync(each));
  if (found === undefined) throw new Error("there is no chromium: scripts/install-deps installs it, PARITY_CHROMIUM names another");
  return found;
}

/** Made by tests/dashboard: make_reports, and two real ones by parity. */
export function reportFolder(name: string): string {
  const root = process.env["PARITY_REPORTS"];
  if (!root) throw new Error("PARITY_REPORTS must name the folder of the reports: ctest -R dashboard makes it");
  return resolve(join(root, name));
}

export function readReport(name: string): Report {
  return JSON.parse(readFileSync(join(reportFolder(name), "report.json"), "utf8")) as Report;
}

/** The hash of what stands at these places of a report, by its names. material: -1: the whole image. */
export function hashOfItem(name: string, material = 0, scene = 0, view = 0): string {
  const row = rowsOf(readReport(name)).find((each) => each.scene === scene && each.view === view && each.material === material);
  if (!row) throw new Error(`${name} has no such item`);
  return toHash({ ...kDefaultState, ...row.link });
}

const changedFolders: string[] = [];

/** The folder of a copy of a report, its page changed. */
export function changedReport(name: string, change: (html: string) => string): string {
  const folder = mkdtempSync(join(tmpdir(), "parity-page-"));
  changedFolders.push(folder);
  cpSync(reportFolder(name), folder, { recursive: true });
  const file = join(folder, "index.html");
  const before = readFileSync(file, "utf8");
  const after = change(before);
  if (after === before) throw new Error("nothing was changed");
  writeFileSync(file, after);
  return folder;
}

/** What a run with --history adds to a report. */
export interface AddedHistory {
  history: EarlierRuns;
  rows: Readonly<Record<number, OverRuns>>; // by their place among all of the report
  trends: Readonly<Record<number, SceneTrends>>; // by scene
}

/** The folder of a copy of a report, its data changed: that of its page, and of its scenes' files. */
export function changedData(name: string, change: (report: Report) => void, added: AddedHistory | null = null): string {
  const report = readReport(name);
  change(report);
  const { scenes, ...head } = report;
  const blocks: Record<string, unknown> = { report: head, overview: packOverview(report, added?.rows) };
  const block = added === null ? "" : `<script type="application/json" id="history">${JSON.stringify(added.history)}</script>\n`;
  const folder = changedReport(name, (html) =>
    html.replace(/(<script type="application\/json" id="(report|overview)">)[\s\S]*?(<\/script>)/g, (_all, open: string, id: string, close: string) => open + JSON.stringify(blocks[id]).replaceAll("<", "\\u003c") + close)
      .replace('<script type="application/json" id="report">', (each) => block + each),
  );
  scenes.forEach((scene, i) => {
    const file = `scenes/${i}.js`;
    writeFileSync(join(folder, file), `parityScene(${JSON.stringify({ file, format: 1, scene, again: [], history: added?.trends[i] })});\n`);
  });
  return folder;
}

export function removeChanged(): void {
  for (const folder of changedFolders.splice(0)) rmSync(folder, { recursive: true, force: true });
}

export interface Opened {
  page: Page;
  problems: string[]; // errors of scripts, of the policy, and of the page's console
  requests: string[]; // all that the page asked for
}

export async function startBrowser(): Promise<Browser> {
  return chromium.launch({ executablePath: chromiumProgram(), args: ["--no-sandbox", "--disable-background-networking", "--disable-gpu"] });
}

const kViewport = { width: 1400, height: 900 };
const spare = new Map<string, Page[]>(); // blank pages, by the options of their contexts
const inUse: { page: Page; key: string; viewport: { width: number; height: number } }[] = [];

/** A page as if it were new. A navigation in a browser process that is there takes a fourth of the time of a new one. */
async function blank(page: Page, viewport: { width: number; height: number }): Promise<void> {
  page.removeAllListeners();
  await page.evaluate(() => localStorage.clear());
  await page.emulateMedia({ media: null, colorScheme: null });
  await page.setViewportSize(viewport);
  await page.mouse.move(-1, -1);
  await page.goto("about:blank", { timeout: 10_000 });
}

/** Ends the pages of a test: one that stays open goes on to take time. Later tests are given them again, blank. */
export async function closePages(): Promise<void> {
  await Promise.all(
    inUse.splice(0).map(async ({ page, key, viewport }) => {
      try {
        await blank(page, viewport);
        spare.set(key, [...(spare.get(key) ?? []), page]);
      } catch {
        await page.context().close(); // it hangs, or the test has closed it
      }
    }),
  );
}

/** The page of a report, once it is drawn. hash: with "#". The end of the test closes it. */
export async function openReport(browser: Browser, folder: string, hash = "", options: BrowserContextOptions = {}): Promise<Opened> {
  const key = JSON.stringify(options);
  const page = spare.get(key)?.pop() ?? (await (await browser.newContext({ viewport: kViewport, ...options })).newPage());
  inUse.push({ page, key, viewport: options.viewport ?? kViewport });
  const opened: Opened = { page, problems: [], requests: [] };
  page.on("pageerror", (error) => opened.problems.push(String(error.stack ?? error)));
  page.on("console", (message) => {
    if (message.type() === "error") opened.problems.push(message.text());
  });
  page.on("request", (request) => opened.requests.push(request.url()));
  await page.goto(pathToFileURL(join(folder, "index.html")).href + hash);
  await page.waitForSelector("parity-app h1, parity-study h1, .failure h1", { state: "attached" }); // on a phone an item hides it
  return opened;
}

/** Waits until the page's content and size have not changed for a tenth of a second, and its pictures and values are there (lazy pictures may stay away). */
export async function settle(page: Page): Promise<void> {
  await page.evaluate(async () => {
    const look = (): string => {
      const root = document.documentElement;
      const pictures = [...document.images].filter((each) => !each.complete && each.loading !== "lazy").length;
      const values = [...document.querySelectorAll("[role=status], p.aside")].filter((each) => /^\s*loading\b.*…/i.test(each.textContent ?? "")).length;
      return `${pictures + values} ${root.scrollWidth} ${root.scrollHeight} ${root.outerHTML}`;
    };
    let before = "";
    const end = performance.now() + 40_000;
    for (let same = 0; same < 2; ) {
      if (performance.now() > end) throw new Error("the page does not settle: it changes, or loads, for 40 s");
      await new Promise((done) => setTimeout(done, 50));
      await new Promise((done) => requestAnimationFrame(done));
      const now = look();
      same = now === before && now.startsWith("0 ") ? same + 1 : 0;
      before = now;
    }
  });
}

/** Problems that are not the missing of a file that the test left out. */
export function realProblems(opened: Opened): string[] {
  return opened.problems.filter((text) => !text.includes("ERR_FILE_NOT_FOUND"));
}
