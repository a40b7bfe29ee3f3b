import { describe, expect, it } from "vitest";

import { checkScene } from "../../src/data/scenes";
import { makeScene, makeView } from "./sample";

const scene = makeScene("Desk", [makeView("front", [])]);
const whole = { file: "scenes/0.js", format: 1, scene };
const check = (patch: object): unknown => checkScene({ ...whole, ...patch }, "scenes/0.js", "Desk");

describe("the file of a scene", () => {
  it("hands over the scene that the list names", () => {
    expect(check({})).toEqual({ scene, again: [], history: null });
    expect(check({ again: [{ scene: "Desk", view: "front", command: "parity" }] })).toMatchObject({ again: [{ command: "parity" }] });
  });

  it("hands over what the runs say of its rows; without it where it is damaged", () => {
    const trend = { figures: { "flip.mean": [[0, 3, 0.1]] }, verdicts: [[0, 3, "pass"]], changes: [] };
    expect(check({ history: { views: [[trend, null]] } })).toMatchObject({ history: { views: [[trend, null]] } });
    for (const history of [null, 3, {}, { views: 3 }, { views: [3] }]) expect(check({ history })).toMatchObject({ history: null });
    const broken = [{}, { ...trend, figures: { a: [3] } }, { ...trend, verdicts: [["a", 1]] }, { ...trend, changes: [null] }, { ...trend, approved: { run: 1 } }];
    expect(check({ history: { views: [[...broken, trend]] } })).toMatchObject({ history: { views: [[null, null, null, null, null, trend]] } });
  });

  it("that is another one, or damaged, is refused in words", () => {
    expect(() => checkScene(undefined, "scenes/0.js", "Desk")).toThrow("scenes/0.js holds no scene");
    expect(() => check({ format: 2 })).toThrow("has format 2, but this page reads format 1");
    expect(() => check({ file: "scenes/1.js" })).toThrow("that of another file");
    expect(() => check({ scene: null })).toThrow("holds no scene");
    expect(() => check({ scene: { ...scene, name: "Sofa" } })).toThrow("is of another report: it holds the scene Sofa");
    expect(() => check({ scene: { name: "Desk" } })).toThrow("has no views");
  });
});
