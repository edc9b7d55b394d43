// SPDX-License-Identifier: MIT
// A linked program with its uniforms by name.

/** @param {WebGL2RenderingContext} gl @param {number} type @param {string} source */
function compile(gl, type, source) {
  const shader = /** @type {WebGLShader} */ (gl.createShader(type));
  gl.shaderSource(shader, `#version 300 es\nprecision highp float;\nprecision highp sampler2DArray;\n${source}`);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader) ?? "shader");
  return shader;
}

/** @typedef {{use: () => void, set: (name: string, ...values: number[]) => void, whole: (name: string, value: number) => void}} Program */

/** @param {WebGL2RenderingContext} gl @param {string} vertex @param {string} fragment @returns {Program} */
export function program(gl, vertex, fragment) {
  const made = /** @type {WebGLProgram} */ (gl.createProgram());
  gl.attachShader(made, compile(gl, gl.VERTEX_SHADER, vertex));
  gl.attachShader(made, compile(gl, gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(made) ?? "program");
  const places = new Map();
  const place = (/** @type {string} */ name) => {
    if (!places.has(name)) places.set(name, gl.getUniformLocation(made, name));
    return places.get(name);
  };
  return {
    use: () => gl.useProgram(made),
    set: (name, ...values) => gl[/** @type {"uniform1fv" | "uniform2fv" | "uniform4fv"} */ (`uniform${values.length}fv`)](place(name), values),
    whole: (name, value) => gl.uniform1i(place(name), value),
  };
}

/**
 * A vertex array over one interleaved buffer of 4-byte words.
 * @param {WebGL2RenderingContext} gl @param {WebGLBuffer} buffer @param {{size: number, whole?: boolean, bytes?: boolean}[]} fields @param {boolean} instanced
 */
export function layout(gl, buffer, fields, instanced) {
  const array = /** @type {WebGLVertexArrayObject} */ (gl.createVertexArray());
  const words = fields.reduce((sum, { size, bytes }) => sum + (bytes ? 1 : size), 0);
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  let at = 0;
  fields.forEach(({ size, whole, bytes }, i) => {
    gl.enableVertexAttribArray(i);
    if (whole) gl.vertexAttribIPointer(i, size, gl.UNSIGNED_INT, 4 * words, 4 * at);
    else gl.vertexAttribPointer(i, size, bytes ? gl.UNSIGNED_BYTE : gl.FLOAT, Boolean(bytes), 4 * words, 4 * at);
    if (instanced) gl.vertexAttribDivisor(i, 1);
    at += bytes ? 1 : size;
  });
  gl.bindVertexArray(null);
  return array;
}
