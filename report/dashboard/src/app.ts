// The page as a whole: one state, which the URL's hash holds, and what of it is shown.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";

import { factsOf, type Facts } from "./data/facts";
import { filterOf, isListed, matcherOf, sortRows } from "./data/filter";
import { groupingsOf, groupRows, type Group } from "./data/groups";
import type { Page } from "./data/page";
import { reasonOf } from "./data/reason";
import { findRow, makeRows, type Row } from "./data/rows";
import { barScale } from "./data/scale";
import { keptScene, loadScene, type SceneDetails } from "./data/scenes";
import { fromHash, isSameItem, kDefaultState, openItem, toHash, type Item, type State } from "./data/state";
import { PageElement } from "./element";
import { count } from "./format";
import { HelpPopover } from "./help_popover";
import { actionOf, shortcutsDialog, type Action } from "./keys";
import { kPhone, Media } from "./media";
import { filters, kCategories } from "./overview/filters";
import { kBarFigures } from "./overview/head";
import { header } from "./overview/header";
import "./overview/list";
import type { ParityList } from "./overview/list";
import "./item/item";
import type { ParityItem } from "./item/item";
import { Theme } from "./theme";

@customElement("parity-app")
export class ParityApp extends PageElement {
  @property({ attribute: false }) page!: Page;
  @state() private state: State = kDefaultState;
  @state() private isFolded = true; // the filters, on a phone and beside an item
  @query("parity-list") private list!: ParityList;
  @query("parity-item") private item!: ParityItem | null;
  @query("#shortcuts") private shortcuts!: HTMLDialogElement;
  @query("#search") private search!: HTMLInputElement | null;

  /** What is known of the open row's scene; null: nothing is open. */
  @state() private opened: { place: number; details: SceneDetails | null; problem: string } | null = null;

  private rows: Row[] = [];
  private facts!: Facts;
  private warnings: readonly string[] = []; // of the run, also crashes that it survived, and of each scene
  private tests: readonly string[] = []; // paths
  private scales: Readonly<Record<string, number>> = {};
  private groups: Group[] = [];
  private shown: Row[] = []; // of the groups, in their order
  private shownKey = "";
  private readonly phone = new Media(this, kPhone);
  private hashTimer = 0;
  private readonly theme = new Theme(() => this.requestUpdate());
  private readonly helpPopover = new HelpPopover();

  override connectedCallback(): void {
    super.connectedCallback();
    const { report, overview, run } = this.page;
    this.rows = makeRows(overview);
    this.facts = factsOf(this.rows);
    this.warnings = [...report.warnings, ...(run?.incidents ?? []), ...overview.warnings()];
    this.tests = overview.tests();
    this.scales = Object.fromEntries(kBarFigures.map((name) => [name, barScale(this.rows, name)]));
    this.read(location.hash);
    window.addEventListener("hashchange", this.onHash);
    window.addEventListener("keydown", this.onKey);
    window.addEventListener("keyup", this.onKeyUp);
    this.addEventListener("parity-state", this.onState as EventListener);
    this.helpPopover.listen(this);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    window.removeEventListener("hashchange", this.onHash);
    window.removeEventListener("keydown", this.onKey);
    window.removeEventListener("keyup", this.onKeyUp);
    this.helpPopover.stop();
  }

  /** A link to an item opens the list that has its row. */
  private read(hash: string): void {
    this.state = fromHash(hash);
    const open = this.openRow();
    if (open && !isListed(open, this.state.list)) this.state = { ...this.state, list: open.kind === "whole" ? "views" : "materials" };
  }

  private readonly onHash = (): void => {
    if (location.hash !== toHash(this.state)) this.read(location.hash);
  };

  private readonly onState = (event: CustomEvent<Partial<State>>): void => this.set(event.detail);

  /** What moves continuously replaces the URL's hash once it rests; what opens or closes an item is a step of the history. */
  private set(patch: Partial<State>): void {
    const before = this.state;
    this.state = { ...before, ...patch };
    const isStep = (["scene", "view", "material", "tab"] as const).some((key) => this.state[key] !== before[key]);
    window.clearTimeout(this.hashTimer);
    if (!isStep) {
      this.hashTimer = window.setTimeout(() => this.writeHash(this.state, false), 150);
      return;
    }
    this.writeHash(before, false); // it may not have rested yet
    this.writeHash(this.state, true);
  }

  private writeHash(state: State, isStep: boolean): void {
    const url = toHash(state) || location.pathname + location.search;
    try {
      if (isStep) history.pushState(null, "", url);
      else history.replaceState(null, "", url);
    } catch {
      // A sandboxed frame has no history: the page works, its link just does not say what is shown.
    }
  }

  /** The rows that pass the filter, sorted and grouped: made anew only when these change. */
  private visibleRows(): Row[] {
    const { list, query: words, verdicts, changes, causedBy, preset, group, sort, ascending } = this.state;
    const key = JSON.stringify([list, words, verdicts, changes, causedBy, preset, group, sort, ascending]);
    if (key !== this.shownKey) {
      const sorted = sortRows(this.rows.filter(matcherOf(this.page.overview, filterOf(this.state))), sort, ascending);
      this.groups = groupRows(sorted, groupingsOf(list).includes(group) ? group : "none");
      this.shown = this.groups.length === 1 ? this.groups[0]!.rows : this.groups.flatMap((each) => each.rows);
      this.shownKey = key;
    }
    return this.shown;
  }

  private rowOf(item: Item): Row | null {
    return findRow(this.page.overview, this.rows, item);
  }

  private openRow(): Row | null {
    return this.rowOf(this.state);
  }

  /** Asks for the details of a row's scene, unless they are here or on their way. */
  private loadDetails({ scene: place, sceneName }: Row): void {
    if (this.opened?.place === place) return;
    const opened = { place, details: keptScene(place), problem: "" };
    this.opened = opened;
    if (opened.details) return;
    const settle = (patch: { details: SceneDetails } | { problem: string }): void => {
      if (this.opened?.place === place) this.opened = { ...opened, ...patch };
    };
    loadScene(place, sceneName).then((details) => settle({ details }), (error: unknown) => settle({ problem: reasonOf(error) }));
  }

  /** Of the rows beside the open one, so that the keys step to them without waiting. */
  private loadBeside(open: Row): void {
    const rows = this.visibleRows();
    const at = rows.indexOf(open);
    for (const row of at < 0 ? [] : [rows[at - 1], rows[at + 1]])
      if (row && row.scene !== open.scene) void loadScene(row.scene, row.sceneName).catch(() => undefined); // it says so when it is opened
  }

  private open(row: Row | undefined): void {
    if (row) this.set(openItem(this.state, row.link));
  }

  private step(by: number): void {
    const rows = this.visibleRows();
    const open = this.openRow();
    const at = open ? rows.indexOf(open) : -1;
    this.open(rows[Math.min(rows.length - 1, Math.max(0, at < 0 ? (by > 0 ? 0 : rows.length - 1) : at + by))]);
  }

  private readonly onKey = (event: KeyboardEvent): void => {
    if (this.shortcuts.open) return;
    const action = actionOf(event);
    if (action ? this.act(action) : this.openRow() !== null && (this.item?.handleKey(event) ?? false)) event.preventDefault();
  };

  private readonly onKeyUp = (event: KeyboardEvent): void => {
    this.item?.handleKeyUp(event);
  };

  /** Whether it did anything. */
  private act(action: Action): boolean {
    switch (action.kind) {
      case "help":
        this.shortcuts.showModal();
        return true;
      case "search":
        this.search?.focus();
        return true;
      case "step":
        this.step(action.by);
        return true;
      case "category": {
        const category = kCategories[action.index];
        if (category) this.set({ verdicts: category.verdict === "" ? [] : [category.verdict] });
        return category !== undefined;
      }
      case "tab":
        if (action.tab === "history" && this.page.history === null) return false;
        if (this.openRow()?.isJudged) this.set({ tab: action.tab });
        return this.openRow() !== null;
      case "close":
        if (!this.openRow()) return false;
        this.set({ scene: "", view: "", material: "" });
        return true;
      case "theme":
        this.theme.next();
        return true;
    }
  }

  protected override willUpdate(): void {
    const { report } = this.page;
    const open = this.openRow();
    document.title = [report.tool, report.suite, open?.name.slice(0, 80) ?? report.headline].filter((each) => each !== "").join(": ");
    if (open) this.loadDetails(open);
    else this.opened = null;
  }

  protected override updated(changed: PropertyValues): void {
    const before = changed.get("state") as State | undefined;
    if (before && !isSameItem(before, this.state)) this.moveFocus(before);
    const open = changed.has("opened") && this.opened?.details ? this.openRow() : null;
    if (open) this.loadBeside(open);
  }

  /** Where the reader goes on: at the title of what was opened, at the row of what was closed. */
  private moveFocus(before: State): void {
    const isOpen = this.openRow() !== null;
    const wasOpen = before.scene !== "";
    void this.list?.updateComplete.then(async () => {
      if (isOpen && !wasOpen) {
        window.scrollTo(0, 0);
        this.querySelector<HTMLElement>("#item-title")?.focus({ preventScroll: true });
      }
      await this.list?.reveal(this.rowOf(isOpen ? this.state : before), !isOpen);
    });
  }

  protected override render(): TemplateResult {
    const rows = this.visibleRows();
    const open = this.openRow();
    const { report, run, history } = this.page;
    const { scene, view, material } = this.state;
    return html`
      ${header({
        report,
        run,
        history,
        facts: this.facts,
        warnings: this.warnings,
        isBrief: open !== null,
        isPhone: this.phone.matches,
        lost: open === null ? [scene, view, material].filter((each) => each !== "").join(" · ").slice(0, 200) : "",
        theme: this.theme,
        openKeys: () => this.shortcuts.showModal(),
      })}
      <div class="layout ${open ? "with-item" : ""}">
        <section class="overview" aria-label="Overview">
          ${filters({ report, history, facts: this.facts, shown: rows.length, state: this.state, fold: open !== null || this.phone.matches ? { isFolded: this.isFolded, toggle: () => (this.isFolded = !this.isFolded) } : null, set: (patch) => this.set(patch) })}
          <parity-list .report=${report} .tests=${this.tests} .isEmpty=${this.rows.length === 0} .groups=${this.groups} .scales=${this.scales} .state=${this.state} .open=${open} .compact=${open !== null}></parity-list>
        </section>
        ${
          open
            ? html`<parity-item
                .page=${this.page}
                .scales=${this.scales}
                .row=${open}
                .details=${this.opened?.details ?? null}
                .problem=${this.opened?.problem ?? ""}
                .state=${this.state}
                .place=${rows.includes(open) ? `${count(rows.indexOf(open) + 1)} of ${count(rows.length)}` : "not in the list"}
                @parity-step=${(event: CustomEvent<number>) => this.step(event.detail)}
                @parity-close=${() => this.act({ kind: "close" })}
              ></parity-item>`
            : nothing
        }
      </div>
      ${shortcutsDialog()}
    `;
  }
}
