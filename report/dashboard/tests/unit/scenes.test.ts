import { describe, expect, it } from "vitest";

import { checkScene } from "../../src/data/scenes";
import { makeScene, makeView } from "./sample";

const scene = makeScene("Desk", [makeView("front", [])]);
const whole = { file: "scenes/0.js", format: 1, scene };
const check = (patch: object): unknown => checkScene({ ...whole, ...patch }, "scenes/0.js", "Desk");

describe("the file of a scene", () => {
  it("hands over the scene that the list names", () => {
    expect(check({})).toEqual({ scene, again: [] });
    expect(check({ again: [{ scene: "Desk", view: "front", command: "parity" }] })).toMatchObject({ again: [{ command: "parity" }] });
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
