// SPDX-License-Identifier: MIT
// One recording being replayed: time, camera, what is shown of it, and the picture of that.
import { tellsContacts } from "./physics/contacts.js";
import { among, neighbours } from "./physics/neighbours.js";
import { AGENT } from "./reader/scene.js";
import { blend, bodyAt, faceForward, placeOf } from "./view/blend.js";
import { Camera } from "./view/camera.js";
import { colour, colourings } from "./view/colouring.js";
import { framing } from "./view/framing.js";
import { Frames } from "./view/frames.js";
import { mesh } from "./view/mesh.js";
import { Overlay } from "./overlay.js";
import { Player } from "./view/player.js";
import { Trails } from "./trails.js";

const MEMORY = 256e6;  // bytes of frames that are kept

/** @typedef {import("./reader/source.js").Loaded} Loaded */

export class Replay {
  picked = -1;
  following = false;
  showContacts = false;
  dirty = true;
  #told = /** @type {{row: number, frame: number, found: import("./reader/sensors.js").Found | null | undefined, rows: number[]}} */ ({ row: -1, frame: -1, found: null, rows: [] });
  #asking = false;
  shown = /** @type {{a: Loaded, b: Loaded, t: number, frame: number} | null} */ (null);
  stats = { frames: 0, prepare: 0, upload: 0, draw: 0 };  // ms, sums

  /**
   * @param {import("./reader/source.js").Source} source @param {import("./reader/source.js").Opened} opened
   * @param {import("./gl/stage.js").Stage} stage @param {(error: Error) => void} failed
   */
  constructor(source, { description, overview }, stage, failed) {
    const { bodies } = description, radii = bodies.radius.slice().sort();
    this.source = source;
    this.failed = failed;
    this.description = description;
    this.overview = overview;
    this.stage = stage;
    this.radius = radii.length ? radii[radii.length >> 1] : 1;  // m, of a typical body
    this.sensing = 8 * this.radius;
    this.camera = new Camera();
    this.extent = framing(description, overview);
    this.player = new Player(description.times);
    this.colourings = colourings(description, overview);
    this.colouring = this.colourings[0];
    this.walks = bodies.kind.includes(AGENT);
    this.places = new Float32Array(bodies.count);
    this.frames = new Frames((frame, fields, contacts) => source.frame(frame, fields, contacts), () => { this.dirty = true; }, failed, MEMORY);
    stage.open(mesh(description), bodies.count, this.radius);
    this.trails = new Trails(description, /** @type {import("./gl/trails.js").TrailPainter} */ (stage.trails));
    this.overlay = new Overlay(description, stage, this.radius);
    this.need();
  }

  /** Asks for the fields that what is shown takes. */
  need() {
    const velocity = this.colouring.needs === "velocity" || this.picked >= 0 || this.walks;
    this.frames.need(["position", "angle", ...(velocity ? /** @type {const} */ (["velocity"]) : []), ...(this.picked >= 0 ? /** @type {const} */ (["spin"]) : [])],
                     this.wantsContacts);
    this.dirty = true;
  }

  get wantsContacts() { return this.colouring.needs === "contacts" || this.showContacts; }

  /** Whether contacts are asked for that the frame which is shown doesn't tell. */
  get lacksContacts() { return this.wantsContacts && this.shown !== null && !tellsContacts(this.description, this.shown.frame); }

  /** @param {number} width @param {number} height */
  resize(width, height) {
    this.camera.width = width;
    this.camera.height = height;
    if (this.camera.fitted) this.fit();
    this.dirty = true;
  }

  fit() {
    this.following = false;
    this.camera.fit(this.extent);
    this.dirty = true;
  }

  /** The row, or -1 for none. @param {number} row */
  pick(row) {
    this.picked = row;
    if (row < 0) this.following = false;
    this.need();
  }

  /** The body under a pixel of the page, or -1. @param {number} px @param {number} py */
  under(px, py) {
    const [x, y] = this.camera.world(px, py), { stateTexels } = this.stage;
    if (!this.shown || !stateTexels) return -1;
    return bodyAt(stateTexels, this.description.bodies.radius, x - this.camera.x, y - this.camera.y, 8 / this.camera.scale);
  }

  /** What a recorded sensor of the picked body found: null where none of its own looked, undefined where that isn't known yet. */
  get recorded() {
    if (this.description.sensors === 0) return null;
    return this.#told.row === this.picked ? this.#told.found : undefined;
  }

  /** Asks what it found in the frame that is shown, one question at a time. @param {number} frame */
  #askSensed(frame) {
    const { picked: row } = this, told = this.#told;
    if (row < 0 || this.description.sensors === 0 || this.#asking || (told.row === row && told.frame === frame)) return;
    this.#asking = true;
    const { id } = this.description.bodies;
    this.source.sensed(frame, id[row]).then(found => {
      const ids = new Set(found?.ids ?? []);
      this.#asking = false;
      this.#told = { row, frame, found, rows: found ? [...id.keys()].filter(other => ids.has(id[other])) : [] };
      this.dirty = true;
    }, error => {
      this.#asking = false;
      this.#told = { row, frame, found: undefined, rows: [] };
      this.failed(error);
    });
  }

  /** m, of what tells whom the picked body senses. */
  get reach() { return this.recorded === undefined ? 0 : this.recorded?.radius ?? this.sensing; }

  /** Whom the picked body senses in the frame that is shown: by its recorded sensor, else all within the radius of the page. */
  sensed() {
    const position = this.shown?.a.values.position, { domain } = this.description;
    if (this.picked < 0 || !position || this.recorded === undefined) return [];
    if (!this.recorded) return neighbours(position, this.picked, this.sensing, domain);
    return among(position, this.picked, this.#told.rows, Infinity, domain);  // who was found may have moved since
  }

  /** Time goes on and the picture with it; true where it changed. @param {number} seconds  since the last tick */
  tick(seconds) {
    const { player, frames } = this, now = player.between();
    if (player.playing && frames.has(now.a)) { player.advance(seconds); this.dirty = true; }
    frames.want([...player.wanted(), ...this.trails.wanted(player.frame, frames)]);
    if (!this.dirty) return false;
    this.dirty = false;
    this.#take();
    if (this.shown) this.#draw(this.shown);
    return true;
  }

  /** The frames of this moment; until they are there, what was shown stays. */
  #take() {
    const { a, b, t } = this.player.between(), first = this.frames.get(a), second = this.frames.get(b);
    if (!first) return;
    this.shown = { a: first, b: second ?? first, t, frame: a };
  }

  /** @param {{a: Loaded, b: Loaded, t: number, frame: number}} shown */
  #draw({ a, b, t, frame }) {
    const { stage, camera, description } = this, { domain } = description, states = stage.stateTexels;
    if (!states) return;
    const start = performance.now();
    this.#askSensed(frame);
    colour(this.colouring, description, a, this.places);
    if (this.following) this.#centre(a, b, t);
    blend(a.values, b.values, t, camera, domain, this.places, states);
    if (this.walks) faceForward(states, description.bodies.kind, a.values);
    const prepared = performance.now();
    stage.loadStates();
    const uploaded = performance.now();
    const view = this.#view(), place = this.picked >= 0 ? placeOf(states, this.picked, camera) : [NaN], at = Number.isNaN(place[0]) ? null : place;
    this.overlay.prepare(view, { states, contacts: this.showContacts ? a.contacts : undefined, at, picked: this.picked,
                                 velocity: a.values.velocity, sensing: this.reach, sensed: this.sensed() });
    stage.clear(this.overlay.paper);
    stage.draw(view, { turns: Boolean(a.values.angle) || (this.walks && Boolean(a.values.velocity)), trail: this.trails.prepare(frame, this.frames, view), links: this.showContacts });
    const done = performance.now();
    this.stats.frames += 1;
    this.stats.prepare += prepared - start;
    this.stats.upload += uploaded - prepared;
    this.stats.draw += done - uploaded;
  }

  /** Moves the camera to the picked body. @param {Loaded} a @param {Loaded} b @param {number} t */
  #centre(a, b, t) {
    const one = new Float32Array(4), row = this.picked, { domain } = this.description;
    const only = (/** @type {Loaded} */ { values: { position } }) => ({ position: position?.subarray(2 * row, 2 * row + 2) });
    blend(only(a), only(b), t, this.camera, domain, this.places.subarray(row, row + 1), one);
    if (Number.isNaN(one[0])) return;  // it is not there
    this.camera.x += one[0];
    this.camera.y += one[1];
  }

  /** @returns {import("./gl/stage.js").View} */
  #view() {
    const { camera, stage: { canvas }, description: { domain } } = this, ratio = canvas.width / Math.max(1, camera.width), periodic = domain.kind === "periodic";
    return { x: camera.x, y: camera.y, scale: camera.scale * ratio, width: canvas.width, height: canvas.height, ratio,
             domain: { size: periodic ? [0, 1].map(i => domain.max[i] - domain.min[i]) : [0, 0],
                       middle: [(domain.min[0] + domain.max[0]) / 2 - camera.x, (domain.min[1] + domain.max[1]) / 2 - camera.y] } };
  }
}
