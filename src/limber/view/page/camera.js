// The camera: presets, framing, following a body.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const kDirections = {
  Iso: [1, -1.4, 0.8],
  Front: [1, 0, 0],
  Side: [0, -1, 0],
  Top: [0.0001, 0, 1],
};

export class Camera {
  constructor(canvas, box) {
    this.box = box;
    this.eye = new THREE.PerspectiveCamera(35, 1, box.size * 1e-3, box.size * 50);
    this.eye.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.eye, canvas);
    this.controls.enableDamping = false;
    this.followed = null; // a function that gives a place
    this.last = null;
    this.show(this.findSide());
  }

  /// Of the flat directions of the motion's box, the view along the shortest.
  findSide() {
    const edges = this.box.upper.map((u, c) => u - this.box.lower[c]);
    const [x, y, z] = edges;
    const flat = 0.35 * Math.max(...edges);
    if (y < flat && y <= x && y <= z) return 'Side';
    if (z < flat && z <= x) return 'Iso';
    if (x < flat) return 'Front';
    return 'Iso';
  }

  show(name) {
    this.direction = kDirections[name];
    this.frame();
  }

  /// Fits the box of the motion into the picture.
  frame() {
    const { lower, upper } = this.box;
    const centre = new THREE.Vector3(...lower.map((l, c) => (l + upper[c]) / 2));
    const back = new THREE.Vector3(...this.direction).normalize();
    const right = new THREE.Vector3().crossVectors(this.eye.up, back).normalize();
    const up = new THREE.Vector3().crossVectors(back, right);
    const half = Math.tan((this.eye.fov * Math.PI) / 360);
    let distance = 0;
    for (let i = 0; i < 8; ++i) {
      const corner = new THREE.Vector3(
        ...[0, 1, 2].map((c) => (i & (1 << c) ? upper[c] : lower[c]))).sub(centre);
      const across = Math.abs(corner.dot(right)) / this.eye.aspect;
      const along = Math.abs(corner.dot(up));
      distance = Math.max(distance, corner.dot(back) + Math.max(across, along) / half);
    }
    distance = Math.max(1.12 * distance, 0.05 * this.box.size);
    this.controls.target.copy(centre);
    this.eye.position.copy(centre).addScaledVector(back, distance);
    this.controls.update();
    this.last = null;
  }

  resize(width, height) {
    const aspect = width / height;
    const reframe = this.eye.aspect === 1 && aspect !== 1;
    this.eye.aspect = aspect;
    this.eye.updateProjectionMatrix();
    if (reframe) this.frame();
  }

  /// @param place function of nothing to [x, y, z], or null
  follow(place) {
    this.followed = place;
    this.last = place ? place() : null;
  }

  /// Pixels a metre at a place, in a picture of this height [pixels].
  findScale(place, height) {
    const half = Math.tan((this.eye.fov * Math.PI) / 360);
    return height / (2 * half * this.eye.position.distanceTo(place));
  }

  update() {
    if (!this.followed) return;
    const now = this.followed();
    if (this.last) {
      const shift = new THREE.Vector3(...now.map((value, c) => value - this.last[c]));
      this.eye.position.add(shift);
      this.controls.target.add(shift);
      this.controls.update();
    }
    this.last = now;
  }
}

export const kPresets = Object.keys(kDirections);
