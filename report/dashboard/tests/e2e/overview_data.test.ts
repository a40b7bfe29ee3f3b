// The list that the program writes into index.html, held against one made here from report.json.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";

import { Overview, type PackedOverview } from "../../src/data/overview";
import { figureOf, makeRows, type Row } from "../../src/data/rows";
import { overviewOf } from "../pack_overview";
import { readReport, reportFolder } from "./browser";

function writtenOverview(name: string): Overview {
  const html = readFileSync(join(reportFolder(name), "index.html"), "utf8");
  const block = /<script type="application\/json" id="overview">([\s\S]*?)<\/script>/.exec(html)?.[1] ?? "";
  return new Overview(JSON.parse(block) as PackedOverview);
}

const kParts = [
  "kind", "scene", "view", "material", "order", "link", "name", "place", "reference", "test", "isJudged", "verdict", "gravity", "reason", "accepted", "bias", "preset", "pixels",
  "nonFinite", "notModelled", "limits", "images", "cause", "noCause", "help", "isInBaseline", "changes", "change", "notComparable",
  "standing", "nights", "owner",
] as const;

describe.each(["many", "evil", "broken", "states", "empty", "real", "single", "restricted"])("the list of %s", (name) => {
  const report = readReport(name);
  const [written, made] = [writtenOverview(name), overviewOf(report)];

  it("has the report's rows", () => {
    const partsOf = (row: Row): object => Object.fromEntries<unknown>([...kParts.map((part): [string, unknown] => [part, row[part]]), ...Object.keys(report.statistics).map((figure): [string, unknown] => [figure, figureOf(row, figure)])]);
    expect(makeRows(written).map(partsOf)).toEqual(makeRows(made).map(partsOf));
  });

  it("has what the head of the page says of scenes and views", () => {
    expect(written.warnings()).toEqual(made.warnings());
    expect(written.tests()).toEqual(made.tests());
    expect(written.sceneLinks).toEqual(made.sceneLinks);
  });
});
