// The command that approves a row whose figures are beyond a limit.
import { html, nothing, type TemplateResult } from "lit";

import type { Judged } from "../data/judged";
import type { Row } from "../data/rows";
import { copyable } from "../parts";
import { approveCommand } from "./commands";

/** view: its name. Nothing of rows that need no approval, or can have none. */
export function approvePart(row: Row, judged: Judged, view: string): TemplateResult | typeof nothing {
  const command = approveCommand({ ...judged, kind: row.kind, name: row.name, scene: row.sceneName, view });
  if (command === null) return nothing;
  return html`<section class="approve"><h3>Approve this row as it is</h3>
    <p class="aside">Run it in the folder of this report, with your own words for WHO, DATE (such as 2027-02-01) and TEXT. Later runs read the file by <code>--approvals</code>. It holds until that day, for these inputs, and up to these figures.</p>
    ${copyable(command, "the command that approves this row")}</section>`;
}
