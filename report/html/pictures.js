// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
"use strict";
// Pictures: decoding (report/picture_codec.hpp) and drawing on canvas.

const MARKS = ["ok", "either", "missing", "extra", "double", "value", "order"];
const MARK_TEXT = ["as expected", "free: several numbers of hits are allowed", "missing: must be covered",
  "extra: must not be covered", "double: hit too often", "value: covered, wrong value", "order: written by the wrong triangle"];
// Okabe and Ito's colours, each with a pattern of its own.
const MARK_COLOR = ["", "#999999", "#D55E00", "#0072B2", "#CC79A7", "#E69F00", "#009E73"];
const SEVERAL = 255;  // Verdict::expected_hits: more than one number of hits is allowed

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

// The pictures of a case, or null. Samples of a pixel are drawn as columns x rows cells, in order.
function openPictures(p) {
  if (!p || !p.width || !p.height) { return null; }
  const pictures = {width: p.width, height: p.height, left: p.left, top: p.top,
    expected: decodePicture(p.expected_hits), device: decodePicture(p.device_hits), marks: decodePicture(p.marks)};
  const samples = pictures.marks.length / (p.width * p.height);
  if (!Number.isInteger(samples) || samples < 1 || pictures.expected.length !== pictures.marks.length ||
      pictures.device.length !== pictures.marks.length) { return null; }
  pictures.samples = samples;
  pictures.columns = Math.ceil(Math.sqrt(samples));
  pictures.rows = Math.ceil(samples / pictures.columns);
  return pictures;
}

function fitZoom(p) {
  const least = p.samples > 1 ? 2 * p.columns : 1;
  const side = Math.max(120, Math.min(400, (window.innerWidth - 130) / 3));  // the three of a case beside each other
  return Math.max(least, Math.min(40, Math.floor(side / Math.max(p.width, p.height))));
}

function hitColor(hits) {
  return hits === 0 ? "#ffffff" : hits === 1 ? "#b9c3cd" : hits === 2 ? "#7b8894" : "#4a545e";
}

// A cell with the pattern of its mark; dark on its colour, so that it shows without colour too.
function drawMark(context, mark, x, y, w, h) {
  context.fillStyle = MARK_COLOR[mark];
  context.fillRect(x, y, w, h);
  if (Math.min(w, h) < 5) { return; }
  context.save();
  context.beginPath();
  context.rect(x, y, w, h);
  context.clip();
  context.strokeStyle = "rgba(0,0,0,.75)";
  context.fillStyle = "rgba(255,255,255,.9)";
  context.lineWidth = Math.max(1, Math.min(w, h) / 14);
  const step = Math.max(4, Math.min(w, h) / 3);
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
    for (let v = step / 2; v < h; v += step) {
      for (let u = step / 2; u < w; u += step) { context.fillRect(x + u - 1, y + v - 1, 2, 2); }
    }
  }
  context.restore();
}

function drawEither(context, x, y, w, h) {
  context.fillStyle = "#ffffff";
  context.fillRect(x, y, w, h);
  context.fillStyle = "#a8a8a8";
  const a = Math.ceil(w / 2), b = Math.ceil(h / 2);
  context.fillRect(x, y, a, b);
  context.fillRect(x + a, y + b, w - a, h - b);
}

// kind: "expected", "device" or "marks". `pin` is {x, y, sample} in the target, or null.
function drawPicture(canvas, p, kind, zoom, pin) {
  canvas.width = p.width * zoom;
  canvas.height = p.height * zoom;
  const context = canvas.getContext("2d", {alpha: false});
  context.fillStyle = "#ffffff";
  context.fillRect(0, 0, canvas.width, canvas.height);
  const numbers = Math.floor(zoom / Math.max(p.columns, p.rows)) >= 14;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (let j = 0; j < p.height; ++j) {
    for (let i = 0; i < p.width; ++i) {
      for (let s = 0; s < p.samples; ++s) {
        const k = (j * p.width + i) * p.samples + s;
        const u = s % p.columns, v = Math.floor(s / p.columns);
        const x = i * zoom + Math.floor(u * zoom / p.columns), y = j * zoom + Math.floor(v * zoom / p.rows);
        const w = i * zoom + Math.floor((u + 1) * zoom / p.columns) - x;
        const h = j * zoom + Math.floor((v + 1) * zoom / p.rows) - y;
        const hits = kind === "device" ? p.device[k] : p.expected[k];
        if (kind === "marks" && p.marks[k] > 1) {
          drawMark(context, p.marks[k], x, y, w, h);
          continue;
        }
        if (kind !== "device" && (hits === SEVERAL || (kind === "marks" && p.marks[k] === 1))) {
          drawEither(context, x, y, w, h);
          continue;
        }
        if (hits === 0) { continue; }
        context.fillStyle = kind === "marks" ? "#e3e7eb" : hitColor(hits);
        context.fillRect(x, y, w, h);
        if (numbers && kind !== "marks" && hits > 1) {
          context.fillStyle = "#ffffff";
          context.font = "bold " + Math.min(16, Math.floor(h * .6)) + "px sans-serif";
          context.fillText(String(hits), x + w / 2, y + h / 2);
        }
      }
    }
  }
  if (zoom >= 8) {
    context.fillStyle = "rgba(60,70,80,.28)";
    for (let i = 1; i < p.width; ++i) { context.fillRect(i * zoom, 0, 1, canvas.height); }
    for (let j = 1; j < p.height; ++j) { context.fillRect(0, j * zoom, canvas.width, 1); }
  }
  if (pin) {
    const x = (pin.x - p.left) * zoom, y = (pin.y - p.top) * zoom;
    context.strokeStyle = "#000000";
    context.lineWidth = 3;
    context.strokeRect(x - 1, y - 1, zoom + 2, zoom + 2);
    context.strokeStyle = "#ffffff";
    context.lineWidth = 1;
    context.strokeRect(x - 1, y - 1, zoom + 2, zoom + 2);
  }
}

function hitsText(hits, expected) {
  if (expected && hits === SEVERAL) { return "several numbers of hits allowed"; }
  return (hits >= (expected ? 254 : 255) ? hits + " or more" : String(hits)) + (hits === 1 ? " hit" : " hits");
}

// What the pictures know of a pixel, one line a sample.
function pixelLines(p, x, y) {
  const i = x - p.left, j = y - p.top;
  if (i < 0 || j < 0 || i >= p.width || j >= p.height) { return []; }
  const lines = [];
  for (let s = 0; s < p.samples; ++s) {
    const k = (j * p.width + i) * p.samples + s;
    lines.push("pixel (" + x + "," + y + ")" + (p.samples > 1 ? " sample " + s : "") + ": reference " +
      hitsText(p.expected[k], true) + ", device " + hitsText(p.device[k], false) + ", " + MARK_TEXT[p.marks[k]]);
  }
  return lines;
}
