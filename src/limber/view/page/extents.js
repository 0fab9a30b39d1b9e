// Bounds of a result over time: the box of its motion, ranges of fields, the
// time of the largest deformation.
import { locate, rotate } from './motion.js';

// Half of the edges of a rigid shape's box about its origin.
function halfEdges({ kind, size }) {
  const [a, b, c] = size;
  if (kind === 'box') return [a / 2, b / 2, c / 2];
  if (kind === 'sphere') return [a, a, a];
  if (kind === 'cylinder') return [a, a, b / 2];
  if (kind === 'cone') return [a, a, b / 2];
  if (kind === 'ellipsoid') return [a, b, c];
  if (kind === 'capsule') return [a, a, a + b / 2];
  return [0, 0, 0]; // a plane
}

// Corners of the box [lower, upper].
const boxCorners = (lower, upper) =>
  Array.from({ length: 8 }, (_, i) =>
    lower.map((value, k) => (i & (1 << k) ? upper[k] : value)));

function meshCorners({ x }) {
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  x.forEach((value, i) => {
    lower[i % 3] = Math.min(lower[i % 3], value);
    upper[i % 3] = Math.max(upper[i % 3], value);
  });
  return boxCorners(lower, upper);
}

// Box of a rigid shape, as points of its body.
function shapePoints(shape) {
  const half = halfEdges(shape);
  const corners =
    shape.kind === 'mesh' ? meshCorners(shape) : boxCorners(half.map((h) => -h), half);
  return corners.map((corner) =>
    rotate(shape.q, corner).map((value, k) => value + shape.p[k]));
}

/// Box of all bodies over the whole motion, and of what is fixed but planes:
/// { lower, upper, size }, from `home`. Of a result that travels from its own,
/// which moves, and of its bodies alone.
export function findBox({ result }, home) {
  const fixed = result.shapes.filter((shape) => shape.body < 0 && shape.kind !== 'plane');
  const from = (origin) => (point) => point.map((value, c) => value + origin[c] - home[c]);
  const points = result.travels
    ? result.box
    : [
      ...(result.box ?? []).map(from(result.offset)),
      ...fixed.flatMap(shapePoints).map(from([0, 0, 0])),
    ];
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  for (const point of points) {
    point.forEach((value, c) => {
      lower[c] = Math.min(lower[c], value);
      upper[c] = Math.max(upper[c], value);
    });
  }
  const size = Math.hypot(...upper.map((u, c) => u - lower[c])) || 1;
  return { lower, upper, size };
}

// Largest value of each field at an output, over all nodes: src/limber/view/extremes.hpp.
const fieldsAt = ({ most }, i) => [0, ...(most?.subarray(4 * i, 4 * i + 4) ?? [0, 0, 0, 0])];

/// Largest of each field over the run, and when the deformation is largest.
export function findRanges({ result, times }) {
  const most = [0, 0, 0, 0, 0];
  let peak = times[0];
  times.forEach((t, i) => {
    const now = fieldsAt(result, i);
    if (now[1] > most[1]) peak = t;
    now.forEach((value, f) => (most[f] = Math.max(most[f], value)));
  });
  return { most, peak };
}

/// The same at one time alone, for a scale of its own; straight lines between outputs.
export function findRangesAt({ result, times }, t) {
  const { i, s } = locate(times, t);
  const now = fieldsAt(result, i);
  if (s === 0) return now;
  const next = fieldsAt(result, i + 1);
  return now.map((value, f) => value + s * (next[f] - value));
}
