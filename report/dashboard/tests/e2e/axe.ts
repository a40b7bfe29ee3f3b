// Accessibility by axe-core, in the page as it stands.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import type { AxeResults } from "axe-core";
import type { Page } from "playwright-core";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Rules of axe-core (these; none: all) that are broken seriously or critically, each with the first place. */
export async function violations(page: Page, rules: string[] = []): Promise<string[]> {
  if (!(await page.evaluate(() => "axe" in window))) await page.evaluate(axe);
  // Of what passes axe would list every element, too.
  const found = await page.evaluate(async (only) => {
    const { axe: program } = window as unknown as { axe: { run(options: object): Promise<AxeResults> } };
    const results = await program.run({ resultTypes: ["violations"], ...(only.length > 0 ? { runOnly: only } : {}) });
    return results.violations;
  }, rules);
  return found
    .filter((each) => each.impact === "serious" || each.impact === "critical")
    .map((each) => `${each.id}: ${each.help}: ${each.nodes[0]?.html.slice(0, 200)} ${each.nodes[0]?.failureSummary ?? ""}`);
}
