// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// The page of one case.

function makeCasePage(record, neighbours, onChange) {
  const page = {record, viewer: null, inspector: null, rows: [], findings: (record.findings || []).map(finding)};
  const announce = byId("announcer");
  const show = (at) => page.inspector.show(at);
  page.viewer = makeViewer(record, (at) => show(at), () => onChange());
  page.pin = (at) => {
    if (isOfCase(at)) { page.mark(at); return; }  // what is pinned stays
    const full = {x: at.x, y: at.y, sample: at.sample || 0};
    if (page.viewer) {
      page.viewer.pin(full);
      announce.textContent = page.inspector.sentence(full);
    }
    page.mark(full);
  };
  page.isMarked = (f) => Boolean(page.marked) && (isOfCase(f) ? f === page.marked : f.x === page.marked.x && f.y === page.marked.y && f.sample === page.marked.sample);
  page.mark = (at) => {
    page.marked = at;
    page.findings.forEach((f, k) => page.rows[k].setAttribute("aria-selected", String(page.isMarked(f))));
  };
  const heading = el("h1", {tabIndex: -1, id: "case-title", class: "id"}, idText(record.id));
  const step = (label, key, target) => el("button", {type: "button", disabled: !target, title: "key " + key, "data-step": key, onclick: () => openCase(target)}, label);
  const described = string(record.description), catches = string(record.catches);
  const head = el("header", {class: "case-head"},
    el("nav", {class: "case-nav", "aria-label": "cases"}, el("button", {type: "button", id: "back", title: "key Esc", onclick: () => openOverview()}, "\u2190 All cases"),
      el("span", {class: "grow"}), neighbours.position ? el("span", {class: "quiet"}, neighbours.position) : null,
      step("\u2039 Previous", "p", neighbours.previous), step("Next unexpected \u203a", "n", neighbours.next)),
    el("div", {class: "case-title"}, statusTag(record.status), heading),
    el("p", {class: "what"}, record.what), diagnosisLine(record), described ? el("p", {class: "described"}, described) : null,
    catches ? el("p", {class: "quiet described"}, "Catches: " + catches) : null);
  page.element = el("article", {class: "case-page", "aria-labelledby": "case-title"}, head);
  if (page.viewer) {
    page.inspector = makeInspector(record, page.viewer.scene);
    if (page.viewer.scene.pictures.isReference) { page.element.append(el("p", {class: "note"}, "The device drew what the rules ask for, which is shown here. --capture=all keeps its own pictures, too.")); }
    page.element.append(el("div", {class: "bench"}, page.viewer.element, page.inspector.element));
    page.viewer.element.addEventListener("click", () => { if (page.viewer.pinned) { page.mark(page.viewer.pinned); } });
  } else {
    page.element.append(el("p", {class: "note"}, noPictureText(record)));
  }
  add(page.element, findingsSection(page), el("div", {class: "columns"}, rulesSection(record), factsSection(record), commandsSection(record)),
    geometrySection(page), sourceSection(record), outputSections(record));
  return page;
}

// The diagnosis that explains the case: it was tried on this one, or on others of its cause.
function diagnosisLine(record) {
  const cause = causeOf(record), isTried = record.diagnosis !== undefined, number = isTried ? record.diagnosis : cause && cause.diagnosis;
  const diagnosis = (data.diagnoses || [])[number];
  return diagnosis ? el("div", {class: "diagnosis"}, el("p", {class: "what"}, diagnosis.what + "."),
    el("p", {class: "quiet small"}, isTried ? "The diagnosis repeats what is wrong here." : "The diagnosis repeats what is wrong in the cases of the same cause that it was tried on; this one was not.")) : null;
}

// The file of another part of the report: report.html, report-2.html ...
function partName(part) {
  const name = decodeURIComponent(location.pathname.slice(location.pathname.lastIndexOf("/") + 1)), own = data.part > 1 ? "-" + data.part : "";
  return name.replace(new RegExp(own + "(\\.[^.]*)?$"), (part > 1 ? "-" + part : "") + "$1");
}

function noPictureText(record) {
  if (record.part) { return ["To keep this page small its pictures stand in ", el("a", {href: partName(record.part) + "#case=" + encodeURIComponent(record.id)}, partName(record.part)), "."]; }
  if (!record.file) { return "Nothing was drawn: this is about the device."; }
  if (record.findings) { return "No pictures were kept; --capture=failed keeps them."; }
  if (record.status === "pass" || record.status === "xpass") { return "Nothing is wrong here, so no pictures were kept; --capture=all keeps them, and \u201crender\u201d draws the reference."; }
  return "Nothing was compared, so there are no pictures.";
}

function findingsSection(page) {
  const record = page.record;
  if (page.findings.length === 0) { return null; }
  page.rows = page.findings.map((f) => {
    const row = el("tr", {class: "pick", tabIndex: 0, onclick: () => page.pin(f), onkeydown: (event) => {
      if (event.key === "Enter") { page.pin(f); }
    }}, el("td", {class: "number whole"}, isOfCase(f) ? "the case" : pixelName((record.pictures || {}).layer_height, f.x, f.y) + (f.sample ? " s" + f.sample : "")), el("td", {}, f.kind), el("td", {}, ruleLink(f.rule)), el("td", {}, levelTag(f.level)),
    el("td", {class: "number", "data-label": "expected"}, f.quantity ? f.quantity + ": " : "", unfolded(f.expected)), el("td", {class: numberClass(f.got), "data-label": "got"}, f.got), el("td", f.ratio ? {class: "number right", "data-label": "budgets off"} : {class: "number right"}, f.ratio || ""), el("td", {class: "why"}, f.why));
    return row;
  });
  const here = page.findings.length, kept = record.finding_kept;
  const rest = record.finding_total === here ? "" : ", " + here + " of them here" + (kept > here ? " and " + kept + " in results.json" : "; the others are counted only");
  return el("section", {class: "findings"}, el("h2", {}, "Findings ", el("span", {class: "count"}, String(record.finding_total) + rest)),
    el("div", {class: "scroll tall", tabIndex: 0, role: "region", "aria-label": "findings"},
      table("", ["sample", "kind", "rule", "breaks", "expected", "got", "budgets off", "why"], page.rows, "cards")));
}

function rulesSection(record) {
  if (!record.rules) { return null; }
  return el("section", {}, el("h2", {}, "Rules"), el("ul", {class: "plain"}, record.rules.map((id) => {
    const rule = data.rules[id];
    return el("li", {}, ruleLink(id), rule ? [": " + rule.title, el("span", {class: "quiet"}, " (" + rule.profile + ")")] : "");
  }), (record.links || []).map((text) => el("li", {}, "see ", /^https?:\/\//.test(text) ? el("a", {href: text, rel: "noreferrer"}, text) : text))));
}

function factsSection(record) {
  const list = el("dl", {class: "facts"});
  const fact = (name, value) => { if (value) { add(list, el("dt", {}, name), el("dd", {}, value)); } };
  fact("file", record.file && record.file + (record.line ? ":" + record.line : ""));
  fact("expected", record.expected && word(record.expected) + (record.bug ? " (" + record.bug + ")" : ""));
  fact("reason", record.reason);
  fact("signal", record.signal);
  fact("last step", record.step);
  if (record.compared) {
    const [samples, must, free, values] = record.compared;
    fact("compared", samples + " samples (" + must + " must be covered, " + free + " free), " + values + " values");
  }
  fact(record.finding_total ? "largest error of a value" : "largest error", record.worst && record.worst[1] + (numberOf(record.worst[0]) === Infinity ? "" : " budgets") + (record.worst[2] ? ", " + record.worst[2] : ""));
  fact("time", record.time + (record.attempts > 1 ? ", " + record.attempts + " attempts" : ""));
  return el("section", {}, el("h2", {}, "Facts"), list);
}

function commandsSection(record) {
  if (!record.rerun && !record.explain) { return null; }
  const settings = string(record.settings);
  return el("section", {}, el("h2", {}, "Again"),
    settings ? el("div", {class: "command"}, el("span", {class: "quiet"}, "settings"), el("div", {}, el("code", {}, settings.trim()), el("div", {class: "quiet small"}, "in front of " + (record.debug ? "rerun and debug, copied with them" : "rerun, copied with it")))) : null,
    command("rerun", record.rerun, settings), command("debug", record.debug, settings), command("explain", record.explain), command("reproducer", record.reproducer),
    record.no_reproducer ? el("div", {class: "command"}, el("span", {class: "quiet"}, record.reproducer ? "" : "reproducer"), el("div", {class: record.reproducer ? "quiet small" : ""},
      record.reproducer ? "The case has " + record.no_reproducer + ", perhaps too many for one program; the command says so." : record.no_reproducer === "doors alone" ? "none: only doors show the failure, and such a program draws without them" : "none: the case has " + record.no_reproducer + ", which such a program cannot draw")) : null);
}

const SHOWN_SHAPES = 64;
function geometrySection(page) {
  const g = page.viewer && page.viewer.scene.geometry;
  if (!g || (g.triangles.length === 0 && g.blit.length === 0)) { return null; }
  if (g.blit.length) {
    const box = ([x0, y0, x1, y1]) => "(" + x0 + ", " + y0 + ") to (" + x1 + ", " + y1 + ")";
    return el("section", {}, el("h2", {}, "What is drawn"), el("p", {}, "A blit of texels " + box(g.blit[0]) + " of the source to " + box(g.blit[1]) + " of the target."));
  }
  const rows = g.triangles.slice(0, SHOWN_SHAPES).map((t) => el("tr", {}, el("td", {}, triangleName(t, g) + (page.viewer.scene.pictures.layerHeight ? ", layer " + t.layer : "")),
    t.corners.length ? t.corners.map((c, k) => el("td", {class: "number", "data-label": "v" + c.number}, pointText(c), boxText(t.boxes[k]) ? el("div", {class: "quiet small"}, boxText(t.boxes[k])) : null)) : el("td", {colspan: 3, class: "quiet"}, "a vertex has no position on screen"),
    el("td", {}, t.edges.filter((e) => t.hasArea && ownsTies(e.kind)).map((e) => e.kind + " v" + e.a.number + "\u2192v" + e.b.number).join(", ")),
    el("td", {class: "number right", "data-label": "area"}, t.corners.length ? fractionText(abs(t.area), 33) : "")));
  return el("details", {class: "section"}, el("summary", {}, el("h2", {}, "Triangles ", el("span", {class: "count"}, g.total + (rows.length < g.total ? ", " + rows.length + " here" : "")))),
    el("p", {class: "quiet"}, "Vertices in framebuffer coordinates, snapped to 1/" + 2 ** data.subpixel_bits + " pixel. " +
      (g.samples > 1 ? "Samples at " + g.locations.map((l) => "(" + coordinateText(l.x) + ", " + coordinateText(l.y) + ")").join(", ") + " in a pixel." : "")),
    el("div", {class: "scroll tall", tabIndex: 0, role: "region", "aria-label": "triangles"}, table("", ["triangle", "first vertex", "second", "third", "top and left edges", "area"], rows, "cards")));
}

// The file that makes the case; one with a matrix makes several.
function sourceSection(record) {
  const text = onDemand().sources[record.file];
  return text ? el("details", {class: "section source"}, el("summary", {}, el("h2", {}, "Case file")), el("p", {class: "quiet"}, record.file),
    el("pre", {class: "output", tabIndex: 0}, text)) : null;
}

function outputSections(record) {
  return [["Validation layer", (record.messages || []).join("\n")], ["What the driver printed", record.stderr]].filter(([, text]) => text)
    .map(([title, text]) => el("section", {}, el("h2", {}, title), el("pre", {class: "output", tabIndex: 0}, text)));
}
