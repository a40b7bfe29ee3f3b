// Tests of the adapter: Blender renders the tiny contract (../threejs/tiny.mjs), and its pictures are what is known in closed
// form; errors are told in one line. Run by `node --test test.mjs`; needs nothing but node and Blender.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";

import { changedContract, writeTinyContract } from "../threejs/tiny.mjs";
import { checkBall, checkColours, checkEdges, checkLights } from "../threejs/tiny_checks.mjs";

const kBlender = process.env.BLENDER || "blender";
const kProgram = fileURLToPath(new URL("render.py", import.meta.url));
const skip = spawnSync(kBlender, ["--version"]).status === 0 ? false : "there is no Blender: install it, or name it by BLENDER";
let folder, shots, contract;

const run = (...words) => spawnSync(kBlender, ["-b", "--factory-startup", "-t", "1", "--python", kProgram, "--", ...words], { encoding: "utf8", env: { ...process.env, DISPLAY: "", WAYLAND_DISPLAY: "" } });

function runChanged(name, change) {
  const copy = changedContract(folder, contract, name, change);
  return { ...run(copy, join(copy, "shots"), "--samples", "1"), shots: join(copy, "shots") };
}

function assertRefused(result, ...words) {
  assert.equal(result.status, 1, result.stderr);
  assert.match(result.stderr, /^render\.py: [^\n]*\n$/);
  for (const word of words) assert.ok(result.stderr.includes(word), `"${result.stderr}" has no "${word}"`);
}

before(() => {
  if (skip) return;
  folder = mkdtempSync(join(tmpdir(), "parity-blender-"));
  shots = join(folder, "shots");
  contract = writeTinyContract(join(folder, "contract"));
  const result = run(join(folder, "contract"), shots, "--samples", "64");
  assert.equal(result.status, 0, result.stderr);
  assert.equal(result.stderr, "");
});
after(() => folder && rmSync(folder, { recursive: true, force: true }));

test("each view has a picture", { skip }, () => {
  assert.deepEqual(readdirSync(shots).sort(), contract.scenes.flatMap((scene) => scene.views.map((view) => view.picture)).sort());
});
test("the filter is a box of one pixel, at the right place", { skip }, () => checkEdges(shots, 0.03));
test("unlit colours have the codes of sRGB", { skip }, () => checkColours(shots, 0));
test("the environment is oriented as the contract says", { skip }, () => checkBall(shots, contract, 3));
// More samples: each chooses one of the three lights at random. Slack: the importer of Blender 3.4 does not read
// specularFactor, so the plane shines a little, and its diffuse part is Disney's: both together add 3 %.
test("lights are in lux and candela, and those of the file are removed", { skip }, () => {
  const lit = join(folder, "lit");
  assert.equal(run(join(folder, "contract"), lit, "--scene", "lights", "--samples", "2048").status, 0);
  checkLights(lit, 2);
});

test("--scene chooses, and the calibration is rendered, too", { skip }, () => {
  const result = runChanged("colours", (changed) => {
    changed.calibration = structuredClone(changed.scenes[0]);
    changed.calibration.views = [{ ...changed.calibration.views[0], picture: "calibration.png" }];
  });
  assert.equal(result.status, 0, result.stderr);
  assert.deepEqual(readdirSync(result.shots).sort(), ["calibration.png", "colours-brighter.png", "colours-plain.png"]);
});
test("errors name the file and the reason in one line", { skip }, () => {
  assertRefused(run(join(folder, "nothing"), shots), "contract.json", "No such file");
  assertRefused(runChanged("edges", (changed) => (changed.format = 2)), "contract.json", "format is 2");
  assertRefused(runChanged("edges", (changed) => (changed.scenes[0].scene = "0/gone.glb")), "0/gone.glb");
  assertRefused(runChanged("edges", (_, copy) => writeFileSync(join(copy, "0/edges.glb"), "glTF, but broken")), "edges.glb");
  assertRefused(runChanged("ball", (_, copy) => writeFileSync(join(copy, "0/patches.hdr"), "no map")), "patches.hdr");
  assertRefused(runChanged("edges", (changed) => (changed.scenes[0].views[0].camera.projection[8] = 0.1)), "edges-oblique.png", "not centred");
  assertRefused(run(join(folder, "contract"), shots, "--engine", "eevee"), "Eevee", "display");
});
test("a texture that is missing is an error", { skip }, () => {
  const result = runChanged("edges", (changed, copy) => {
    const gltf = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], images: [{ uri: "gone.png" }], textures: [{ source: 0 }] };
    gltf.buffers = [{ byteLength: 36, uri: `data:application/octet-stream;base64,${Buffer.from(Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer).toString("base64")}` }];
    gltf.bufferViews = [{ buffer: 0, byteLength: 36 }];
    gltf.accessors = [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3", min: [0, 0, 0], max: [1, 1, 0] }];
    gltf.materials = [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }];
    gltf.meshes = [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }];
    writeFileSync(join(copy, "0/textured.gltf"), JSON.stringify(gltf));
    changed.scenes[0].scene = "0/textured.gltf";
  });
  assertRefused(result, "textured.gltf", "gone.png");
});
