import { execFileSync } from "node:child_process";
import { describe, expect, it } from "vitest";

import { makeRows } from "../../src/data/rows";
import { diffCommand, globOf, shellWord, splitWords } from "../../src/item/commands";
import { makeMaterial, makeReport, makeScene, makeView } from "./sample";

const evil = ["plain", "two words", "it's", '"$(touch /tmp/x)"', "`id`", "a\\b", "*", "ünïcödé 🎨", "-n"];
const byShell = (line: string): string[] => execFileSync("sh", ["-c", `printf '%s\\0' ${line}`]).toString().split("\0").slice(0, -1);

describe("shell words", () => {
  it("come out of a shell as they went in", () => {
    expect(byShell(evil.map(shellWord).join(" "))).toEqual(evil);
  });

  it("are split as a shell does", () => {
    for (const line of [evil.map(shellWord).join(" "), `a  "b c"'d' e\\ f '' "x\\"y"`]) expect(splitWords(line)).toEqual(byShell(line));
  });
});

describe("the command for a row", () => {
  const scene = makeScene("Desk", [makeView("front", [makeMaterial("Gold [1]*", "fail", 0.4)])]);
  const [material, whole] = makeRows(makeReport([scene]));
  if (!material || !whole) throw new Error("two rows");

  it("is the report's for one scene and material, without what only a report has", () => {
    const line = "parity report other.glb 'a b/Desk.glb' --env sky.hdr -o out --size 64x64 --json x.json --single-file -q --material Old --bench=b.json";
    expect(diffCommand(line, scene, whole)).toBe("parity diff 'a b/Desk.glb' --env sky.hdr --size 64x64");
    expect(diffCommand(line, scene, material)).toBe("parity diff 'a b/Desk.glb' --env sky.hdr --size 64x64 --material 'Gold ?1??'");
  });

  it("has the scene's own environment where the report had several", () => {
    const night = { ...scene, environment: "night.hdr" };
    const line = "parity report 'a b/Desk.glb' --env sky.hdr --env=lights/night.hdr --csv x.csv";
    expect(diffCommand(line, night, whole)).toBe("parity diff 'a b/Desk.glb' --env=lights/night.hdr");
    expect(diffCommand(line, { ...scene, environment: "sky.hdr" }, whole)).toBe("parity diff 'a b/Desk.glb' --env sky.hdr");
  });

  it("is none where the line does not say which file it is", () => {
    expect(diffCommand("parity report --suite a.toml -o out", scene, whole)).toBeNull();
    expect(diffCommand("parity report other.glb -o out", scene, whole)).toBeNull();
    expect(diffCommand("parity report a/Desk.glb b/Desk.glb -o out", scene, whole)).toBeNull();
    expect(diffCommand("", scene, whole)).toBeNull();
  });

  it("matches wildcards by any one character", () => {
    expect(globOf("a*b?[c]\\")).toBe("a?b??c??");
  });
});
