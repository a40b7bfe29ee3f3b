// What each stage of a path alone makes of its picture.
import { html, nothing, type TemplateResult } from "lit";

import { pathWord } from "../data/paths";
import type { Head } from "../data/page";
import type { Stage } from "../data/types";
import { figureIn } from "../format";
import { help, type Topic } from "../help";

const kStages: Record<string, { words: string; topic: Topic }> = {
  encoding: { words: "The render target", topic: "encoding" },
  textures: { words: "Texture compression with", topic: "textures" },
};

/** "The render target": what comes before the thing that the picture passes through. */
export function wordsOf(stage: string): string {
  return kStages[stage]?.words ?? `The stage ${stage} with`;
}

/** path: its name. */
export function stageLine({ stage, through, figures }: Stage, path: string, report: Head): TemplateResult {
  const topic = kStages[stage]?.topic;
  return html`<p>${wordsOf(stage)} <code>${through}</code> alone causes FLIP ${figureIn(figures, "flip.mean", report.statistics)} in the picture of ${pathWord(path)}.${topic ? help(topic) : nothing}</p>`;
}
