// What the pictures of the tiny contract (tiny.mjs) must show. slack: codes, of 255, by which a value may differ.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { decodePng } from "./png.mjs";
import { directionsBeside, kBackground, kCentres, kColours, kEdges, kPatches, kRestOfMap, lightsAt, reflectedAt, toCode } from "./tiny.mjs";

const kBackgroundCodes = kBackground.map(toCode);
const read = (shots, picture) => decodePng(readFileSync(join(shots, picture)));

function assertNear(actual, expected, slack, what) {
  const most = Math.max(...actual.map((each, i) => Math.abs(each - expected[i])));
  assert.ok(most <= slack, `${what}: ${actual}, not ${expected}`);
}

/** A pixel is covered if its centre is. For views of one sample. */
export function checkCentres(shots) {
  const picture = read(shots, "centres-oblique.png");
  assert.deepEqual([picture.width, picture.height], [24, 16]);
  for (const { x, y, covered } of kCentres) assert.deepEqual(picture.at(x, y), covered ? [255, 255, 255] : kBackgroundCodes, `pixel ${x}, ${y}`);
}

/** Returns where the four edges lie, in pixels, as the partly covered pixels say; checks them. slack: pixels. */
export function checkEdges(shots, slack) {
  const picture = read(shots, "edges-oblique.png");
  const toLinear = (code) => (code <= 10.31475 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4);
  const share = (x, y) => (toLinear(picture.at(x, y)[0]) - kBackground[0]) / (kEdges.color[0] - kBackground[0]); // of the pixel that is covered, by red
  const across = (from, to, shareAt) => Array.from({ length: to - from }, (_, i) => shareAt(from + i)).reduce((sum, each) => sum + each);
  const found = {
    left: 13 - across(8, 13, (x) => share(x, 20)),
    right: 38 + across(38, 43, (x) => share(x, 20)),
    top: 11 - across(6, 11, (y) => share(25, y)),
    bottom: 28 + across(28, 33, (y) => share(25, y)),
  };
  for (const side of Object.keys(found)) assert.ok(Math.abs(found[side] - kEdges[side]) <= slack, `${side} edge at ${found[side]}, not ${kEdges[side]}`);
  // The filter is a box of one pixel: pixels beside the cut ones are whole.
  for (const [x, covered] of [[9, 0], [11, 1], [39, 1], [41, 0]]) assert.ok(Math.abs(share(x, 20) - covered) < 0.01, `pixel ${x}, 20 is covered by ${share(x, 20)}`);
  return found;
}

/** Unlit colours and background, sRGB-encoded, without and with exposure. */
export function checkColours(shots, slack) {
  for (const [name, exposure] of [["plain", 1], ["brighter", 2]]) {
    const picture = read(shots, `colours-${name}.png`);
    kColours.forEach((color, i) => assertNear(picture.at(8 * i + 4, 2), color.map((each) => toCode(each * exposure)), slack, `${name}, colour ${i}`));
    assertNear(picture.at(4, 6), kBackground.map((each) => toCode(each * exposure)), slack, `${name}, background`);
  }
}

/** The ball shows each patch where a mirror would. */
export function checkBall(shots, contract, slack) {
  const scene = contract.scenes.find((each) => each.name === "ball");
  const seen = new Set();
  for (const view of scene.views) {
    const picture = read(shots, view.picture);
    assertNear(picture.at(0, 0), kBackgroundCodes, 1, "the map lights the ball, and is not seen");
    const check = (direction, most, color, what) => {
      const at = reflectedAt(view, direction, most);
      if (at) assertNear(picture.at(...at), color.map(toCode), slack, `${view.name}, ${what}, pixel ${at}`);
      return at !== null;
    };
    for (const { direction, color, name } of kPatches) {
      if (check(direction, 70, color, name)) seen.add(name);
      for (const each of directionsBeside(direction, 31)) check(each, 45, color, `inside ${name}`);
      for (const each of directionsBeside(direction, 43)) check(each, 45, kRestOfMap, `beside ${name}`);
    }
  }
  assert.equal(seen.size, kPatches.length);
}

/** Lux and candela; the light of the file is gone. */
export function checkLights(shots, slack) {
  const picture = read(shots, "lights-above.png");
  for (const { x, y, color } of lightsAt()) assertNear(picture.at(x, y), color.map(toCode), slack, `pixel ${x}, ${y}`);
}
