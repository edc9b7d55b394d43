// SPDX-License-Identifier: MIT
// What all bodies share in the shaders: their state by row, their colour, the place on the screen.

import { NOWHERE } from "../view/blend.js";

/** Rows of a texture. */
export const WIDTH = 1024;

/** Of every body: x, y from the camera (m), angle, place in the table of colours, below 0 of those that are not there. */
export const BODY = `
uniform sampler2D states, colours;
uniform vec2 pixels;       // of the screen
uniform float scale;       // pixels a metre
uniform vec2 image, size;  // which image of a periodic domain: 0 or 1 in each direction; the domain's size, or 0
uniform vec2 middle;       // of the domain, from the camera
vec4 stateOf(uint row) { return texelFetch(states, ivec2(row % ${WIDTH}u, row / ${WIDTH}u), 0); }
vec3 colourOf(vec4 state) { return texelFetch(colours, ivec2(int(state.w + 0.5), 0), 0).rgb; }
vec2 turned(vec2 local, float angle) { float c = cos(angle), s = sin(angle); return vec2(c * local.x - s * local.y, s * local.x + c * local.y); }
vec2 placed(vec4 state) { return state.xy + image * size * mix(vec2(-1.0), vec2(1.0), lessThan(state.xy, middle)); }
vec4 onScreen(vec4 state, vec2 px) { return state.w < 0.0 ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(2.0 * px / pixels, 0.0, 1.0); }  // or nowhere
const float SHADE = 0.55;
`;

export const DISC = [`
layout(location = 0) in uint row;
layout(location = 1) in vec3 disc;
uniform float rim, inset;  // pixels; inset: the disc is drawn that much smaller
out vec2 at; out vec3 colour; out float radius, looks;
${BODY}
void main() {
  vec4 state = stateOf(row);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  radius = max(disc.z * scale, 0.6) - min(inset, 0.24 * disc.z * scale);
  at = corner * (radius + 1.0);
  colour = colourOf(state);
  looks = state.z > float(${0.5 * NOWHERE}) ? 1.0 : 0.0;
  gl_Position = onScreen(state, (placed(state) + turned(disc.xy, state.z)) * scale + turned(at, state.z));
}`, `
in vec2 at; in vec3 colour; in float radius, looks;
uniform float rim, turn, whole;  // pixels; turn: of the line that shows how a disc has turned; whole: 1 for all in the rim's colour
out vec4 shown;
void main() {
  float d = length(at), width = min(rim, 0.24 * radius);
  float inner = max(whole, rim > 0.0 ? clamp(d - (radius - width) + 0.5, 0.0, 1.0) * clamp(radius - 1.2, 0.0, 1.0) : 0.0);
  if (turn * looks > 0.0 && radius > 4.0 * turn && at.x > 0.0)
    inner = max(inner, clamp(0.5 * min(turn, 0.16 * radius) - abs(at.y) + 0.5, 0.0, 1.0));
  float alpha = clamp(radius - d + 0.5, 0.0, 1.0);
  shown = vec4(mix(colour, colour * ${0.55}, inner), 1.0) * alpha;
}`];

export const TRIANGLE = [`
layout(location = 0) in uint row;
layout(location = 1) in vec2 local;
out vec3 colour;
${BODY}
void main() {
  vec4 state = stateOf(row);
  colour = colourOf(state);
  gl_Position = onScreen(state, (placed(state) + turned(local, state.z)) * scale);
}`, `
in vec3 colour;
out vec4 shown;
void main() { shown = vec4(colour, 1.0); }`];

export const EDGE = [`
layout(location = 0) in uint row;
layout(location = 1) in vec4 ends;
uniform float rim;
out vec3 colour;
${BODY}
void main() {
  vec4 state = stateOf(row);
  colour = SHADE * colourOf(state);
  vec2 a = turned(ends.xy, state.z) * scale, b = turned(ends.zw, state.z) * scale, along = b - a;
  along = dot(along, along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 end = corner.x < 0.0 ? a : b;
  gl_Position = onScreen(state, placed(state) * scale + end + 0.5 * rim * (corner.x * 0.6 * along + corner.y * vec2(-along.y, along.x)));
}`, TRIANGLE[1]];

export const LINE = [`
layout(location = 0) in vec4 ends;   // m, from the anchor
layout(location = 1) in vec2 look;   // width and dash, pixels
layout(location = 2) in vec4 paint;
uniform vec2 pixels, anchor;         // the anchor from the camera, m
uniform float scale, ratio;          // ratio: device pixels a pixel
out vec4 colour; out float along, dash; out vec2 side; out float half_width, long_side;
void main() {
  vec2 a = (ends.xy + anchor) * scale, b = (ends.zw + anchor) * scale, way = b - a;
  float far = length(way);
  vec2 unit = far > 0.0 ? way / far : vec2(1.0, 0.0);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  half_width = 0.5 * look.x * ratio;
  float reach = half_width + 1.0;
  along = corner.x < 0.0 ? -reach : far + reach;
  long_side = far;
  side = vec2(along, corner.y * reach);
  dash = look.y * ratio;
  colour = paint;
  gl_Position = vec4(2.0 * ((corner.x < 0.0 ? a : b) + reach * (corner.x * unit + corner.y * vec2(-unit.y, unit.x))) / pixels, 0.0, 1.0);
}`, `
in vec4 colour; in float along, dash, half_width, long_side; in vec2 side;
out vec4 shown;
void main() {
  float beyond = max(max(-side.x, side.x - long_side), 0.0);
  float alpha = clamp(half_width - length(vec2(beyond, side.y)) + 0.5, 0.0, 1.0) * min(1.0, 2.0 * half_width);
  if (dash > 0.0 && mod(along, 2.0 * dash) > dash) discard;
  shown = vec4(colour.rgb, 1.0) * colour.a * alpha;
}`];

/** One segment of all bodies' trails: from one layer of past places to another, or to where bodies are now. */
export const TRAIL = [`
uniform sampler2DArray past;
uniform int older, newer;      // layers; newer < 0: where bodies are now
uniform vec2 anchor;           // from the camera, m
uniform float width;
uniform vec4 fade;             // alpha at both ends, least length in pixels, longest in metres
out vec4 colour; out float across; out float alpha;
${BODY}
vec2 pastOf(uint row, int layer) { return texelFetch(past, ivec3(row % ${WIDTH}u, row / ${WIDTH}u, layer), 0).xy + anchor; }
void main() {
  uint row = uint(gl_InstanceID);
  vec4 state = stateOf(row);
  vec2 a = pastOf(row, older), b = newer < 0 ? state.xy : pastOf(row, newer), way = (b - a) * scale;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  float far = length(way);
  bool shows = far > fade.z && length(b - a) < fade.w;
  vec2 normal = shows ? vec2(-way.y, way.x) / far : vec2(0.0);
  colour = vec4(colourOf(state), 1.0);
  alpha = corner.x < 0.0 ? fade.x : fade.y;
  across = corner.y * (0.5 * width + 1.0);
  gl_Position = shows ? onScreen(state, (corner.x < 0.0 ? a : b) * scale + across * normal) : vec4(2.0, 2.0, 2.0, 1.0);
}`, `
in vec4 colour; in float across, alpha;
uniform float width;
out vec4 shown;
void main() { shown = colour * alpha * clamp(0.5 * width - abs(across) + 0.5, 0.0, 1.0); }`];

export const AREA = [`
layout(location = 0) in vec2 point;  // m, from the anchor
uniform vec2 pixels, anchor;
uniform float scale;
void main() { gl_Position = vec4(2.0 * (point + anchor) * scale / pixels, 0.0, 1.0); }`, `
uniform vec4 paint;
out vec4 shown;
void main() { shown = paint; }`];
