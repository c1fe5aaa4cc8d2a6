// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// What is shown, the address, keys and theme.

let page = null;  // the case page that is shown, or null
let overviewScroll = 0;

function setTheme(name) {
  markTheme(name);
  try { localStorage.setItem("edgecase-theme", name); } catch (e) { /* not remembered */ }
  if (page && page.viewer) { page.viewer.rebuild(); if (page.viewer.cursor) { page.inspector.show(page.viewer.cursor); } }
}

function setAddress(hash) {
  if (location.hash === hash) { return; }
  try { history.replaceState(null, "", hash || location.pathname); } catch (e) { location.hash = hash; }
}
function rememberOverview() {
  byId("unknown").hidden = true;
  const parts = new URLSearchParams();
  if (listing.words) { parts.set("q", listing.words); }
  if (listing.group !== "family") { parts.set("group", listing.group); }
  if (listing.sort !== "status") { parts.set("sort", listing.sort); }
  if (listing.cause) { parts.set("cause", listing.cause); }
  if (listing.off.size) { parts.set("hide", [...listing.off].join(",")); }
  setAddress("#" + parts.toString());
}
function rememberCase() {
  if (!page) { return; }
  let hash = "#case=" + encodeURIComponent(page.record.id);
  const v = page.viewer;
  if (v && v.pinned) { hash += "&px=" + v.pinned.x + "," + v.pinned.y + (v.scene.pictures.samples > 1 ? "," + v.pinned.sample : ""); }
  if (v) { hash += "&view=" + viewing.view; }
  if (v && viewing.zoom) { hash += "&zoom=" + viewing.zoom; }
  setAddress(hash);
}

function neighboursOf(id) {
  const order = listedCases().filter((e) => !isExpected(e.record)), at = order.findIndex((e) => e.record.id === id);
  const list = order.length ? order : [];
  if (at < 0) { return {previous: null, next: list.length ? list[0].record.id : null, position: ""}; }
  const name = (k) => list[k] ? list[k].record.id : null;
  return {previous: name(at - 1), next: name(at + 1), position: (at + 1) + " of " + list.length + " unexpected"};
}

function openCase(id, at) {
  const entry = entryOf.get(id);
  if (!entry) { return; }
  if (!page) { overviewScroll = window.scrollY; }
  page = makeCasePage(entry.record, neighboursOf(id), rememberCase);
  byId("overview").hidden = true;
  byId("case").hidden = false;
  byId("case").replaceChildren(page.element);
  document.title = id + " \u2014 " + document.documentElement.dataset.title;
  window.scrollTo(0, 0);
  byId("case-title").focus({preventScroll: true});
  if (page.viewer) {
    page.viewer.rebuild();
    const lead = entry.record.lead && finding(entry.record.lead);
    if (at || lead) { page.pin(at ? {...at, sample: at.sample === undefined ? sampleToSee(page, at, lead) : at.sample} : page.findings[0]); }
  }
  rememberCase();
}

// Of a pixel the sample that fails, or leads all that fail; else the first.
function sampleToSee({viewer}, at, lead) {
  if (lead && lead.x === at.x && lead.y === at.y) { return lead.sample; }
  const p = viewer.scene.pictures;
  for (let sample = 0; sample < p.samples && isInPicture(p, {...at, sample}); ++sample) {
    if (p.marks[indexOf(p, {...at, sample})] > 1) { return sample; }
  }
  return 0;
}

function openOverview() {
  page = null;
  byId("case").hidden = true;
  byId("case").replaceChildren();
  byId("overview").hidden = false;
  document.title = document.documentElement.dataset.title;
  rememberOverview();
  window.scrollTo(0, overviewScroll);
}

// Shows what the address names.
function follow() {
  const hash = location.hash.slice(1);
  // An id may hold "+", which stands for a space in a filter alone.
  const parts = new URLSearchParams(/(^|&)case=/.test(hash) ? hash.replaceAll("+", "%2B") : hash), id = parts.get("case");
  if (id !== null && entryOf.has(id)) {
    if (VIEWS.some((v) => v[0] === parts.get("view"))) { viewing.view = parts.get("view"); }
    const zoom = Number(parts.get("zoom"));
    viewing.zoom = Number.isInteger(zoom) && zoom >= 1 && zoom <= MAX_ZOOM ? zoom : 0;
    const numbers = (parts.get("px") || "").split(",").map(Number);
    openCase(id, numbers.length >= 2 && numbers.every((n) => Number.isInteger(n) && n >= 0) ? {x: numbers[0], y: numbers[1], sample: numbers[2]} : null);
    return;
  }
  listing.words = parts.get("q") || "";
  listing.group = GROUPS[parts.get("group")] ? parts.get("group") : "family";
  listing.sort = SORTS[parts.get("sort")] ? parts.get("sort") : "status";
  listing.cause = parts.get("cause") || "";
  listing.off = new Set((parts.get("hide") || "").split(",").filter((s) => GLYPHS[s]));
  byId("filter").value = listing.words;
  byId("group").value = listing.group;
  byId("sort").value = listing.sort;
  showList();
  if (page) { openOverview(); }
  byId("unknown").hidden = id === null;
  byId("unknown").textContent = id === null ? "" : "There is no case " + id + " in this report.";
}

function help(show) {
  const dialog = byId("help");
  if (show === undefined ? !dialog.open : show) { dialog.showModal(); } else { dialog.close(); }
}

function stepFinding(by) {
  const list = page.findings;
  if (list.length === 0) { return; }
  const at = list.findIndex(page.isMarked);
  let next = at < 0 ? 0 : at;
  if (at >= 0) { do { next = (next + by + list.length) % list.length; } while (next !== at && page.isMarked(list[next])); }
  page.pin(list[next]);
}
function stepCase(by) {
  const to = neighboursOf(page.record.id);
  const id = by > 0 ? to.next : to.previous;
  if (id) { openCase(id); }
}
function toggle(option) {
  const box = document.querySelector("[data-option=" + option + "]");
  if (box) { box.click(); }
}

const CASE_KEYS = {n: () => stepCase(1), p: () => stepCase(-1), j: () => stepFinding(1), k: () => stepFinding(-1), Escape: () => openOverview()};
const moved = (dx, dy, ds) => () => { page.viewer.move(dx, dy, ds); byId("announcer").textContent = page.inspector.sentence(page.viewer.cursor); page.mark(page.viewer.cursor); };
const VIEWER_KEYS = {ArrowLeft: moved(-1, 0, 0), ArrowRight: moved(1, 0, 0), ArrowUp: moved(0, -1, 0), ArrowDown: moved(0, 1, 0), "[": moved(0, 0, -1), "]": moved(0, 0, 1),
  "+": () => page.viewer.zoomBy(1), "=": () => page.viewer.zoomBy(1), "-": () => page.viewer.zoomBy(-1), 0: () => page.viewer.setZoom(0),
  b: () => page.viewer.setView(viewing.view === "blink" ? "difference" : "blink"), o: () => toggle("outlines"), s: () => toggle("samples"), g: () => toggle("grid"),
  " ": () => { page.viewer.blinkOn = !page.viewer.blinkOn; page.viewer.draw(); }};
LIMITS.forEach(([kind, , key]) => { VIEWER_KEYS[key] = () => toggle(kind); });
VIEWS.forEach(([name], k) => { VIEWER_KEYS[k + 1] = () => page.viewer.setView(name); });
const LIST_KEYS = {n: () => { const first = listedCases().find((e) => !isExpected(e.record)); if (first) { openCase(first.record.id); } }, Escape: () => byId("clear").click()};

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) { return; }
  const tag = event.target.tagName;
  if (byId("help").open || tag === "SELECT" || (tag === "INPUT" && event.target.type !== "checkbox")) {
    if (event.key === "Escape" && tag === "INPUT") { event.target.blur(); }
    if (event.key === "?" && byId("help").open) { help(false); }
    return;
  }
  if (event.key === " " && tag !== "BODY" && tag !== "H1" && tag !== "DIV") { return; }
  if (event.key.startsWith("Arrow") && event.target.closest(".scroll")) { return; }  // these scroll
  const common = {"?": () => help(), t: () => setTheme(otherTheme()), "/": () => { if (page) { openOverview(); } byId("filter").focus(); }};
  const keys = {...common, ...(page ? CASE_KEYS : LIST_KEYS), ...(page && page.viewer ? VIEWER_KEYS : {})};
  if (keys[event.key]) { event.preventDefault(); keys[event.key](); }
});

(function start() {
  let remembered = "";
  try { remembered = localStorage.getItem("edgecase-theme"); } catch (e) { /* none */ }
  document.documentElement.dataset.title = document.title;
  byId("theme").addEventListener("click", () => setTheme(otherTheme()));
  byId("help-button").addEventListener("click", () => help());
  byId("help-close").addEventListener("click", () => help(false));
  if (remembered === "dark" || remembered === "light") { setTheme(remembered); }
  buildOverview();
  byId("bar").hidden = false;
  follow();
  window.addEventListener("hashchange", follow);
  window.addEventListener("resize", () => { if (page && page.viewer) { page.viewer.draw(); } });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (page && page.viewer) { page.viewer.rebuild(); } });
})();
