import { readdirSync, readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { hashOfItem, openReport, reportFolder, settle, startBrowser } from "./browser";

const kPolicy = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; base-uri 'none'; form-action 'none'";
const kTypes: Record<string, string> = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".png": "image/png", ".json": "application/json" };

let browser: Browser;
let server: Server;
let root = "";
beforeAll(async () => {
  browser = await startBrowser();
  // As a viewer of build artifacts serves them: from a folder, under a policy of its own.
  server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url ?? "/", "http://localhost").pathname));
    try {
      const bytes = readFileSync(join(reportFolder("real"), path));
      response.writeHead(200, { "Content-Type": kTypes[extname(path)] ?? "application/octet-stream", "Content-Security-Policy": kPolicy, "X-Content-Type-Options": "nosniff" });
      response.end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise<void>((done) => server.listen(0, "127.0.0.1", done));
  root = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
});
afterAll(async () => {
  server.close();
  await browser.close();
});

describe("the page", () => {
  it("works under a strict policy of the server that shows it", async () => {
    const page = await browser.newPage();
    const problems: string[] = [];
    page.on("console", (message) => message.type() === "error" && !message.text().includes("favicon") && problems.push(message.text()));
    page.on("pageerror", (error) => problems.push(String(error)));
    for (const mode of ["side", "slider", "onion", "difference", "flip"]) {
      await page.goto(`${root}index.html${hashOfItem("real")}&exposure=1&pixelX=128&pixelY=128&mode=${mode}`);
      await page.reload();
      await page.waitForSelector(".inspector tbody tr");
      await page.waitForSelector("parity-pane canvas");
    }
    for (const [key, what] of [["t", "parity-term-image canvas:not([width='1'])"], ["n", "parity-numbers table"]] as const) {
      await page.keyboard.press(key);
      await page.waitForSelector(what);
      await settle(page); // what is drawn last may break the policy, too
    }
    expect(problems).toEqual([]);
  });

  it("has a policy of its own that lets nothing else in, and no script or style within (folder)", () => {
    const html = readFileSync(join(reportFolder("real"), "index.html"), "utf8");
    expect(html).toMatch(/http-equiv="Content-Security-Policy" content="default-src 'none';/);
    expect(html.replaceAll("http://www.w3.org/2000/svg", "")).not.toMatch(/unsafe-|https?:\/\//); // the name of SVG is no address
    for (const [, attributes] of html.matchAll(/<script([^>]*)>/g)) expect(attributes).toMatch(/src="dashboard\.js"|type="application\/json"/);
    expect(html).not.toMatch(/<style|\sstyle=|\son[a-z]+=/i);
  });
});

describe("the bundle", () => {
  it("is at most 250 kB, gzipped", () => {
    const sizes = ["dashboard.js", "dashboard.css"].map((file) => gzipSync(readFileSync(join(reportFolder("real"), file))).length);
    expect(sizes[0]! + sizes[1]!).toBeLessThanOrEqual(250_000);
  });
});

describe("a report in one file", () => {
  it("holds everything: no picture and no value lies beside it, and nothing is asked for", async () => {
    const folder = reportFolder("single");
    expect(readdirSync(folder).sort()).toEqual(["index.html", "junit.xml", "report.json", "run.json"]);
    const opened = await openReport(browser, folder, `${hashOfItem("single")}&pixelX=128&pixelY=128&exposure=1`);
    await opened.page.waitForSelector(".inspector tbody tr");
    await opened.page.waitForSelector("parity-pane canvas");
    await opened.page.waitForFunction(() => [...document.querySelectorAll("img")].some((each) => each.naturalWidth > 0));
    expect(opened.requests.filter((url) => !url.startsWith("data:") && !url.startsWith("blob:")).length).toBe(1);
    expect(opened.problems).toEqual([]);
  });
});
