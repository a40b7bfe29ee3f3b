import { describe, expect, it } from "vitest";

import { entriesOf, groupingsOf, groupRows, kNoCause, kUnknownCause } from "../../src/data/groups";
import { makeRows } from "../../src/data/rows";
import { causeTotals } from "../../src/overview/causes";
import { troubleText } from "../../src/overview/group";
import { makeMaterial, makeReport, makeScene, makeView } from "./sample";

const by = (term: string, flip: number) => ({ attribution: { flip, terms: [{ term, flip: flip / 4 }] } });
const unclear = { attribution: { flip: 0.3, terms: [{ term: "fog", flip: 0.29 }] } };
const report = makeReport([
  makeScene("Desk", [
    makeView("front", [
      makeMaterial("Gold", "fail", 0.4, by("skySpecular", 0.4)),
      makeMaterial("Iron", "fail", 0.5, by("skySpecular", 0.5)),
      makeMaterial("Wood", "warn", 0.15, by("sunDiffuse", 0.15)),
      makeMaterial("Wax", "fail", 0.3, unclear),
      makeMaterial("Clay", "pass", 0.01),
    ]),
  ]),
  makeScene("Lamp", [makeView("front", [makeMaterial("Gold", "warn", 0.2, by("skySpecular", 0.2))])]),
]);
const rows = makeRows(report).filter((row) => row.kind === "material");
const labels = (grouping: Parameters<typeof groupRows>[1]): string[] => groupRows(rows, grouping).map(({ label, rows: all }) => `${label} ${all.length}`);

describe("groups", () => {
  it("gather by material, scene or cause, in the order of their first rows", () => {
    expect(labels("material")).toEqual(["Gold 2", "Iron 1", "Wood 1", "Wax 1", "Clay 1"]);
    expect(labels("scene")).toEqual(["Desk 5", "Lamp 1"]);
    expect(labels("cause")).toEqual(["skySpecular 3", "sunDiffuse 1", `${kNoCause} 1`, `${kUnknownCause} 1`]);
  });

  it("say how many failed and warned, and name the worst first", () => {
    const [sky] = groupRows(rows, "cause");
    expect([sky!.over, sky!.warned, troubleText(sky!)]).toEqual([2, 1, "2 failed, 1 warned"]);
    expect(sky!.worst.map((row) => row.name)).toEqual(["Iron", "Gold", "Gold"]);
    expect(troubleText(groupRows(rows, "cause")[3]!)).toBe("");
  });

  it("of views are by scene alone", () => {
    expect(groupingsOf("views")).toEqual(["none", "scene"]);
    expect(groupingsOf("materials")).toContain("cause");
  });

  it("is one without a head where nothing is grouped", () => {
    const entries = entriesOf(groupRows(rows, "none"), () => true, null);
    expect(entries.map((entry) => entry.kind)).toEqual(rows.map(() => "row"));
  });
});

describe("the lines of a grouped list", () => {
  const groups = groupRows(rows, "scene");
  const lines = (folded: string[], open: number | null = null): string[] =>
    entriesOf(groups, (key) => folded.includes(key), open === null ? null : rows[open]!).map((entry) => (entry.kind === "row" ? entry.row.name : `[${entry.group.label}${entry.isFolded ? " …" : ""}]`));

  it("are a head and its rows; of a folded group the head alone", () => {
    expect(lines([])).toEqual(["[Desk]", "Gold", "Iron", "Wood", "Wax", "Clay", "[Lamp]", "Gold"]);
    expect(lines(["scene Desk"])).toEqual(["[Desk …]", "[Lamp]", "Gold"]);
  });

  it("always hold the row that is open", () => {
    expect(lines(["scene Desk", "scene Lamp"], 1)).toEqual(["[Desk]", "Gold", "Iron", "Wood", "Wax", "Clay", "[Lamp …]"]);
  });
});

describe("totals by cause", () => {
  it("count what failed or warned, the cause of most failures first", () => {
    expect(causeTotals(rows).map(({ label, over, warned }) => [label, over, warned])).toEqual([
      ["skySpecular", 2, 1], [kNoCause, 1, 0], ["sunDiffuse", 0, 1],
    ]);
  });
});
