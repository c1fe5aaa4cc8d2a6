// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
"use strict";
// The page's data, and how its elements are made: text only, so that nothing of a case becomes markup.

const data = JSON.parse(document.getElementById("data").textContent);
const GLYPHS = {pass: "\u2713", unsupported: "\u2013", skip: "\u21b7", xfail: "\u25cb", xpass: "!", improved: "!", flake: "\u2248",
  fail: "\u2717", device_lost: "\u26a1", timeout: "\u2026", crash: "\u2620", error: "?", not_run: "\u00b7"};
const STATUSES = Object.keys(GLYPHS);
const EXPECTED = new Set(["pass", "unsupported", "skip", "xfail"]);
const SPECIFICATION = "https://registry.khronos.org/vulkan/specs/latest/html/vkspec.html#";
const MOST_BUDGETS = data.profile === "vulkan" ? 8e-5 * 2 ** 24 : 2;  // ref::budget_factor
const byId = (id) => document.getElementById(id);
// References of cases that pass, and the cases' files: read when the first case asks for them.
let onDemandData = null;
function onDemand() {
  onDemandData = onDemandData || JSON.parse(byId("on-demand").textContent);
  return onDemandData;
}
const string = (k) => data.strings[k] === undefined ? "" : data.strings[k];  // texts that many cases share
if (data.strings.length) {
  for (const record of data.cases) {
    if (record.file !== undefined) { record.file = string(record.file); }
    if (record.rules !== undefined) { record.rules = string(record.rules).split(" "); }
    for (const command of ["rerun", "debug"]) {
      if (record[command]) { record[command] = string(record.settings) + record[command]; }
    }
  }
}

// An element: `properties` are set as they are, but class, data-... and aria-... as attributes.
function el(tag, properties, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties || {})) {
    if (value === undefined || value === null || value === false) { continue; }
    if (name === "class") { element.className = value; }
    else if (name.startsWith("on")) { element.addEventListener(name.slice(2), value); }
    else if (/^(aria-|data-|role$|scope$|for$|colspan$)/.test(name)) { element.setAttribute(name, value); }
    else { element[name] = value; }
  }
  add(element, ...children);
  return element;
}
function add(parent, ...children) {
  for (const child of children.flat(Infinity)) {
    if (child !== undefined && child !== null && child !== false && child !== "") { parent.append(child); }
  }
  return parent;
}

function theme() {
  return document.documentElement.dataset.theme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}
function markTheme(name) {
  document.documentElement.dataset.theme = name;
  byId("theme").setAttribute("aria-pressed", String(name === "dark"));
}
const otherTheme = () => theme() === "dark" ? "light" : "dark";

// An id that breaks, where it must, after its own separators and not inside a word.
const idText = (id) => id.split(/(?<=[:,=/])/).flatMap((part, k) => k === 0 ? [part] : [el("wbr"), part]);

const numberClass = (text) => text.length > 20 ? "number" : "number whole";  // one that fits in a line is not broken

// A text in which fractions too long for a glance are folded: a button shows all of their digits.
const LONG_FRACTION = /[\u2212-]?\d+\/\d+/g, MOST_DIGITS = 13;
function folded(text) {
  const parts = [];
  let from = 0;
  for (const {0: fraction, index} of text.matchAll(LONG_FRACTION)) {
    if (fraction.length <= MOST_DIGITS) { continue; }
    const short = fraction.split("/").map((digits) => digits.length > 5 ? digits.slice(0, 4) + "\u2026" : digits).join("/");
    const whole = el("span", {}, short);
    parts.push(text.slice(from, index), el("button", {type: "button", class: "link fold", "aria-expanded": "false", "aria-label": "exact fraction " + fraction, title: "the exact fraction", onclick: (event) => {
      event.stopPropagation();
      const open = event.currentTarget.getAttribute("aria-expanded") !== "true";
      event.currentTarget.setAttribute("aria-expanded", String(open));
      whole.textContent = open ? fraction : short;
    }}, whole));
    from = index + fraction.length;
  }
  return [...parts, text.slice(from)];
}
const unfolded = (text) => text.replace(LONG_FRACTION, (fraction) => fraction.length <= MOST_DIGITS ? fraction : "").replace(" =  ", " ");

const word = (status) => status.replace("_", " ");
const plural = (count, noun) => count + " " + noun + (count === 1 ? "" : noun.endsWith("y") ? "" : "s");
const isExpected = (record) => EXPECTED.has(record.status);
const statusTag = (status) => el("span", {class: "status " + status}, GLYPHS[status] + "\u00a0" + word(status));
// As family_of in report/text/causes.cpp: of a file of one's own, its folder.
const familyOf = (id, file) => {
  const path = id.split(":")[0], folder = (file || "").split("/").slice(-2, -1)[0];
  return path.includes("/") ? path.slice(0, path.indexOf("/")) : folder && folder !== "." && folder !== ".." ? folder + "/" : path;
};

function ruleLink(id) {
  const rule = data.rules[id];
  if (!rule || !rule.anchor) { return el("span", {class: "id"}, id); }
  return el("a", {class: "id", href: SPECIFICATION + encodeURIComponent(rule.anchor), rel: "noreferrer", title: rule.title}, id);
}

const levelTag = (level) => el("span", {class: "level level-" + level, title: data.meanings[level]}, level);

// A table; `heads` are texts, or elements, `rows` rows or bodies.
function table(caption, heads, rows, className) {
  return el("table", {class: className},
    caption ? el("caption", {}, caption) : null,
    el("thead", {}, el("tr", {}, heads.map((head) => el("th", {scope: "col"}, head)))),
    rows.length && rows[0].tagName === "TBODY" ? rows : el("tbody", {}, rows));
}

// Puts a text into the clipboard; false where that is not allowed.
function copyText(text) {
  const take = (event) => { event.clipboardData.setData("text/plain", text); event.preventDefault(); };
  document.addEventListener("copy", take);
  const isDone = document.execCommand("copy");
  document.removeEventListener("copy", take);
  return isDone;
}

// A button that copies a text, or else selects it in `shown`.
function copyButton(title, what, text, shown) {
  const button = el("button", {type: "button", "aria-label": "copy " + what}, title);
  button.addEventListener("click", () => {
    const select = () => { getSelection().selectAllChildren(shown); };
    select();
    const isDone = copyText(text);
    if (!isDone) { shown.textContent = text; select(); }
    button.textContent = isDone ? "copied" : "selected";
    setTimeout(() => { button.textContent = title; }, 1500);
  });
  return button;
}

// A command line of which no option is cut at its hyphens.
const commandText = (text) => text.split(" ").flatMap((word, k) => [k ? " " : "", word.startsWith("--") ? el("span", {class: "option"}, word) : word]);

// A command line and a button that copies it. `settings` in front of it are copied and not shown: they stand above.
function command(label, text, settings = "") {
  if (!text) { return null; }
  const code = el("code", {}, commandText(text.startsWith(settings) ? text.slice(settings.length) : text));
  return el("div", {class: "command"}, el("span", {class: "quiet"}, label), code, copyButton("copy", "the " + label + " command", text, code));
}

// Of the whole case, as a query's count: it has no place.
const isOfCase = (f) => f.x === null;

function finding(row) {
  return {kind: row[0], rule: string(row[1]), level: row[2], x: row[3], y: row[4], sample: row[5], quantity: string(row[6]),
    expected: string(row[7]), got: string(row[8]), why: string(row[9]), ratio: row[10]};
}
