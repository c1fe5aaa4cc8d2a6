// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// What went wrong, one row a cause, in the order of report::causes(): the gravest status first, in it the loosest level, in
// that the rule that leads in the most families.

const SHOWN_CAUSES = 8;

const causes = data.causes.map((cause) => ({...cause, key: [cause.change, cause.status, cause.family, cause.rule, cause.kind].filter((part) => part !== undefined).join("|"),
  records: cause.cases.map((k) => data.cases[k])}));
const causeOf = new Map(causes.flatMap((cause) => cause.records.map((record) => [record, cause])));

function causeText(cause) {
  const rule = data.rules[cause.rule], record = cause.records[0];
  return rule ? rule.title : cause.rule || cause.kind || record.reason || record.what || word(cause.status);
}
const causeTitle = (cause) => (cause.rule ? cause.rule + " \u00b7 " + cause.kind : word(cause.status) + " \u00b7 " + causeText(cause)) + " \u00b7 " + cause.family;

function causeRow(cause, show) {
  const findings = cause.records.reduce((sum, record) => sum + (record.finding_total || 0), 0), example = cause.records[0].id;
  return el("tr", {"data-cause": cause.key},
    el("td", {}, cause.change ? cause.change : statusTag(cause.status)),
    el("td", {}, cause.rule ? [ruleLink(cause.rule), " ", el("span", {class: "kind"}, cause.kind), " in " + cause.family] : null, el("div", {}, causeText(cause))),
    el("td", {}, cause.level ? [levelTag(cause.level), el("div", {class: "quiet small"}, data.meanings[cause.level])] : ""),
    el("td", {class: "right"}, el("button", {type: "button", class: "link", title: "show only these", onclick: () => show(cause.key)}, plural(cause.records.length, "case")),
      findings ? el("div", {class: "quiet small"}, plural(findings, "finding")) : null),
    el("td", {}, el("a", {href: "#case=" + encodeURIComponent(example), class: "id"}, example)));
}

// `show(key)` is called to list the cases of one cause alone.
function causesSection(show) {
  if (causes.length === 0) { return null; }
  const rows = causes.map((cause) => causeRow(cause, show));
  const rest = rows.length > SHOWN_CAUSES + 1 ? rows.slice(SHOWN_CAUSES) : [];
  rest.forEach((row) => { row.hidden = true; });
  const more = rest.length ? el("button", {type: "button", class: "link more", onclick: () => { rest.forEach((row) => { row.hidden = false; }); more.remove(); }}, "show " + plural(rest.length, "more cause")) : null;
  return el("section", {id: "causes"}, el("h2", {}, "Causes ", el("span", {class: "count"}, String(causes.length))),
    el("div", {class: "framed"}, table("", [data.runs ? "change" : "status", "cause", "breaks", "cases", "smallest case"], rows, "cards")), more);
}
