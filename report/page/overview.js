// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// All cases: totals, causes, and the list by family, rule, status or cause.

const SHOWN_ROWS = 60;  // of a group, before it is asked for more
const listing = {words: "", group: "family", sort: "status", cause: "", off: new Set(), opened: new Map(), more: new Map()};

const entries = data.cases.map((record) => ({record, family: familyOf(record.id, record.file), cause: causeOf(record), rank: STATUSES.indexOf(record.status),
  wrong: record.finding_total || 0, worst: record.worst ? numberOf(record.worst[0]) : -1, seconds: numberOf(record.seconds),
  rules: new Set([...(record.rules || []), ...(record.lead ? [string(record.lead[1])] : [])]),
  text: [record.id, string(record.description), (record.rules || []).join(" "), record.what, word(record.status), record.lead ? string(record.lead[1]) : ""].join("\n").toLowerCase()}));
const entryOf = new Map(entries.map((entry) => [entry.record.id, entry]));
const SORTS = {status: (a, b) => b.rank - a.rank || (a.record.id < b.record.id ? -1 : 1), name: (a, b) => a.record.id < b.record.id ? -1 : 1,
  findings: (a, b) => b.wrong - a.wrong, error: (a, b) => b.worst - a.worst, time: (a, b) => b.seconds - a.seconds};
const GROUPS = {family: (e) => [e.family], rule: (e) => e.rules.size ? [...e.rules] : ["no rule"], status: (e) => [word(e.record.status)],
  cause: (e) => [e.cause ? causeTitle(e.cause) : "as expected"]};

const collator = (a, b) => a < b ? -1 : a > b ? 1 : 0;

function statusBar(members) {
  const counts = new Map();
  for (const m of members) { counts.set(m.record.status, (counts.get(m.record.status) || 0) + 1); }
  const bar = el("span", {class: "bar", "aria-hidden": "true"});
  for (const status of STATUSES) {
    if (counts.has(status)) {
      const part = el("span", {class: "part " + status, title: counts.get(status) + " " + word(status)});
      part.style.flexGrow = counts.get(status);
      bar.append(part);
    }
  }
  const said = STATUSES.filter((s) => counts.has(s)).reverse().map((s) => counts.get(s) + " " + word(s)).join(", ");
  return [bar, el("span", {class: "quiet counts"}, said)];
}

// In a line of the list.
function happened(record) {
  if (!record.lead) { return record.what; }
  const f = finding(record.lead);
  const flaky = record.status === "flake" ? "differs from run to run (" + record.attempts + " attempts) \u00b7 " : "";
  return [flaky + record.counts + " \u00b7 ", el("span", {class: "id"}, f.rule), " \u00b7 ", levelTag(f.level)];
}

// What fails without a value out of its budget (a sample, a colour) has no error that says so: "0" would read as success.
const isWorstTold = (record) => Boolean(record.worst) && (!record.finding_total || !(numberOf(record.worst[0]) <= MOST_BUDGETS));

// One unit for all rows, so that digits that stand below each other mean the same.
const millisecondsText = (seconds) => Number.isFinite(seconds) ? (1000 * seconds).toFixed(2) : "?";

function caseRow(entry) {
  const record = entry.record;
  return el("tr", {class: "case-row " + (isExpected(record) ? "" : "unexpected"), "data-case": record.id, onclick: (event) => { if (event.target.tagName !== "A") { openCase(record.id); } }},
    el("td", {}, statusTag(record.status)), el("td", {}, el("a", {class: "id", href: "#case=" + encodeURIComponent(record.id)}, idText(record.id))),
    el("td", {class: "quiet what"}, happened(record)), el("td", {class: "number right", "data-label": "findings"}, entry.wrong ? String(entry.wrong) : ""),
    el("td", {class: "number right told", "data-label": "budgets"}, isWorstTold(record) ? record.worst[1] : ""), el("td", {class: "number right quiet", "data-label": "ms"}, millisecondsText(entry.seconds)));
}

function groupBody(name, members, total, anySearch) {
  const unexpected = members.filter((m) => !isExpected(m.record)).length;
  const key = listing.group + "|" + name;
  const open = listing.opened.has(key) ? listing.opened.get(key) : unexpected > 0 || anySearch || entries.length <= 40;
  const button = el("button", {type: "button", class: "group", "aria-expanded": String(open), onclick: () => {
    listing.opened.set(key, !open);
    const scroll = window.scrollY;
    showList();
    window.scrollTo(0, scroll);
    const again = [...document.querySelectorAll("button.group")].find((b) => b.dataset.key === key);
    if (again) { again.focus({preventScroll: true}); }
  }, "data-key": key}, el("span", {class: "turn", "aria-hidden": "true"}, open ? "\u25be" : "\u25b8"), el("span", {}, idText(name)));
  const hidden = total - members.length;
  const body = el("tbody", {}, el("tr", {class: "group-row"}, el("th", {colspan: 6, scope: "rowgroup"}, el("div", {class: "group-line"}, button, el("span", {class: "quiet count"}, String(members.length)),
    statusBar(members), hidden > 0 ? el("span", {class: "quiet"}, hidden + " hidden") : null))));
  if (!open) { return body; }
  // At first little more than what is unexpected, if that comes first.
  const most = listing.more.get(key) || (unexpected > 0 && listing.sort === "status" ? Math.min(Math.max(unexpected, 5), SHOWN_ROWS) : SHOWN_ROWS);
  for (const entry of members.slice(0, most)) { body.append(caseRow(entry)); }
  if (members.length > most) {
    body.append(el("tr", {}, el("td", {colspan: 6}, el("button", {type: "button", class: "link", onclick: () => { listing.more.set(key, most + 8 * SHOWN_ROWS); showList(); }}, "show " + Math.min(members.length - most, 8 * SHOWN_ROWS) + " more"))));
  }
  return body;
}

function isListed(entry, words) {
  return !listing.off.has(entry.record.status) && (!listing.cause || isOfCause(entry.record, listing.cause)) && words.every((w) => entry.text.includes(w));
}
// The cases as listed, first to last: what "next" and "previous" walk through.
function listedCases() {
  const words = listing.words.toLowerCase().split(/\s+/).filter(Boolean);
  return entries.filter((entry) => isListed(entry, words)).sort((a, b) => collator(a.family, b.family) || SORTS[listing.sort](a, b));
}

function showList() {
  const words = listing.words.toLowerCase().split(/\s+/).filter(Boolean), groups = new Map(), totals = new Map();
  let shown = 0;
  for (const entry of entries) {
    const listed = isListed(entry, words);
    shown += listed ? 1 : 0;
    for (const name of GROUPS[listing.group](entry)) {
      totals.set(name, (totals.get(name) || 0) + 1);
      if (!groups.has(name)) { groups.set(name, []); }
      if (listed) { groups.get(name).push(entry); }
    }
  }
  const worstFirst = (a, b) => Math.max(...b[1].map((m) => isExpected(m.record) ? 0 : 1), 0) - Math.max(...a[1].map((m) => isExpected(m.record) ? 0 : 1), 0) || collator(a[0], b[0]);
  const bodies = [...groups].filter(([, members]) => members.length > 0).sort(worstFirst).map(([name, members]) =>
    groupBody(name, members.sort(SORTS[listing.sort]), totals.get(name), words.length > 0 || Boolean(listing.cause)));
  const list = byId("list");
  list.querySelectorAll("tbody").forEach((body) => body.remove());
  list.append(...bodies);
  byId("shown").textContent = shown + " of " + entries.length + " cases" + (listing.cause ? " of one cause" : "");
  byId("clear").hidden = !(words.length || listing.cause || listing.off.size);
  for (const row of document.querySelectorAll(".causes tr[data-cause]")) { row.setAttribute("aria-selected", String(row.dataset.cause === listing.cause)); }
  for (const button of document.querySelectorAll("#statuses button")) { button.setAttribute("aria-pressed", String(!listing.off.has(button.dataset.status))); }
}

function buildOverview() {
  const statuses = STATUSES.filter((status) => data.totals[status]).reverse();
  add(byId("statuses"), statuses.map((status) => el("button", {type: "button", class: "tile", "data-status": status, "aria-pressed": "true", onclick: () => {
    if (!listing.off.delete(status)) { listing.off.add(status); }
    changed();
  }}, el("span", {class: "tally"}, String(data.totals[status])), statusTag(status))));
  const show = (key) => { listing.cause = listing.cause === key ? "" : key; changed(); };
  add(byId("causes-slot"), diagnosesSection(show, false), causesSection(show), diagnosesSection(show, true), knownCausesSection(show));
  if (data.without_pictures) {
    byId("causes-slot").append(el("p", {class: "note"}, "To keep this page small, the pictures of " + plural(data.without_pictures, "case") + " stand in ",
      el("a", {href: partName(data.part + 1)}, partName(data.part + 1)), ". Every cause has one here."));
  }
  const choice = (id, name, values) => {
    const select = byId(id);
    add(select, values.map((value) => el("option", {value}, value)));
    select.addEventListener("change", () => { listing[name] = select.value; changed(); });
  };
  choice("group", "group", Object.keys(GROUPS));
  choice("sort", "sort", Object.keys(SORTS));
  byId("filter").addEventListener("input", () => { listing.words = byId("filter").value; changed(); });
  // The column headers stick below the bar, however many lines it takes.
  const bar = byId("bar");
  new ResizeObserver(() => document.documentElement.style.setProperty("--bar-height", getComputedStyle(bar).position === "sticky" ? bar.offsetHeight + "px" : "0")).observe(bar);
  byId("clear").addEventListener("click", () => { listing.words = ""; listing.cause = ""; listing.off.clear(); byId("filter").value = ""; changed(); });
}

// After a change of what is listed: the list and the address.
function changed() {
  showList();
  rememberOverview();
}
