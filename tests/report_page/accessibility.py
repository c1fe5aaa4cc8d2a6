# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of WCAG 2.2 (level AA) that a machine can decide, asked of the page that is shown.

problems(page) gives a list of "RULE: what and where". Each rule names the criterion that it comes from.
"""

# Visible elements alone; what is hidden for a while is asked when it is shown.
RULES = r"""(() => {
const found = [];
const where = (e) => e.tagName.toLowerCase() + (e.id ? "#" + e.id : "") + (typeof e.className === "string" && e.className ? "." + e.className.trim().replace(/\s+/g, ".") : "");
const say = (rule, e, text) => found.push(rule + ": " + where(e) + (text ? " " + text : ""));
const isShown = (e) => e.getClientRects().length > 0 && getComputedStyle(e).visibility !== "hidden" && !e.closest("[aria-hidden=true]");
const all = (selector) => [...document.querySelectorAll(selector)].filter(isShown);
const textOf = (ids) => (ids || "").split(/\s+/).map((id) => document.getElementById(id)).filter(Boolean).map((e) => e.textContent.trim()).join(" ");
const nameOf = (e) => (e.getAttribute("aria-label") || textOf(e.getAttribute("aria-labelledby")) || [...(e.labels || [])].map((l) => l.textContent.trim()).join(" ") ||
  (e.matches("input, select, textarea") ? "" : e.textContent.trim()) || e.title || "").trim();
const CONTROLS = "button, a[href], input, select, textarea, summary, [tabindex='0'], [role=button]";

// 3.1.1, 2.4.2
if (!document.documentElement.lang) { found.push("lang: the page has no language"); }
if (!document.title.trim()) { found.push("title: the page has no title"); }
// 4.1.2: name, role, value. A row that can be picked is named by its cells.
for (const e of all(CONTROLS)) { if (!nameOf(e)) { say("name", e, "has no name"); } }
// 1.1.1
for (const e of all("img, canvas, svg")) {
  if (!nameOf(e) || (e.tagName === "CANVAS" && e.getAttribute("role") !== "img")) { say("picture", e, "has no text"); }
}
// 2.4.3
for (const e of document.querySelectorAll("[tabindex]")) { if (e.tabIndex > 0) { say("tabindex", e, "is " + e.tabIndex); } }
// 4.1.1 of WCAG 2.0; labels lead astray where an id stands twice.
const ids = new Map();
for (const e of document.querySelectorAll("[id]")) { ids.set(e.id, (ids.get(e.id) || 0) + 1); }
for (const [id, count] of ids) { if (count > 1) { found.push("id: " + id + " stands " + count + " times"); } }
for (const name of ["aria-labelledby", "aria-describedby", "aria-controls"]) {
  for (const e of document.querySelectorAll("[" + name + "]")) {
    for (const id of e.getAttribute(name).split(/\s+/)) { if (!document.getElementById(id)) { say("reference", e, name + " names " + id + ", which is not there"); } }
  }
}
// 1.3.1, 2.4.6: headings begin with one h1 and skip no level.
let level = 0;
const headings = all("h1, h2, h3, h4, h5, h6").filter((e) => !e.closest("dialog"));
if (headings.filter((e) => e.tagName === "H1").length !== 1) { found.push("heading: there is not one h1"); }
for (const e of headings) {
  const own = Number(e.tagName[1]);
  if (own > level + 1) { say("heading", e, "follows one of level " + level); }
  level = own;
}
// 1.3.1: tables have headers that say what they are of, as many as there are columns.
for (const table of all("table")) {
  const heads = table.tHead ? [...table.tHead.rows[0].cells] : [];
  if (heads.length === 0 || heads.some((h) => h.tagName !== "TH" || h.scope !== "col" || !h.textContent.trim())) { say("table", table, "has a column without a header"); }
  const width = (row) => [...row.cells].reduce((sum, cell) => sum + cell.colSpan, 0);
  for (const row of table.querySelectorAll("tbody tr")) { if (width(row) > heads.length) { say("table", table, "has more columns than headers"); break; } }
}
// 1.3.1, 2.4.1: one main landmark, and nothing beside landmarks.
if (document.querySelectorAll("main").length !== 1) { found.push("landmark: there is not one main"); }
for (const e of [...document.body.children].filter(isShown)) {
  if (!e.matches("header, main, nav, footer, aside, dialog, [role=status], [role=alert]")) { say("landmark", e, "stands beside all landmarks"); }
}
// 2.1.1: what scrolls can be scrolled by keys.
for (const e of all("*")) {
  const style = getComputedStyle(e), scrolls = (o, size, room) => /auto|scroll/.test(o) && size > room + 1;
  if ((scrolls(style.overflowX, e.scrollWidth, e.clientWidth) || scrolls(style.overflowY, e.scrollHeight, e.clientHeight)) &&
      e.tabIndex < 0 && !e.querySelector(CONTROLS)) { say("scroll", e, "cannot be scrolled by keys"); }
}
// 1.4.3: contrast of text, over the backgrounds of what it stands in; 1.4.1 of disabled controls is exempt.
const numbers = (color) => { const n = (color.match(/[\d.]+/g) || []).map(Number); return color.startsWith("color(") ? [n[0] * 255, n[1] * 255, n[2] * 255, n[3] === undefined ? 1 : n[3]] : [n[0], n[1], n[2], n[3] === undefined ? 1 : n[3]]; };
const over = (top, below) => [0, 1, 2].map((k) => top[k] * top[3] + below[k] * (1 - top[3])).concat(1);
const light = ([r, g, b]) => [r, g, b].map((v) => { v /= 255; return v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4; }).reduce((sum, v, k) => sum + v * [.2126, .7152, .0722][k], 0);
const ground = (e) => { const layers = []; for (let at = e; at; at = at.parentElement) { layers.push(numbers(getComputedStyle(at).backgroundColor)); } return layers.reverse().reduce((below, top) => over(top, below), [255, 255, 255, 1]); };
const clear = (e) => { let o = 1; for (let at = e; at; at = at.parentElement) { o *= Number(getComputedStyle(at).opacity); } return o; };
const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), asked = new Set();
while (texts.nextNode()) {
  const e = texts.currentNode.parentElement;
  if (!texts.currentNode.data.trim() || asked.has(e) || !isShown(e) || e.closest(".hidden-text, :disabled, script, style, option") || e.closest("thead") && e.offsetHeight <= 1) { continue; }
  asked.add(e);
  const style = getComputedStyle(e), size = parseFloat(style.fontSize), isLarge = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
  const back = ground(e), own = numbers(style.color), front = over([own[0], own[1], own[2], own[3] * clear(e)], back);
  const [a, b] = [light(front), light(back)].sort((x, y) => y - x), ratio = (a + .05) / (b + .05);
  if (ratio < (isLarge ? 3 : 4.5)) { say("contrast", e, ratio.toFixed(2) + " of \"" + texts.currentNode.data.trim().slice(0, 30) + "\""); }
}
// 2.4.7: where the focus is, is to be seen. Asked last, since it moves the focus.
const before = document.activeElement;
for (const e of all(CONTROLS).filter((e) => !e.disabled && e.tabIndex >= 0)) {
  e.focus({preventScroll: true});
  const style = getComputedStyle(e);
  if (document.activeElement === e && (style.outlineStyle === "none" || parseFloat(style.outlineWidth) < 2)) { say("focus", e, "does not show that it has the focus"); }
}
if (before && before !== document.body) { before.focus({preventScroll: true}); } else if (document.activeElement) { document.activeElement.blur(); }
return [...new Set(found)];
})()"""


def problems(page):
    """What breaks a rule on the page as it is shown, each once."""
    return page.run(RULES)
