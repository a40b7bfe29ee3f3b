// The page of a sweep, of a stress run or of nightly runs: its head, and what it is made of.
import { html, nothing, type TemplateResult } from "lit";
import { customElement, property } from "lit/decorators.js";

import type { Study } from "../data/study";
import { spanOf, titleOf } from "../data/nights";
import type { Verdict } from "../data/types";
import { countOf } from "../data/wording";
import { PageElement } from "../element";
import { HelpPopover } from "../help_popover";
import { actionOf } from "../keys";
import { badge } from "../parts";
import { Theme, themeButton } from "../theme";
import "./nights";
import { stressParts } from "./stress";
import { sweepParts } from "./sweep";

interface Head {
  tool: string;
  title: string;
  verdict: Verdict | null;
  sub: readonly string[];
}

function headOf(study: Study): Head {
  if (study.kind === "sweep") {
    const { version, startedAt, machine } = study.sweep.bench;
    return { tool: "parity bench", title: "Error against time", verdict: null, sub: [machine.device, startedAt.replace("T", " ").replace("Z", " UTC"), `parity ${version}`] };
  }
  if (study.kind === "nights") {
    const { nights } = study;
    return { tool: "parity history", title: titleOf(nights), verdict: nights.runs.at(-1)?.verdict ?? null, sub: [spanOf(nights.runs), nights.version === "" ? "" : `parity ${nights.version}`] };
  }
  const { unexpected, expected, device, version } = study.stress;
  return { tool: "parity stress", title: `${unexpected} unexpected, ${countOf(expected, "expected findings")}`, verdict: unexpected > 0 ? "fail" : "pass", sub: [device, `parity ${version}`] };
}

function partsOf(study: Study): TemplateResult {
  if (study.kind === "sweep") return sweepParts(study.sweep);
  if (study.kind === "stress") return stressParts(study.stress, study.times);
  return html`<parity-nights .nights=${study.nights}></parity-nights>`;
}

@customElement("parity-study")
export class ParityStudy extends PageElement {
  @property({ attribute: false }) study!: Study;
  private readonly theme = new Theme(() => this.requestUpdate());
  private readonly helpPopover = new HelpPopover();

  override connectedCallback(): void {
    super.connectedCallback();
    window.addEventListener("keydown", this.onKey);
    this.helpPopover.listen(this);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    window.removeEventListener("keydown", this.onKey);
    this.helpPopover.stop();
  }

  private readonly onKey = (event: KeyboardEvent): void => {
    if (actionOf(event)?.kind === "theme") this.theme.next();
  };

  protected override render(): TemplateResult {
    const { tool, title, verdict, sub } = headOf(this.study);
    return html`<header class="page-head ${verdict?.replace(" ", "-") ?? ""}">
        <div class="head-line">
          <h1>${verdict ? badge(verdict) : nothing} <span>${title}</span></h1>
          <div class="head-buttons">${themeButton(this.theme)}</div>
        </div>
        <p class="sub">${[tool, ...sub].filter((each) => each !== "").join(" · ")}</p>
      </header>
      <div class="study">${partsOf(this.study)}</div>`;
  }
}
