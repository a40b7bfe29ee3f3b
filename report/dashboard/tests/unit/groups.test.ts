import { describe, expect, it } from "vitest";

import { entriesOf, groupingsOf, groupRows, kUnknownCause } from "../../src/data/groups";
import { causeTotals } from "../../src/data/facts";
import { troubleText } from "../../src/overview/group";
import { layLines } from "../../src/overview/lines";
import { makeMaterial, makeReport, makeScene, makeView } from "./sample";
import { rowsOf } from "../pack_overview";

const by = (term: string, flip: number) => ({ attribution: { flip, terms: [{ term, flip: flip / 4 }] } });
const kNoCause = "no single term explains it";
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
const rows = rowsOf(report).filter((row) => row.kind === "material");
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
    expect(entries).toEqual(rows);
  });
});

describe("the lines of a grouped list", () => {
  const groups = groupRows(rows, "scene");
  const lines = (folded: string[], open: number | null = null): string[] =>
    entriesOf(groups, (key) => folded.includes(key), open === null ? null : rows[open]!).map((entry) => (entry.kind === "group" ? `[${entry.group.label}${entry.isFolded ? " …" : ""}]` : entry.name));

  it("are a head and its rows; of a folded group the head alone", () => {
    expect(lines([])).toEqual(["[Desk]", "Gold", "Iron", "Wood", "Wax", "Clay", "[Lamp]", "Gold"]);
    expect(lines(["scene Desk"])).toEqual(["[Desk …]", "[Lamp]", "Gold"]);
  });

  it("always hold the row that is open", () => {
    expect(lines(["scene Desk", "scene Lamp"], 1)).toEqual(["[Desk]", "Gold", "Iron", "Wood", "Wax", "Clay", "[Lamp …]"]);
  });
});

describe("the place of the lines", () => {
  const lay = (highest?: number) => layLines(entriesOf(groupRows(rows, "scene"), () => false, null), 40, 84, highest);

  it("is below one another, heads of groups by their own height", () => {
    expect(lay()).toMatchObject({ starts: [0, 40, 124, 208, 292, 376, 460, 500, 584], left: 0 });
  });

  it("ends where a browser has no more room, and says how many are left", () => {
    const { entries, starts, left } = lay(300);
    expect([entries.length, starts.at(-1), left]).toEqual([4, 292, 4]);
  });
});

describe("totals by cause", () => {
  it("count what failed or warned, the cause of most failures first", () => {
    expect(causeTotals(rows).map(({ label, over, warned }) => [label, over, warned])).toEqual([
      ["skySpecular", 2, 1], [kNoCause, 1, 0], ["sunDiffuse", 0, 1],
    ]);
  });
});
