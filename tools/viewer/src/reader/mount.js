// SPDX-License-Identifier: MIT
// A blob as a file of h5wasm, read where it lies: nothing of it is copied but what is asked for, and a little ahead.

const BLOCK = 65536;  // bytes, of little reads

/**
 * A read of a browser's file costs a millisecond, and then 6 ms a MB: little reads, of which HDF5 does many side by side, are served
 * from a block; values are read alone, exactly.
 * @param {Blob} blob
 * @returns {(position: number, length: number) => Uint8Array}  what there is of `length` bytes
 */
export function reader(blob) {
  // @ts-ignore  only workers have it
  const files = new FileReaderSync();
  const bytesAt = (/** @type {number} */ from, /** @type {number} */ to) => new Uint8Array(files.readAsArrayBuffer(blob.slice(from, to)));
  let at = 0, block = new Uint8Array(0);
  return (position, length) => {
    const end = Math.max(position, Math.min(blob.size, position + length));
    if (length >= BLOCK) return bytesAt(position, end);
    if (position < at || end > at + block.length) {
      at = position;
      block = bytesAt(position, Math.min(blob.size, position + BLOCK));
    }
    return block.subarray(position - at, end - at);
  };
}

/** The path under which the blob is found. @param {any} h5  h5wasm's module @param {Blob} blob */
export function mount(h5, blob) {
  const { WORKERFS } = h5.FS.filesystems, read = reader(blob);
  h5.FS.mkdir("/recording");
  h5.FS.mount(WORKERFS, { blobs: [{ name: "file", data: blob }] }, "/recording");
  WORKERFS.stream_ops.read = (/** @type {any} */ _, /** @type {Uint8Array} */ buffer, /** @type {number} */ offset, /** @type {number} */ length, /** @type {number} */ position) => {
    const bytes = read(position, length);
    buffer.set(bytes, offset);
    return bytes.length;
  };
  return "/recording/file";
}
