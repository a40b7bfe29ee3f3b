// Tests of the adapter: the tiny contract is rendered, and its pictures are what is known in closed form; errors are told
// in one line. Run by `npm test`.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";

import { decodePng } from "./png.mjs";
import { changedContract, writeTinyContract } from "./tiny.mjs";
import { checkBall, checkCentres, checkColours, checkEdges, checkLights } from "./tiny_checks.mjs";

const kProgram = fileURLToPath(new URL("render.mjs", import.meta.url));
let folder, shots, contract;

const run = (...words) => spawnSync(process.execPath, [kProgram, ...words], { encoding: "utf8" });

/** What the adapter says of a changed copy of the contract. */
function runChanged(name, change) {
  const copy = changedContract(folder, contract, name, change);
  return { ...run(copy, join(copy, "shots")), shots: join(copy, "shots") };
}

function assertRefused(result, ...words) {
  assert.equal(result.status, 1);
  assert.match(result.stderr, /^render\.mjs: [^\n]*\n$/);
  for (const word of words) assert.ok(result.stderr.includes(word), `"${result.stderr}" has no "${word}"`);
}

before(() => {
  folder = mkdtempSync(join(tmpdir(), "parity-threejs-"));
  shots = join(folder, "shots");
  contract = writeTinyContract(join(folder, "contract"));
  const result = run(join(folder, "contract"), shots);
  assert.equal(result.status, 0, result.stderr);
  assert.equal(result.stderr, "");
  for (const picture of readdirSync(shots)) assert.match(result.stdout, new RegExp(`^${picture}: \\d+x\\d+, \\d+ samples?, \\d+\\.\\d+ s$`, "m"));
});
after(() => rmSync(folder, { recursive: true, force: true }));

test("each view has a picture", () => {
  assert.deepEqual(readdirSync(shots).sort(), contract.scenes.flatMap((scene) => scene.views.map((view) => view.picture)).sort());
});
test("one sample lies at the pixel's centre", () => checkCentres(shots));
// Slack: the software rasterizer rounds places to 1/16 of a pixel.
test("16 samples lie in a box of one pixel, averaged in linear light", () => checkEdges(shots, 1 / 16));
test("unlit colours have the codes of sRGB", () => checkColours(shots, 0));
// Slack: the prefiltered map rounds to half floats, and a mirror has the roughness .045.
test("the environment is oriented as the contract says", () => checkBall(shots, contract, 3));
test("lights are in lux and candela, and those of the file are removed", () => checkLights(shots, 1));

test("--tone changes the curve, --scene chooses", () => {
  const curved = join(folder, "curved");
  const result = run(join(folder, "contract"), curved, "--scene", "colours", "--tone", "aces");
  assert.equal(result.status, 0, result.stderr);
  assert.deepEqual(readdirSync(curved).sort(), ["colours-brighter.png", "colours-plain.png"]);
  assert.notDeepEqual(decodePng(readFileSync(join(curved, "colours-plain.png"))).at(20, 2), decodePng(readFileSync(join(shots, "colours-plain.png"))).at(20, 2));
});
test("the calibration is rendered, too", () => {
  const result = runChanged("colours", (changed) => {
    const scene = structuredClone(changed.scenes[0]);
    scene.views = [{ ...scene.views[0], picture: "calibration.png" }];
    changed.calibration = scene;
  });
  assert.equal(result.status, 0, result.stderr);
  assert.ok(readdirSync(result.shots).includes("calibration.png"));
});

test("errors name the file and the reason in one line", () => {
  assertRefused(run(join(folder, "nothing"), shots), "contract.json", "no such file");
  assertRefused(runChanged("edges", (changed) => (changed.format = 2)), "contract.json", "format is 2");
  assertRefused(runChanged("edges", (changed) => (changed.scenes[0].scene = "0/gone.glb")), "0/gone.glb");
  assertRefused(runChanged("edges", (changed) => (changed.scenes[0].views[0].picture = "../x.png")), "../x.png");
  assertRefused(runChanged("edges", (_, copy) => writeFileSync(join(copy, "0/edges.glb"), "glTF, but broken")), "edges.glb");
  assertRefused(runChanged("ball", (_, copy) => writeFileSync(join(copy, "0/patches.hdr"), "no map")), "patches.hdr", "no header");
});
test("a texture that is missing, or on the network, is an error", () => {
  const withTexture = (uri) => (changed, copy) => {
    const gltf = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], images: [{ uri }], textures: [{ source: 0 }] };
    gltf.buffers = [{ byteLength: 36, uri: `data:application/octet-stream;base64,${Buffer.alloc(36).toString("base64")}` }];
    gltf.bufferViews = [{ buffer: 0, byteLength: 36 }];
    gltf.accessors = [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3", min: [0, 0, 0], max: [0, 0, 0] }];
    gltf.materials = [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }];
    gltf.meshes = [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }];
    writeFileSync(join(copy, "0/textured.gltf"), JSON.stringify(gltf));
    changed.scenes[0].scene = "0/textured.gltf";
  };
  assertRefused(runChanged("edges", withTexture("gone.png")), "gone.png", "no such file");
  assertRefused(runChanged("edges", withTexture("https://example.org/a.png")), "https://example.org/a.png", "network");
});
test("wrong usage ends with 64", () => {
  assert.equal(run("only-one").status, 64);
  assert.equal(run(join(folder, "contract"), shots, "--tone", "filmic").status, 64);
  assert.match(run("--help").stdout, /^usage: render\.mjs/);
});
