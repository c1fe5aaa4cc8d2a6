// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// The list of cases; what a case holds is built when it is first opened.

const data = JSON.parse(document.getElementById("data").textContent);
const GLYPHS = {pass: "\u2713", unsupported: "\u2013", skip: "\u21b7", xfail: "x", xpass: "!", improved: "!", flake: "\u2248",
  fail: "\u2717", device_lost: "\u26a1", timeout: "\u2026", crash: "\u2620", error: "E", not_run: "\u00b7"};
const EXPECTED = ["pass", "unsupported", "skip", "xfail"];
const ZOOMS = [0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64];
const byId = (id) => document.getElementById(id);
const views = [];  // one a case: {record, row, open(), pin()}
const hidden = new Set();
let current = null;

// An element with text only: nothing of a case ever becomes markup.
function make(tag, className, text) {
  const element = document.createElement(tag);
  if (className) { element.className = className; }
  if (text !== undefined) { element.textContent = text; }
  return element;
}
function add(parent, ...children) {
  for (const child of children) { if (child) { parent.append(child); } }
  return parent;
}
function word(status) { return status.replace("_", " "); }
function statusTag(status) { return make("span", "status " + status, GLYPHS[status] + " " + word(status)); }

function ruleTag(id, withTitle) {
  const rule = data.rules[id];
  const tag = rule && rule.anchor ? make("a", "", id) : make("span", "", id);
  tag.classList.add("id");
  if (rule && rule.anchor) {
    tag.href = "https://registry.khronos.org/vulkan/specs/latest/html/vkspec.html#" + encodeURIComponent(rule.anchor);
    tag.rel = "noreferrer";
  }
  if (!withTitle) {
    if (rule) { tag.title = rule.title; }
    return tag;
  }
  const item = add(make("li"), tag);
  if (rule) { item.append(": " + rule.title + " (profile " + rule.profile + ")"); }
  return item;
}

function command(label, text) {
  if (!text) { return null; }
  const code = make("code", "", text);
  const button = make("button", "", "copy");
  button.type = "button";
  button.setAttribute("aria-label", "copy the " + label + " command");
  button.addEventListener("click", () => {
    const range = document.createRange();
    range.selectNodeContents(code);
    getSelection().removeAllRanges();
    getSelection().addRange(range);
    const done = document.execCommand("copy");
    button.textContent = done ? "copied" : "selected";
    setTimeout(() => { button.textContent = "copy"; }, 1500);
  });
  return add(make("div", "command"), make("span", "", label), code, button);
}

function findingsTable(view) {
  const record = view.record;
  if (!record.findings) { return null; }
  const table = make("table");
  const head = add(make("thead"), add(make("tr"), ...["sample", "kind", "rule", "level", "expected", "got", "why"].map((t) => {
    const th = make("th", "", t);
    th.scope = "col";
    return th;
  })));
  const body = make("tbody");
  view.rows = record.findings.map((f) => {
    const row = make("tr", "pick");
    const level = make("td", "level-" + f.level, f.level);
    level.append(make("div", "what", data.meanings[f.level]));
    const got = make("td", "", f.got);
    if (f.kind === "value" && f.ratio !== "0") { got.append(" (" + f.ratio + " budgets off)"); }
    add(row, make("td", "number", "(" + f.x + "," + f.y + ")" + (f.sample ? " sample " + f.sample : "")),
      make("td", "", f.kind), add(make("td"), ruleTag(f.rule, false)), level,
      make("td", "", (f.quantity ? f.quantity + ": " : "") + f.expected), got, make("td", "", f.why));
    row.addEventListener("click", () => view.pin(f));
    body.append(row);
    return row;
  });
  const wrap = add(make("div", "scroll"), add(table, head, body));
  wrap.tabIndex = 0;
  const title = make("h3", "", "Findings: " + record.finding_total);
  const rest = record.finding_total - record.findings.length;
  if (rest > 0) { title.append(" (the first " + record.findings.length + " here, more in results.json)"); }
  return add(make("section"), title, wrap);
}

function zoomOf(p) {
  const chosen = ZOOMS[Number(byId("zoom").value)];
  return chosen === 0 ? fitZoom(p) : chosen;
}

function legend() {
  const list = make("ul", "legend");
  const entry = (draw, text) => {
    const canvas = make("canvas");
    canvas.width = 15;
    canvas.height = 15;
    draw(canvas.getContext("2d"));
    list.append(add(make("li"), canvas, text));
  };
  entry((c) => { c.fillStyle = hitColor(1); c.fillRect(0, 0, 15, 15); }, "1 hit");
  entry((c) => { c.fillStyle = hitColor(2); c.fillRect(0, 0, 15, 15); }, "2 hits");
  entry((c) => drawEither(c, 0, 0, 15, 15), "free");
  for (let mark = 2; mark < MARKS.length; ++mark) { entry((c) => drawMark(c, mark, 0, 0, 15, 15), MARKS[mark]); }
  return list;
}

function picturePanes(view) {
  const p = openPictures(view.record.pictures);
  if (!p) { return null; }
  view.pictures = p;
  const readout = make("div", "readout number", "Point at a pixel.");
  const panes = make("div", "panes");
  const windows = [], canvases = [];
  const say = (x, y) => {
    const lines = pixelLines(p, x, y);
    const told = (view.record.findings || []).filter((f) => f.x === x && f.y === y);
    readout.replaceChildren();
    for (const line of lines) { readout.append(make("div", "", line)); }
    for (const f of told) { readout.append(make("div", "", f.rule + ": " + f.why)); }
  };
  for (const [kind, title] of [["expected", "reference"], ["device", "device"], ["marks", "difference"]]) {
    const canvas = make("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", title + ", " + p.width + " by " + p.height + " pixels; the table lists the wrong samples");
    const at = (event) => {
      const zoom = zoomOf(p), box = canvas.getBoundingClientRect();
      return {x: p.left + Math.min(p.width - 1, Math.max(0, Math.floor((event.clientX - box.left) / zoom))),
        y: p.top + Math.min(p.height - 1, Math.max(0, Math.floor((event.clientY - box.top) / zoom)))};
    };
    canvas.addEventListener("mousemove", (event) => { const {x, y} = at(event); say(x, y); });
    canvas.addEventListener("mouseleave", () => { if (view.pinned) { say(view.pinned.x, view.pinned.y); } });
    canvas.addEventListener("click", (event) => view.pin(at(event)));
    const frame = add(make("div", "window"), canvas);
    frame.addEventListener("scroll", () => {
      for (const other of windows) {
        if (other !== frame) { other.scrollLeft = frame.scrollLeft; other.scrollTop = frame.scrollTop; }
      }
    });
    windows.push(frame);
    canvases.push([canvas, kind]);
    panes.append(add(make("figure", "pane"), make("figcaption", "", title), frame));
  }
  view.draw = () => { for (const [canvas, kind] of canvases) { drawPicture(canvas, p, kind, zoomOf(p), view.pinned); } };
  view.say = say;
  const place = "Pixels (" + p.left + "," + p.top + ") to (" + (p.left + p.width - 1) + "," + (p.top + p.height - 1) + ")" +
    (p.samples > 1 ? ", " + p.samples + " samples a pixel, drawn as cells in order" : "");
  return add(make("section"), make("h3", "", place), panes, legend(), readout);
}

function facts(record) {
  const list = make("dl", "facts");
  const fact = (name, value) => { if (value) { add(list, make("dt", "", name), make("dd", "", value)); } };
  fact("file", record.file + (record.line ? ":" + record.line : ""));
  fact("expected", record.expected && word(record.expected) + (record.bug ? " (" + record.bug + ")" : ""));
  fact("reason", record.reason);
  fact("signal", record.signal);
  fact("last step", record.step);
  fact("compared", record.compared);
  fact("largest accepted error", record.worst);
  fact("time", record.time + (record.attempts > 1 ? ", " + record.attempts + " attempts" : ""));
  return list;
}

function fill(view) {
  const record = view.record;
  const body = make("div", "body");
  if (record.description) { body.append(make("p", "", record.description)); }
  if (record.rules) { add(body, add(make("ul", "rules"), ...record.rules.map((id) => ruleTag(id, true)))); }
  add(body, picturePanes(view), findingsTable(view), facts(record));
  for (const text of record.links || []) {
    const web = /^https?:\/\//.test(text);
    const link = make(web ? "a" : "span", "", text);
    if (web) { link.href = text; link.rel = "noreferrer"; }
    body.append(add(make("div"), "see ", link));
  }
  add(body, command("rerun", record.rerun), command("explain", record.explain));
  for (const [title, text] of [["Validation layer", (record.messages || []).join("\n")], ["What the driver printed", record.stderr]]) {
    if (text) { body.append(add(make("section"), make("h3", "", title), make("pre", "output", text))); }
  }
  view.row.append(body);
  if (view.draw) { view.draw(); }
}

function remember(view) {
  let hash = "#case=" + encodeURIComponent(view.record.id);
  if (view.pinned) { hash += "&px=" + view.pinned.x + "," + view.pinned.y; }
  try { history.replaceState(null, "", hash); } catch (e) { location.hash = hash; }
}

function makeView(record) {
  const row = make("details", "case");
  const summary = add(make("summary"), statusTag(record.status), make("span", "id", record.id), make("span", "what", record.what));
  row.append(summary);
  const view = {record, row, summary, filled: false, pinned: null, rows: [],
    text: [record.id, record.description, (record.rules || []).join(" "), record.what, record.status].join("\n").toLowerCase()};
  view.open = () => {
    if (!view.filled) { view.filled = true; fill(view); }
  };
  view.pin = (at) => {
    view.pinned = at;
    (record.findings || []).forEach((f, k) => {
      const same = f.x === at.x && f.y === at.y && (at.sample === undefined || f.sample === at.sample);
      view.rows[k].setAttribute("aria-selected", String(same));
    });
    if (view.draw) { view.draw(); view.say(at.x, at.y); }
    remember(view);
  };
  row.addEventListener("toggle", () => { if (row.open) { view.open(); current = view; remember(view); } });
  summary.addEventListener("focus", () => { current = view; });
  return view;
}

const families = new Map();
function buildList() {
  for (const record of data.cases) {
    const name = record.id.includes("/") ? record.id.slice(0, record.id.indexOf("/")) : "other";
    if (!families.has(name)) { families.set(name, []); }
    const view = makeView(record);
    families.get(name).push(view);
  }
  const main = byId("list");
  for (const [name, members] of families) {
    const group = make("details", "family");
    const count = make("span", "count");
    const wrong = members.filter((v) => !EXPECTED.includes(v.record.status)).length;
    group.open = wrong > 0 || data.cases.length <= 60;
    add(group, add(make("summary", "", name), count));
    members.sort((a, b) => EXPECTED.includes(a.record.status) - EXPECTED.includes(b.record.status));
    for (const view of members) { view.group = group; group.append(view.row); views.push(view); }
    members.group = group;
    members.count = count;
    members.wrong = wrong;
    main.append(group);
  }
}

function filter() {
  const words = byId("filter").value.toLowerCase().split(/\s+/).filter(Boolean);
  let shown = 0;
  for (const members of families.values()) {
    let here = 0;
    for (const view of members) {
      const visible = !hidden.has(view.record.status) && words.every((w) => view.text.includes(w));
      view.row.hidden = !visible;
      here += visible ? 1 : 0;
    }
    shown += here;
    members.count.textContent = members.length + (members.length === 1 ? " case" : " cases") +
      (members.wrong ? ", " + members.wrong + " unexpected" : "") + (here < members.length ? ", " + (members.length - here) + " hidden" : "");
    members.group.style.opacity = here === 0 ? ".5" : "";
    if (words.length > 0 && here > 0) { members.group.open = true; }
  }
  byId("shown").textContent = shown + " of " + views.length + " cases shown";
}

function buildBar() {
  byId("bar").hidden = false;
  for (const status of Object.keys(GLYPHS)) {
    const count = data.totals[status];
    if (!count) { continue; }
    const button = add(make("button"), statusTag(status), " " + count);
    button.type = "button";
    button.setAttribute("aria-pressed", "true");
    button.addEventListener("click", () => {
      const off = !hidden.delete(status);
      if (off) { hidden.add(status); }
      button.setAttribute("aria-pressed", String(!off));
      filter();
    });
    byId("statuses").append(button);
  }
  byId("filter").addEventListener("input", filter);
  byId("zoom").addEventListener("input", zoomed);
  byId("help-button").addEventListener("click", help);
}

function zoomed() {
  const zoom = ZOOMS[Number(byId("zoom").value)];
  byId("zoom-text").textContent = zoom === 0 ? "fit" : zoom + "x";
  for (const view of views) { if (view.draw && view.row.open) { view.draw(); } }
}

function help() {
  byId("help").hidden = !byId("help").hidden;
  byId("help-button").setAttribute("aria-expanded", String(!byId("help").hidden));
}

function step(by) {
  const visible = views.filter((v) => !v.row.hidden && v.group.open);
  if (visible.length === 0) { return; }
  const at = visible.indexOf(current);
  current = visible[at < 0 ? 0 : Math.min(visible.length - 1, Math.max(0, at + by))];
  current.summary.focus();
  current.summary.scrollIntoView({block: "nearest"});
}

function stepFinding(by) {
  if (!current || !current.row.open || !current.record.findings) { return; }
  const list = current.record.findings;
  const at = list.findIndex((f) => f === current.pinned);
  const next = at < 0 ? 0 : (at + by + list.length) % list.length;
  current.pin(list[next]);
  current.rows[next].scrollIntoView({block: "nearest"});
}

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) { return; }
  if (event.target.tagName === "INPUT") {
    if (event.key === "Escape") { event.target.blur(); }
    return;
  }
  const zoom = byId("zoom");
  const actions = {j: () => step(1), k: () => step(-1), n: () => stepFinding(1), p: () => stepFinding(-1), "?": help,
    "/": () => byId("filter").focus(), "+": () => { zoom.value = Number(zoom.value) + 1; zoomed(); },
    "-": () => { zoom.value = Number(zoom.value) - 1; zoomed(); }};
  if (actions[event.key]) { event.preventDefault(); actions[event.key](); }
});

buildList();
buildBar();
filter();
(function start() {
  const parts = new URLSearchParams(location.hash.slice(1));
  const asked = views.find((v) => v.record.id === parts.get("case"));
  const first = asked || views.find((v) => !EXPECTED.includes(v.record.status));
  if (!first) { return; }
  current = first;
  first.group.open = true;
  first.row.open = true;
  first.open();
  const pixel = (parts.get("px") || "").split(",").map(Number);
  if (asked && pixel.length === 2 && pixel.every(Number.isInteger)) { first.pin({x: pixel[0], y: pixel[1]}); }
  if (asked) { first.summary.scrollIntoView(); }
})();
