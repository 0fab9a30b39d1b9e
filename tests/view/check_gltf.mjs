// A scene in the Khronos validator and in three.js's reader, which steps it to
// the library's positions: check_gltf.mjs NODE_MODULES SCENE POINTS
import { strict as assert } from 'node:assert';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [modules, scene, pointsFile] = process.argv.slice(2);
const require = createRequire(`${modules}/`);
globalThis.self = globalThis;

const load = (path) => import(pathToFileURL(`${modules}/${path}`));

async function validate(bytes) {
  const report = await require('gltf-validator').validateBytes(new Uint8Array(bytes));
  const { issues, info } = report;
  assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 5), null, 1));
  assert.equal(issues.numWarnings, 0, JSON.stringify(issues.messages.slice(0, 5), null, 1));
  return info;
}

async function comparePoints(bytes) {
  const THREE = await load('three/build/three.module.js');
  const { GLTFLoader } = await load('three/examples/jsm/loaders/GLTFLoader.js');
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const gltf = await new GLTFLoader().parseAsync(buffer, '');
  const mixer = new THREE.AnimationMixer(gltf.scene);
  for (const clip of gltf.animations) mixer.clipAction(clip).play();
  const points = JSON.parse(await readFile(pointsFile, 'utf8'));
  const meshes = new Map();
  gltf.scene.traverse((node) => {
    if (node.isMesh && node.morphTargetInfluences) meshes.set(node.name, node);
  });
  let worst = 0;
  let size = 0;
  let last = null;
  const place = new THREE.Vector3();
  for (const { time, body, node, position } of points) {
    if (time !== last) mixer.setTime(Math.min(time, gltf.animations[0].duration * (1 - 1e-7)));
    if (time !== last) gltf.scene.updateMatrixWorld(true);
    last = time;
    const mesh = meshes.get(body);
    assert.ok(mesh, `there is no mesh '${body}'`);
    mesh.getVertexPosition(node, place).applyMatrix4(mesh.matrixWorld);
    // From y up to z up.
    const found = [place.x, -place.z, place.y];
    worst = Math.max(worst, Math.hypot(...position.map((value, c) => value - found[c])));
    size = Math.max(size, Math.hypot(...position));
  }
  // Single precision, of times too.
  assert.ok(worst < 1e-5 * size, `positions differ by ${worst} m of ${size} m`);
  return { worst, count: points.length };
}

const bytes = await readFile(scene);
const info = await validate(bytes);
const { worst, count } = await comparePoints(bytes);
console.log(
  `${info.animationCount} animation, ${info.totalVertexCount} vertices, ` +
    `${(bytes.length / 1e6).toFixed(2)} MB; ${count} positions within ${worst.toExponential(2)} m`);
