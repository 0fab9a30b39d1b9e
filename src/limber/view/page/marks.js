// Couplers, tendons, loads and contacts.
import * as THREE from 'three';
import { sampleMap } from './colours.js';
import { factorAt, locate, rotate } from './motion.js';

const kColours = {
  joint: 0x333333, bushing: 0x7f7f7f, spring: 0x2ca02c, latch: 0x9467bd, tendon: 0x8c564b,
  load: 0xd62728, contact: 0xff7f0e, stick: 0x1f77b4, slip: 0xd62728,
};
const kTouch = 6;  // numbers of an output
const kPatch = 10;

// In front of all bodies: most of it is inside of one, or behind.
function makeArrow(colour) {
  const material = new THREE.MeshBasicMaterial({
    color: colour, depthTest: false, transparent: true });
  const shaft = new THREE.CylinderGeometry(0.025, 0.025, 0.78, 12).translate(0, 0.39, 0);
  const tip = new THREE.ConeGeometry(0.07, 0.22, 16).translate(0, 0.89, 0);
  const arrow = new THREE.Group();
  arrow.add(new THREE.Mesh(shaft, material), new THREE.Mesh(tip, material));
  for (const part of arrow.children) part.renderOrder = 2;
  return arrow;
}

function makeDot(colour, radius) {
  const dot = new THREE.Mesh(
    new THREE.SphereGeometry(radius, 16, 8),
    new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true }));
  dot.renderOrder = 2;
  return dot;
}

// A moment: an arrow with two tips.
function makeTwist(colour) {
  const arrow = makeArrow(colour);
  const tip = arrow.children[1].clone();
  tip.position.y = -0.18;
  arrow.add(tip);
  return arrow;
}

// The ellipse of a touch, a disc of radius 1 that is moved into place.
function makePatch() {
  const material = new THREE.MeshBasicMaterial({
    depthTest: false, transparent: true, opacity: 0.8, side: THREE.DoubleSide });
  const patch = new THREE.Mesh(new THREE.CircleGeometry(1, 48), material);
  patch.renderOrder = 1;
  patch.matrixAutoUpdate = false;
  return patch;
}

const kUp = new THREE.Vector3(0, 1, 0);

// Points at `p` if `towards`, else away from it.
function aim(arrow, p, vector, length, towards) {
  const size = Math.hypot(...vector);
  arrow.visible = size > 0 && Number.isFinite(size) && length > 0;
  if (!arrow.visible) return;
  const direction = new THREE.Vector3(...vector).divideScalar(size);
  arrow.quaternion.setFromUnitVectors(kUp, direction);
  arrow.scale.setScalar(length);
  arrow.position.set(...p);
  if (towards) arrow.position.addScaledVector(direction, -length);
}

// The normal force over the ellipse's area [Pa]; 0 where there is none.
function pressureOf(touch, patch, i) {
  const p = patch.subarray(kPatch * i, kPatch * (i + 1));
  if (p.length === 0) return 0;
  const u = new THREE.Vector3(...p.subarray(0, 3));
  const v = new THREE.Vector3(...p.subarray(3, 6));
  const normal = new THREE.Vector3().crossVectors(u, v);
  const area = Math.PI * normal.length();
  if (!(area > 0)) return 0;
  const force = new THREE.Vector3(...touch.subarray(kTouch * i + 3, kTouch * i + 6));
  return Math.abs(force.dot(normal.normalize())) / area;
}

const largestFactor = (course) => {
  let most = 0;
  for (let i = 1; i < course.length; i += 2) most = Math.max(most, Math.abs(course[i]));
  return most;
};

export class Marks {
  constructor(result, motion, size) {
    this.motion = motion;
    this.size = size;
    this.map = 'viridis'; // of pressures
    this.couplers = new THREE.Group();
    this.loads = new THREE.Group();
    this.contacts = new THREE.Group();
    this.group = new THREE.Group();
    this.group.add(this.couplers, this.loads, this.contacts);
    this.marks = result.marks.map((mark) => this.addMark(mark));
    this.forces = result.loads.map((load) => this.addLoad(load, result.loads));
    this.touches = this.addContacts(result);
  }

  addMark(mark) {
    const color = kColours[mark.kind] ?? 0x333333;
    if (mark.kind === 'spring' || mark.kind === 'tendon') {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute(
        'position', new THREE.BufferAttribute(new Float32Array(3 * mark.points.length), 3));
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color, depthTest: false }));
      line.renderOrder = 2;
      line.frustumCulled = false;
      this.couplers.add(line);
      return { mark, line };
    }
    const radius = 0.006 * this.size;
    const geometry =
      mark.kind === 'joint'
        ? new THREE.SphereGeometry(radius, 16, 8)
        : new THREE.OctahedronGeometry(1.2 * radius);
    const dot = new THREE.Mesh(
      geometry, new THREE.MeshBasicMaterial({ color, depthTest: false, transparent: true }));
    dot.renderOrder = 2;
    this.couplers.add(dot);
    return { mark, dot };
  }

  addLoad(load, all) {
    const scaleOf = (vector) => Math.hypot(...vector) * largestFactor(load.course);
    const most = (key) =>
      Math.max(...all.map((other) => Math.hypot(...other[key]) * largestFactor(other.course)));
    const force = makeArrow(kColours.load);
    const moment = makeTwist(kColours.load);
    this.loads.add(force, moment);
    return {
      load, force, moment,
      forceScale: scaleOf(load.force) > 0 ? 1 / most('force') : 0,
      momentScale: scaleOf(load.moment) > 0 ? 1 / most('moment') : 0,
    };
  }

  addContacts({ contacts }) {
    let most = 0;
    let mostPressure = 0;
    for (const { touch, patch } of contacts) {
      for (let i = 0; i < touch.length / kTouch; ++i) {
        const force = Math.hypot(...touch.subarray(kTouch * i + 3, kTouch * i + 6));
        if (Number.isFinite(force)) most = Math.max(most, force);
        const pressure = pressureOf(touch, patch, i);
        if (Number.isFinite(pressure)) mostPressure = Math.max(mostPressure, pressure);
      }
    }
    this.mostPressure = mostPressure;
    return contacts.map(({ touch, patch }) => {
      const arrow = makeArrow(kColours.contact);
      const friction = makeArrow(kColours.stick);
      const area = makePatch();
      const dot = makeDot(kColours.contact, 0.005 * this.size);
      this.contacts.add(area, arrow, friction, dot);
      return { touch, patch, arrow, friction, area, dot, scale: most > 0 ? 1 / most : 0 };
    });
  }

  updateContact({ touch, patch, arrow, friction, area, dot, scale }, i, home) {
    const row = touch.subarray(kTouch * i, kTouch * (i + 1));
    const force = row.subarray(3);
    const place = home.map((value, c) => value + row[c]);
    aim(arrow, place, force, this.length(scale * Math.hypot(...force)), false);
    dot.visible = arrow.visible;
    dot.position.set(...place);
    const numbers = patch.subarray(kPatch * i, kPatch * (i + 1));
    const pressure = pressureOf(touch, patch, i);
    area.visible = pressure > 0 && Number.isFinite(pressure);
    if (area.visible) {
      const u = new THREE.Vector3(...numbers.subarray(0, 3));
      const v = new THREE.Vector3(...numbers.subarray(3, 6));
      const n = new THREE.Vector3().crossVectors(u, v).normalize();
      area.matrix.makeBasis(u, v, n).setPosition(...place);
      const colour = sampleMap(this.map, pressure / this.mostPressure).map((c) => c / 255);
      area.material.color.setRGB(...colour, THREE.SRGBColorSpace);
    }
    const along = numbers.subarray(6, 9);
    const share = numbers.length > 0 ? scale * Math.hypot(...along) : 0;
    aim(friction, place, along, this.length(share), false);
    const colour = numbers[9] > 0 ? kColours.slip : kColours.stick;
    for (const part of friction.children) part.material.color.setHex(colour);
  }

  update(t, magnification) {
    const at = locate(this.motion.times, t);
    for (const item of this.marks) {
      const points = item.mark.points.map((p) => this.motion.anchor(p, at, magnification));
      if (item.dot) item.dot.position.set(...points[0]);
      if (!item.line) continue;
      const array = item.line.geometry.attributes.position;
      // Single precision holds the line, not its place.
      item.line.position.set(...points[0]);
      points.forEach((p, i) => array.setXYZ(i, ...p.map((value, c) => value - points[0][c])));
      array.needsUpdate = true;
    }
    for (const item of this.forces) this.updateLoad(item, t, at, magnification);
    const home = this.motion.home(at);
    for (const touch of this.touches) this.updateContact(touch, at.i, home);
  }

  updateLoad({ load, force, moment, forceScale, momentScale }, t, at, magnification) {
    const factor = factorAt(load.course, t);
    const p = this.motion.anchor(load.where, at, magnification);
    const turn = (v) => {
      const scaled = Array.from(v, (c) => c * factor);
      if (load.in_world || load.where.body < 0) return scaled;
      return rotate(this.motion.pose(load.where.body, at).q, scaled);
    };
    const f = turn(load.force);
    const m = turn(load.moment);
    aim(force, p, f, this.length(forceScale * Math.hypot(...f)), true);
    aim(moment, p, m, this.length(momentScale * Math.hypot(...m)), true);
  }

  // Small ones stay visible.
  length(share) {
    return share > 0 ? this.size * 0.16 * Math.max(0.25, share) : 0;
  }
}
