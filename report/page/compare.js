// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// The page of "edgecase compare --html": kinds of change, causes, cases, and where the runs hit other samples.

const hidden = new Set(data.kinds.filter((k) => k.count === 0 || k.name === "same").map((k) => k.name));
let onlyCause = "";  // the key of the cause whose cases alone are listed
let opened = "";     // the case whose detail was opened last
const MOST_ROWS = 500;  // shown at once; the filter finds the others

function turnTheme() {
  markTheme(otherTheme());
  for (const repaint of painters) { repaint(); }
}
const painters = new Set();
const PLURALS = {regression: "regressions", fix: "fixes"};
const TOLD_BY_RESULTS = new Set(["regression", "fix", "fails otherwise", "fails alike"]);  // the detail says what a run's cell does

// Where a case stands in the report of a run.
function caseLink(k, id, child) {
  const run = data.runs[k];
  return run.report ? el("a", {href: run.report + "#case=" + encodeURIComponent(id), rel: "noreferrer"}, child) : child;
}

function runsTable() {
  const cell = (label, ...children) => el("td", {"data-label": label}, children);
  return el("div", {class: "framed"}, table("", ["run", "device", "driver", "subpixel bits", "cases", "ended with", "folder"], data.runs.map((run) => el("tr", {},
    el("th", {scope: "row"}, el("strong", {}, run.name)), cell("device", run.device), cell("driver", run.driver), cell("subpixel bits", String(run.subpixel_bits)),
    cell("cases", String(run.cases)), cell("", run.exit), el("td", {class: "id"}, run.report ? el("a", {href: run.report, rel: "noreferrer"}, run.folder) : run.folder))), "cards"));
}

function tiles() {
  return data.kinds.filter((kind) => kind.count > 0).map((kind) => {
    const isListed = kind.name !== "same";
    const tile = el(isListed ? "button" : "div", {type: isListed ? "button" : null, class: "tile", "data-kind": kind.name, title: kind.text, "aria-pressed": isListed ? String(!hidden.has(kind.name)) : null},
      el("span", {class: "tally"}, String(kind.count)), kind.name === "same" ? "the same bit for bit" : kind.count === 1 ? kind.name : PLURALS[kind.name] || kind.name);
    if (isListed) { tile.addEventListener("click", () => {
      if (hidden.has(kind.name)) { hidden.delete(kind.name); } else { hidden.add(kind.name); }
      tile.setAttribute("aria-pressed", String(!hidden.has(kind.name)));
      showList();
    }); }
    return tile;
  });
}

// What two runs make of a sample: 0 nothing, 1 both hit it alike, 2 the first alone, 3 the other alone, 4 both, not as often.
const relation = (a, b) => a === b ? (a === 0 ? 0 : 1) : a > 0 && b > 0 ? 4 : a > 0 ? 2 : 3;

const RELATIONS = ["", "", (a) => "hit by " + a + " alone", (a, b) => "hit by " + b + " alone", () => "hit by both, not as often"];
const WIDEST = 420;  // of a picture in CSS pixels, where its column has the room

// What paint() shows of one run (its hits), or of two (where they differ).
function sceneOf(entry, samples, hits, marks) {
  const p = entry.pictures, columns = Math.ceil(Math.sqrt(samples));
  const pictures = {width: p.width, height: p.height, left: p.left, top: p.top, layerHeight: p.layer_height || 0, expected: hits, device: hits, marks, samples, count: hits.length,
    columns, rows: Math.ceil(samples / columns), errors: null, colors: null, expectedColors: null, depths: null, expectedDepths: null};
  const geometry = openGeometry(p.geometry), scene = {pictures, geometry, ties: tiesIn(geometry, pictures)};
  scene.limits = limitsOf(scene);
  return scene;
}

function picturePart(entry) {
  const p = entry.pictures, planes = p.hits.map((text) => text && decodePicture(text));
  const base = planes.findIndex(Boolean), samples = planes[base].length / (p.width * p.height);
  const figures = [], name = (k) => data.runs[k].name, none = new Uint8Array(planes[base].length), marksSeen = new Map(), hitsSeen = new Set();
  const figure = (title, text, kind, hits, marks) => {
    const canvas = el("canvas", {role: "img", "aria-label": text}), scene = sceneOf(entry, samples, hits, marks);
    const repaint = () => {
      const room = Math.min(WIDEST, (byId("list").clientWidth || WIDEST) - 32), zoom = Math.max(2, Math.min(32, Math.floor(room / (Math.max(p.width, p.height) + 2))));
      paint(canvas, scene, {kind, zoom, left: 0, top: 0, width: (p.width + 2) * zoom, height: (p.height + 2) * zoom, cursor: null, theme: theme(),
        options: {grid: true, outlines: true, samples: true, scissor: true, viewport: true, planes: true, boxes: true}});
    };
    repaint();
    painters.add(repaint);
    figures.push(el("figure", {}, el("figcaption", {}, title), el("div", {class: "frame", tabIndex: 0, role: "group", "aria-label": text}, canvas)));
    return scene;
  };
  let scene = null;
  planes.forEach((plane, k) => {
    if (!plane) { return; }
    scene = figure([el("strong", {}, name(k) + ": " + data.runs[k].folder), el("div", {}, data.runs[k].device)], "hits of run " + name(k), "device", plane, none);
    for (const hits of plane) { if (hits > 0) { hitsSeen.add(Math.min(hits, 3)); } }
  });
  planes.forEach((plane, k) => {
    if (!plane || k === base) { return; }
    const counts = [0, 0, 0, 0, 0];
    const marks = plane.map((hits, at) => { const what = relation(planes[base][at], hits); ++counts[what]; return what > 1 ? what : 0; });
    const text = counts[2] + " samples hit by " + name(base) + " alone, " + counts[3] + " by " + name(k) + " alone, " + counts[4] + " by both, not as often";
    for (const what of [2, 3, 4]) { if (counts[what]) { marksSeen.set(what, RELATIONS[what](name(base), planes.length > 2 ? "the other" : name(k))); } }
    figure([el("strong", {}, "difference of " + name(base) + " and " + name(k)), el("div", {}, text)], text, "difference", planes[base], marks);
  });
  const legend = el("ul", {class: "legend"});
  const fillLegend = () => {
    const palette = PALETTES[theme()];
    legend.replaceChildren(...[...hitsSeen].sort().map((count) => legendItem(count === 1 ? "1 hit" : count === 2 ? "2 hits" : "3 hits or more", legendBox(palette.hits[count]))),
      legendItem("hit alike", legendBox(palette.ok)), ...[...marksSeen].sort().map(([what, text]) => legendItem(text, (c) => drawMark(c, what, 0, 0, 18, 18))), ...outlineItems(scene));
  };
  fillLegend();
  painters.add(fillLegend);
  return el("div", {}, el("div", {class: "stage"}, figures), legend);
}

function resultCell(entry, k) {
  const result = entry.results[k];
  const label = data.runs[k].name + ":";
  if (!result) { return el("td", {class: "quiet result", "data-label": label}, "not there"); }
  return el("td", {class: "result", "data-label": label}, caseLink(k, entry.id, statusTag(result.status)), result.status === "pass" ? null : el("div", {class: "quiet small what"}, result.what));
}

function showDetail(entry, row) {
  const open = row.nextSibling && row.nextSibling.classList.contains("detail");
  row.querySelector("button").setAttribute("aria-expanded", String(!open));
  opened = entry.id;
  if (open) { row.nextSibling.remove(); return; }
  const told = entry.results.map((result, k) => result && el("li", {}, el("strong", {}, data.runs[k].name + ": "), result.what || word(result.status), result.why ? el("div", {class: "quiet"}, result.why) : null));
  row.after(el("tr", {class: "detail"}, el("td", {colspan: row.cells.length}, el("ul", {class: "plain"}, told),
    entry.pictures ? picturePart(entry) : el("p", {class: "quiet"}, "No pictures of both: the runs hit the same samples, or did not keep them (run --capture all keeps them)."))));
}

function showList() {
  painters.clear();
  const words = byId("filter").value.toLowerCase().split(/\s+/).filter(Boolean);
  const text = (entry) => (entry.id + " " + entry.detail + " " + entry.results.map((r) => r ? r.status + " " + r.what + " " + r.why : "").join(" ")).toLowerCase();
  const shown = data.cases.filter((entry) => !hidden.has(entry.change) && words.every((w) => text(entry).includes(w)) && (!onlyCause || isOfCause(entry, onlyCause)));
  byId("clear").hidden = !words.length && !onlyCause;
  for (const row of document.querySelectorAll(".causes tr[data-cause]")) { row.setAttribute("aria-selected", String(row.dataset.cause === onlyCause)); }
  byId("shown").textContent = shown.length + " of " + data.cases.length + " cases that are not the same" + (shown.length > MOST_ROWS ? ", the first " + MOST_ROWS + " here" : "");
  const sections = [];
  let left = MOST_ROWS;
  for (const kind of data.kinds) {
    const entries = shown.filter((entry) => entry.change === kind.name).slice(0, left);
    left -= entries.length;
    if (entries.length === 0) { continue; }
    const hasDetail = !TOLD_BY_RESULTS.has(kind.name);
    sections.push(el("section", {"data-kind": kind.name}, el("h3", {}, kind.text), el("div", {class: "framed"},
      table("", ["case", ...data.runs.map((run) => run.name), hasDetail ? "detail" : []].flat(), entries.map((entry) => {
        const button = el("button", {type: "button", class: "link id", "aria-expanded": "false"}, idText(entry.id));
        const row = el("tr", {class: "compared", "data-case": entry.id}, el("td", {}, button), data.runs.map((_, k) => resultCell(entry, k)), hasDetail ? el("td", {class: "quiet"}, entry.detail) : null);
        button.addEventListener("click", () => showDetail(entry, row));
        return row;
      }), "cards"))));
  }
  byId("list").replaceChildren(...sections);
}

// Opens the next case of the list, or the one before, and closes the one that was open.
function step(by) {
  const rows = [...document.querySelectorAll("tr.compared")], at = rows.findIndex((row) => row.dataset.case === opened);
  const next = rows[at < 0 ? (by > 0 ? 0 : rows.length - 1) : at + by], isOpen = (row) => row.querySelector("button").getAttribute("aria-expanded") === "true";
  if (!next) { return; }
  if (at >= 0 && isOpen(rows[at])) { rows[at].querySelector("button").click(); }
  if (!isOpen(next)) { next.querySelector("button").click(); }
  next.querySelector("button").focus();
  next.scrollIntoView({block: "nearest"});
}

// The case that the address names.
function follow() {
  const id = new URLSearchParams(location.hash.slice(1).replaceAll("+", "%2B")).get("case"), entry = data.cases.find((one) => one.id === id);
  if (!entry) { return; }
  hidden.delete(entry.change);
  showAll();
  const row = [...document.querySelectorAll("tr.compared")].find((one) => one.dataset.case === id);
  if (row) { row.querySelector("button").click(); row.scrollIntoView({block: "start"}); row.querySelector("button").focus(); }
}

function showAll() {
  onlyCause = "";
  byId("filter").value = "";
  showList();
}

(function start() {
  add(byId("runs"), runsTable(), data.remarks.map((remark) => el("p", {class: "note"}, remark)),
    data.pictures_left_out ? el("p", {class: "note"}, "Pictures of " + plural(data.pictures_left_out, "case") + " are left out to keep this page small.") : null);
  add(byId("causes-slot"), causesSection((key) => { onlyCause = onlyCause === key ? "" : key; showList(); }));
  add(byId("statuses"), tiles());
  byId("clear").addEventListener("click", showAll);
  byId("help-button").addEventListener("click", () => byId("help").showModal());
  byId("help-close").addEventListener("click", () => byId("help").close());
  byId("filter").addEventListener("input", showList);
  byId("theme").addEventListener("click", turnTheme);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "INPUT") { return; }
    const keys = {t: turnTheme, n: () => step(1), p: () => step(-1), Escape: showAll, "/": () => byId("filter").focus(), "?": () => byId("help").showModal()};
    if (keys[event.key] && !byId("help").open) { event.preventDefault(); keys[event.key](); }
  });
  showList();
  follow();
  window.addEventListener("hashchange", follow);
})();
