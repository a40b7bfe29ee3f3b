#!/usr/bin/env node
// Renders the pictures of a parity contract by three.js in headless Chromium. See README.md, and usage below.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, extname, join, resolve, sep } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";

import { encodePng } from "./png.mjs";

const kUsage = `usage: render.mjs CONTRACT SHOTS [--scene NAME] [--tone none|aces|agx|neutral|cineon|reinhard]
  CONTRACT      the folder that 'parity contract' wrote
  SHOTS         the folder for the pictures, made where it is missing
  --scene NAME  this scene only, and the calibration
  --tone CURVE  the tone curve of three.js; none is what the contract asks for (the default)
  --help        this text
CHROMIUM names the browser, else it is /usr/bin/chromium.
Exit code: 0 all pictures are written, 1 not, 64 wrong usage.`;

const kHere = dirname(fileURLToPath(import.meta.url));
const kOrigin = "http://parity.invalid"; // nothing is there: all requests are answered from this process
const kPage = `<!doctype html><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}</script>`;
const kTypes = { ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm", ".png": "image/png", ".jpg": "image/jpeg", ".jpeg": "image/jpeg", ".webp": "image/webp" };

const urlOf = (file) => `${kOrigin}/files${file.split(sep).map(encodeURIComponent).join("/")}`;
const message = (error) => (error?.code === "ENOENT" ? "there is no such file" : String(error?.message ?? error).replace(/^page\.evaluate: (Error: )?/, "").split("\n")[0]);

function readOptions() {
  try {
    const { values, positionals } = parseArgs({
      allowPositionals: true,
      options: { scene: { type: "string" }, tone: { type: "string", default: "none" }, help: { type: "boolean" } },
    });
    if (values.help) {
      console.log(kUsage);
      process.exit(0);
    }
    if (positionals.length !== 2) throw new Error("CONTRACT and SHOTS are needed");
    if (!["none", "aces", "agx", "neutral", "cineon", "reinhard"].includes(values.tone)) throw new Error(`--tone ${values.tone} is not known`);
    return { contract: resolve(positionals[0]), shots: resolve(positionals[1]), ...values };
  } catch (error) {
    console.error(`render.mjs: ${message(error)}\n${kUsage}`);
    process.exit(64);
  }
}

function readContract(folder, onlyScene) {
  const file = join(folder, "contract.json");
  const refuse = (reason) => {
    throw new Error(`${file}: ${reason}`);
  };
  let contract;
  try {
    contract = JSON.parse(readFileSync(file, "utf8"));
  } catch (error) {
    refuse(message(error));
  }
  if (contract.format !== 1) refuse(`its format is ${contract.format}, this adapter reads 1`);
  const wanted = (contract.scenes ?? []).filter((scene) => onlyScene === undefined || scene.name === onlyScene);
  if (!wanted.length) refuse(onlyScene === undefined ? "it has no scenes" : `it has no scene ${onlyScene}`);
  const scenes = contract.calibration ? [{ name: "calibration", ...contract.calibration }, ...wanted] : wanted;
  for (const scene of scenes) {
    for (const each of [scene.scene, scene.environment?.file ?? []].flat()) if (!existsSync(join(folder, each))) refuse(`scene ${scene.name}: there is no ${each}`);
    if (!scene.views?.length) refuse(`scene ${scene.name} has no views`);
    for (const view of scene.views) {
      if (!/^[^/\\]+\.png$/.test(view.picture)) refuse(`${view.picture} is not the name of a picture`);
      if (view.transfer !== "srgb") refuse(`${view.picture}: the transfer ${view.transfer} is not known`);
      if (![view.width, view.height, view.samples].every((n) => Number.isInteger(n) && n > 0)) refuse(`${view.picture}: width, height or samples is not a positive integer`);
      if (view.camera?.view?.length !== 16 || view.camera.projection?.length !== 16) refuse(`${view.picture}: a matrix has not 16 numbers`);
    }
  }
  return scenes;
}

async function startBrowser() {
  const program = process.env.CHROMIUM || "/usr/bin/chromium";
  if (!existsSync(program)) throw new Error(`${program}: there is no Chromium; install it, or name it by CHROMIUM`);
  // Software rendering: the same pixels on all machines, whatever their graphics card.
  return chromium.launch({ executablePath: program, args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking"] });
}

// An empty page whose requests are answered from files. failures collects what could not be read.
async function openPage(browser, failures) {
  const page = await browser.newPage();
  await page.route("**/*", async (route) => {
    const url = new URL(route.request().url());
    if (url.origin !== kOrigin) {
      failures.push(`${url.href}: the network is not used`);
      return route.abort();
    }
    if (url.pathname === "/") return route.fulfill({ contentType: "text/html", body: kPage });
    const path = decodeURIComponent(url.pathname);
    const file = path.startsWith("/files/") ? path.slice(6) : path.startsWith("/three/") ? join(kHere, "node_modules", path) : join(kHere, path);
    try {
      return await route.fulfill({ contentType: kTypes[extname(file).toLowerCase()] ?? "application/octet-stream", body: readFileSync(file) });
    } catch (error) {
      failures.push(`${file}: ${message(error)}`);
      return route.fulfill({ status: 404 });
    }
  });
  // three.js says errors of textures and shaders only here.
  page.on("console", (said) => {
    const text = said.text().split("\n")[0];
    if (!text.startsWith("THREE.")) return;
    if (said.type() === "error") failures.push(text);
    if (said.type() === "warning") console.error(`render.mjs: ${text}`);
  });
  await page.goto(kOrigin);
  return page;
}

const seconds = (since) => ((performance.now() - since) / 1000).toFixed(2);

async function renderScene(browser, scene, options) {
  const failures = [];
  const page = await openPage(browser, failures);
  // Calls a function of page.mjs. subject: the file that an error names.
  const call = async (subject, name, ...words) => {
    try {
      const result = await page.evaluate(async ([each, args]) => (await import("/page.mjs"))[each](...args), [name, words]);
      if (failures.length) throw new Error();
      return result;
    } catch (error) {
      throw new Error(`${subject}: ${failures[0] ?? message(error)}`);
    }
  };
  try {
    const started = performance.now();
    const file = resolve(options.contract, scene.scene);
    await call(file, "loadScene", urlOf(file), scene.lights ?? []);
    const environment = scene.environment && resolve(options.contract, scene.environment.file);
    if (environment) await call(environment, "loadEnvironment", urlOf(environment));
    console.log(`${scene.name}: loaded in ${seconds(started)} s`);
    for (const view of scene.views) {
      const began = performance.now();
      const base64 = await call(`${file}, view ${view.name}`, "drawView", view, options.tone);
      writeFileSync(join(options.shots, view.picture), encodePng(view.width, view.height, Buffer.from(base64, "base64")));
      console.log(`${view.picture}: ${view.width}x${view.height}, ${view.samples} sample${view.samples === 1 ? "" : "s"}, ${seconds(began)} s`);
    }
  } finally {
    await page.close();
  }
}

const options = readOptions();
let browser;
try {
  const scenes = readContract(options.contract, options.scene);
  mkdirSync(options.shots, { recursive: true });
  browser = await startBrowser();
  for (const scene of scenes) await renderScene(browser, scene, options);
} catch (error) {
  console.error(`render.mjs: ${message(error)}`);
  process.exitCode = 1;
} finally {
  await browser?.close();
}
