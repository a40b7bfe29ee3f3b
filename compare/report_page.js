// Sorting, filtering and a viewer that flips between the renders. The page reads well without any of it.
"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const rows = [...document.querySelectorAll(".material")];
  const filter = byId("filter"), sort = byId("sort");
  const chips = [...document.querySelectorAll(".chip input")];
  document.querySelector(".toolbar").hidden = rows.length < 2;

  function applyFilter() {
    const words = filter.value.toLowerCase();
    const hiddenVerdicts = new Set(chips.filter((chip) => !chip.checked).map((chip) => chip.value));
    for (const row of rows)
      row.hidden = hiddenVerdicts.has(row.dataset.verdict) || !row.dataset.name.toLowerCase().includes(words);
  }

  function applySort() {
    const number = (row, key) => Number(row.dataset[key]);
    const inOrder = (a, b) => number(a, "order") - number(b, "order");
    const largestFirst = (key) => (a, b) => number(b, key) - number(a, key);
    const orders = {
      gravity: (a, b) => largestFirst("gravity")(a, b) || largestFirst("mean")(a, b) || inOrder(a, b),
      mean: (a, b) => largestFirst("mean")(a, b) || inOrder(a, b),
      change: (a, b) => largestFirst("change")(a, b) || inOrder(a, b),
      light: (a, b) => largestFirst("light")(a, b) || inOrder(a, b),
      truth: (a, b) => largestFirst("truth")(a, b) || inOrder(a, b),
      name: (a, b) => a.dataset.name.localeCompare(b.dataset.name) || inOrder(a, b),
      order: inOrder,
    };
    for (const list of document.querySelectorAll(".materials"))
      list.append(...[...list.children].sort(orders[sort.value]));
  }

  filter.addEventListener("input", applyFilter);
  for (const chip of chips) chip.addEventListener("change", applyFilter);
  sort.addEventListener("change", applySort);

  const viewer = byId("viewer"), picture = byId("viewer-image"), tabs = byId("viewer-tabs");
  let shots = [], current = 0;

  function show(index) {
    current = (index + shots.length) % shots.length;
    picture.src = shots[current].href;
    picture.alt = shots[current].querySelector("img").alt;
    byId("viewer-open").href = shots[current].href;
    [...tabs.children].forEach((tab, i) => tab.setAttribute("aria-pressed", String(i === current)));
  }

  function open(shot) {
    const trio = shot.closest(".trio");
    shots = [...trio.querySelectorAll(".shot")];
    byId("viewer-title").textContent = trio.dataset.title;
    tabs.replaceChildren(...shots.map((each, i) => {
      const tab = document.createElement("button");
      tab.type = "button";
      tab.textContent = (i + 1) + "  " + each.closest("figure").querySelector("figcaption").textContent;
      tab.addEventListener("click", () => show(i));
      return tab;
    }));
    show(shots.indexOf(shot));
    viewer.showModal();
  }

  for (const shot of document.querySelectorAll(".shot"))
    shot.addEventListener("click", (event) => {
      if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      open(shot);
    });
  byId("viewer-close").addEventListener("click", () => viewer.close());
  viewer.addEventListener("click", (event) => { if (event.target === viewer) viewer.close(); });
  viewer.addEventListener("keydown", (event) => {
    if (event.key === "ArrowRight") show(current + 1);
    else if (event.key === "ArrowLeft") show(current - 1);
    else if (event.key >= "1" && event.key <= "9" && Number(event.key) <= shots.length) show(Number(event.key) - 1);
    else return;
    event.preventDefault();
  });
})();
