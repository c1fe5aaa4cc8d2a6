// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// What else than edges decides where a triangle shows: scissor and viewport rectangles, planes of the clip volume, and the boxes
// in which vertices may be snapped. Decided and told in whole numbers and fractions; rounded for drawing alone.

const LIMITS = [["scissor", "Scissor", "c"], ["viewport", "Viewport", "v"], ["planes", "Clip planes", "l"], ["boxes", "Snapping boxes", "x"]];
const LIMIT_COLOR = {light: {scissor: "#b0006d", viewport: "#6a3d9a", planes: "#00624f", boxes: "#0059b3"},
  dark: {scissor: "#ff8fd0", viewport: "#c9a9ff", planes: "#5ee0c8", boxes: "#7cc4f2"}};
const LIMIT_DASH = {scissor: [7, 3], viewport: [8, 3, 2, 3], planes: [3, 3], boxes: []};
const FIRST_OF_DEPTH = 4, FIRST_DISTANCE = 7;  // ref::ClipPlane::z_low, user_0
const PLANE_NAMES = ["x = \u2212w", "x = w", "y = \u2212w", "y = w", "z = 0", "z = w", "z = \u2212w"];
const planeName = (plane) => plane < FIRST_DISTANCE ? "plane " + PLANE_NAMES[plane] : "clip distance " + (plane - FIRST_DISTANCE);

// Fractions: {n, d} with d > 0.
function fractionOf(text) {
  const [n, d] = text.split("/");
  return {n: BigInt(n), d: BigInt(d || 1)};
}
const isLess = (a, b) => a.n * b.d < b.n * a.d;
const numberOfFraction = ({n, d}) => Number(n) / Number(d);
function quotientText(n, d) {
  let a = abs(n), b = d;
  while (b > 0n) { [a, b] = [b, a % b]; }
  const common = a || 1n;
  return (n < 0n ? "\u2212" : "") + abs(n) / common + (d / common === 1n ? "" : "/" + d / common);
}
const fractionPart = ({n, d}) => quotientText(n, d);
const rangeText = (x0, x1, y0, y1) => "x " + x0 + " to " + x1 + ", y " + y0 + " to " + y1;

const scissorText = ([x, y, w, h]) => rangeText(x, x + w, y, y + h);
function openViewport(texts) {
  const [x0, y0, x1, y1] = texts.map(fractionOf), ordered = (a, b) => isLess(b, a) ? [b, a] : [a, b];
  return {x: ordered(x0, x1), y: ordered(y0, y1)};
}
const viewportText = ({x, y}) => rangeText(fractionPart(x[0]), fractionPart(x[1]), fractionPart(y[0]), fractionPart(y[1]));
// Strictly: what lies on the border is for the top-left rule.
function isOutsideViewport(viewport, point) {
  const at = (value) => ({n: value, d: ONE});
  return ["x", "y"].some((axis) => isLess(at(point[axis]), viewport[axis][0]) || isLess(viewport[axis][1], at(point[axis])));
}

// Of a triangle's plane at a point: its distance over w, as n / d.
function distanceAt(cut, point) {
  const [a, b, c, d] = cut.abcd.map(BigInt);
  return {n: a * point.x + b * point.y + c * ONE, d: d * ONE};
}

// The limits that decide anything in the picture, with what is told of each. Rectangles that several draws share are one.
function limitsOf(scene) {
  const g = scene.geometry, found = {scissor: [], viewport: [], planes: [], boxes: []};
  if (!g || g.blit.length) { return found; }
  const height = scene.pictures.layerHeight || g.height, draws = new Set(g.triangles.map((t) => t.draw));
  const share = (list, key, draw, made) => {
    const known = list.find((l) => l.key === key);
    if (known) { known.draws.push(draw); } else { list.push({...made, key, draws: [draw]}); }
  };
  for (const draw of draws) {
    const s = g.scissors[draw], v = g.viewports[draw];
    if (s && (s[0] > 0 || s[1] > 0 || s[0] + s[2] < g.width || s[1] + s[3] < height)) {
      share(found.scissor, s.join(), draw, {text: scissorText(s), corners: [s[0], s[1], s[0] + s[2], s[1] + s[3]]});
    }
    const end = (size) => ({n: BigInt(size), d: 1n}), zero = end(0);
    if (v && (isLess(zero, v.x[0]) || isLess(zero, v.y[0]) || isLess(v.x[1], end(g.width)) || isLess(v.y[1], end(height)))) {
      share(found.viewport, viewportText(v), draw, {text: viewportText(v), corners: [v.x[0], v.y[0], v.x[1], v.y[1]].map(numberOfFraction)});
    }
  }
  // The planes of a viewport that holds the whole target cut off what the target does not hold.
  const shown = new Set(found.viewport.flatMap((l) => l.draws));
  for (const t of g.triangles) {
    t.cuts = t.cuts.filter((cut) => cut.plane >= FIRST_OF_DEPTH || shown.has(t.draw));
    for (const cut of t.cuts) { share(found.planes, String(cut.plane), t.draw, {text: planeName(cut.plane)}); }
    if (t.boxes.some(isWide)) { share(found.boxes, "box", t.draw, {text: "vertices that may be snapped to several positions"}); }
  }
  return found;
}
const isWide = ([x0, y0, x1, y1]) => x0 !== x1 || y0 !== y1;

const MOST_TOLD = 3;
// "x 0 to 2, y 0 to 8 (draw 1); 4 more"
function limitText(scene, list) {
  const several = scene.geometry.scissors.length > 1;
  const told = list.slice(0, MOST_TOLD).map((l) => l.text + (several && l.key !== "box" ? (l.draws.length > 1 ? "" : " (draw " + l.draws[0] + ")") : ""));
  return told.join("; ") + (list.length > MOST_TOLD ? "; " + (list.length - MOST_TOLD) + " more" : "");
}

function strokeLimit(view, kind, width) {
  const {context} = view;
  context.setLineDash([]);
  context.lineWidth = width + 2;
  context.strokeStyle = view.palette.halo;
  context.stroke();
  context.setLineDash(LIMIT_DASH[kind]);
  context.lineWidth = width;
  context.strokeStyle = LIMIT_COLOR[view.theme][kind];
  context.stroke();
  context.setLineDash([]);
}

// Where a plane cuts: the edges of what clipping leaves that lie on it. Corners are rounded, so as near as rounding is off.
function edgesOn(cut, piece) {
  const [a, b, c] = cut.abcd.map(Number), scale = Math.hypot(a, b), found = [];
  for (let k = 0; k < piece.length && scale > 0; k += 2) {
    const [x0, y0, x1, y1] = [piece[k], piece[k + 1], piece[(k + 2) % piece.length], piece[(k + 3) % piece.length]];
    const isOn = (x, y) => Math.abs(a * x + b * y + c) / scale < 1e-6 * (1 + Math.abs(x) + Math.abs(y));
    if (isOn(x0, y0) && isOn(x1, y1)) { found.push([x0, y0, x1, y1]); }
  }
  return found;
}

const LABEL_HEIGHT = 14;
const overlap = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

// Names beside the lines, over everything else but the marks of samples and other names: each at the first of its places that
// is free, or nowhere; the legend has its line, too.
function paintLabels(view) {
  const {context, p, zoom} = view, taken = [...view.told], right = (p.width + 2) * zoom, bottom = (p.height + 2) * zoom;
  context.font = "600 11px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.lineJoin = "round";
  context.lineWidth = 4;
  context.strokeStyle = view.palette.paper;
  for (const {kind, text, places} of zoom < 16 ? [] : view.labels) {
    const width = context.measureText(text).width;
    const boxes = places.map(([x, y]) => [x, y - LABEL_HEIGHT, x + width, y]);
    const box = boxes.find((b) => b[0] >= 0 && b[1] >= 0 && b[2] <= right && b[3] <= bottom && !taken.some((other) => overlap(b, other)));
    if (!box) { continue; }
    taken.push(box);
    context.strokeText(text, box[0], box[3]);
    context.fillStyle = LIMIT_COLOR[view.theme][kind];
    context.fillText(text, box[0], box[3]);
  }
}

// Along the sides of a rectangle, outside and then inside: beginning above it at the left, or below it if `isBelow`.
function placesAlong([x0, y0, x1, y1], isBelow, step) {
  const above = [y0 - 3, y1 + LABEL_HEIGHT], inside = [y0 + LABEL_HEIGHT, y1 - 3];
  const rows = isBelow ? [above[1], above[0], inside[1], inside[0]] : [...above, ...inside];
  const places = [];
  for (const y of rows) {
    for (let x = x0; x < Math.max(x1, x0 + 1); x += step) { places.push([x, y]); }
  }
  return places;
}

// Over the triangles of one layer.
function paintLimits(view, scene, triangles, options) {
  const {context, p, zoom} = view, draws = new Set(triangles.map((t) => t.draw)), right = (p.width + 2) * zoom, bottom = (p.height + 2) * zoom;
  const inside = (value, size) => Math.min(Math.max(value, 2), size - 2);  // of what lies beyond the picture, its near side
  for (const kind of ["scissor", "viewport"]) {
    for (const limit of options[kind] ? scene.limits[kind] : []) {
      if (!limit.draws.some((draw) => draws.has(draw))) { continue; }
      const [x0, y0] = toScreen(view, limit.corners[0], limit.corners[1]), [x1, y1] = toScreen(view, limit.corners[2], limit.corners[3]);
      context.beginPath();
      context.rect(x0, y0, x1 - x0, y1 - y0);
      strokeLimit(view, kind, 2);
      if (x1 < 0 || y1 < 0 || x0 > right || y0 > bottom) { continue; }  // the legend tells where it is
      const seen = [inside(x0, right - 60), Math.max(y0, LABEL_HEIGHT + 3), inside(x1, right), Math.min(y1, bottom - LABEL_HEIGHT)];
      view.labels.push({kind, text: kind, places: placesAlong(seen, kind === "viewport", zoom / 2)});
    }
  }
  for (const t of triangles) {
    for (const cut of options.planes ? t.cuts : []) {
      for (const [x0, y0, x1, y1] of edgesOn(cut, t.piece)) {
        const [ax, ay] = toScreen(view, x0, y0), [bx, by] = toScreen(view, x1, y1);
        context.beginPath();
        context.moveTo(ax, ay);
        context.lineTo(bx, by);
        strokeLimit(view, "planes", 2.5);
        const along = (share) => [ax + (bx - ax) * share + 4, ay + (by - ay) * share];
        view.labels.push({kind: "planes", text: planeName(cut.plane).replace("plane ", ""), places: [.5, .35, .65, .2, .8, .05, .95].map(along)});
      }
    }
    for (const box of options.boxes ? t.boxes.filter(isWide) : []) {
      const [x0, y0] = toScreen(view, box[0] / 65536, box[1] / 65536), [x1, y1] = toScreen(view, box[2] / 65536, box[3] / 65536);
      const w = Math.max(7, x1 - x0), h = Math.max(7, y1 - y0);  // smaller ones would not be seen
      context.beginPath();
      context.rect((x0 + x1 - w) / 2, (y0 + y1 - h) / 2, w, h);
      strokeLimit(view, "boxes", 1.5);
    }
  }
}

// What keeps a sample inside a triangle's edges from being covered: ", but the scissor rectangle, x 0 to 2, y 0 to 8, leaves this
// pixel out".
function limitsText(g, triangle, point, x, y) {
  const list = [], scissor = g.scissors[triangle.draw], viewport = g.viewports[triangle.draw];
  if (isOutsideScissor(g, triangle, x, y)) { list.push("the scissor rectangle, " + scissorText(scissor) + ", leaves this pixel out"); }
  if (viewport && isOutsideViewport(viewport, point)) { list.push("it lies outside the viewport, " + viewportText(viewport)); }
  for (const cut of triangle.cuts) {
    if (distanceAt(cut, point).n < 0n) { list.push((cut.plane < FIRST_DISTANCE ? "the " : "") + planeName(cut.plane) + " clips it away"); }
  }
  return list.length ? ", but " + list.join(", and ") : "";
}

// Where a vertex may be snapped, if it has a choice.
function boxText(box) {
  const coordinate = (a, b) => fractionText(BigInt(a), 16) + (a === b ? "" : " to " + fractionText(BigInt(b), 16));
  return box && isWide(box) ? "x " + coordinate(box[0], box[2]) + ", y " + coordinate(box[1], box[3]) : "";
}

// The numbers of a triangle's planes at a sample, and of its vertices' boxes.
function limitRows(triangle, point) {
  const planes = triangle.cuts.map((cut) => {
    const {n, d} = distanceAt(cut, point);
    return el("li", {}, planeName(cut.plane) + ": distance over w is ", el("span", {class: "number"}, folded(quotientText(n, d))), n < 0n ? ", clipped away" : n > 0n ? ", kept" : ", on it");
  });
  const boxes = triangle.boxes.map((box, k) => isWide(box) ? el("li", {}, "v" + triangle.numbers[k] + " may be snapped to ", el("span", {class: "number"}, boxText(box))) : null);
  return planes.length || boxes.some(Boolean) ? el("ul", {class: "plain limits"}, planes, boxes) : null;
}

// In the legend: what is drawn of each, with numbers, to be turned on and off.
function limitEntries(scene, onTurn) {
  return LIMITS.filter(([kind]) => scene.limits[kind].length > 0).map(([kind, title, key]) => {
    const canvas = el("canvas", {width: 36, height: 36, "aria-hidden": "true"}), context = canvas.getContext("2d");
    context.scale(2, 2);
    context.beginPath();
    if (kind === "boxes") { context.rect(5, 5, 8, 8); } else { context.moveTo(1, 9); context.lineTo(17, 9); }
    strokeLimit({context, palette: PALETTES[theme()], theme: theme()}, kind, 2);
    return el("li", {class: "limit"}, el("button", {type: "button", "data-option": kind, "aria-pressed": String(viewing[kind]), title: "key " + key, onclick: (event) => {
      viewing[kind] = !viewing[kind];
      event.currentTarget.setAttribute("aria-pressed", String(viewing[kind]));
      onTurn();
    }}, canvas, title), " ", el("span", {class: "number"}, limitText(scene, scene.limits[kind])));
  });
}
