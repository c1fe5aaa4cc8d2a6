// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// All that is known of one sample: what the rules say, why, and what the device wrote.

const SHOWN_TRIANGLES = 6;
// Whether all findings of a sample are here: page_data.cpp cuts off the list of a case, but of a sample never below this many.
const LEAST_OF_SAMPLE = 9;
const isComplete = (record, findings, told) => findings.length === (record.finding_total || 0) || (told.length > 0 && told.length < LEAST_OF_SAMPLE);

function makeInspector(record, scene) {
  const body = el("div", {class: "inspector-body"});
  const summary = el("p", {id: "sample-summary", class: "hint"}, "Point at a sample, or move with the arrow keys.");
  const element = el("aside", {class: "inspector", "aria-label": "sample"}, summary, body);
  const findings = (record.findings || []).map(finding);
  const evidence = new Map((record.evidence || []).map((e) => [e.at.join(","), e]));
  return {element, show(at) {
    const told = findings.filter((f) => f.x === at.x && f.y === at.y && f.sample === at.sample);
    const known = evidence.get(at.x + "," + at.y + "," + at.sample);
    summary.className = "sample-title";
    summary.replaceChildren(...sampleTitle(scene, at));
    body.replaceChildren(...[verdictPart(scene, at, known, told), findingsPart(told), coursesPart(known), colorsPart(known), valuesPart(scene, at, known, told, isComplete(record, findings, told)), trianglesPart(scene, at), blitPart(scene, at)].filter(Boolean));
  }, sentence: (at) => sampleSentence(scene, at)};
}

const sampleName = (scene, at) => pixelName(scene.pictures.layerHeight, at.x, at.y) + (scene.pictures.samples > 1 ? " sample " + at.sample : "");

function sampleTitle(scene, at) {
  const parts = [el("strong", {}, (isBlitScene(scene) ? "Texel " : "Pixel ") + sampleName(scene, at))];
  if (scene.geometry && !isBlitScene(scene)) {
    parts.push(el("span", {class: "quiet"}, " at " + pointText(samplePosition(scene.geometry, at.x, rowInLayer(scene.pictures, at.y), at.sample))));
  }
  return parts;
}

// Where nobody counted hits the colour alone says whether something was drawn.
const deviceText = (scene, hits) => isBlitScene(scene) ? (hits ? "written" : "not written") : !scene.pictures.isUncounted ? hitsText(hits, false) : hits ? "not the clear colour" : "the clear colour";

// The same for a screen reader, when the arrow keys have moved there.
function sampleSentence(scene, at) {
  if (!isInPicture(scene.pictures, at)) { return ""; }
  const p = scene.pictures, k = indexOf(p, at);
  return (isBlitScene(scene) ? "Texel " : "Pixel ") + sampleName(scene, at) + ": " + spoken(scene, MARK_TEXT[p.marks[k]]) + "; reference: " + spoken(scene, classText(p.expected[k])) + (p.isReference ? "" : ", device: " + deviceText(scene, p.device[k])) +
    (scene.ties.has(k) ? "; exactly on an edge" : "");
}

function verdictPart(scene, at, known, told) {
  const p = scene.pictures;
  if (!isInPicture(p, at)) { return el("p", {class: "quiet"}, "Outside the picture that was kept."); }
  const k = indexOf(p, at), mark = p.marks[k];
  const swatch = el("canvas", {width: 44, height: 44, class: "swatch", "aria-hidden": "true"}), context = swatch.getContext("2d");
  context.scale(2, 2);
  if (mark > 1) { drawMark(context, mark, 0, 0, 22, 22); } else if (mark === 1) { drawFree(context, PALETTES[theme()], 0, 0, 22, 22); }
  else { context.fillStyle = PALETTES[theme()].hits[Math.min(3, p.expected[k])]; context.fillRect(0, 0, 22, 22); }
  const rows = [];
  const fact = (name, value) => { if (value) { rows.push(el("dt", {}, name), el("dd", {}, value)); } };
  const expected = p.expected[k];
  fact("reference", [el("strong", {"data-class": expected === SEVERAL ? "either" : expected === 0 ? "must-not" : "must"}, spoken(scene, classText(expected))),
    known && known.allowed ? ", hits " + known.allowed : expected === SEVERAL || expected === 0 || isBlitScene(scene) ? "" : ", " + hitsText(expected, true)]);
  fact("device", p.isReference ? "" : (known && known.hits ? known.hits : deviceText(scene, p.device[k])) + (known && known.writer ? ", last by " + known.writer : ""));
  // Beside what is wrong without a distance the error of a value that is right would mislead.
  if (p.errors && p.errors[k] && (told.length === 0 || told.some((f) => f.ratio))) { fact("error", errorText(p.errors[k])); }
  const color = (plane) => [plane[k], plane[p.count + k], plane[2 * p.count + k]];
  const chip = (c) => { const s = el("span", {class: "chip", "aria-hidden": "true"}); s.style.background = "rgb(" + c.join(",") + ")"; return [s, " " + c.join(", ")]; };
  if (p.expectedColors) { fact("expected colour", chip(color(p.expectedColors))); }
  if (p.colors) { fact("device colour", [...chip(color(p.colors)), el("span", {class: "quiet"}, " of 255")]); }
  const depth = (codes) => codes && codes[k] ? "about " + shortNumber(p.depthLow + (p.depthHigh - p.depthLow) * (codes[k] - 1) / 254, 4) : "";
  fact("expected depth", depth(p.expectedDepths));
  fact("device depth", depth(p.depths));
  const stencil = (codes) => codes && codes[k] ? String(Math.round(p.stencilLow + (p.stencilHigh - p.stencilLow) * (codes[k] - 1) / 254)) : "";
  fact("expected stencil", known && known.stencil ? known.stencil : stencil(p.expectedStencils));
  fact("device stencil", known && known.device_stencil ? known.device_stencil : stencil(p.stencils));
  return el("div", {class: "verdict-part"}, el("div", {class: "mark-line"}, swatch, el("strong", {"data-mark": MARKS[mark]}, p.isReference && mark === 0 ? "the reference" : spoken(scene, MARK_TEXT[mark]))), el("dl", {}, rows));
}

function findingsPart(told) {
  if (told.length === 0) { return null; }
  const groups = new Map();  // one rule and sentence may be broken by several quantities
  for (const f of told) {
    const key = f.rule + f.why + f.level;
    if (!groups.has(key)) { groups.set(key, []); }
    groups.get(key).push(f);
  }
  return el("div", {class: "told"}, [...groups.values()].map((list) => {
    const f = list[0], rule = data.rules[f.rule];
    return el("div", {class: "broken"},
      el("p", {}, ruleLink(f.rule), " ", levelTag(f.level), el("span", {class: "quiet"}, " " + data.meanings[f.level])),
      rule ? el("p", {}, el("strong", {}, rule.title + ". "), el("span", {class: "quiet"}, rule.text)) : null,
      el("p", {class: "why"}, f.why),
      list.map((g) => el("p", {class: "pair"}, g.quantity ? el("strong", {}, g.quantity + ": ") : null, "expected ", el("span", {class: "number"}, folded(g.expected)), ", got ",
        el("span", {class: numberClass(g.got)}, g.got), g.ratio ? ", " + g.ratio + " budgets off" : "")));
  }));
}

// What the tests of each triangle make of it, and what its shader discards, in drawing order.
const coursesPart = (known) => known ? sentencesPart("Discards and tests", known.courses) : null;
// How the colour that is expected comes about.
const colorsPart = (known) => known ? sentencesPart("Expected colour, fragment by fragment", known.colors) : null;

function sentencesPart(title, sentences) {
  if (!sentences || sentences.length === 0) { return null; }
  return el("div", {class: "courses"}, el("h2", {}, title),
    sentences.map(([name, sentence]) => el("p", {class: "small"}, name ? [el("strong", {}, name), " "] : "", sentence)));
}

const MAX_STEPS = 1e7;
function valueRow(value, told, complete, drawn) {
  const [quantity, fraction, nearestText, budgetText, lowText, highText, bits, also = ""] = value;
  const exact = fraction.replace(MINUS, "\u2212");
  const nearest = numberOf(nearestText), budget = numberOf(budgetText), low = numberOf(lowText), high = numberOf(highText);
  const f = told.find((g) => g.quantity === quantity), got = bits === null ? NaN : floatOf(bits);
  const steps = bits === null ? null : ulps(bits, nearest), inside = got >= low && got <= high;
  let budgets = "";
  if (f && f.ratio) { budgets = f.ratio + " budgets"; }
  else if (f) { budgets = Number.isNaN(got) ? "" : "another number"; }
  else if (budget > 0 && bits !== null) {
    const off = Math.abs(got - nearest) / budget;
    budgets = off <= MOST_BUDGETS ? shortNumber(off, 3) + " budgets" : inside || complete ? "another set-up" : shortNumber(off, 3) + " budgets";
  }
  const verdict = bits === null ? "" : f ? el("strong", {class: "bad"}, "\u2717", el("span", {class: "hidden-text"}, " wrong")) : inside || complete ? "\u2713" : also ? "" : "outside";
  const exactText = exact && exact !== shortNumber(nearest) ? [" = ", folded(exact)] : "";
  return el("tbody", {class: f ? "wrong" : ""},
    el("tr", {}, el("th", {scope: "rowgroup", colspan: 3}, quantity, verdict ? [" ", verdict] : null)),
    el("tr", {},
      el("td", {}, el("span", {class: "number"}, el("span", {class: "whole"}, shortNumber(nearest)), exactText),
        el("div", {class: "quiet number small"}, also ? folded(also + (budget === 0 ? ", bit for bit" : "")) : budget === 0 ? "bit for bit" : ["[" + shortNumber(low) + ", ", el("span", {class: "whole"}, shortNumber(high) + "]")])),
      el("td", {class: "device-value"}, bits === null ? el("span", {class: "quiet"}, drawn ? "not compared" : "not drawn") : [el("span", {class: "number whole"}, floatText(bits)), el("div", {class: "quiet number small"}, hex(bits))]),
      el("td", {class: "off"}, bits === null ? "" : [also && !f && complete && steps !== 0 ? "one of these" : steps === null ? "" : steps > MAX_STEPS ? "> 10\u2077 ulp" : steps + " ulp", el("div", {class: "quiet small"}, budgets)])));
}

// `complete`: all findings of the sample are here, so that a value without one was accepted.
function valuesPart(scene, at, known, told, complete) {
  const drawn = isInPicture(scene.pictures, at) && scene.pictures.device[indexOf(scene.pictures, at)] > 0;
  if (!known || known.values.length === 0) {
    return drawn && !known && scene.pictures.errors ? el("p", {class: "quiet small"}, "Values are kept for the first wrong samples and their neighbours, where a triangle may be; the command \u201cexplain\u201d tells them for any sample.") : null;
  }
  const isWrong = (value) => told.some((f) => f.quantity === value[0]);
  return el("div", {class: "values"}, el("h2", {}, "Values"), el("div", {class: "framed"},
    table("", ["exact, [all set-ups]", "device", "off by"], [...known.values].sort((a, b) => isWrong(b) - isWrong(a)).map((v) => valueRow(v, told, complete, drawn)), "compact")));
}

function edgeRow(e) {
  const sign = e.value === 0n ? "zero" : e.value > 0n ? "positive" : "negative";
  const owns = ownsTies(e.kind);
  return el("tr", {class: "edge-" + sign},
    el("td", {class: "number"}, "v" + e.a.number + "\u2192v" + e.b.number),
    el("td", {}, owns ? el("strong", {}, e.kind) : e.kind),
    el("td", {class: "number value"}, fractionText(e.value, 32)),
    el("td", {}, e.value === 0n ? el("strong", {}, "= 0, a tie") : e.value > 0n ? "> 0" : "< 0"));
}

function trianglesPart(scene, at) {
  const g = scene.geometry;
  if (!g || g.blit.length > 0) { return null; }
  const p = scene.pictures, point = samplePosition(g, at.x, rowInLayer(p, at.y), at.sample), list = trianglesAt(g, point, layerOf(p, at.y));
  const parts = [el("h2", {}, "Triangles")];
  if (list.length === 0) { parts.push(el("p", {class: "quiet"}, "No triangle within two pixels.")); }
  for (const seen of list.slice(0, SHOWN_TRIANGLES)) {
    const t = seen.triangle;
    parts.push(el("details", {class: "triangle place-" + seen.place, open: seen.place !== "outside" || list[0] === seen},
      el("summary", {}, el("strong", {}, triangleName(t, g)), " ", placeText(seen), seen.place === "outside" ? "" : limitsText(g, t, point, at.x, rowInLayer(p, at.y))),
      table("", ["edge", "kind", "E, square pixels", "sign"], seen.edges.map(edgeRow), "compact edges"),
      limitRows(t, point),
      el("p", {class: "quiet small"}, [t.isExact ? "" : "Snapped to the nearest subpixel position; the device may choose another. ",
        t.isClipped ? "It reaches out of the clip volume; dashed is what clipping leaves. " : "", t.hasArea ? (t.isBackward ? "Counter-clockwise on screen." : "Clockwise on screen.") : ""].join(""))));
  }
  if (list.length > SHOWN_TRIANGLES) { parts.push(el("p", {class: "quiet"}, "and " + (list.length - SHOWN_TRIANGLES) + " more")); }
  return el("div", {class: "triangles"}, parts);
}

// Where a blit's texel comes from: u = (i + 1/2 - d0) (s1 - s0) / (d1 - d0) + s0.
function blitPart(scene, at) {
  const g = scene.geometry;
  if (!g || g.blit.length < 2) { return null; }
  const [s, d] = g.blit;
  const along = (i, s0, s1, d0, d1) => ({top: BigInt(2 * i + 1 - 2 * d0) * BigInt(s1 - s0) + BigInt(2 * s0) * BigInt(d1 - d0), bottom: 2n * BigInt(d1 - d0)});
  const text = ({top, bottom}) => {
    if (bottom < 0n) { top = -top; bottom = -bottom; }
    const common = (a, b) => b === 0n ? a : common(b, a % b), n = common(abs(top), bottom) || 1n;
    return (top < 0n ? "\u2212" : "") + abs(top) / n + (bottom / n === 1n ? "" : "/" + bottom / n);
  };
  return el("p", {}, "Source coordinate ", el("span", {class: "number"}, "(" + text(along(at.x, s[0], s[2], d[0], d[2])) + ", " + text(along(at.y, s[1], s[3], d[1], d[3])) + ")"), " in texels.");
}
