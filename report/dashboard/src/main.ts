// The page: data blocks in, <parity-app> in place of what index.html showed at first.
import "./style/tokens.css";
import "./style/base.css";
import "./style/frame.css";
import "./style/filters.css";
import "./style/list.css";
import "./style/row.css";
import "./style/beside.css";
import "./style/item.css";
import "./style/runs.css";
import "./style/card.css";
import "./style/explanation.css";
import "./style/plot.css";
import "./style/study.css";
import "./style/print.css";
import "./app";
import "./study/study";

import { readPage } from "./data/page";
import { readStudy } from "./data/study";
import type { ParityApp } from "./app";
import { failurePage } from "./failure";
import type { ParityStudy } from "./study/study";
import { render } from "lit";

function start(): void {
  const root = document.getElementById("app");
  if (!root) return;
  const page = readStudy(document) ?? readPage(document);
  root.replaceChildren();
  if ("problem" in page) {
    render(failurePage(page.problem), root);
  } else if ("kind" in page) {
    const study = document.createElement("parity-study") as ParityStudy;
    study.study = page;
    root.append(study);
  } else {
    const app = document.createElement("parity-app") as ParityApp;
    app.page = page;
    root.append(app);
  }
  // Once the rows in sight are drawn, keys and clicks are answered (bench/page.mjs reads it).
  requestAnimationFrame(() => requestAnimationFrame(() => performance.mark("parity-interactive")));
}

start();
