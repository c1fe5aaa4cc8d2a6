// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// Painting one picture: cells, grid, triangles, samples, cursor. Everything in CSS pixels; `zoom` is a whole number of them a
// pixel, and one pixel of margin lies around the target, for what sticks out of it.

// What is painted: {pictures, geometry, ties, errors: at}. `shot`: {kind, zoom, left, top, width, height, cursor, options, theme};
// left and top say how far the picture is scrolled.
function paint(canvas, scene, shot) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(shot.width * ratio);
  canvas.height = Math.round(shot.height * ratio);
  canvas.style.width = shot.width + "px";
  canvas.style.height = shot.height + "px";
  const context = canvas.getContext("2d", {alpha: false});
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const palette = PALETTES[shot.theme], p = scene.pictures;
  context.fillStyle = palette.margin;
  context.fillRect(0, 0, shot.width, shot.height);
  context.translate(-shot.left, -shot.top);
  const zoom = shot.zoom, margin = zoom;
  const range = (from, length, size) => [Math.max(0, Math.floor((from - margin) / zoom)), Math.min(size - 1, Math.ceil((from + length - margin) / zoom))];
  const view = {context, palette, zoom, p, theme: shot.theme, margin, above: 0, lettered: new Set(), marked: new Set(), told: [], labels: [], columns: range(shot.left, shot.width, p.width), rows: range(shot.top, shot.height, p.height)};
  context.fillStyle = palette.paper;
  context.fillRect(margin, margin, p.width * zoom, p.height * zoom);
  paintCells(view, scene, shot);
  if (zoom >= 6 && shot.options.grid) { paintGrid(view); }
  paintRulers(view);
  paintLayers(view);
  if (scene.geometry) {
    if (shot.options.outlines) { paintRegions(view, scene.geometry); eachLayer(view, scene.geometry, paintTriangles); }
    eachLayer(view, scene.geometry, (layer, triangles) => paintLimits(layer, scene, triangles, shot.options));
    if (shot.options.samples && scene.geometry.blit.length === 0) { paintSamples(view, scene); }
    paintLabels(view);
  }
  if (shot.kind === "error") { paintErrorNumbers(view, scene); }
  if (shot.cursor && isInPicture(p, shot.cursor)) { paintCursor(view, scene, shot.cursor); }
}

// The side in pixels of the largest squares around samples that do not overlap, with those of the pixels around them.
function sampleSide(locations) {
  const at = locations.map((l) => [Number(l.x) / 65536, Number(l.y) / 65536]);
  let side = 1 / 2.6;
  at.forEach(([x, y], s) => at.forEach(([u, v], t) => {
    for (let i = -1; i <= 1; ++i) {
      for (let j = -1; j <= 1; ++j) {
        if (s !== t) { side = Math.min(side, Math.max(Math.abs(x - u - i), Math.abs(y - v - j))); }
      }
    }
  }));
  return side;
}

// Calls with each sample of the view that is seen: its index and its cell.
function eachCell(view, scene, visit) {
  const {p, zoom, margin} = view;
  const placed = isPlaced(view, scene);
  const side = placed ? Math.max(4, zoom * sampleSide(scene.geometry.locations)) : 0;
  for (let j = view.rows[0]; j <= view.rows[1]; ++j) {
    for (let i = view.columns[0]; i <= view.columns[1]; ++i) {
      for (let s = 0; s < p.samples; ++s) {
        const k = (j * p.width + i) * p.samples + s, left = margin + i * zoom, top = margin + j * zoom;
        if (placed) {
          const at = scene.geometry.locations[s];
          visit(k, left + Number(at.x) / 65536 * zoom - side / 2, top + Number(at.y) / 65536 * zoom - side / 2, side, side);
        } else {
          const u = s % p.columns, v = Math.floor(s / p.columns);
          const x = Math.floor(u * zoom / p.columns), y = Math.floor(v * zoom / p.rows);
          visit(k, left + x, top + y, Math.floor((u + 1) * zoom / p.columns) - x, Math.floor((v + 1) * zoom / p.rows) - y);
        }
      }
    }
  }
}
// Several samples a pixel stand where they are, as soon as there is room.
const isPlaced = (view, scene) => view.p.samples > 1 && Boolean(scene.geometry) && view.zoom >= 10 * view.p.columns;

function paintCells(view, scene, shot) {
  const {context, palette, p} = view, frame = isPlaced(view, scene);
  const fill = (color, x, y, w, h) => { context.fillStyle = color; context.fillRect(x, y, w, h); };
  const plane = shot.kind === "expected" && shot.options.colors ? p.expectedColors : shot.kind === "device" && shot.options.colors ? p.colors : null;
  eachCell(view, scene, (k, x, y, w, h) => {
    const mark = p.marks[k];
    if (mark > 1 && (shot.kind === "difference" || shot.kind === "error")) { view.told.push([x, y, x + w, y + h]); }
    if (plane) {
      fill("rgb(" + plane[k] + "," + plane[p.count + k] + "," + plane[2 * p.count + k] + ")", x, y, w, h);
    } else if (codesOf(p, shot.kind, shot.options.plane)) {
      const codes = codesOf(p, shot.kind, shot.options.plane);
      if (codes[k]) { fill(grey(codes[k]), x, y, w, h); }
      else if (shot.kind === "expected" && p.expected[k] === SEVERAL) { drawFree(context, palette, x, y, w, h); }
    } else if (shot.kind === "difference" && mark > 1) {
      if (drawMark(context, mark, x, y, w, h)) { view.lettered.add(k); }
      view.marked.add(k);
    } else if (shot.kind === "error") {
      paintError(view, k, x, y, w, h);
    } else {
      const hits = shot.kind === "device" ? p.device[k] : p.expected[k];
      if (shot.kind !== "device" && (hits === SEVERAL || (shot.kind === "difference" && mark === 1))) { drawFree(context, palette, x, y, w, h); }
      else if (hits > 0) {
        fill(shot.kind === "difference" ? palette.ok : palette.hits[Math.min(hits, 3)], x, y, w, h);
        if (hits > 1 && shot.kind !== "difference" && Math.min(w, h) >= 14) {
          drawLetter(context, String(hits), x + w / 2, y + h / 2, Math.min(16, h * .5));
          view.lettered.add(k);
          view.told.push([x, y, x + w, y + h]);
        }
      }
    }
    if (frame) {
      context.strokeStyle = palette.quiet;
      context.lineWidth = .75;
      context.strokeRect(x, y, w, h);
    }
  });
}

// The depths or stencils that a picture of this kind shows, if they are known.
function codesOf(p, kind, plane) {
  const [device, expected] = plane === "depth" ? [p.depths, p.expectedDepths] : plane === "stencil" ? [p.stencils, p.expectedStencils] : [null, null];
  return kind === "device" ? device : kind === "expected" ? expected : null;
}
const grey = (code) => { const v = Math.round(30 + 215 * (code - 1) / 254); return "rgb(" + v + "," + v + "," + v + ")"; };

function paintError(view, k, x, y, w, h) {
  const {context, p} = view;
  if (!p.errors || p.errors[k] === 0) {
    if (p.marks[k] > 1) {  // no number says how wrong it is
      if (drawMark(context, p.marks[k], x, y, w, h)) { view.lettered.add(k); }
      view.marked.add(k);
    }
    return;
  }
  context.fillStyle = heatColor(p.errors[k], view.theme);
  context.fillRect(x, y, w, h);
  if (p.marks[k] > 1 && Math.min(w, h) >= 5) {  // not accepted: a frame of two colours
    context.lineWidth = Math.max(1, w / 16);
    context.strokeStyle = "#ffffff";
    context.strokeRect(x + 1.5, y + 1.5, w - 3, h - 3);
    context.setLineDash([3, 3]);
    context.strokeStyle = "#000000";
    context.strokeRect(x + 1.5, y + 1.5, w - 3, h - 3);
    context.setLineDash([]);
  }
}

// Over triangles and below sample positions, so that nothing hides them.
function paintErrorNumbers(view, scene) {
  const {context, p} = view;
  if (!p.errors) { return; }
  eachCell(view, scene, (k, x, y, w, h) => {
    if (p.errors[k] !== 0 && Math.min(w, h) >= 34) { drawLetter(context, errorNumber(p.errors[k]), x + w / 2, y + h - 9, 11); }
  });
}
function errorNumber(code) {
  const error = errorOf(code);
  return error === Infinity ? "\u221e" : error >= 1e4 || (error > 0 && error < 1e-3) ? error.toExponential(1).replace("e+", "e") : shortNumber(error, 2).replace(/e\+?/, "e");
}

function paintGrid(view) {
  const {context, zoom, margin, p} = view;
  context.fillStyle = view.palette.grid;
  const x0 = margin + view.columns[0] * zoom, y0 = margin + view.rows[0] * zoom;
  const w = (view.columns[1] - view.columns[0] + 1) * zoom, h = (view.rows[1] - view.rows[0] + 1) * zoom;
  for (let i = view.columns[0]; i <= Math.min(p.width, view.columns[1] + 1); ++i) { context.fillRect(margin + i * zoom, y0, 1, h); }
  for (let j = view.rows[0]; j <= Math.min(p.height, view.rows[1] + 1); ++j) { context.fillRect(x0, margin + j * zoom, w, 1); }
}

// Pixel numbers, in the margin.
function paintRulers(view) {
  const {context, zoom, margin, p} = view;
  if (zoom < 12) { return; }
  const step = zoom >= 20 ? 1 : zoom >= 15 ? 2 : 4, widest = String(Math.max(p.left + p.width, p.top + p.height)).length;
  context.fillStyle = view.palette.quiet;
  context.font = Math.min(11, zoom * .8 / Math.max(1, widest * .55)) + "px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (let i = view.columns[0]; i <= view.columns[1]; ++i) {
    if ((p.left + i) % step === 0) { context.fillText(String(p.left + i), margin + (i + .5) * zoom, margin - Math.min(9, zoom / 2)); }
  }
  for (let j = view.rows[0]; j <= view.rows[1]; ++j) {
    const row = rowInLayer(p, p.top + j);
    if (row % step === 0) { context.fillText(String(row), margin - Math.min(10, zoom / 2), margin + (j + .5) * zoom); }
  }
}

// Where one of several layers ends and the next begins: a line through both margins, and their numbers beside it.
function paintLayers(view) {
  const {context, zoom, margin, p, palette} = view;
  if (!p.layerHeight) { return; }
  for (let layer = layerOf(p, p.top); layer <= layerOf(p, p.top + p.height - 1); ++layer) {
    const y = margin + (Math.max(p.top, layer * p.layerHeight) - p.top) * zoom;
    context.fillStyle = palette.layer;
    if (layer * p.layerHeight > p.top) { context.fillRect(0, y - 1, (p.width + 2) * zoom, 3); }
    if (zoom < 5) { continue; }
    context.save();
    context.translate(margin + p.width * zoom + zoom / 2, y + 4);
    context.rotate(Math.PI / 2);
    context.font = "600 " + Math.min(12, Math.max(8, zoom * .8)) + "px system-ui, sans-serif";
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.fillText("layer " + layer, 0, 0);
    context.restore();
  }
}

// Calls `draw` with each layer that has triangles, and a view that is cut to its rows, a pixel more at the ends of the picture.
function eachLayer(view, geometry, draw) {
  const {context, p, zoom, margin} = view;
  if (!p.layerHeight) { draw(view, geometry.triangles); return; }
  for (const layer of new Set(geometry.triangles.map((t) => t.layer))) {
    const rows = rowsOfLayer(p, layer), isLast = rows.above + rows.last === p.top + p.height - 1;
    if (rows.last < rows.first) { continue; }
    const from = margin + (rows.above + rows.first - p.top) * zoom - (rows.above + rows.first === p.top ? margin : 0);
    const to = margin + (rows.above + rows.last + 1 - p.top) * zoom + (isLast ? margin : 0);
    context.save();
    context.beginPath();
    context.rect(0, from, (p.width + 2) * zoom, to - from);
    context.clip();
    draw({...view, above: rows.above}, geometry.triangles.filter((t) => t.layer === layer));
    context.restore();
  }
}

const toScreen = (view, x, y) => [view.margin + (x - view.p.left) * view.zoom, view.margin + (y + view.above - view.p.top) * view.zoom];
// A fixed-point coordinate is exact in binary64 up to 2^37 pixels.
const pointOnScreen = (view, point) => toScreen(view, Number(point.x) / 65536, Number(point.y) / 65536);

function strokeTwice(view, width, palette = view.palette) {
  const {context} = view;
  context.lineWidth = width + 2;
  context.strokeStyle = palette.halo;
  context.stroke();
  context.lineWidth = width;
  context.strokeStyle = palette.line;
  context.stroke();
}

// Whether clipping leaves something of a triangle that is drawn beside its edges.
const isDashed = (triangle) => triangle.piece.length >= 4;

// Edges as thin lines where they are; along top and left edges, which own their samples, a thick one on the owner's side. What
// clipping leaves is dashed.
function paintTriangles(view, triangles) {
  const {context} = view;
  context.lineCap = "round";
  context.lineJoin = "round";
  const thin = view.zoom >= 6 ? 1 : .75, thick = view.zoom >= 24 ? 4 : view.zoom >= 12 ? 3 : view.zoom >= 6 ? 2.2 : 1.4;
  const stroke = (edges, width, inwards) => {
    context.beginPath();
    for (const {a, b} of edges) {
      const [ax, ay] = pointOnScreen(view, a), [bx, by] = pointOnScreen(view, b);
      const length = Math.hypot(bx - ax, by - ay) || 1, x = -(by - ay) / length * inwards, y = (bx - ax) / length * inwards;  // where E grows
      context.moveTo(ax + x, ay + y);
      context.lineTo(bx + x, by + y);
    }
    strokeTwice(view, width);
  };
  const edges = triangles.flatMap((t) => t.edges.map((e) => ({...e, hasArea: t.hasArea})));
  stroke(edges, thin, 0);
  stroke(edges.filter((e) => e.hasArea && ownsTies(e.kind)), thick, thick / 2);
  context.setLineDash([6, 4]);
  for (const {piece} of triangles.filter(isDashed)) {
    context.beginPath();
    for (let k = 0; k + 1 < piece.length; k += 2) {
      const [x, y] = toScreen(view, piece[k], piece[k + 1]);
      if (k === 0) { context.moveTo(x, y); } else { context.lineTo(x, y); }
    }
    context.closePath();
    strokeTwice(view, 1.5);
  }
  context.setLineDash([]);
}

// The destination of a blit.
function paintRegions(view, geometry) {
  const box = geometry.blit[1];
  if (!box) { return; }
  const [x0, y0] = toScreen(view, box[0], box[1]), [x1, y1] = toScreen(view, box[2], box[3]);
  view.context.beginPath();
  view.context.rect(Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0), Math.abs(y1 - y0));
  strokeTwice(view, 2.5);
}

// Sample positions as points, but where a letter stands; those exactly on an edge ringed.
function paintSamples(view, scene) {
  const {context, p, zoom, margin} = view;
  if (zoom < 8 && scene.ties.size === 0) { return; }
  const paletteOf = (k) => view.marked.has(k) ? PALETTES.light : view.palette;  // marks have the same colours in both themes: light ones
  const radius = Math.max(1, Math.min(3, zoom / 16)), ring = Math.max(3, Math.min(9, zoom * (p.samples > 1 ? .16 : .2)));
  for (let j = view.rows[0]; j <= view.rows[1]; ++j) {
    for (let i = view.columns[0]; i <= view.columns[1]; ++i) {
      for (let s = 0; s < p.samples; ++s) {
        const at = scene.geometry.locations[s];
        if (!at) { continue; }
        const x = margin + (i + Number(at.x) / 65536) * zoom, y = margin + (j + Number(at.y) / 65536) * zoom;
        const k = (j * p.width + i) * p.samples + s, palette = paletteOf(k);
        if (zoom >= 8 && (p.samples === 1 || isPlaced(view, scene)) && !view.lettered.has(k)) {
          context.beginPath();
          context.arc(x, y, radius, 0, 2 * Math.PI);
          context.fillStyle = palette.line;
          context.lineWidth = 1.5;
          context.strokeStyle = palette.halo;  // it stands on any colour
          context.stroke();
          context.fill();
        }
        if (zoom >= 5 && scene.ties.has(k)) {
          context.beginPath();
          context.arc(x, y, ring, 0, 2 * Math.PI);
          strokeTwice(view, zoom >= 16 ? 2 : 1.2, palette);
        }
      }
    }
  }
}

function paintCursor(view, scene, at) {
  const {context, p, zoom, margin, palette} = view;
  const frame = (x, y, w, h, width) => {
    context.lineWidth = width + 2;
    context.strokeStyle = palette.halo;
    context.strokeRect(x, y, w, h);
    context.lineWidth = width;
    context.strokeStyle = palette.cursor;
    context.strokeRect(x, y, w, h);
  };
  frame(margin + (at.x - p.left) * zoom - 1, margin + (at.y - p.top) * zoom - 1, zoom + 2, zoom + 2, p.samples > 1 ? 1.5 : 3);
  if (p.samples > 1) {
    const one = {...view, columns: [at.x - p.left, at.x - p.left], rows: [at.y - p.top, at.y - p.top]}, wanted = indexOf(p, at);
    eachCell(one, scene, (k, x, y, w, h) => { if (k === wanted) { frame(x - 1, y - 1, w + 2, h + 2, 3); } });
  }
}

// The sample under a point of the picture (CSS pixels from its corner, scrolled), or the nearest one.
function sampleUnder(scene, zoom, x, y) {
  const p = scene.pictures, px = (x - zoom) / zoom, py = (y - zoom) / zoom;
  const clamp = (value, size) => Math.min(size - 1, Math.max(0, Math.floor(value)));
  const i = clamp(px, p.width), j = clamp(py, p.height);
  let sample = 0;
  if (p.samples > 1 && isPlaced({p, zoom}, scene)) {
    let least = Infinity;
    scene.geometry.locations.forEach((at, s) => {
      const distance = Math.hypot(px - i - Number(at.x) / 65536, py - j - Number(at.y) / 65536);
      if (distance < least) { least = distance; sample = s; }
    });
  } else if (p.samples > 1) {
    sample = Math.min(p.samples - 1, clamp((py - j) * p.rows, p.rows) * p.columns + clamp((px - i) * p.columns, p.columns));
  }
  return {x: p.left + i, y: p.top + j, sample};
}

// An entry of a legend: `draw` paints a sample of 18 by 18.
function legendItem(text, draw) {
  const canvas = el("canvas", {width: 36, height: 36, "aria-hidden": "true"}), context = canvas.getContext("2d");
  context.scale(2, 2);
  draw(context);
  return el("li", {}, canvas, text);
}
const legendBox = (color) => (context) => { context.fillStyle = color; context.fillRect(0, 0, 18, 18); };

// What lies over the pixels: edges, what clipping leaves of them, samples on them.
function outlineItems(scene) {
  if (!scene.geometry || scene.geometry.triangles.length === 0) { return []; }
  const {line} = PALETTES[theme()];
  const list = [legendItem("top or left edge", (c) => { c.fillStyle = line; c.fillRect(0, 7, 18, 4); }), legendItem("other edge", (c) => { c.fillStyle = line; c.fillRect(0, 8.5, 18, 1); })];
  if (scene.geometry.triangles.some(isDashed)) {
    list.push(legendItem("what clipping leaves", (c) => { c.strokeStyle = line; c.lineWidth = 1.5; c.setLineDash([6, 4]); c.beginPath(); c.moveTo(1, 9); c.lineTo(17, 9); c.stroke(); }));
  }
  if (scene.ties.size) {
    list.push(legendItem("sample exactly on an edge", (c) => { c.strokeStyle = line; c.fillStyle = line; c.lineWidth = 2; c.beginPath(); c.arc(9, 9, 6, 0, 7); c.stroke(); c.beginPath(); c.arc(9, 9, 1.6, 0, 7); c.fill(); }));
  }
  return list;
}
