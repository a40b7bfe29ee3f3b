// What a report's page costs in headless Chromium: time to first paint and until it can be used, and memory.
//   node report/dashboard/bench/page.mjs FOLDER [ROUNDS]     FOLDER: of a report, as build/dashboard_reports/many
// Each round is a new browser with an empty cache. Memory: of the page's process, after scrolling through every row and opening ten items.
import { openReport, residentMegabytes } from "./opened.mjs";

const [folder, rounds = "5"] = process.argv.slice(2);
if (!folder) {
  console.error("node report/dashboard/bench/page.mjs FOLDER [ROUNDS]");
  process.exit(64);
}
const paints = [], interactives = [];
for (let i = 0; i < Number(rounds); ++i) {
  const { browser, times } = await openReport(folder);
  paints.push(times.paint);
  interactives.push(times.interactive);
  await browser.close();
}
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const line = (what, values) => console.log(`${what}: median ${median(values).toFixed(0)} ms, ${Math.min(...values).toFixed(0)} to ${Math.max(...values).toFixed(0)}`);
line("first contentful paint", paints);
line("interactive", interactives);

const { browser, page } = await openReport(folder);
const session = await page.context().newCDPSession(page);
await session.send("Performance.enable");
const before = await residentMegabytes(browser);
const frames = await page.evaluate(async () => {
  const list = document.querySelector(".list-scroll");
  const times = [];
  let last = performance.now();
  for (let top = 0; top < list.scrollHeight; top += 300) {
    list.scrollTop = top;
    await new Promise((done) => requestAnimationFrame(done));
    const now = performance.now();
    times.push(now - last);
    last = now;
  }
  return times.sort((a, b) => a - b);
});
console.log(`scrolling: median frame ${median(frames).toFixed(1)} ms, 99th percentile ${frames[Math.floor(frames.length * 0.99)].toFixed(1)} ms, ${frames.length} frames`);
for (let i = 0; i < 10; ++i) {
  await page.keyboard.press("ArrowDown");
  await page.waitForTimeout(300);
}
const { metrics } = await session.send("Performance.getMetrics");
const heap = metrics.find((each) => each.name === "JSHeapUsedSize").value / 2 ** 20;
console.log(`memory: ${before.toFixed(0)} MB after loading, ${(await residentMegabytes(browser)).toFixed(0)} MB after all rows and ten items; script's heap ${heap.toFixed(0)} MB`);
await browser.close();
