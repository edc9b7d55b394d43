// SPDX-License-Identifier: MIT
// Reads values of an HDF5 file by h5wasm, each checked before memory is taken: what stands in a file is hostile.

/** A file that can't be shown. The message is a sentence for people, without the file's name. */
export class BadFile extends Error {}

/** @param {string} what */
export const damaged = what => new BadFile(`is damaged: ${what}`);

// The bounds of sim/recording/h5_read.cpp: what passes here passes there.
const MOST_CHUNK = 2 ** 24;      // bytes
const CUT_SHORT = 64e6;          // bytes, of frames on their way when a run was killed
const DENSEST = 1032;            // what deflate can make of a byte
const MOST_ATTRIBUTE = 65536;    // bytes

const CLASS = { int: 0, float: 1, text: 3 };
const FLETCHER32 = 3, PACKED = "2,1,3";  // shuffle, deflate, fletcher32

/** An open file, and how many bytes its datasets may claim. */
export class OpenFile {
  #file;

  /** @param {any} h5  h5wasm, ready @param {string} path @param {"r" | "Sr"} mode @param {number} bytes  of the file */
  constructor(h5, path, mode, bytes) {
    this.#file = new h5.File(path, mode);
    this.room = bytes + (mode === "Sr" ? CUT_SHORT : 0);
  }

  /** @param {string} path @returns {any} */
  get(path) { return this.#file.get(path); }
  close() { this.#file.close(); }
}

/** @param {ArrayLike<number>} factors @param {number} first */
function product(factors, first) {
  let result = first;
  for (let i = 0; i < factors.length; ++i) result *= factors[i];
  return result;
}

/**
 * How a dataset is stored. whole: all of it is in the file; packed: through shuffle and deflate; sparse: of its rows little was written.
 * @typedef {"whole" | "packed" | "sparse"} Storage
 */

/** Throws where it is stored as throng never does, or claims more than the file can hold. @param {OpenFile} file @param {any} data @param {string} path @param {Storage} storage */
function expectStorage(file, { metadata, filters }, path, storage) {
  const used = filters.map((/** @type {{id: number}} */ { id }) => id);
  const expected = storage === "packed" ? used.join() === PACKED : used.every((/** @type {number} */ id) => id === FLETCHER32);
  if (!expected) throw damaged(`${path} has a filter that throng never uses there`);
  if (metadata.chunks && product(metadata.chunks, metadata.size) > MOST_CHUNK) throw damaged(`${path} has chunks that are too large`);
  const claimed = product(storage === "sparse" ? metadata.shape.slice(1) : metadata.shape, metadata.size);
  if (claimed > file.room * (storage === "packed" ? DENSEST : 1)) throw damaged(`${path} claims more than the file can hold`);
}

/**
 * The dataset at a path. Throws BadFile where it is missing, of another class or of another rank, or larger than its file.
 * @param {OpenFile} file @param {string} path @param {"int" | "float" | "text"} kind @param {number[]} shape  -1: any @param {Storage} [storage]
 */
export function dataset(file, path, kind, shape, storage = "whole") {
  const data = file.get(path);
  if (!data || data.type !== "Dataset") throw damaged(`${path} is missing`);
  const { metadata } = data;
  const fits = metadata.shape && metadata.shape.length === shape.length &&
    shape.every((size, i) => size < 0 || metadata.shape[i] === size);
  if (metadata.type !== CLASS[kind] || metadata.vlen || !fits) throw damaged(`${path} has another type or shape`);
  expectStorage(file, data, path, storage);
  return data;
}

/**
 * All of a dataset, as numbers. Integers of 64 bits become doubles: exact below 2^53.
 * @param {OpenFile} file @param {string} path @param {"int" | "float"} kind @param {number[]} shape  -1: any
 * @returns {Float64Array}
 */
export function numbers(file, path, kind, shape) {
  const data = dataset(file, path, kind, shape), { metadata } = data, count = product(metadata.shape, 1);
  if (count === 0) return new Float64Array(0);
  const value = data.value, values = metadata.shape.length === 0 ? [value] : value, result = new Float64Array(count);
  for (let i = 0; i < count; ++i) result[i] = Number(values[i]);
  return result;
}

/**
 * A text, or a list of texts, of fixed length.
 * @param {OpenFile} file @param {string} path @param {number[]} shape
 * @returns {string[]}
 */
export function texts(file, path, shape) {
  const data = dataset(file, path, "text", shape);
  if (product(data.metadata.shape, 1) === 0) return [];
  const value = data.value;
  return Array.isArray(value) ? value.map(String) : [String(value)];
}

/**
 * The value of an attribute, or undefined.
 * @param {any} object @param {string} name
 * @returns {any}
 */
export function attribute(object, name) {
  const found = object && object.attrs && object.attrs[name];
  if (!found || found.metadata.size * (found.metadata.total_size ?? 1) > MOST_ATTRIBUTE) return undefined;
  return found.value;
}
