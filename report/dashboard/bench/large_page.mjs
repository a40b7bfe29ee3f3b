// What the page of a large report costs in headless Chromium: until it can be used, a sort, a filter, a search, groups,
// scrolling, opening items.
//   node report/dashboard/bench/large_page.mjs FOLDER [ROUNDS]     FOLDER: of build/bench_report_size write FOLDER
// Each round is a new browser with an empty cache. A time ends when the page is drawn anew.
import { openReport, residentMegabytes } from "./opened.mjs";

const [folder, rounds = "3"] = process.argv.slice(2);
if (!folder) {
  console.error("node report/dashboard/bench/large_page.mjs FOLDER [ROUNDS]");
  process.exit(64);
}
const kDrawn = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
const times = new Map(); // by what is done

function note(what, ms) {
  times.set(what, [...(times.get(what) ?? []), ms]);
}

/** Does it in the page, and waits until `isDone` holds and it is drawn. */
async function measure(page, what, work, argument, isDone = () => true) {
  const ms = await page.evaluate(
    async ([workText, argument, isDoneText, drawnText]) => {
      const [work, isDone, drawn] = [workText, isDoneText, drawnText].map((text) => eval(`(${text})`));
      const start = performance.now();
      work(argument);
      do await drawn();
      while (!isDone(argument));
      return performance.now() - start;
    },
    [String(work), argument, String(isDone), String(kDrawn)],
  );
  note(what, ms);
}

const click = (selector) => document.querySelector(selector).click();
const search = (words) => {
  const input = document.querySelector("#search");
  input.value = words;
  input.dispatchEvent(new Event("input", { bubbles: true }));
};
const choose = ([selector, value]) => {
  const select = document.querySelector(selector);
  select.value = value;
  select.dispatchEvent(new Event("change", { bubbles: true }));
};
const press = (key) => document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
const isOpen = () => document.querySelector("parity-item .checks, parity-item .notice.error") !== null;

for (let round = 0; round < Number(rounds); ++round) {
  const { browser, page, times: loading } = await openReport(folder);
  note("first contentful paint", loading.paint);
  note("interactive", loading.interactive);
  note("memory after loading, MB", await residentMegabytes(browser));
  if (round === 0) console.log(await page.textContent(".shown"));

  await measure(page, "sort by mean FLIP", click, ".cell-flip-mean button.sort");
  await measure(page, "sort the other way", click, ".cell-flip-mean button.sort");
  await measure(page, "sort by name", click, ".cell-name button.sort");
  await measure(page, "filter: what failed", press, "2");
  await measure(page, "filter: all", press, "1");
  await measure(page, "search, first word", search, "chrome");
  await measure(page, "search, next letter", search, "chrome 1");
  await measure(page, "search for nothing", search, "");
  await measure(page, "group by scene", choose, ["select.grouping", "scene"]);
  await measure(page, "totals only", click, "button.fold-all");
  await measure(page, "group by cause", choose, ["select.grouping", "cause"]);
  await measure(page, "group by nothing", choose, ["select.grouping", "none"]);
  await measure(page, "scroll to the end", () => {
    const list = document.querySelector(".list-scroll");
    list.scrollTop = list.scrollHeight;
  });
  await measure(page, "scroll by a screen", () => document.querySelector(".list-scroll").scrollBy(0, -800));
  await measure(page, "views", click, ".lists button:nth-child(2)");
  await measure(page, "materials", click, ".lists button:nth-child(1)");
  await measure(page, "open an item", press, "ArrowDown", isOpen);
  await measure(page, "next item", press, "ArrowDown", isOpen);
  await measure(page, "back to the list", press, "Escape", () => document.querySelector("parity-item") === null);
  note("memory after all this, MB", await residentMegabytes(browser));
  await browser.close();
}

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
for (const [what, values] of times) console.log(`${what.padEnd(28)} median ${median(values).toFixed(0).padStart(5)}${what.endsWith("MB") ? "" : " ms"}, ${Math.min(...values).toFixed(0)} to ${Math.max(...values).toFixed(0)}`);
