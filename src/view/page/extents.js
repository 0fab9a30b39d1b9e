// Bounds of a result over time: the box of its motion, ranges of fields, the
// time of the largest deformation.
import { findSemiAxes } from './ellipsoid.js';
import { locate, rotate } from './motion.js';

const kNodes = 150; // of a surface, evenly taken
const kBoxTimes = 24;

function sampleNodes(surface) {
  const step = Math.max(1, Math.floor(surface.nodes / kNodes));
  const nodes = [];
  for (let i = 0; i < surface.nodes; i += step) nodes.push(i);
  return nodes;
}

// Half of the edges of a rigid shape's box about its origin.
function halfEdges({ kind, size }) {
  const [a, b, c] = size;
  if (kind === 'box') return [a / 2, b / 2, c / 2];
  if (kind === 'sphere') return [a, a, a];
  if (kind === 'cylinder') return [a, a, b / 2];
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

/// Points of a body in its own frame, undeformed.
function bodyPoints(result, b) {
  const body = result.bodies[b];
  if (body.surface >= 0) {
    const surface = result.surfaces[body.surface];
    return sampleNodes(surface).map((n) => Array.from(surface.x.subarray(3 * n, 3 * n + 3)));
  }
  const points = result.shapes.filter((s) => s.body === b).flatMap(shapePoints);
  if (points.length > 0) return points;
  return findSemiAxes(body).flatMap((axis) => [axis, axis.map((c) => -c)]);
}

/// Box of all bodies over the whole motion, and of what is fixed but planes:
/// { lower, upper, size }.
export function findBox(motion) {
  const { result, times } = motion;
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  const extend = (point) =>
    point.forEach((value, c) => {
      lower[c] = Math.min(lower[c], value);
      upper[c] = Math.max(upper[c], value);
    });
  result.shapes
    .filter((shape) => shape.body < 0 && shape.kind !== 'plane')
    .flatMap(shapePoints)
    .forEach(extend);
  const points = result.bodies.map((_, b) => bodyPoints(result, b));
  for (let k = 0; k < kBoxTimes; ++k) {
    const at = { i: Math.round((k / (kBoxTimes - 1)) * (times.length - 1)), s: 0, h: 0 };
    points.forEach((list, b) => {
      const pose = motion.pose(b, at);
      for (const point of list) {
        extend(rotate(pose.q, point).map((value, c) => value + pose.p[c]));
      }
    });
  }
  const size = Math.hypot(...upper.map((u, c) => u - lower[c])) || 1;
  return { lower, upper, size };
}

// Largest value of each field at one output.
function fieldsAt(motion, at, starts, points) {
  const { result } = motion;
  const most = [0, 0, 0, 0];
  result.bodies.forEach((body, b) => {
    const pose = motion.pose(b, at);
    const twist = motion.twist(b, at, pose);
    const m = body.surface >= 0 ? body.modes : 0;
    const surface = m > 0 ? result.surfaces[body.surface] : null;
    const eta = motion.eta(b, at, new Float64Array(m));
    const rate = motion.etadot(b, at, new Float64Array(m));
    points[b].forEach(({ x, node }, p) => {
      const u = m > 0 ? motion.deformation(b, node, eta) : [0, 0, 0];
      const udot = surface ? motion.deformation(b, node, rate) : [0, 0, 0];
      const r = x.map((value, c) => value + u[c]);
      const world = rotate(pose.q, r).map((value, c) => value + pose.p[c]);
      starts[b][p] ??= world;
      const speed = [0, 1, 2].map((c) => {
        const d = (c + 1) % 3;
        const e = (c + 2) % 3;
        return twist.v[c] + twist.w[d] * r[e] - twist.w[e] * r[d] + udot[c];
      });
      most[1] = Math.max(most[1], Math.hypot(...u));
      most[2] = Math.max(most[2], Math.hypot(...world.map((value, c) => value - starts[b][p][c])));
      most[3] = Math.max(most[3], Math.hypot(...speed));
    });
  });
  return most;
}

function makeProbes(result) {
  return result.bodies.map((body, b) => {
    if (body.surface < 0) return bodyPoints(result, b).map((x) => ({ x, node: -1 }));
    const surface = result.surfaces[body.surface];
    const nodes = sampleNodes(surface).filter((_, i) => i % 3 === 0);
    return nodes.map((node) => ({
      node, x: Array.from(surface.x.subarray(3 * node, 3 * node + 3)),
    }));
  });
}

/// Largest of each field over the run, and when the deformation is largest.
/// Of sampled nodes and outputs: at most 400 of these.
export function findRanges(motion) {
  const points = makeProbes(motion.result);
  const starts = points.map((list) => new Array(list.length));
  const step = Math.max(1, Math.ceil(motion.times.length / 400));
  const most = [0, 0, 0, 0];
  let peak = motion.times[0];
  for (let i = 0; i < motion.times.length; i += step) {
    const now = fieldsAt(motion, { i, s: 0, h: 0 }, starts, points);
    if (now[1] > most[1]) peak = motion.times[i];
    for (let f = 1; f < 4; ++f) most[f] = Math.max(most[f], now[f]);
  }
  return { most, peak };
}

/// The same at one time alone, for a scale of its own.
export function findRangesAt(motion, t) {
  const points = makeProbes(motion.result);
  const starts = points.map((list) => new Array(list.length));
  fieldsAt(motion, { i: 0, s: 0, h: 0 }, starts, points);
  return fieldsAt(motion, locate(motion.times, t), starts, points);
}
