// SPDX-License-Identifier: MIT
// Buttons, sliders and keys: what hands do to the replay, and what the page says of it.
import { count, length, short, toStep } from "../view/format.js";
import { roundBelow } from "../view/camera.js";
import { table } from "../view/palette.js";
import { niceTop } from "../reader/overview.js";
import { AGENT } from "../reader/scene.js";
import { speeds } from "../view/player.js";
import { byId, fillSelect, isDark } from "./dom.js";
import { carried, facts, showFacts, showSensed } from "./inspector.js";
import { bindKeys } from "./keys.js";
import { Labels } from "./labels.js";
import { showLegend } from "./legend.js";
import { bindPointer } from "./pointer.js";

/** @typedef {import("../replay.js").Replay} Replay */

/** How many, and which: those without places can't be shown. @param {import("../reader/recording.js").Description} d */
const frames = ({ frames, times }) => frames === times.length ? `${count(frames)} frames` : `${count(times.length)} of ${count(frames)} frames: those that hold positions`;

const PHONE = "(max-width: 760px)";
const RANGE = 1000;  // steps of the slider of the sensing radius: from 1 to 100 times that of a typical body

export class Controls {
  replay = /** @type {Replay | null} */ (null);
  charts = /** @type {import("./charts.js").Charts | null} */ (null);
  #labels = new Labels([], [], []);
  #last = 0;
  #told = 0;

  constructor() {
    this.#bindFooter();
    this.#bindPanel();
    this.#bindStage();
    bindKeys(this.#keys());
    requestAnimationFrame(at => this.#tick(at));
  }

  /** From now on this is what the controls move. @param {Replay} replay @param {import("./charts.js").Charts} charts */
  show(replay, charts) {
    this.replay = replay;
    this.charts = charts;
    const { description: d, player, colourings } = replay, { bodies, times } = d;
    document.title = `${d.name || "recording"} · throng`;
    byId("name").textContent = d.name || "recording";
    byId("about").textContent = [d.description, `${count(bodies.count)} ${bodies.count > 0 && bodies.kind.every(kind => kind === AGENT) ? "agents" : "bodies"}, ${frames(d)}`, d.complete ? "" : "the run did not end: these are its frames so far"].filter(Boolean).join(" · ");
    byId("about").title = byId("about").textContent;
    byId("scrub").max = times.length - 1;
    const { choices, start } = speeds(player.last - player.first);
    player.speed = start;
    fillSelect(byId("speed"), choices.map(c => ({ value: String(c), text: `${short(c)}×` })), String(start));
    fillSelect(byId("colouring"), colourings.map(({ key, name }) => ({ value: key, text: name })), colourings[0].key);
    const seconds = [0, 0.02, 0.1, 0.4].map(part => Number(roundBelow(Math.max(1e-12, part * (player.last - player.first))).toPrecision(1)));
    fillSelect(byId("trails"), seconds.map((s, i) => ({ value: i === 0 ? "0" : String(s), text: i === 0 ? "none" : `${short(s)} s` })), "0");
    byId("contacts").checked = false;
    byId("areas-row").hidden = d.areas.length + d.queues.length + d.measuredLines.length === 0;
    byId("show-areas").checked = true;
    this.#labels = new Labels(d.areas, d.queues, d.measuredLines);
    byId("pick").max = bodies.id[bodies.count - 1] ?? 1;
    player.loop = byId("loop").checked;
    this.#pick(-1);
    this.#radius(replay.sensing);
    this.#paint(replay);
    this.#resize();
    player.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  /** The colours of this theme. @param {Replay} replay */
  #paint({ stage, colouring }) {
    stage.setColours(table(isDark()));
    showLegend(colouring.name, colouring.legend);
  }

  /** @param {number} at  ms */
  #tick(at) {
    const { replay } = this, seconds = Math.min(0.1, (at - this.#last) / 1000);
    this.#last = at;
    if (replay && replay.tick(seconds)) {
      this.#labels.show(replay.camera, replay.overlay.showAreas);
      this.#tell(replay, at);
    }
    requestAnimationFrame(next => this.#tick(next));
  }

  /** Time, scale and body in words; what costs layout not more often than it can be read. @param {Replay} replay @param {number} at */
  #tell(replay, at) {
    const { player, description: { times, steps }, shown, camera } = replay, i = player.frame;
    byId("play").classList.toggle("playing", player.playing);
    byId("play").setAttribute("aria-label", player.playing ? "pause" : "play");
    byId("scrub").value = i;
    if (player.playing && at - this.#told < 90) return;
    this.#told = at;
    const mean = times.length > 1 ? (player.last - player.first) / (times.length - 1) : 1;
    byId("time").textContent = `${toStep(player.time, roundBelow(mean || 1) / 1.01)} s`;
    byId("frame").textContent = `step ${count(steps[i])}`;
    byId("scrub").setAttribute("aria-valuetext", `${short(player.time, 4)} s`);
    const metres = roundBelow(0.2 * Math.max(80, camera.width) / camera.scale), bar = byId("scalebar");
    bar.style.width = `${metres * camera.scale}px`;
    bar.firstElementChild.textContent = length(metres);
    this.charts?.show(player.time);
    const from = shown && replay.colouring.needs === "velocity" ? carried(replay.description, shown.frame, "velocity") : "";
    byId("no-velocity").hidden = !from;
    byId("no-velocity").textContent = from && `No velocity in this frame: speeds are those of ${from}.`;
    byId("no-contacts").hidden = !replay.lacksContacts;
    showFacts(replay.picked >= 0 && shown ? facts(replay.description, shown.frame, replay.picked, shown.a) : null);
    if (replay.picked >= 0) showSensed(replay.sensed(), replay.description.bodies.id, replay.sensing, replay.recorded);
  }

  /** @param {number} time */
  seek(time) {
    if (!this.replay) return;
    this.replay.player.playing = false;
    this.replay.player.seek(time);
    this.replay.dirty = true;
  }

  /** @param {(replay: Replay, event: any) => void} act @returns {(event?: any) => void} */
  #with(act) {
    return event => {
      if (!this.replay) return;
      act(this.replay, event);
      this.replay.dirty = true;
    };
  }

  #step = (/** @type {number} */ by) => this.#with(({ player }) => player.stand(player.frame + by));
  #play = this.#with(({ player }) => player.play(!player.playing));
  #follow = this.#with(replay => {
    replay.following = replay.picked >= 0 && !replay.following;
    if (replay.following) replay.camera.fitted = false;
    byId("follow").setAttribute("aria-pressed", String(replay.following));
  });
  #fit = this.#with(replay => { replay.fit(); byId("follow").setAttribute("aria-pressed", "false"); });

  #bindFooter() {
    byId("play").onclick = this.#play;
    byId("back").onclick = this.#step(-1);
    byId("on").onclick = this.#step(1);
    byId("fit").onclick = this.#fit;
    byId("scrub").oninput = this.#with(({ player }) => player.stand(Number(byId("scrub").value)));
    byId("speed").onchange = this.#with(({ player }) => { player.speed = Number(byId("speed").value); });
    byId("loop").onchange = this.#with(({ player }) => { player.loop = byId("loop").checked; });
  }

  #bindPanel() {
    const panel = byId("panel"), toggle = byId("panel-toggle");
    const set = (/** @type {boolean} */ shows) => { panel.hidden = !shows; toggle.setAttribute("aria-expanded", String(shows)); };
    set(!matchMedia(PHONE).matches);
    toggle.onclick = () => set(panel.hidden);
    byId("help").onclick = () => byId("keys").showModal();
    byId("colouring").onchange = this.#with(replay => {
      replay.colouring = replay.colourings.find(({ key }) => key === byId("colouring").value) ?? replay.colouring;
      replay.need();
      this.#paint(replay);
    });
    byId("trails").onchange = this.#with(({ trails }) => { trails.seconds = Number(byId("trails").value); });
    byId("contacts").onchange = this.#with(replay => { replay.showContacts = byId("contacts").checked; replay.need(); });
    byId("show-areas").onchange = this.#with(({ overlay }) => overlay.setAreas(byId("show-areas").checked));
    byId("pick").onchange = this.#with(({ description: { bodies } }) => this.#pick(bodies.id.indexOf(Number(byId("pick").value))));
    byId("follow").onclick = this.#follow;
    byId("radius").oninput = this.#with(replay => this.#radius(replay.radius * 100 ** (Number(byId("radius").value) / RANGE)));
  }

  #bindStage() {
    const canvas = byId("canvas");
    bindPointer(canvas, {
      pan: (dx, dy) => this.#with(({ camera, following }) => { if (!following) camera.pan(dx, dy); })(),
      zoom: (factor, x, y) => this.#zoom(factor, x, y),
      tap: (x, y) => this.#with(replay => this.#pick(replay.under(x, y)))(),
    });
    new ResizeObserver(() => this.#resize()).observe(byId("stage"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", this.#with(replay => {
      replay.overlay.restyle();
      this.#paint(replay);
      this.charts?.draw();
    }));
  }

  /** @param {number} factor @param {number} [x] @param {number} [y] */
  #zoom(factor, x, y) {
    this.#with(({ camera, following, radius }) => {
      const scale = camera.scale * factor;
      if (scale * radius > 1e6 || scale * radius < 1e-7) return;
      if (following) camera.zoom(factor); else camera.zoom(factor, x, y);
    })();
  }

  #resize() {
    const stage = byId("stage"), canvas = byId("canvas"), ratio = Math.min(3, devicePixelRatio || 1);
    canvas.width = Math.max(1, Math.round(stage.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(stage.clientHeight * ratio));
    this.replay?.resize(stage.clientWidth, stage.clientHeight);
  }

  /** @param {number} row  -1 for none */
  #pick(row) {
    const { replay } = this;
    if (!replay) return;
    replay.pick(row);
    byId("pick").value = row >= 0 ? String(replay.description.bodies.id[row]) : "";
    byId("follow").setAttribute("aria-pressed", String(replay.following));
    if (row < 0) showFacts(null);
  }

  /** The sensing radius. @param {number} metres */
  #radius(metres) {
    const { replay } = this;
    if (!replay) return;
    replay.sensing = niceTop(metres);
    byId("radius").value = String(Math.round(RANGE * Math.log(metres / replay.radius) / Math.log(100)));
  }

  /** @param {string} id @param {number} by */
  #choose(id, by) {
    const select = byId(id), to = select.selectedIndex + by;
    select.selectedIndex = id === "speed" ? Math.min(Math.max(to, 0), select.options.length - 1) : to % select.options.length;
    select.dispatchEvent(new Event("change"));
  }

  /** @returns {import("./keys.js").Key[]} */
  #keys() {
    const pan = (/** @type {number} */ dx, /** @type {number} */ dy) => this.#with(({ camera }) => camera.pan(dx * camera.width / 10, dy * camera.height / 10));
    const another = (/** @type {number} */ by) => this.#with(({ picked, description: { bodies } }) => this.#pick((Math.max(picked, by < 0 ? 0 : -1) + by + bodies.count) % bodies.count));
    const moves = new Map([["w", pan(0, 1)], ["a", pan(1, 0)], ["s", pan(0, -1)], ["d", pan(-1, 0)]]);
    return [
      { keys: [" "], shown: "space", says: "play, pause", does: this.#play },
      { keys: ["ArrowLeft", "ArrowRight"], shown: "← →", says: "a frame back or on; with shift, ten", does: e => this.#step((e.key === "ArrowLeft" ? -1 : 1) * (e.shiftKey ? 10 : 1))() },
      { keys: ["Home", "End"], shown: "home end", says: "to the beginning, to the end", does: e => this.#step(e.key === "Home" ? -Infinity : Infinity)() },
      { keys: ["[", "]"], shown: "[ ]", says: "slower, faster", does: e => this.#choose("speed", e.key === "[" ? -1 : 1) },
      { keys: ["+", "=", "-", "_"], shown: "+ −", says: "zoom", does: e => this.#zoom("+=".includes(e.key) ? 1.25 : 0.8) },
      { keys: [...moves.keys()], shown: "W A S D", says: "move the picture", does: e => moves.get(e.key.toLowerCase())?.() },
      { keys: ["0"], shown: "0", says: "see all", does: this.#fit },
      { keys: [".", ","], shown: ", .", says: "pick the body before or after", does: e => another(e.key === "," ? -1 : 1)() },
      { keys: ["f"], shown: "F", says: "follow the picked body", does: this.#follow },
      { keys: ["Escape"], shown: "esc", says: "pick no body", does: () => this.#with(() => this.#pick(-1))() },
      { keys: ["c"], shown: "C", says: "other colours", does: () => this.#choose("colouring", 1) },
      { keys: ["t"], shown: "T", says: "other trails", does: () => this.#choose("trails", 1) },
      { keys: ["k"], shown: "K", says: "contacts", does: () => byId("contacts").click() },
      { keys: ["g"], shown: "G", says: "areas", does: () => byId("show-areas").click() },
      { keys: ["p"], shown: "P", says: "panel", does: () => byId("panel-toggle").click() },
      { keys: ["o"], shown: "O", says: "open another recording", does: () => byId("open").click() },
      { keys: ["?"], shown: "?", says: "these keys", does: () => byId("keys").showModal() },
    ];
  }
}

