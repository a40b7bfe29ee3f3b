import { execFileSync } from "node:child_process";
import { describe, expect, it } from "vitest";

import { againCommand, approveCommand, globOf, shellWord, type Approvable } from "../../src/item/commands";
import { makeFigures, makeMaterial, makeReport, makeScene, makeView } from "./sample";
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

describe("the command that approves a row", () => {
  const check = { metric: "flip.mean", regress: false, value: 0.4, warn: 0.1, fail: 0.2, verdict: "fail" as const, note: "" };
  const hero: Approvable = { verdict: "fail", checks: [check], figures: makeFigures(0.4), kind: "material", name: "Chrome", scene: "Hero 1", view: "front" };
  const end = "--owner WHO --until DATE --reason 'TEXT' -o approvals.toml";

  it("names the row, and leaves who, until when and why to the reader", () => {
    expect(approveCommand(hero)).toBe(`parity approve . --scene 'Hero 1' --view front --material Chrome ${end}`);
    expect(approveCommand({ ...hero, kind: "whole", name: "" })).toBe(`parity approve . --scene 'Hero 1' --view front --whole ${end}`);
    expect(approveCommand({ ...hero, verdict: "warn" })).toBe(`parity approve . --scene 'Hero 1' --view front --material Chrome --warnings ${end}`);
  });

  it("comes out of a shell as globs of these names, whatever they are", () => {
    const words = byShell(approveCommand({ ...hero, name: "-it's [1]*", view: "$(id)" })!.replace("parity approve . ", ""));
    expect(words.slice(0, 5)).toEqual(["--scene", "Hero 1", "--view", "$(id)", "--material=-it's ?1]?"]);
  });

  it("is none where parity approve refuses the row, or has nothing to approve", () => {
    expect(approveCommand({ ...hero, verdict: "pass" })).toBeNull();
    expect(approveCommand({ ...hero, verdict: "error" })).toBeNull();
    expect(approveCommand({ ...hero, checks: [{ ...check, verdict: "pass" }] })).toBeNull();
    expect(approveCommand({ ...hero, figures: makeFigures(0.4, { nonFinite: 2 }) })).toBeNull();
    expect(approveCommand({ ...hero, figures: null })).toBeNull();
  });
});
