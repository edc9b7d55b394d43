// SPDX-License-Identifier: MIT
// What of a recording never changes: names, domain, shapes, bodies, walls, areas, queues. The file's form is sim/recording/layout.h.
import { attribute, BadFile, damaged, numbers, texts } from "./h5.js";
import { areasOf, gravityOf, groupsOf, sections } from "./scenario.js";

/**
 * @typedef {import("./h5.js").OpenFile} File
 * @typedef {{points: Float64Array, radius: number}} Part  a convex part, grown by its radius (m)
 * @typedef {{name: string, kind: number, radius: number, gyration2: number, outline: Float64Array, holes: Float64Array[],
 *   parts: Part[]}} Shape
 *   kind: 0 disc, 1 polygon, 2 composite; points are x, y, x, y about the centre of mass
 * @typedef {{count: number, changes: boolean, id: Float64Array, shape: Float64Array, material: Float64Array, kind: Float64Array,
 *   radius: Float64Array, mass: Float64Array}} Bodies  kind: 0 dynamic, 1 static, 2 kinematic,
 *   3 agent; changes: each frame holds some of them, agents until they leave
 * @typedef {{points: Float64Array, closed: boolean}} Wall
 * @typedef {{name: string, line: Float64Array}} Queue  x, y, x, y (m), from its head
 * @typedef {{name: string, line: number[]}} MeasuredLine  x, y, x, y (m); forward is from its left to its right
 * @typedef {{kind: "unbounded" | "box" | "periodic", min: number[], max: number[]}} Domain
 * @typedef {{name: string, description: string, version: string, domain: Domain, gravity: number[] | null, shapes: Shape[],
 *   materials: string[], bodies: Bodies, walls: Wall[], walkable: Float64Array[], areas: import("./scenario.js").Area[], queues: Queue[],
 *   measuredLines: MeasuredLine[], groups: import("./scenario.js").Group[]}} Scene
 */

/** @param {any} value @returns {string} */
const text = value => typeof value === "string" ? value : "";

/** Throws unless it is 0 = o[0] <= o[1] <= ... = total. @param {Float64Array} offset @param {number} total @param {string} path */
function expectOffsets(offset, total, path) {
  let sound = offset[0] === 0 && offset[offset.length - 1] === total;
  for (let i = 1; i < offset.length; ++i) sound = sound && offset[i] >= offset[i - 1];
  if (!sound) throw damaged(`${path} does not fit its points`);
}

/** @param {Float64Array} values @param {string} path @param {number} low @param {number} high  not included */
function expectRange(values, path, low, high) {
  for (const value of values) if (!(value >= low && value < high)) throw damaged(`${path} holds ${value}`);
  return values;
}

/** Lists of points end to end. @param {File} file @param {string} offsets @param {string} points */
function ragged(file, offsets, points) {
  const offset = numbers(file, offsets, "int", [-1]), all = numbers(file, points, "float", [-1, 2]);
  expectOffsets(offset, all.length / 2, offsets);
  expectRange(all, points, -1e300, 1e300);
  return Array.from({ length: offset.length - 1 }, (_, i) => all.slice(2 * offset[i], 2 * offset[i + 1]));
}

/** @param {File} file @returns {Domain} */
function readDomain(file) {
  const group = file.get("throng/domain"), kind = attribute(group, "kind");
  const min = Array.from(attribute(group, "min") ?? [], Number), max = Array.from(attribute(group, "max") ?? [], Number);
  if (kind === "unbounded") return { kind, min: [0, 0], max: [0, 0] };
  const sound = (kind === "box" || kind === "periodic") && min.length === 2 && max.length === 2 && [0, 1].every(i => max[i] > min[i] && Number.isFinite(max[i] - min[i]));
  if (!sound) throw damaged("throng/domain");
  return { kind, min, max };
}

/** Of each shape; files of version 1.0 have none. @param {File} file @param {string} at @param {number} n @returns {Float64Array[][]} */
function readHoles(file, at, n) {
  if (!file.get(at + "hole_offset")) return Array.from({ length: n }, () => []);
  const offset = numbers(file, at + "hole_offset", "int", [n + 1]), rings = ragged(file, at + "ring_offset", at + "rings");
  expectOffsets(offset, rings.length, at + "hole_offset");
  return Array.from({ length: n }, (_, i) => rings.slice(offset[i], offset[i + 1]));
}

/** @param {File} file @returns {Shape[]} */
function readShapes(file) {
  const at = "throng/shapes/", names = texts(file, at + "name", [-1]), n = names.length;
  const kind = expectRange(numbers(file, at + "kind", "int", [n]), at + "kind", 0, 3);
  const radius = expectRange(numbers(file, at + "radius", "float", [n]), at + "radius", 0, Infinity);
  const gyration2 = expectRange(numbers(file, at + "gyration2", "float", [n]), at + "gyration2", 0, Infinity);
  const outlines = ragged(file, at + "outline_offset", at + "outline");
  const holes = readHoles(file, at, n);
  const partOffset = numbers(file, at + "part_offset", "int", [n + 1]);
  const partRadius = expectRange(numbers(file, at + "part_radius", "float", [-1]), at + "part_radius", 0, Infinity);
  const vertices = ragged(file, at + "vertex_offset", at + "vertices");
  expectOffsets(partOffset, partRadius.length, at + "part_offset");
  if (outlines.length !== n || vertices.length !== partRadius.length) throw damaged(at + "outline");
  const parts = vertices.map((points, i) => ({ points, radius: partRadius[i] }));
  return names.map((name, i) => ({ name, kind: kind[i], radius: radius[i], gyration2: gyration2[i], outline: outlines[i], holes: holes[i],
                                   parts: parts.slice(partOffset[i], partOffset[i + 1]) }));
}

/** @param {File} file @param {number} shapes @param {number} materials @returns {Bodies} */
function readBodies(file, shapes, materials) {
  const at = "throng/bodies/", radius = numbers(file, at + "radius", "float", [-1]), count = radius.length;
  expectRange(radius, at + "radius", 0, Infinity);
  return {
    count, radius,
    changes: Boolean(file.get(at + "id")),
    id: numbers(file, file.get(at + "id") ? at + "id" : "particles/trajectory/id", "int", [count]),
    shape: expectRange(numbers(file, at + "shape", "int", [count]), at + "shape", 0, shapes),
    material: expectRange(numbers(file, at + "material", "int", [count]), at + "material", 0, materials),
    kind: expectRange(numbers(file, at + "kind", "int", [count]), at + "kind", 0, 4),
    mass: expectRange(numbers(file, at + "mass", "float", [count]), at + "mass", 0, Infinity),
  };
}

export const DYNAMIC = 0, AGENT = 3;

/** Whether a body moves by itself: all but what is static or driven. @param {number} kind */
export const isFree = kind => kind === DYNAMIC || kind === AGENT;

/** @param {File} file @returns {Wall[]} */
function readWalls(file) {
  const lines = ragged(file, "throng/walls/offset", "throng/walls/points");
  const closed = numbers(file, "throng/walls/closed", "int", [lines.length]);
  return lines.map((points, i) => ({ points, closed: closed[i] !== 0 }));
}

/** Rings of points. @param {File} file */
function readWalkable(file) {
  return file.get("throng/walkable") ? ragged(file, "throng/walkable/offset", "throng/walkable/points") : [];
}

const USES = /** @type {const} */ (["none", "goal", "wait"]);

/** Their table, which is there since layout 1.6, or null. @param {File} file @returns {import("./scenario.js").Area[] | null} */
function readAreas(file) {
  const at = "throng/areas/";
  if (!file.get("throng/areas")) return null;
  const names = texts(file, at + "name", [-1]), use = expectRange(numbers(file, at + "use", "int", [names.length]), at + "use", 0, USES.length);
  const rings = ragged(file, at + "offset", at + "points"), offset = numbers(file, at + "area_offset", "int", [names.length + 1]);
  expectOffsets(offset, rings.length, at + "area_offset");
  if (rings.some(ring => ring.length < 6)) throw damaged(at + "offset");
  return names.map((name, i) => ({ name, rings: rings.slice(offset[i], offset[i + 1]), use: USES[use[i]] }));
}

/** @param {File} file @returns {Queue[]} */
function readQueues(file) {
  if (!file.get("throng/queues")) return [];
  const names = texts(file, "throng/queues/name", [-1]), lines = ragged(file, "throng/queues/offset", "throng/queues/points");
  if (lines.length !== names.length || lines.some(line => line.length < 4)) throw damaged("throng/queues/offset");
  return names.map((name, i) => ({ name, line: lines[i] }));
}

/** Of the measures those that have no area. @param {File} file @returns {MeasuredLine[]} */
function readMeasuredLines(file) {
  const at = "throng/measures/";
  if (!file.get("throng/measures")) return [];
  const names = texts(file, at + "name", [-1]), line = expectRange(numbers(file, at + "line", "float", [names.length, 4]), at + "line", -1e300, 1e300);
  const offset = numbers(file, at + "area_offset", "int", [names.length + 1]);
  return names.map((name, i) => ({ name, line: Array.from(line.slice(4 * i, 4 * i + 4)) })).filter((_, i) => offset[i] === offset[i + 1]);
}

/** Throws unless this program can read the file. @param {File} file */
export function expectVersion(file) {
  const version = attribute(file.get("throng"), "version");
  if (!version || version.length !== 2) throw new BadFile("is HDF5 but not a recording of throng");
  if (version[0] > 1) throw new BadFile(`was written by a newer throng: its form is ${version[0]}.${version[1]}, this page reads 1`);
}

/** @param {File} file  @returns {Scene} */
export function readScene(file) {
  expectVersion(file);
  const throng = file.get("throng"), shapes = readShapes(file), materials = texts(file, "throng/materials/name", [-1]);
  const scenario = sections(texts(file, "parameters/resolved", [])[0] ?? ""), parameters = file.get("parameters");
  const bodies = readBodies(file, shapes.length, materials.length);
  return { name: text(attribute(throng, "name")), description: text(attribute(throng, "description")),
           version: text(attribute(parameters, "version")), domain: readDomain(file), gravity: gravityOf(scenario),
           shapes, materials, bodies, walls: readWalls(file), walkable: readWalkable(file), areas: readAreas(file) ?? areasOf(scenario), queues: readQueues(file), measuredLines: readMeasuredLines(file),
           groups: groupsOf(scenario, Number(attribute(parameters, "bodies") ?? bodies.count)) };
}
