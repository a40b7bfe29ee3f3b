import { execFileSync } from "node:child_process";
import { describe, expect, it } from "vitest";

import { againCommand, globOf, shellWord } from "../../src/item/commands";
import { makeMaterial, makeReport, makeScene, makeView } from "./sample";
import { rowsOf } from "../pack_overview";

const evil = ["plain", "two words", "it's", '"$(touch /tmp/x)"', "`id`", "a\\b", "*", "ünïcödé 🎨", "-n"];
const byShell = (line: string): string[] => execFileSync("sh", ["-c", `printf '%s\\0' ${line}`]).toString().split("\0").slice(0, -1);

describe("shell words", () => {
  it("come out of a shell as they went in", () => {
    expect(byShell(evil.map(shellWord).join(" "))).toEqual(evil);
  });
});

describe("the command for a row", () => {
  const scene = makeScene("Desk", [makeView("front", [makeMaterial("Gold [1]*", "fail", 0.4)])]);
  const [material, whole] = rowsOf(makeReport([scene]));
  if (!material || !whole) throw new Error("two rows");

  const line = "parity diff 'a b/Desk.glb' --size 64x64";

  it("is the view's, with the material behind it", () => {
    const run = [{ scene: "Other", view: "front", command: "no" }, { scene: "Desk", view: "back", command: "no" }, { scene: "Desk", view: "front", command: line }];
    expect(againCommand(run, scene, whole)).toBe(line);
    expect(againCommand(run, scene, material)).toBe(`${line} --material 'Gold ?1]?'`);
    expect(againCommand(run, scene, { kind: "material", view: material.view, name: "-n" })).toBe(`${line} --material=-n`);
    const chosen = `${line} --material 'G*'`; // what the run itself was given stays
    expect(againCommand([{ scene: "Desk", view: "front", command: chosen }], scene, material)).toBe(chosen);
  });

  it("is the view's for each path that it was compared with", () => {
    const further = makeScene("Desk", [{ ...makeView("front (third)", []), test: "third" }]);
    expect(againCommand([{ scene: "Desk", view: "front", command: line }], further, whole)).toBe(line);
  });

  it("is none where the run does not have it", () => {
    expect(againCommand([], scene, whole)).toBeNull();
    expect(againCommand([{ scene: "Desk", view: "front", command: line }], makeScene("Desk", []), whole)).toBeNull();
  });

  it("matches wildcards, and what a terminal must not get, by any one character", () => {
    expect(globOf("a*b?[c]\\")).toBe("a?b??c]\\");
    expect(globOf("a\u001b\u202eb\n")).toBe("a**b*");
  });
});
