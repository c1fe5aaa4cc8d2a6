// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// The pictures of a case: views, zoom, scrolling, pointing.

const VIEWS = [["reference", "Reference"], ["device", "Device"], ["difference", "Difference"], ["error", "Error"], ["blink", "Blink"], ["side", "Side by side"]];
const KIND_OF_VIEW = {reference: "expected", device: "device", difference: "difference", error: "error"};
const PANE_TITLE = {expected: "reference", device: "device", difference: "difference", error: "error in budgets"};
// With what it is painted by, where that is not the same in all pictures of a view: of colours the device's alone may be known.
const paneTitle = (kind, p, plane) => PANE_TITLE[kind] + (plane !== "hits" && (kind === "expected" || kind === "device") ? ", " + paintedBy(kind, p, plane) : "");
const MAX_ZOOM = 128;
// Kept from case to case.
const viewing = {view: "difference", zoom: 0, grid: true, outlines: true, samples: true, scissor: true, viewport: true, planes: true, boxes: true, show: ""};

const panesOf = (view) => view === "side" ? ["expected", "device", "difference"] : view === "blink" ? ["blink"] : [KIND_OF_VIEW[view]];

// The plane that shows what the leading finding of a case is about.
function planeOf(record) {
  const quantity = record.lead ? finding(record.lead).quantity : "";
  return /^(depth|frag_coord\.z)$/.test(quantity) ? "depth" : quantity === "stencil" ? "stencil" : /^(color|texel)/.test(quantity) ? "colour" : "";
}

// `onSample(at)` is called when another sample is pointed at; `onChange()` when the address should change.
function makeViewer(record, onSample, onChange) {
  const reference = record.pictures ? null : openReference(record), pictures = reference ? reference.pictures : openPictures(record.pictures);
  if (!pictures) { return null; }
  const geometry = openGeometry(reference ? reference.geometry : record.geometry);
  const scene = {pictures, geometry, ties: tiesIn(geometry, pictures)};
  scene.limits = limitsOf(scene);
  const viewer = {scene, cursor: null, pinned: null, blinkOn: false, timer: 0};
  const stage = el("div", {class: "stage"});
  const zoomText = el("output", {class: "zoom-text"});
  const legendList = el("ul", {class: "legend"});
  let panes = [];

  const views = VIEWS.filter(([name]) => pictures.isReference ? name === "reference" : name !== "error" || pictures.errors);
  // What is looked at, or the nearest that this case has.
  const shownView = () => views.some(([name]) => name === viewing.view) ? viewing.view : pictures.isReference ? "reference" : "difference";
  const planes = [["hits", "hits"], pictures.colors && ["colour", "colour"], pictures.depths && ["depth", "depth"], pictures.stencils && ["stencil", "stencil"]].filter(Boolean);
  const hasPlane = (name) => planes.some(([plane]) => plane === name);
  // What was chosen, else what the leading finding is about; a blit is seen by its colours.
  const leading = planeOf(record), firstPlane = hasPlane(leading) ? leading : pictures.expectedColors ? "colour" : "hits";
  const shownPlane = () => hasPlane(viewing.show) ? viewing.show : firstPlane;
  const zoomNow = () => viewing.zoom || fitZoom();
  function fitZoom() {
    const count = shownView() === "side" && stage.clientWidth > 700 ? 3 : 1;
    const width = (stage.clientWidth || 640) / count - 14, height = highest();
    const least = Math.min(pictures.width, pictures.height) <= 32 ? 8 : 1;  // long and narrow: better scrolled
    return Math.max(least, Math.min(MAX_ZOOM, Math.floor(Math.min(width / (pictures.width + 2), height / (pictures.height + 2)))));
  }

  // The whole picture fits in the window, once what stands above it is scrolled away.
  const highest = () => Math.max(262, window.innerHeight - 110);
  // As large as the picture, with room for a scrollbar across if there is one down, and the other way round.
  function fit(pane, width, height, widest) {
    const most = highest(), key = [width, height, widest, most].join();
    if (pane.fitted === key) { return; }
    pane.fitted = key;
    const {frame} = pane, borders = 2;
    pane.canvas.style.width = pane.canvas.style.height = "0";  // as it was painted last it may stick out
    const set = (name, size) => { frame.style[name] = size + "px"; };
    set("width", Math.min(width + borders, widest));
    set("height", Math.min(height + borders, most));
    const down = Math.max(0, frame.offsetWidth - frame.clientWidth - borders), across = Math.max(0, frame.offsetHeight - frame.clientHeight - borders);
    set("width", Math.min(width + borders + down, widest));
    set("height", Math.min(height + borders + across, most));
  }

  const kindOf = (pane) => pane.kind !== "blink" ? pane.kind : viewer.blinkOn ? "device" : "expected";
  function draw() {
    const zoom = zoomNow(), width = (pictures.width + 2) * zoom, height = (pictures.height + 2) * zoom;
    const share = Math.floor(stage.clientWidth / (shownView() === "side" && stage.clientWidth > 700 ? 3 : 1)) - 12;  // what fitZoom() leaves, and two borders
    for (const pane of panes) {
      pane.sizer.style.width = width + "px";
      pane.sizer.style.height = height + "px";
      fit(pane, width, height, Math.max(120, share));
      const shown = {width: Math.min(width, pane.frame.clientWidth), height: Math.min(height, pane.frame.clientHeight)};
      paint(pane.canvas, scene, {kind: kindOf(pane), zoom, left: pane.frame.scrollLeft, top: pane.frame.scrollTop, ...shown,
        cursor: viewer.cursor, options: {...viewing,
          colors: shownPlane() === "colour", plane: shownPlane()}, theme: theme()});
      pane.title.textContent = paneTitle(kindOf(pane), pictures, shownPlane());
    }
    zoomText.textContent = zoom + "\u00d7";
  }

  function makePane(kind) {
    const canvas = el("canvas", {role: "img", "aria-label": pictureText(record, scene, kind), "aria-describedby": "sample-summary"});
    const sizer = el("div", {class: "sizer"}, canvas);
    const frame = el("div", {class: "frame", tabIndex: 0, role: "group", "aria-label": "picture; arrow keys move from sample to sample"}, sizer);
    const title = el("figcaption");
    const at = (event) => {
      const box = frame.getBoundingClientRect();
      return sampleUnder(scene, zoomNow(), event.clientX - box.left - frame.clientLeft + frame.scrollLeft, event.clientY - box.top - frame.clientTop + frame.scrollTop);
    };
    canvas.addEventListener("mousemove", (event) => viewer.look(at(event)));
    canvas.addEventListener("mouseleave", () => { if (viewer.pinned) { viewer.look(viewer.pinned); } });
    canvas.addEventListener("click", (event) => viewer.pin(at(event)));
    canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey) { return; }
      event.preventDefault();
      viewer.zoomBy(event.deltaY < 0 ? 1 : -1);
    }, {passive: false});
    frame.addEventListener("scroll", () => {
      for (const other of panes) {
        if (other.frame !== frame) { other.frame.scrollLeft = frame.scrollLeft; other.frame.scrollTop = frame.scrollTop; }
      }
      draw();
    });
    return {kind, canvas, sizer, frame, title, figure: el("figure", {class: "pane"}, title, frame)};
  }

  const refreshLegend = () => legendList.replaceChildren(...legendEntries(scene, shownView(), shownPlane()), ...limitEntries(scene, draw));
  function rebuild() {
    clearInterval(viewer.timer);
    panes = panesOf(shownView()).map(makePane);
    stage.replaceChildren(...panes.map((pane) => pane.figure));
    refreshLegend();
    for (const button of bar.querySelectorAll("[data-view]")) { button.setAttribute("aria-pressed", String(button.dataset.view === shownView())); }
    viewer.blinkOn = false;
    if (shownView() === "blink" && !matchMedia("(prefers-reduced-motion: reduce)").matches) {
      viewer.timer = setInterval(() => {
        if (!stage.isConnected) { clearInterval(viewer.timer); return; }
        viewer.blinkOn = !viewer.blinkOn;
        draw();
      }, 1000);
    }
    draw();
  }

  const bar = el("div", {class: "toolbar", role: "toolbar", "aria-label": "picture"},
    el("div", {class: "segments", role: "group", "aria-label": "view"}, views.map(([name, title]) =>
      el("button", {type: "button", "data-view": name, title: "key " + (1 + VIEWS.findIndex((v) => v[0] === name)), onclick: () => viewer.setView(name)}, title))),
    el("div", {class: "segments", role: "group", "aria-label": "zoom"},
      el("button", {type: "button", "aria-label": "smaller", title: "key \u2212", onclick: () => viewer.zoomBy(-1)}, "\u2212"), zoomText,
      el("button", {type: "button", "aria-label": "larger", title: "key +", onclick: () => viewer.zoomBy(1)}, "+"),
      el("button", {type: "button", title: "key 0", onclick: () => viewer.setZoom(0)}, "Fit")),
    el("div", {class: "checks"}, (isBlitScene(scene) ? [["outlines", "Region"], ["grid", "Grid"]] : [["outlines", "Triangles"], ["samples", "Samples"], ["grid", "Grid"]]).map(([name, title]) =>
      el("label", {}, el("input", {type: "checkbox", checked: viewing[name], "data-option": name, onchange: (event) => { viewing[name] = event.target.checked; draw(); }}), title))),
    planes.length > 1 ? el("label", {}, "show ", el("select", {onchange: (event) => { viewing.show = event.target.value; refreshLegend(); draw(); }},
      planes.map(([value, title]) =>
        el("option", {value, selected: shownPlane() === value}, title)))) : null);

  viewer.element = el("section", {class: "viewer", "aria-label": "pictures"}, bar, stage, legendList);
  viewer.draw = draw;
  viewer.rebuild = rebuild;
  viewer.zoomNow = zoomNow;
  viewer.setView = (name) => {
    if (!views.some((v) => v[0] === name)) { return; }
    viewing.view = name;
    rebuild();
    onChange();
  };
  viewer.setZoom = (zoom) => {
    const before = zoomNow(), pane = panes[0], middle = (scroll, size) => (scroll + size / 2) / before;
    const x = middle(pane.frame.scrollLeft, pane.frame.clientWidth), y = middle(pane.frame.scrollTop, pane.frame.clientHeight);
    viewing.zoom = zoom === 0 ? 0 : Math.max(1, Math.min(MAX_ZOOM, zoom));
    draw();
    if (viewer.cursor) { viewer.reveal(); } else {
      pane.frame.scrollLeft = x * zoomNow() - pane.frame.clientWidth / 2;
      pane.frame.scrollTop = y * zoomNow() - pane.frame.clientHeight / 2;
    }
    onChange();
  };
  viewer.zoomBy = (direction) => {
    const steps = [1, 2, 3, 4, 6, 8, 10, 12, 16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96, 112, 128], now = zoomNow();
    viewer.setZoom(direction > 0 ? steps.find((z) => z > now) || MAX_ZOOM : [...steps].reverse().find((z) => z < now) || 1);
  };
  viewer.look = (at) => {
    const old = viewer.cursor;
    if (old && old.x === at.x && old.y === at.y && old.sample === at.sample) { return; }
    viewer.cursor = at;
    draw();
    onSample(at);
  };
  viewer.pin = (at) => { viewer.pinned = at; viewer.cursor = null; viewer.look(at); viewer.reveal(); onChange(); };
  viewer.reveal = () => {
    const zoom = zoomNow(), at = viewer.cursor;
    if (!at || !isInPicture(pictures, at)) { return; }
    const x = (at.x - pictures.left + 1.5) * zoom, y = (at.y - pictures.top + 1.5) * zoom;
    for (const {frame} of panes) {
      if (x < frame.scrollLeft + zoom || x > frame.scrollLeft + frame.clientWidth - zoom) { frame.scrollLeft = x - frame.clientWidth / 2; }
      if (y < frame.scrollTop + zoom || y > frame.scrollTop + frame.clientHeight - zoom) { frame.scrollTop = y - frame.clientHeight / 2; }
    }
    draw();
  };
  viewer.move = (dx, dy, ds) => {
    const at = viewer.cursor || {x: pictures.left, y: pictures.top, sample: 0};
    const clamp = (value, from, size) => Math.min(from + size - 1, Math.max(from, value));
    viewer.pin({x: clamp(at.x + dx, pictures.left, pictures.width), y: clamp(at.y + dy, pictures.top, pictures.height),
      sample: (at.sample + ds + pictures.samples) % pictures.samples});
  };
  return viewer;
}

// The text alternative of a picture.
function pictureText(record, scene, kind) {
  const p = scene.pictures, counts = MARKS.map(() => 0);
  for (const mark of p.marks) { ++counts[mark]; }
  const wrong = MARKS.slice(2).map((name, k) => counts[k + 2] ? counts[k + 2] + " " + name : "").filter(Boolean).join(", ");
  return (PANE_TITLE[kind] || "reference and device in turn") + ": " + p.width + " by " + p.height + " pixels" + (p.samples > 1 ? " of " + p.samples + " samples" : "") +
    ", " + (wrong || "no wrong sample") + (counts[1] ? ", " + counts[1] + " free" : "") + ". " + (p.isReference ? "What must be covered, as the rules say." : "The table of findings says the same.");
}

// What each picture of a view is painted by: hits, colours, depths, stencils or errors.
function paintedBy(kind, p, plane) {
  if (kind === "error" || kind === "difference") { return kind; }
  if (plane === "colour") { return (kind === "device" ? p.colors : p.expectedColors) ? "colour" : "hits"; }
  return codesOf(p, kind, plane) ? plane : "hits";
}

// Names for what the pictures of this view show of this case, and for nothing else.
function legendEntries(scene, view, plane) {
  const palette = PALETTES[theme()], p = scene.pictures;
  const kinds = panesOf(view).flatMap((kind) => kind === "blink" ? ["expected", "device"] : [kind]), list = [], hits = new Set(), marks = new Set();
  const isPainted = (by) => kinds.some((kind) => paintedBy(kind, p, plane) === by);
  let isOk = false, isFree = false;
  for (const kind of kinds) {
    const by = paintedBy(kind, p, plane);
    for (let k = 0; k < p.count; ++k) {
      const mark = p.marks[k], count = kind === "device" ? p.device[k] : p.expected[k];
      if (by === "difference" && mark > 1) { marks.add(mark); }
      else if (by === "error" && mark > 1 && !(p.errors && p.errors[k])) { marks.add(mark); }
      else if (by === "depth" || by === "stencil") { isFree = isFree || (kind === "expected" && count === SEVERAL); }
      else if (by === "hits" || by === "difference") {
        if (kind !== "device" && (count === SEVERAL || (by === "difference" && mark === 1))) { isFree = true; }
        else if (by === "difference") { isOk = isOk || count > 0; }
        else if (count > 0) { hits.add(Math.min(count, 3)); }
      }
    }
  }
  if (isPainted("error")) {
    const ramp = el("canvas", {width: 320, height: 28, class: "ramp", "aria-hidden": "true"}), context = ramp.getContext("2d");
    for (let x = 0; x < 320; ++x) { context.fillStyle = heatColor(Math.round(128 + 8 * HEAT_SPAN * (x / 160 - 1)), theme()); context.fillRect(x, 0, 1, 28); }
    list.push(el("li", {class: "scale"}, "\u2264 1/256", ramp, "\u2265 256 budgets; " + Math.round(MOST_BUDGETS) + " are accepted. Framed: not accepted"));
  }
  if (isPainted("stencil")) {
    list.push(legendItem("stencil " + p.stencilLow, legendBox(grey(1))));
    if (p.stencilHigh > p.stencilLow) { list.push(legendItem("stencil " + p.stencilHigh, legendBox(grey(255)))); }
  }
  if (isPainted("depth")) { list.push(legendItem("depth " + shortNumber(p.depthLow, 4), legendBox(grey(1))), legendItem("depth " + shortNumber(p.depthHigh, 4), legendBox(grey(255)))); }
  for (const count of [...hits].sort()) {
    list.push(legendItem(isBlitScene(scene) ? "written" : count === 1 ? "1 hit" : count === 2 ? "2 hits" : "3 hits or more", legendBox(palette.hits[count])));
  }
  if (isOk) { list.push(legendItem(isBlitScene(scene) ? "written as expected" : "covered as expected", legendBox(palette.ok))); }
  if (isFree) { list.push(legendItem("free", (c) => drawFree(c, palette, 0, 0, 18, 18))); }
  for (const mark of [...marks].sort()) { list.push(legendItem(MARKS[mark], (c) => drawMark(c, mark, 0, 0, 18, 18))); }
  return [...list, ...outlineItems(scene)];
}
