// SPDX-License-Identifier: MIT
// The page of `throng motion`: the motion at any time, and what each computed distance proves free.
"use strict";
const given = JSON.parse(document.getElementById("given").textContent);
const $ = id => document.getElementById(id);
const segments = given.segments.length;
let time = 0, playing = 0;
const svg = (parent, kind, attributes) => {
  const node = document.createElementNS("http://www.w3.org/2000/svg", kind);
  for (const key in attributes) node.setAttribute(key, attributes[key]);
  return parent.appendChild(node);
};

// Where the links of a mover stand at a time, counted in segments: x, y, angle of each.
function place(mover, time) {
  const segment = Math.min(Math.floor(time), segments - 1), part = time - segment;
  const from = mover.waypoints[segment], to = mover.waypoints[segment + 1], frames = [];
  mover.links.forEach((link, i) => {
    const q = from[i] + part * (to[i] - from[i]);
    const [x, y, turn] = link.parent === null ? mover.base : frames[link.parent];
    const slide = link.joint === "prismatic" ? q : 0;
    const u = link.at[0] + slide * link.axis[0], v = link.at[1] + slide * link.axis[1], c = Math.cos(turn), s = Math.sin(turn);
    frames.push([x + c * u - s * v, y + s * u + c * v, turn + link.angle + (link.joint === "prismatic" ? 0 : q)]);
  });
  return frames;
}

function pose([x, y, turn]) {
  const c = Math.cos(turn), s = Math.sin(turn);
  return `matrix(${c} ${s} ${-s} ${c} ${x} ${y})`;
}

// All movers at a time, new or moved.
function draw(group, time, colour) {
  const paths = group.children;
  let k = 0;
  for (const mover of given.movers) {
    const frames = place(mover, time);
    mover.links.forEach((link, i) => {
      if (link.shape === null) return;
      const path = paths[k] ?? svg(group, "path", { d: given.shapes[link.shape], fill: colour ?? mover.colour, stroke: colour ?? mover.colour });
      path.setAttribute("transform", pose(frames[i]));
      ++k;
    });
  }
}

function way(mover) {
  const points = [];
  for (let i = 0; i <= 32 * segments; ++i) points.push(place(mover, i / 32).at(-1).slice(0, 2).join(" "));
  return "M" + points.join("L");
}

const contacts = given.segments.flatMap((segment, i) => segment.point ? [{ time: i + segment.to, ...segment }] : []);
function mark(one, size) {
  const [x, y] = one.point, [u, v] = one.normal, r = size / 160, arm = size / 25, tip = [x + arm * u, y + arm * v];
  const barb = side => `L${tip[0] - .35 * arm * u + side * .2 * arm * v} ${tip[1] - .35 * arm * v - side * .2 * arm * u}`;
  return `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0M${x} ${y}L${tip}${barb(1)}M${tip}${barb(-1)}`;
}

// What is seen of the plane: x, y of the upper left corner, y downwards, and the size, m.
const [x0, y0, x1, y1] = given.extent;
let view = { x: x0, y: -y1, w: x1 - x0, h: y1 - y0 };
function look(next) {
  view = next;
  $("stage").setAttribute("viewBox", `${view.x} ${view.y} ${view.w} ${view.h}`);
  contacts.forEach((one, i) => marks[i]?.setAttribute("d", mark(one, Math.max(view.w, view.h))));
}
const fit = () => look({ x: x0, y: -y1, w: x1 - x0, h: y1 - y0 });

// Around a place of the drawing, which stays where it is; from a millionth of the extent to ten times of it.
function zoom(factor, px = view.x + view.w / 2, py = view.y + view.h / 2) {
  const w = view.w / factor, all = Math.max(x1 - x0, y1 - y0);
  if (!(w > 1e-6 * all && w < 10 * all)) return;
  look({ x: px - (px - view.x) / factor, y: py - (py - view.y) / factor, w, h: view.h / factor });
}
const pan = (dx, dy) => look({ ...view, x: view.x + dx, y: view.y + dy });

// The place of the drawing under a pixel.
function under(x, y) {
  const { a, d, e, f } = $("stage").getScreenCTM();
  return [(x - e) / a, (y - f) / d];
}

function bindStage() {
  const stage = $("stage"), held = new Map();
  const middle = () => [0, 1].map(k => [...held.values()].reduce((sum, p) => sum + p[k], 0) / held.size);
  const spread = () => { const [a, b] = held.values(); return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0; };
  stage.onpointerdown = event => { stage.setPointerCapture(event.pointerId); held.set(event.pointerId, [event.clientX, event.clientY]); };
  stage.onpointermove = event => {
    if (!held.has(event.pointerId)) return;
    const before = under(...middle()), apart = spread();
    held.set(event.pointerId, [event.clientX, event.clientY]);
    const now = under(...middle());
    pan(before[0] - now[0], before[1] - now[1]);
    if (apart > 0 && spread() > 0) zoom(spread() / apart, ...under(...middle()));
  };
  stage.onpointerup = stage.onpointercancel = event => held.delete(event.pointerId);
  stage.addEventListener("wheel", event => { event.preventDefault(); zoom(wheel(event), ...under(event.clientX, event.clientY)); }, { passive: false });
}
const wheel = event => Math.exp(-Math.max(-300, Math.min(300, event.deltaY * (event.deltaMode === 1 ? 16 : 1))) / 400);

const marks = [];
function build() {
  document.title = given.name + " - throng motion";
  $("name").textContent = given.name;
  $("about").textContent = given.description;
  $("verdict").textContent = given.summary;
  $("verdict").className = given.verdict === "free" ? "" : "contact";
  $("world").setAttribute("transform", "scale(1 -1)");
  for (const d of given.obstacles) svg($("obstacles"), "path", { d });
  for (const time of given.ghosts) draw(svg($("ghosts"), "g", {}), time);
  for (const mover of given.movers) svg($("ways"), "path", { d: way(mover), stroke: mover.colour });
  draw($("start"), 0);
  if (contacts.length) draw(svg($("contacts"), "g", {}), contacts[0].time, "var(--contact)");
  for (const _ of contacts) marks.push(svg($("contacts"), "path", { class: "mark" }));
  fit();
  $("scrub").max = segments;
  $("near").hidden = segments === 1;
  given.segments.forEach((segment, i) => {
    if (!segment.pair) return;
    const jump = $("jumps").appendChild(document.createElement("button"));
    jump.type = "button";
    jump.textContent = `Segment ${i}: ${segment.verdict}, ${segment.pair.join(" – ")}`;
    jump.onclick = () => { stop(); show(timeOf(i)); };
  });
  const axis = $("lanes").appendChild(document.createElement("span")), line = $("lanes").appendChild(document.createElement("div"));
  axis.textContent = "segment";
  line.className = "axis";
  for (const lane of given.lanes) addLane(lane);
  drawLanes();
}
const timeOf = i => i + (given.segments[i].point ? given.segments[i].to : given.segments[i].from);

// The timeline: from which to which time, in segments, it shows.
let span = [0, segments];
const rows = [];
function addLane(lane) {
  const label = $("lanes").appendChild(document.createElement("span"));
  label.textContent = label.title = lane.label;
  const row = svg($("lanes"), "svg", { preserveAspectRatio: "none" });
  rows.push({ lane, row });
  const at = event => {
    const box = row.getBoundingClientRect();
    return span[0] + (span[1] - span[0]) * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
  };
  const seek = event => { stop(); show(at(event)); };
  row.onpointerdown = event => { row.setPointerCapture(event.pointerId); seek(event); };
  row.onpointermove = event => { if (row.hasPointerCapture(event.pointerId)) seek(event); };
  row.addEventListener("wheel", event => {
    event.preventDefault();
    const factor = wheel(event), middle = at(event);
    showSpan(span.map(end => middle + (end - middle) / factor));
  }, { passive: false });
}

// A hundredth of a segment at least, all of them at most.
function showSpan([from, to]) {
  const length = Math.min(segments, Math.max(0.01, to - from)), first = Math.min(Math.max(0, from), segments - length);
  span = [first, first + length];
  $("near").setAttribute("aria-pressed", String(length < segments));
  drawLanes();
}
// One segment where all are shown, else all.
const oneSegment = () => { const i = Math.min(Math.floor(time), segments - 1); showSpan(span[1] - span[0] < segments ? [0, segments] : [i, i + 1]); };

// Steps of 1, 2 or 5 times a power of ten: the least that is at least so large.
function roundAbove(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map(digit => digit * power).find(step => step >= least * (1 - 1e-9));
}

// Strips that touch as one, so that thousands of them cost no more than what can be seen.
function merged(strips, unit) {
  const all = strips.filter(([from, to, , proven]) => proven && to >= span[0] && from <= span[1]).map(([from, to]) => [from, to]).sort((a, b) => a[0] - b[0]), out = [];
  for (const [from, to] of all) {
    const last = out.at(-1);
    if (last && from <= last[1] + 0.25 * unit) last[1] = Math.max(last[1], to); else out.push([from, to]);
  }
  return out;
}

// Those that stand at least 3 pixels apart; where that leaves out more than a few they would say something else: none.
function thinned(times, unit) {
  const here = times.filter(at => at >= span[0] && at <= span[1]).sort((a, b) => a - b), out = [];
  for (const at of here) if (!out.length || at - out.at(-1) >= 3 * unit) out.push(at);
  return out.length >= 0.9 * here.length ? out : [];
}

function drawLanes() {
  const width = rows[0]?.row.clientWidth || 800, unit = (span[1] - span[0]) / width, borders = [];
  const every = Math.max(1, roundAbove(6 * unit));
  for (let i = Math.max(every, every * Math.ceil(span[0] / every)); i < Math.min(segments, span[1]); i += every) borders.push(i);
  for (const entry of rows) {
    const { lane, row } = entry;
    row.setAttribute("viewBox", `${span[0]} 0 ${span[1] - span[0]} 1`);
    row.replaceChildren();
    for (const [from, to] of merged(lane.strips, unit)) svg(row, "rect", { class: "proven", x: from, width: Math.max(to - from, unit), y: .08, height: .84 });
    for (const i of borders) svg(row, "line", { class: "border", x1: i, x2: i, y1: 0, y2: 1 });
    for (const at of thinned(lane.strips.map(strip => strip[2]), unit)) svg(row, "line", { class: "tick", x1: at, x2: at, y1: .25, y2: .75 });
    given.segments.forEach((segment, i) => {
      if (segment.pair && i + 1 >= span[0] && i <= span[1]) svg(row, "rect", { class: "doubt", x: i + segment.from - unit, width: Math.max(segment.to - segment.from, 2 * unit), y: 0, height: 1 });
    });
    entry.head = svg(row, "line", { class: "head", x1: time, x2: time, y1: 0, y2: 1 });
  }
  drawAxis(70 * unit);
}

function drawAxis(least) {
  const step = roundAbove(least), digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), line = $("lanes").querySelector(".axis");
  line.replaceChildren();
  for (let k = Math.ceil(span[0] / step - 1e-9); k * step < span[1]; ++k) {
    const label = line.appendChild(document.createElement("i"));
    label.textContent = (k * step).toFixed(digits);
    label.style.left = `${100 * (k * step - span[0]) / (span[1] - span[0])}%`;
  }
}

function show(at) {
  time = Math.min(segments, Math.max(0, at));
  const segment = Math.min(Math.floor(time), segments - 1), part = time - segment, length = span[1] - span[0];
  draw($("now"), time);
  $("scrub").value = time;
  if (length < segments && (time < span[0] || time > span[1])) showSpan(length === 1 ? [segment, segment + 1] : [time - length / 10, time + 0.9 * length]);
  for (const { head } of rows) for (const end of ["x1", "x2"]) head.setAttribute(end, time);
  const seconds = given.durations && given.durations.slice(0, segment).reduce((a, b) => a + b, 0) + part * given.durations[segment];
  $("clock").textContent = `segment ${segment}, ${part.toFixed(4)}` + (given.durations ? `, ${seconds.toFixed(3)} s` : "");
}

function stop() {
  playing = 0;
  $("play").textContent = "Play";
}

function play() {
  if (time >= segments) time = 0;
  const token = ++play.last;
  playing = token;
  $("play").textContent = "Pause";
  let before = performance.now();
  const step = now => {
    if (playing !== token) return;
    const length = given.durations ? given.durations[Math.min(Math.floor(time), segments - 1)] : 2;
    show(Math.min(segments, time + (now - before) / 1000 / length));
    before = now;
    if (time < segments) requestAnimationFrame(step); else stop();
  };
  requestAnimationFrame(step);
}
play.last = 0;

// To the next contact or doubt, from the last to the first.
function next() {
  const times = given.segments.flatMap((segment, i) => segment.pair ? [timeOf(i)] : []);
  if (times.length) go(times.find(at => at > time + 1e-9) ?? times[0]);
}
const go = at => { stop(); show(at); };
const toggle = () => playing ? stop() : play();

const keys = [
  { keys: [" "], shown: "space", says: "play, pause", does: toggle },
  { keys: ["ArrowLeft", "ArrowRight"], shown: "← →", says: "a hundredth of a segment back or on; with shift, a tenth", does: e => go(time + (e.key === "ArrowLeft" ? -1 : 1) * (e.shiftKey ? 0.1 : 0.01)) },
  { keys: ["PageUp", "PageDown"], shown: "page up, down", says: "to the segment before or after", does: e => go(e.key === "PageUp" ? Math.ceil(time - 1e-9) - 1 : Math.floor(time + 1e-9) + 1) },
  { keys: ["Home", "End"], shown: "home end", says: "to the beginning, to the end", does: e => go(e.key === "Home" ? 0 : segments) },
  { keys: ["n"], shown: "N", says: "to the next contact or doubt", does: next },
  { keys: ["+", "=", "-", "_"], shown: "+ −", says: "zoom", does: e => zoom("+=".includes(e.key) ? 1.25 : 0.8) },
  { keys: ["w", "a", "s", "d"], shown: "W A S D", says: "move the picture", does: e => pan(({ a: -1, d: 1 }[e.key.toLowerCase()] ?? 0) * view.w / 10, ({ w: -1, s: 1 }[e.key.toLowerCase()] ?? 0) * view.h / 10) },
  { keys: ["0"], shown: "0", says: "see all", does: fit },
  { keys: ["z"], shown: "Z", says: "the timeline shows one segment, or all", does: oneSegment },
  { keys: ["t"], shown: "T", says: "what is on the way", does: () => $("trace").click() },
  { keys: ["?"], shown: "?", says: "these keys", does: () => $("keys").showModal() },
];
function bindKeys() {
  for (const { shown, says } of keys) {
    $("key-list").appendChild(document.createElement("dt")).appendChild(document.createElement("kbd")).textContent = shown;
    $("key-list").appendChild(document.createElement("dd")).textContent = says;
  }
  addEventListener("keydown", event => {
    if (event.ctrlKey || event.altKey || event.metaKey || $("keys").open) return;
    if (event.target.matches("button, [type=checkbox]") && (event.key === " " || event.key === "Enter")) return;
    const key = keys.find(one => one.keys.includes(event.key.length === 1 ? event.key.toLowerCase() : event.key));
    if (!key) return;
    event.preventDefault();
    key.does(event);
  });
}

build();
bindStage();
bindKeys();
$("play").onclick = toggle;
$("fit").onclick = fit;
$("near").onclick = oneSegment;
$("help").onclick = () => $("keys").showModal();
$("scrub").oninput = () => go(Number($("scrub").value));
$("trace").onchange = () => { $("ghosts").style.display = $("trace").checked ? "" : "none"; };
addEventListener("resize", drawLanes);
show(contacts.length ? contacts[0].time : 0);
