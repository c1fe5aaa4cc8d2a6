// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// Pictures: decoding (report/journal/picture_codec.hpp), and what their bytes look like.

const MARKS = ["ok", "either", "missing", "extra", "double", "value", "order"];
const LETTERS = ["", "", "M", "X", "D", "V", "O"];
const MARK_TEXT = ["as expected", "free: the rules allow several answers", "missing: must be covered", "extra: must not be covered",
  "double: hit too often", "value: a wrong value was written", "order: written by the wrong triangle"];
// Okabe and Ito's colours, each with a pattern and a letter of its own.
const MARK_COLOR = ["", "#999999", "#D55E00", "#56B4E9", "#CC79A7", "#F0B429", "#009E73"];
const SEVERAL = 255;  // Verdict::expected_hits: more than one number of hits is allowed
const PALETTES = {
  light: {paper: "#ffffff", margin: "#eef1f4", hits: ["#ffffff", "#cfd8e1", "#9aa8b6", "#66727e"], free: "#b4bac1", grid: "rgba(30,42,54,.16)",
    line: "#17212b", halo: "rgba(255,255,255,.85)", quiet: "#5b6670", cursor: "#0059b3", ok: "#e6ebf0", layer: "#0072b2"},
  dark: {paper: "#171b20", margin: "#21262d", hits: ["#171b20", "#3d4a58", "#62758a", "#93a6ba"], free: "#5a626b", grid: "rgba(225,235,245,.15)",
    line: "#eef3f8", halo: "rgba(12,15,18,.8)", quiet: "#a2abb5", cursor: "#6cc0ff", ok: "#2b333c", layer: "#56b4e9"},
};
// Magma, after Smith and van der Walt (matplotlib): one path from dark to light, the same without colour.
const MAGMA = [[0, 0, 4], [28, 16, 68], [79, 18, 123], [129, 37, 129], [181, 54, 122], [229, 80, 100], [251, 135, 97], [254, 194, 135], [252, 253, 191]];

function decodePicture(text) {
  const runs = atob(text);
  let size = 0;
  for (let at = 0; at < runs.length; at += 2) { size += runs.charCodeAt(at) + 1; }
  const bytes = new Uint8Array(size);
  let to = 0;
  for (let at = 0; at < runs.length; at += 2) {
    const length = runs.charCodeAt(at) + 1;
    bytes.fill(runs.charCodeAt(at + 1), to, to + length);
    to += length;
  }
  return bytes;
}

// The pictures of a case, or null.
function openPictures(p) {
  if (!p || !p.width || !p.height || !p.marks) { return null; }
  const open = (name) => p[name] ? decodePicture(p[name]) : new Uint8Array(0);
  const pictures = {isUncounted: Boolean(p.uncounted), width: p.width, height: p.height, left: p.left, top: p.top, layerHeight: p.layer_height || 0, expected: open("expected_hits"),
    device: open("device_hits"), marks: open("marks"), errors: open("errors"), colors: open("device_colors"),
    expectedColors: open("expected_colors"), depths: open("device_depths"), expectedDepths: open("expected_depths"), depthLow: numberOf(p.depth_low), depthHigh: numberOf(p.depth_high),
    stencils: open("device_stencils"), expectedStencils: open("expected_stencils"), stencilLow: p.stencil_low || 0, stencilHigh: p.stencil_high || 0};
  const count = pictures.marks.length, samples = count / (p.width * p.height);
  if (!Number.isInteger(samples) || samples < 1 || pictures.expected.length !== count || pictures.device.length !== count) { return null; }
  const fits = (plane, planes) => plane.length === planes * count ? plane : null;
  pictures.errors = fits(pictures.errors, 1);
  pictures.depths = fits(pictures.depths, 1);
  pictures.expectedDepths = fits(pictures.expectedDepths, 1);
  pictures.stencils = fits(pictures.stencils, 1);
  pictures.expectedStencils = fits(pictures.expectedStencils, 1);
  pictures.colors = fits(pictures.colors, 3);
  pictures.expectedColors = fits(pictures.expectedColors, 3);
  pictures.samples = samples;
  pictures.count = count;
  pictures.columns = Math.ceil(Math.sqrt(samples));
  pictures.rows = Math.ceil(samples / pictures.columns);
  return pictures;
}

// Of a case that passes the reference alone; or null.
function openReference(record) {
  if (record.reference === undefined) { return null; }
  const pair = onDemand().references[record.reference];
  const [r, geometry] = pair, expected = decodePicture(r.hits), none = new Uint8Array(expected.length), samples = expected.length / (r.width * r.height);
  const columns = Math.ceil(Math.sqrt(samples));
  return {geometry, pictures: {width: r.width, height: r.height, left: r.left, top: r.top, layerHeight: r.layer_height, expected, device: none,
    marks: expected.map((hits) => hits === SEVERAL ? 1 : 0), errors: null, depths: null, expectedDepths: null, stencils: null, expectedStencils: null, colors: null, expectedColors: null, samples, count: expected.length, columns,
    rows: Math.ceil(samples / columns), isReference: true}};
}

// A pixel's name; layers are stacked in pictures, each `layerHeight` rows high (0: one layer).
const pixelName = (layerHeight, x, y) =>
  layerHeight ? "(" + x + ", " + y % layerHeight + ") of layer " + Math.floor(y / layerHeight) : "(" + x + ", " + y + ")";
const layerOf = (p, y) => p.layerHeight ? Math.floor(y / p.layerHeight) : 0;
const rowInLayer = (p, y) => p.layerHeight ? y % p.layerHeight : y;
// Which rows of a layer the picture shows, first to last, and how many rows of other layers lie above the layer.
function rowsOfLayer(p, layer) {
  const above = layer * p.layerHeight, height = p.layerHeight || p.top + p.height;
  return {above, first: Math.max(0, p.top - above), last: Math.min(height, p.top + p.height - above) - 1};
}

const indexOf = (p, at) => ((at.y - p.top) * p.width + (at.x - p.left)) * p.samples + at.sample;
const isInPicture = (p, at) => at.x >= p.left && at.y >= p.top && at.x < p.left + p.width && at.y < p.top + p.height && at.sample < p.samples;

function hitsText(hits, expected) {
  if (expected && hits === SEVERAL) { return "several answers allowed"; }
  return hits >= (expected ? 254 : 255) ? hits + " or more hits" : hits === 1 ? "1 hit" : hits + " hits";
}
const classText = (hits) => hits === SEVERAL ? "either: the rules leave it open" : hits === 0 ? "must not be covered" : "must be covered";

// report::error_code(): about how many budgets.
function errorOf(code) {
  return code === 0 ? null : code === 1 ? 0 : code === 255 ? Infinity : Math.pow(2, (code - 128) / 8);
}
function errorText(code) {
  const error = errorOf(code);
  return error === null ? "nothing compared" : error === 0 ? "exact" : error === Infinity ? "NaN or infinity" : "about " + shortNumber(error, 2) + " budgets";
}
// 2^-8 to 2^8 budgets. Large errors stand out of the paper: bright on dark, dark on light.
const HEAT_SPAN = 8;
function heatColor(code, theme) {
  const error = errorOf(code);
  const t = error === 0 ? 0 : Math.min(1, Math.max(0, (Math.log2(error) + HEAT_SPAN) / (2 * HEAT_SPAN)));
  const at = (theme === "dark" ? .12 + .88 * t : 1 - .96 * t) * (MAGMA.length - 1), k = Math.min(MAGMA.length - 2, Math.floor(at));
  const mix = (c) => Math.round(MAGMA[k][c] + (MAGMA[k + 1][c] - MAGMA[k][c]) * (at - k));
  return "rgb(" + mix(0) + "," + mix(1) + "," + mix(2) + ")";
}

// A cell with the pattern of its mark, so that it is told apart without colour too. Returns whether a letter stands in its
// middle, where nothing else should be drawn.
function drawMark(context, mark, x, y, w, h) {
  context.fillStyle = MARK_COLOR[mark];
  context.fillRect(x, y, w, h);
  const size = Math.min(w, h);
  if (size < 5) { return false; }
  context.save();
  context.beginPath();
  context.rect(x, y, w, h);
  context.clip();
  context.strokeStyle = "rgba(0,0,0,.62)";
  context.fillStyle = "rgba(0,0,0,.62)";
  context.lineWidth = Math.max(1, size / 18);
  const step = Math.max(4, size / 4);
  context.beginPath();
  if (mark === 2) {         // missing: diagonals
    for (let d = -h; d < w; d += step) { context.moveTo(x + d, y + h); context.lineTo(x + d + h, y); }
  } else if (mark === 4) {  // double: a cross
    context.moveTo(x, y); context.lineTo(x + w, y + h); context.moveTo(x + w, y); context.lineTo(x, y + h);
  } else if (mark === 5) {  // value: horizontal lines
    for (let d = step / 2; d < h; d += step) { context.moveTo(x, y + d); context.lineTo(x + w, y + d); }
  } else if (mark === 6) {  // order: vertical lines
    for (let d = step / 2; d < w; d += step) { context.moveTo(x + d, y); context.lineTo(x + d, y + h); }
  }
  context.stroke();
  if (mark === 3) {         // extra: dots
    const r = Math.max(1, size / 16);
    context.beginPath();
    for (let v = step / 2; v < h; v += step) {
      for (let u = step / 2; u < w; u += step) { context.moveTo(x + u + r, y + v); context.arc(x + u, y + v, r, 0, 2 * Math.PI); }
    }
    context.fill();
  }
  context.restore();
  // In a corner as soon as there is room: the sample is in the middle.
  if (size >= 34) {
    const inset = Math.max(9, Math.min(16, size * .26));  // clear of the grid and of a thick edge, where there is room
    drawLetter(context, LETTERS[mark], x + inset, y + inset, 12);
    return false;
  }
  if (size >= 9) { drawLetter(context, LETTERS[mark], x + w / 2, y + h / 2, Math.min(12, Math.max(8, size * .7))); return true; }
  return false;
}

function drawLetter(context, text, x, y, size) {
  context.font = "700 " + Math.round(size) + "px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.lineWidth = Math.max(3, size / 4);
  context.strokeStyle = "rgba(255,255,255,.92)";
  context.strokeText(text, x, y + 1);
  context.fillStyle = "#111111";
  context.fillText(text, x, y + 1);
}

// Free: a checker of four fields.
function drawFree(context, palette, x, y, w, h) {
  context.fillStyle = palette.paper;
  context.fillRect(x, y, w, h);
  context.fillStyle = palette.free;
  const n = Math.min(w, h) >= 16 ? 4 : 2, a = w / n, b = h / n;
  for (let j = 0; j < n; ++j) {
    for (let i = j % 2; i < n; i += 2) { context.fillRect(x + i * a, y + j * b, a, b); }
  }
}
