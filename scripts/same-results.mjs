#!/usr/bin/env node
// Runs two builds of parity over the same scenes and compares every file byte by byte: the check of a change that is to
// change no figure and no picture.
//   scripts/same-results.mjs OLD NEW [--renamed OLD=NEW ...] [--without KEY ...] [ASSET.gltf ENVIRONMENT.hdr ...]
// OLD, NEW: the programs. --renamed: a text that the new program writes in place of the old one. --without: keys of
// report.json that are not compared. Exit code: 0 the same, 1 not, 2 a run differs in its exit code.
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative, resolve } from "node:path";

const words = process.argv.slice(2);
const take = (option) => {
  const values = [];
  for (let at = words.indexOf(option); at >= 0; at = words.indexOf(option)) values.push(words.splice(at, 2)[1]);
  return values;
};
const renamed = take("--renamed").map((pair) => pair.split("="));
const without = new Set(take("--without"));
const [oldProgram, newProgram] = words.splice(0, 2).map((program) => resolve(program));
const pairs = [];
while (words.length >= 2) pairs.push(words.splice(0, 2).map((file) => resolve(file)));

const small = ["--size", "160x160", "--no-cache"];
const runs = {
  spheres: ["report", "builtin:spheres", "builtin:materials", "--env", "builtin:studio", "--sun", "30,50,4", "--attribution", "all", "--costs", ...small, "-o", "r"],
  lights: ["report", "builtin:lights", "builtin:lamps", "--shadows", "--dropped-lights", "4", "--terms", ...small, "-o", "r"],
  truth: ["report", "builtin:spheres", "--env", "builtin:sky", "--size", "64x64", "--reference", "--error", "5%", "--interreflection", "1", "--no-cache", "-o", "r"],
  room: ["report", "builtin:room", "builtin:courtyard", "--samples", "2", "--metrics", "flip,ssim,psnr,relmse,deltae", ...small, "-o", "r"],
  stored: ["diff", "builtin:materials", "--env", "builtin:night", "--mobile-preset", "refit", "--mobile-target", "rgba8-gamma2", "--mobile-textures", "astc6x6", ...small],
  karis: ["diff", "builtin:furnace", "--env", "builtin:white", "--mobile-preset", "karis2014", "--precision", "fp32", ...small, "--json", "-"],
  mobile: ["render", "builtin:spheres", "--path", "mobile", "--env", "builtin:studio", "--terms", ...small, "-o", "o.exr"],
  highend: ["render", "builtin:spheres", "--path", "highend", "--env", "builtin:studio", "--terms", "--shadows", ...small, "-o", "o.exr"],
  plot: ["plot", "env-brdf", "-o", "p"],
};
pairs.forEach(([asset, environment], i) => {
  runs[`asset ${i + 1}`] = ["report", asset, "--env", environment, "--size", "256x256", "--no-cache", "-o", "r"];
});

// Times and the page, which holds them, differ from run to run.
const isCompared = (file) => !file.endsWith("run.json") && !file.endsWith("index.html");
const filesOf = (folder) =>
  readdirSync(folder, { recursive: true }).map((file) => join(folder, file)).filter((file) => statSync(file).isFile() && isCompared(file));
const stripped = (value) => {
  if (Array.isArray(value)) return value.map(stripped);
  if (value === null || typeof value !== "object") return value;
  return Object.fromEntries(Object.entries(value).filter(([key]) => !without.has(key)).map(([key, each]) => [key, stripped(each)]));
};
// What a run says; of JSON without the keys that are not compared.
const saidBy = ({ folder, text }) => {
  const said = text.replaceAll(folder, "");
  return said.startsWith("{") ? JSON.stringify(stripped(JSON.parse(said))) : said;
};
const contentOf = (file, isOld) => {
  const bytes = readFileSync(file);
  if (!file.endsWith(".json") && !file.endsWith(".xml") && !file.endsWith(".txt")) return bytes.toString("latin1");
  let text = bytes.toString("utf8").replace(/ (time|timestamp)="[^"]*"/g, "");
  if (without.has("settings")) text = text.replace(/<property [^>]*>\s*/g, "");
  if (isOld) for (const [from, to] of renamed) text = text.replaceAll(from, to);
  if (!file.endsWith(".json") || without.size === 0) return text;
  return JSON.stringify(stripped(JSON.parse(text)));
};

const out = mkdtempSync(join(tmpdir(), "parity-same-"));
let exitCode = 0;
for (const [name, options] of Object.entries(runs)) {
  const [before, after] = [oldProgram, newProgram].map((program, i) => {
    const folder = join(out, `${i}`, name);
    mkdirSync(folder, { recursive: true });
    const result = spawnSync(program, options, { cwd: folder, encoding: "utf8" });
    return { folder, code: result.status, text: result.stdout };
  });
  const different = [];
  if (before.code !== after.code) exitCode = 2, different.push(`exit codes ${before.code} and ${after.code}`);
  if (saidBy(before) !== saidBy(after)) different.push("stdout");
  const names = new Set([before, after].flatMap(({ folder }) => filesOf(folder).map((file) => relative(folder, file))));
  for (const file of names) {
    const [a, b] = [before, after].map(({ folder }, i) => {
      try {
        return contentOf(join(folder, file), i === 0);
      } catch {
        return undefined; // the other alone has it
      }
    });
    if (a !== b) different.push(file);
  }
  if (different.length > 0) exitCode ||= 1;
  console.log(`${different.length > 0 ? "DIFFERS" : "same   "} ${name} (${names.size} files)${different.length > 0 ? ": " + different.join(", ") : ""}`);
}
rmSync(out, { recursive: true });
process.exit(exitCode);
