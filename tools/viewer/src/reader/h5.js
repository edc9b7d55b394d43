// SPDX-License-Identifier: MIT
// Reads values of an HDF5 file by h5wasm, each checked before memory is taken: what stands in a file is hostile.

/** A file that can't be shown. The message is a sentence for people, without the file's name. */
export class BadFile extends Error {}

/** @param {string} what */
export const damaged = what => new BadFile(`is damaged: ${what}`);

/** Elements that one array may have; a body takes a few, a frame is an array of its own. */
const MOST = 2 ** 28;

const CLASS = { int: 0, float: 1, text: 3 };

/**
 * The dataset at a path. Throws BadFile where it is missing, of another class or of another rank.
 * @param {any} file @param {string} path @param {"int" | "float" | "text"} kind @param {number[]} shape  -1: any
 */
export function dataset(file, path, kind, shape) {
  const data = file.get(path);
  if (!data || data.type !== "Dataset") throw damaged(`${path} is missing`);
  const { metadata } = data;
  const fits = metadata.shape && metadata.shape.length === shape.length &&
    shape.every((size, i) => size < 0 || metadata.shape[i] === size);
  if (metadata.type !== CLASS[kind] || metadata.vlen || !fits) throw damaged(`${path} has another type or shape`);
  if (metadata.shape.reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b, metadata.size) > 8 * MOST && shape.length < 2)
    throw damaged(`${path} is too large`);
  return data;
}

/**
 * All of a dataset, as numbers. Integers of 64 bits become doubles: exact below 2^53.
 * @param {any} file @param {string} path @param {"int" | "float"} kind @param {number[]} shape  -1: any
 * @returns {Float64Array}
 */
export function numbers(file, path, kind, shape) {
  const data = dataset(file, path, kind, shape), { metadata } = data;
  const count = metadata.shape.reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b, 1);
  if (count > MOST) throw damaged(`${path} is too large`);
  if (count === 0) return new Float64Array(0);
  const value = data.value, values = metadata.shape.length === 0 ? [value] : value, result = new Float64Array(count);
  for (let i = 0; i < count; ++i) result[i] = Number(values[i]);
  return result;
}

/**
 * A text, or a list of texts, of fixed length.
 * @param {any} file @param {string} path @param {number[]} shape
 * @returns {string[]}
 */
export function texts(file, path, shape) {
  const data = dataset(file, path, "text", shape), { metadata } = data;
  const count = metadata.shape.reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b, 1);
  if (count * metadata.size > 2 ** 26) throw damaged(`${path} is too large`);
  if (count === 0) return [];
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
  if (!found || found.metadata.size * (found.metadata.total_size ?? 1) > 65536) return undefined;
  return found.value;
}
