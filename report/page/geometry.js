// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// Where a case's triangles and samples lie.

// Sample locations in 2^-16 pixels; g.locations are in 1/16 pixel.
function openGeometry(g) {
  if (!g || !g.width) { return null; }
  const locations = g.locations.map(([x, y]) => ({x: BigInt(x) * ONE / 16n, y: BigInt(y) * ONE / 16n}));
  return {width: g.width, height: g.height, samples: g.samples, locations, scissors: g.scissors, viewports: (g.viewports || []).map(openViewport), blit: g.blit,
    total: g.triangle_total, triangles: g.triangles.map(openTriangle)};
}

function openTriangle(t) {
  const triangle = {draw: t.of[0], primitive: t.of[1], layer: t.of[2] || 0, numbers: t.v, isExact: (t.flags & 1) !== 0, isClipped: (t.flags & 2) !== 0,
    piece: (t.piece || []).map(Number), cuts: t.cuts || [], boxes: t.boxes || [], corners: [], edges: [], isBackward: false, hasArea: false};
  if (t.p.length !== 6) { return triangle; }
  const corner = (k) => ({number: t.v[k], x: BigInt(t.p[2 * k]), y: BigInt(t.p[2 * k + 1])});
  const given = [corner(0), corner(1), corner(2)];
  const area = edgeFunction(given[0], given[1], given[2]);
  triangle.corners = given;
  triangle.area = area;
  triangle.hasArea = area !== 0n;
  triangle.isBackward = area < 0n;
  const order = triangle.isBackward ? [given[0], given[2], given[1]] : given;  // now the inside is where all E > 0
  triangle.edges = order.map((a, k) => {
    const b = order[(k + 1) % 3];
    return {a, b, kind: edgeKind(a, b)};
  });
  return triangle;
}

// A blit's texels are written; the samples of triangles are covered.
const isBlitScene = (scene) => Boolean(scene.geometry) && scene.geometry.blit.length > 0;
const spoken = (scene, text) => isBlitScene(scene) ? text.replace("covered", "written") : text;

const triangleName = (t, g) => "triangle " + t.primitive + (g.scissors.length > 1 || t.draw > 0 ? " of draw " + t.draw : "");

// `y` is a row of its layer, as those of triangles.
function samplePosition(g, x, y, s) {
  const at = g.locations[s] || g.locations[0] || {x: ONE / 2n, y: ONE / 2n};
  return {x: BigInt(x) * ONE + at.x, y: BigInt(y) * ONE + at.y};
}

// A triangle seen from a point: each edge's E, and whether the point is inside, on the border or outside.
function seenFrom(triangle, point) {
  const edges = triangle.edges.map((edge) => ({...edge, value: edgeFunction(edge.a, edge.b, point)}));
  const smallest = edges.reduce((least, e) => e.value < least ? e.value : least, edges.length ? edges[0].value : 0n);
  const zero = edges.filter((e) => e.value === 0n);
  const place = !triangle.hasArea ? "flat" : smallest > 0n ? "inside" : smallest < 0n ? "outside" : "edge";
  return {triangle, edges, smallest, place, zero, owns: place === "edge" && zero.every((e) => ownsTies(e.kind))};
}

// What the top-left rule says of a point on the border; the reference's verdict stands in the pictures.
function placeText(seen) {
  if (seen.place === "inside") { return "inside: every E > 0"; }
  if (seen.place === "outside") { return "outside: some E < 0"; }
  if (seen.place === "flat") { return "no area after snapping"; }
  const kinds = seen.zero.map((e) => e.kind);
  const alike = kinds.length === 2 && kinds[0] === kinds[1];
  const edges = alike ? "two " + kinds[0] + " edges" : kinds.map((kind) => "a " + kind + " edge").join(" and ");
  return "exactly on " + (kinds.length > 1 ? "the corner of " : "") + edges +
    (seen.owns ? ": the top-left rule gives it to this triangle" : ": the top-left rule gives it to the neighbour");
}

// Whether a pixel lies outside the scissor of a triangle's draw; `y` is a row of its layer.
function isOutsideScissor(g, triangle, x, y) {
  const scissor = g.scissors[triangle.draw];
  if (!scissor) { return false; }
  const [left, top, width, height] = scissor;
  return x < left || y < top || x >= left + width || y >= top + height;
}

// Distance of a point from a triangle's nearest edge line, in pixels, for sorting alone.
function nearness(seen) {
  let least = Infinity;
  for (const e of seen.edges) {
    const length = Math.hypot(Number(e.b.x - e.a.x), Number(e.b.y - e.a.y)) || 1;
    least = Math.min(least, Number(e.value) / length / 65536);
  }
  return least;
}
// Triangles of a layer that hold the point, then those that miss it by less than two pixels.
function trianglesAt(g, point, layer) {
  const found = [];
  for (const triangle of g.triangles) {
    if (triangle.edges.length === 0 || triangle.layer !== layer) { continue; }
    const seen = seenFrom(triangle, point);
    seen.nearness = nearness(seen);
    const box = triangle.edges.map((e) => e.a);
    const near = (axis) => box.some((c) => c[axis] <= point[axis] + 2n * ONE) && box.some((c) => c[axis] >= point[axis] - 2n * ONE);
    if (seen.place !== "outside" || (seen.nearness > -2 && near("x") && near("y"))) { found.push(seen); }
  }
  const rank = {edge: 0, inside: 1, flat: 2, outside: 3};
  return found.sort((a, b) => rank[a.place] - rank[b.place] || b.nearness - a.nearness);
}

// Indices (as in the pictures) of samples that lie exactly on a triangle's border. Each row of samples is cut by each edge in
// at most one place, so that only that place has to be looked at.
function tiesIn(g, p) {
  const ties = new Set();
  if (!g) { return ties; }
  for (const triangle of g.triangles) {
    for (const {a, b} of triangle.edges) {
      for (let s = 0; s < p.samples; ++s) { addTies(g, p, triangle, a, b, s, ties); }
    }
  }
  return ties;
}

function addTies(g, p, triangle, a, b, s, ties) {
  const [top, bottom] = a.y < b.y ? [a.y, b.y] : [b.y, a.y];
  const at = g.locations[s];
  const rows = rowsOfLayer(p, triangle.layer);
  const first = Math.max(rows.first, Number((top - at.y) / ONE) - 1), last = Math.min(rows.last, Number((bottom - at.y) / ONE) + 1);
  for (let y = first; y <= last; ++y) {
    const row = BigInt(y) * ONE + at.y;
    if (row < top || row > bottom) { continue; }
    let columns = [];
    if (a.y === b.y) {
      const [left, right] = a.x < b.x ? [a.x, b.x] : [b.x, a.x];
      const from = Math.max(p.left, Math.floor(Number(left - at.x) / 65536)), to = Math.min(p.left + p.width - 1, Math.ceil(Number(right - at.x) / 65536));
      for (let x = from; x <= to; ++x) { columns.push(x); }
    } else {
      const cut = a.x + (row - a.y) * (b.x - a.x) / (b.y - a.y);  // rounded; exactness is asked below
      const x = Math.round(Number(cut - at.x) / 65536);
      columns = [x];
    }
    for (const x of columns) {
      if (x < p.left || x >= p.left + p.width) { continue; }
      const point = {x: BigInt(x) * ONE + at.x, y: row};
      if (edgeFunction(a, b, point) !== 0n) { continue; }
      if (triangle.edges.every((e) => edgeFunction(e.a, e.b, point) >= 0n)) {
        ties.add(((y + rows.above - p.top) * p.width + (x - p.left)) * p.samples + s);
      }
    }
  }
}
