// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// What went wrong, one row a cause, in the order of report::causes(): the gravest status first, in it the loosest level, in
// that the rule that leads in the most families.

const SHOWN_CAUSES = 8;
const SHOWN_BUGS = 3;  // of a cause

const openCause = (cause) => ({...cause, key: [cause.change, cause.status, cause.family, cause.rule, cause.kind, cause.level, cause.door].filter((part) => part !== undefined).join("|"),
  records: cause.cases.map((k) => data.cases[k])});
const causes = data.causes.map(openCause);
const knownCauses = (data.known_causes || []).map(openCause);  // of expected failures
// A case that breaks several relations between drawings stands in several causes, the worst first.
const causesOf = new Map(data.cases.map((record) => [record, []]));
for (const cause of [...causes, ...knownCauses]) { cause.records.forEach((record) => causesOf.get(record).push(cause)); }
const causeOf = (record) => causesOf.get(record)[0] || null;
const isOfCause = (record, key) => causesOf.get(record).some((cause) => cause.key === key);
const ruleAndDoor = (cause) => cause.rule + (cause.door ? "=" + cause.door : "");

function causeText(cause) {
  const rule = data.rules[cause.rule], record = cause.records[0];
  return rule ? rule.title : cause.rule || cause.kind || record.reason || record.what || word(cause.status);
}
const causeTitle = (cause) => (cause.rule ? ruleAndDoor(cause) + " \u00b7 " + cause.kind : word(cause.status) + " \u00b7 " + causeText(cause)) + " \u00b7 " + cause.family;

// Whether a result is what its expectation speaks of; one that fails although it has one is news beside it.
const isKnown = (record) => ["xfail", "xpass", "improved"].includes(record.status) || Boolean(record.expired);
function bugsLine(words, records) {
  const bugs = [...new Set(records.map((record) => record.bug).filter(Boolean))];
  return bugs.length ? el("div", {class: "quiet small"}, words + bugs.slice(0, SHOWN_BUGS).join(", ") + (bugs.length > SHOWN_BUGS ? ", ..." : "")) : null;
}

function causeRow(cause, show) {
  const findings = cause.records.reduce((sum, record) => sum + (record.finding_total || 0), 0), example = cause.records[0];
  const link = el("a", {href: "#case=" + encodeURIComponent(example.id), class: "id"}, idText(example.id));
  return el("tr", {"data-cause": cause.key},
    el("td", {}, cause.change ? cause.change : statusTag(cause.status)),
    el("td", {}, cause.rule ? [ruleLink(cause.rule), cause.door ? "=" + cause.door : "", " ", el("span", {class: "kind"}, cause.kind), " in " + cause.family] : null, el("div", {}, causeText(cause)),
      bugsLine("known as ", cause.records.filter(isKnown)), bugsLine("beside what is known as ", cause.records.filter((record) => !isKnown(record)))),
    el("td", {}, cause.level ? [levelTag(cause.level), el("div", {class: "quiet small"}, data.meanings[cause.level])] : cause.known ? "all expected" : ""),
    el("td", {class: "right"}, el("button", {type: "button", class: "link", title: "show only these", onclick: () => show(cause.key)}, plural(cause.records.length, "case")),
      findings ? el("div", {class: "quiet small"}, plural(findings, "finding")) : null),
    el("td", {}, link, cause.rerun || example.rerun ? [" ", copyButton("copy rerun", "the rerun command of " + example.id, cause.rerun || example.rerun, link)] : null));
}

function causesTable(rows) {
  return el("div", {class: "framed"}, table("", [data.runs ? "change" : "status", "cause", "breaks", "cases", "smallest case"], rows, "cards causes"));
}

// What the device does wrong, as far as it was found out, with the cases that show it best. The causes that it repeats are
// folded under it. What explains a few cases only has none, and stands after the causes.
function diagnosesSection(show, isPartial) {
  const list = (data.diagnoses || []).map((diagnosis, number) => [diagnosis, number]).filter(([diagnosis]) => Boolean(diagnosis.limits) === isPartial);
  if (list.length === 0) { return null; }
  const entries = list.map(([diagnosis, number]) => {
    const shown = diagnosis.cases.map((k) => data.cases[k].id);
    const folded = causes.filter((cause) => cause.diagnosis === number), cases = folded.reduce((sum, cause) => sum + cause.records.length, 0);
    return el("div", {class: "diagnosis"}, el("p", {class: "what"}, diagnosis.what + "."), el("p", {class: "quiet small"}, (diagnosis.limits ? diagnosis.limits + "; " : "") + diagnosis.evidence + "."),
      el("p", {class: "small"}, "Seen in ", shown.flatMap((id, k) => [k ? ", " : "", el("a", {href: "#case=" + encodeURIComponent(id), class: "id"}, idText(id))])),
      folded.length ? el("details", {class: "folded"}, el("summary", {class: "small"}, plural(folded.length, "cause") + (folded.length === 1 ? " says" : " say") + " the same, in " + plural(cases, "case")),
        causesTable(folded.map((cause) => causeRow(cause, show)))) : null);
  });
  return el("section", {id: isPartial ? "partial-diagnoses" : "diagnoses"}, el("h2", {}, isPartial ? "Some cases look as if" : "Diagnosis"), entries);
}

// `show(key)` is called to list the cases of one cause alone.
function causesSection(show) {
  const listed = causes.filter((cause) => cause.diagnosis === undefined), isRest = listed.length < causes.length;
  if (listed.length === 0) { return null; }
  const rows = listed.map((cause) => causeRow(cause, show));
  const rest = rows.length > SHOWN_CAUSES + 1 ? rows.slice(SHOWN_CAUSES) : [];
  rest.forEach((row) => { row.hidden = true; });
  const more = rest.length ? el("button", {type: "button", class: "link more", onclick: () => { rest.forEach((row) => { row.hidden = false; }); more.remove(); }}, "show " + plural(rest.length, "more cause")) : null;
  return el("section", {id: "causes"}, el("h2", {}, isRest ? "Other causes " : "Causes ", el("span", {class: "count"}, String(listed.length))), causesTable(rows), more);
}

// Failures that an expectation file names, folded: they are news to nobody who wrote it.
function knownCausesSection(show) {
  if (knownCauses.length === 0) { return null; }
  const cases = knownCauses.reduce((sum, cause) => sum + cause.records.length, 0);
  return el("details", {id: "known", class: "section"}, el("summary", {}, el("h2", {}, "Known failures by cause ", el("span", {class: "count"}, plural(knownCauses.length, "cause") + ", " + plural(cases, "case")))),
    causesTable(knownCauses.map((cause) => causeRow(cause, show))));
}
