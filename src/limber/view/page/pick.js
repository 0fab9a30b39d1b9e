// A click on a surface: the node there, and its motion.
import * as THREE from 'three';
import { locate } from './motion.js';
import { misesAt, stressAt, stressComponentsAt } from './stress.js';

const kStillPixels = 4;

/// Calls `onPick({ body, node, point })` after a click, null beside all bodies.
export function watchPicks(canvas, camera, bodies, onPick) {
  let down = null;
  canvas.addEventListener('pointerdown', (e) => (down = [e.clientX, e.clientY]));
  canvas.addEventListener('pointerup', (e) => {
    if (!down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > kStillPixels) return;
    const box = canvas.getBoundingClientRect();
    onPick(
      pickAt(
        ((e.clientX - box.left) / box.width) * 2 - 1,
        1 - ((e.clientY - box.top) / box.height) * 2,
        camera, bodies));
  });
}

/// @param x, y in [-1, 1] over the picture
export function pickAt(x, y, camera, bodies) {
  bodies.chooseFine(); // until the next frame: a node is one of all
  const ray = new THREE.Raycaster();
  ray.setFromCamera(new THREE.Vector2(x, y), camera);
  const meshes = bodies.moving
    .filter(({ link }) => link.group.visible)
    .flatMap((item) => item.meshes);
  for (const mesh of meshes) {
    mesh.updateMatrixWorld();
    // Bounds are those of unit modal coordinates, which may be too small.
    if (mesh.userData.isSurface) mesh.geometry.boundingSphere.radius = 1e9;
  }
  const hit = ray.intersectObjects(meshes, false)[0];
  if (!hit) return null;
  const { body, isSurface } = hit.object.userData;
  if (!isSurface) return { body, node: -1, point: hit.point.toArray() };
  const corners = [hit.face.a, hit.face.b, hit.face.c];
  const place = new THREE.Vector3();
  const distances = corners.map((node) => {
    hit.object.getVertexPosition(node, place);
    return place.applyMatrix4(hit.object.matrixWorld).distanceTo(hit.point);
  });
  const node = corners[distances.indexOf(Math.min(...distances))];
  return { body, node, point: hit.point.toArray() };
}

// A group of plots of a node: `labels` name what `read(t)` returns at every output.
function trace(motion, body, node, unit, labels, read) {
  const { result, times } = motion;
  const tag = result.surfaces[result.bodies[body].surface].tags[node];
  const values = labels.map(() => new Float64Array(times.length));
  times.forEach((t, i) => read(t).forEach((value, c) => (values[c][i] = value)));
  return {
    name: `${result.bodies[body].name}, node ${tag}`,
    unit,
    series: labels.map((label, c) => ({ label, values: values[c], times, ghost: 0 })),
  };
}

/// Displacement from the start of a surface's node at every output.
export function traceNode(motion, body, node) {
  const start = motion.position(body, node, motion.times[0]);
  return trace(motion, body, node, 'm', ['ux', 'uy', 'uz'], (t) =>
    motion.position(body, node, t).map((value, c) => value - start[c]));
}

/// Its von Mises stress and the components in the axes of its body, for results
/// that have them.
export function traceStress(motion, body, node) {
  const labels = ['von Mises', 'xx', 'yy', 'zz', 'xy', 'yz', 'xz'];
  return trace(motion, body, node, 'Pa', labels, (t) => {
    const s = stressComponentsAt(motion, body, node, t);
    return [misesAt(s, 0), ...s];
  });
}

/// Displacement and deformation of a node at a time, as lengths [m], and its
/// von Mises stress [Pa], null without.
export function describeNode(motion, body, node, t) {
  const b = motion.result.bodies[body];
  const now = motion.position(body, node, t);
  const start = motion.position(body, node, motion.times[0]);
  const eta = motion.eta(body, locate(motion.times, t), new Float64Array(b.modes));
  return {
    tag: motion.result.surfaces[b.surface].tags[node],
    position: now,
    displacement: Math.hypot(...now.map((value, c) => value - start[c])),
    deformation: Math.hypot(...motion.deformation(body, node, eta)),
    stress: stressAt(motion, body, node, t),
  };
}
