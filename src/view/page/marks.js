// Couplers, tendons, loads and contacts.
import * as THREE from 'three';
import { factorAt, locate, rotate } from './motion.js';

const kColours = {
  joint: 0x333333, bushing: 0x7f7f7f, spring: 0x2ca02c, latch: 0x9467bd, tendon: 0x8c564b,
  load: 0xd62728, contact: 0xff7f0e,
};

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

// A moment: an arrow with two tips.
function makeTwist(colour) {
  const arrow = makeArrow(colour);
  const tip = arrow.children[1].clone();
  tip.position.y = -0.18;
  arrow.add(tip);
  return arrow;
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

const largestFactor = (course) => {
  let most = 0;
  for (let i = 1; i < course.length; i += 2) most = Math.max(most, Math.abs(course[i]));
  return most;
};

export class Marks {
  constructor(result, motion, size) {
    this.motion = motion;
    this.size = size;
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
    for (const { touch } of contacts) {
      for (let i = 0; i < touch.length; i += 6) {
        const size = Math.hypot(touch[i + 3], touch[i + 4], touch[i + 5]);
        if (Number.isFinite(size)) most = Math.max(most, size);
      }
    }
    return contacts.map(({ touch }) => {
      const arrow = makeArrow(kColours.contact);
      this.contacts.add(arrow);
      return { touch, arrow, scale: most > 0 ? 1 / most : 0 };
    });
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
    for (const { touch, arrow, scale } of this.touches) {
      const row = touch.subarray(6 * at.i, 6 * at.i + 6);
      const force = row.subarray(3);
      const place = home.map((value, c) => value + row[c]);
      aim(arrow, place, force, this.length(scale * Math.hypot(...force)), false);
    }
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
