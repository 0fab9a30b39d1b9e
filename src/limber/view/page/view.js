// The picture: what is in it, how it is coloured and drawn.
import * as THREE from 'three';
import { Bodies } from './bodies.js';
import { Camera } from './camera.js';
import { colourOfGhost, fillMap, makeLegend, makeMap, showLegend } from './colours.js';
import { findBox, findRanges, findRangesAt } from './extents.js';
import { hasStress } from './stress.js';
import { Marks } from './marks.js';
import { kFields, kStressField, makeSharedUniforms } from './material.js';
import { locate, Motion } from './motion.js';
import { Names } from './names.js';
import { groupProbes, Plots } from './plots.js';

function nameGhost(result) {
  const levels = [...new Set(result.bodies.map((body) => body.level))];
  return result.folder || `${result.name} (${levels.join(', ')})`;
}

// Whether the processor draws, for which smooth edges cost half of a frame.
function isSoftware() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const known = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = known ? gl.getParameter(known.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

function joinBoxes(boxes) {
  const lower = [0, 1, 2].map((c) => Math.min(...boxes.map((box) => box.lower[c])));
  const upper = [0, 1, 2].map((c) => Math.max(...boxes.map((box) => box.upper[c])));
  return { lower, upper, size: Math.hypot(...upper.map((u, c) => u - lower[c])) || 1 };
}

export class View {
  constructor(results, player, elements) {
    this.player = player;
    this.elements = elements;
    this.motions = results.map((result) => new Motion(result));
    [this.motion] = this.motions;
    this.home = this.motion.result.offset;
    const box = joinBoxes(this.motions.map((motion) => findBox(motion, this.home)));
    this.ranges = findRanges(this.motion);
    this.magnification = 1;
    this.fields = kFields.filter(
      (field) => field.index !== kStressField || hasStress(this.motion.result));
    this.field = 0;
    this.bare = []; // names of links without the field
    this.scalePerFrame = false;
    this.listeners = { magnification: [], field: [], links: [], plots: [] };
    this.colourMap = makeMap();
    this.shared = makeSharedUniforms(this.colourMap);
    this.box = { ...box };
    this.isBeside = false;
    this.makeScene(results, box);
    this.setMap('viridis');
    this.setProcessor(isSoftware());
    this.setDetail(this.isProcessor);
    this.makeRenderer();
    this.camera = new Camera(elements.canvas, box);
    this.camera.controls.addEventListener('change', () => this.redraw());
    this.names = new Names(elements.names, this.bodies.links, elements.legend);
    this.probeGroups = groupProbes(results);
    for (const group of this.probeGroups) {
      for (const s of group.series) if (s.ghost) s.ghostName = this.ghosts[s.ghost - 1].label;
    }
    this.plots = new Plots(elements.plots, player);
    player.onChange(() => this.redraw());
    new ResizeObserver(() => this.resize()).observe(elements.stage);
    this.resize();
  }

  makeScene(results, box) {
    const scene = new THREE.Scene();
    scene.add(new THREE.HemisphereLight(0xffffff, 0x9a9aa8, 2.6));
    this.sun = new THREE.DirectionalLight(0xffffff, 1.5);
    scene.add(this.sun, this.sun.target);
    // Everything in it has its place in the world; what is drawn is from `home`.
    this.world = new THREE.Group();
    scene.add(this.world);
    this.bodies = new Bodies(results[0], this.motion, this.shared, null, box.size);
    this.world.add(this.bodies.group);
    this.ghosts = results.slice(1).map((result, g) => {
      const ghost = new Bodies(result, this.motions[g + 1], null, colourOfGhost(g), box.size);
      ghost.label = nameGhost(result);
      this.world.add(ghost.group);
      return ghost;
    });
    this.marks = new Marks(results[0], this.motion, box.size);
    this.world.add(this.marks.group);
    this.picked = new THREE.Mesh(
      new THREE.SphereGeometry(0.006 * box.size, 16, 8),
      new THREE.MeshBasicMaterial({ color: 0xd62728, depthTest: false, transparent: true }));
    this.picked.visible = false;
    this.picked.renderOrder = 3;
    this.world.add(this.picked);
    this.scene = scene;
  }

  /// Whether the processor draws: then it deforms the surfaces, too, in less time.
  setProcessor(isSo) {
    this.isProcessor = isSo;
    for (const one of [this.bodies, ...this.ghosts]) one.setProcessor(isSo);
    this.redraw();
  }

  setDetail(isSo) {
    for (const one of [this.bodies, ...this.ghosts]) one.setDetail(isSo);
    this.redraw();
  }

  makeRenderer() {
    this.renderer = new THREE.WebGLRenderer({
      canvas: this.elements.canvas, antialias: !this.isProcessor,
    });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.setDark(document.documentElement.classList.contains('dark'));
  }

  setDark(isDark) {
    this.scene.background = new THREE.Color(isDark ? 0x16181d : 0xf7f8fa);
    for (const { mark, dot } of this.marks.marks) {
      if (dot && mark.kind === 'joint') dot.material.color.set(isDark ? 0xd8dce3 : 0x333333);
    }
    this.plots?.rebuild();
    this.redraw();
  }

  resize() {
    const { clientWidth: w, clientHeight: h } = this.elements.stage;
    if (w === 0 || h === 0) return;
    this.renderer.setSize(w, h, false);
    this.camera.resize(w, h);
    this.redraw();
  }

  onMagnification(listener) {
    this.listeners.magnification.push(listener);
  }
  onField(listener) {
    this.listeners.field.push(listener);
  }
  onLinks(listener) {
    this.listeners.links.push(listener);
  }
  onPlots(listener) {
    this.listeners.plots.push(listener);
  }
  tell(what) {
    for (const listener of this.listeners[what]) listener();
    this.redraw();
  }

  setMagnification(value) {
    this.magnification = Math.min(1e5, Math.max(1, Number.isFinite(value) ? value : 1));
    this.tell('magnification');
  }

  setField(field) {
    this.field = field;
    this.bare = this.bodies.setField(field);
    this.tell('field');
  }

  /// Whether other results are beside the shown one, across the picture as it is now,
  /// rather than in its place.
  setBeside(isSo) {
    this.isBeside = isSo && this.ghosts.length > 0;
    this.camera.eye.updateMatrixWorld();
    const across = new THREE.Vector3().setFromMatrixColumn(this.camera.eye.matrixWorld, 0);
    const { lower, upper } = this.box;
    const width = upper.reduce((sum, u, c) => sum + Math.abs(across.getComponent(c)) * (u - lower[c]), 0);
    this.ghosts.forEach((ghost, g) => {
      ghost.group.position.copy(across).multiplyScalar(this.isBeside ? 1.1 * width * (g + 1) : 0);
    });
    const corners = [lower, upper].flatMap((corner) => [{ x: 0, y: 0, z: 0 },
      ...this.ghosts.map(({ group }) => group.position)].map(
      ({ x, y, z }) => [corner[0] + x, corner[1] + y, corner[2] + z]));
    const box = {
      lower: [0, 1, 2].map((c) => Math.min(...corners.map((corner) => corner[c]))),
      upper: [0, 1, 2].map((c) => Math.max(...corners.map((corner) => corner[c]))),
    };
    Object.assign(this.camera.box, box);
    this.camera.frame();
    this.tell('links');
  }

  /// @param name of kMaps
  setMap(name) {
    this.map = this.marks.map = name;
    fillMap(this.colourMap, name);
    this.tell('field');
  }

  setScalePerFrame(isSo) {
    this.scalePerFrame = isSo;
    this.tell('field');
  }

  showLink(link, isShown) {
    link.group.visible = isShown;
    this.isolated = null;
    this.tell('links');
  }

  isolate(link) {
    this.isolated = this.isolated === link ? null : link;
    for (const other of this.bodies.links) {
      other.group.visible = this.isolated === null || other === link;
    }
    this.tell('links');
  }

  clearLink(link) {
    link.isClear = !link.isClear;
    link.material.transparent = link.isClear;
    link.material.opacity = link.isClear ? 0.25 : 1;
    link.material.depthWrite = !link.isClear;
    link.material.needsUpdate = true;
    this.tell('links');
  }

  follow(link) {
    this.followed = link;
    this.camera.follow(link ? () => this.toPicture(link.group.position).toArray() : null);
    this.tell('links');
  }

  redraw() {
    this.isStale = true;
  }

  /// From the world to what the camera sees.
  toPicture(place) {
    return place.clone().add(this.world.position);
  }

  moveHome(time) {
    this.home = this.motion.home(locate(this.motion.times, time));
    this.world.position.set(...this.home.map((value) => -value));
  }

  /// Largest value of the field, of the run or of this moment.
  findMost() {
    if (!this.scalePerFrame) return this.ranges.most[this.field];
    if (this.field === kStressField) return this.bodies.largestStress;
    return findRangesAt(this.motion, this.player.time)[this.field];
  }

  updateColours() {
    this.shared.limberMagnification.value = this.magnification;
    const most = this.findMost();
    this.shared.limberRange.value.set(0, most > 0 ? most : 1);
    const scope = this.scalePerFrame ? 'of this moment' : 'of the whole run';
    this.legend = makeLegend(this.field, most, scope, this.map, this.bare);
    const text = JSON.stringify(this.legend);
    if (text === this.legendText) return;
    this.legendText = text;
    showLegend(this.elements.legend, this.legend);
  }

  draw() {
    const { time } = this.player;
    this.isStale = false;
    this.moveHome(time);
    this.bodies.update(time, this.magnification, this.field);
    for (const ghost of this.ghosts) ghost.update(time, this.magnification);
    this.marks.update(time, this.magnification);
    this.camera.update();
    for (const one of [this.bodies, ...this.ghosts]) {
      one.chooseDetail((place) =>
        this.camera.findScale(this.toPicture(place), this.elements.stage.clientHeight));
    }
    this.updateColours();
    this.movePicked(time);
    this.moveSun();
    this.renderer.render(this.scene, this.camera.eye);
    const { clientWidth: w, clientHeight: h } = this.elements.stage;
    this.names.update(this.camera.eye, w, h);
  }

  // From above the left shoulder of who looks.
  moveSun() {
    const { eye, controls } = this.camera;
    eye.updateMatrixWorld();
    const across = new THREE.Vector3().setFromMatrixColumn(eye.matrixWorld, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(eye.matrixWorld, 1);
    const far = eye.position.distanceTo(controls.target);
    this.sun.target.position.copy(controls.target);
    this.sun.position
      .copy(eye.position)
      .addScaledVector(across, -0.4 * far)
      .addScaledVector(up, 0.5 * far);
  }

  movePicked(time) {
    this.picked.visible = Boolean(this.pick && this.pick.node >= 0);
    if (!this.picked.visible) return;
    this.picked.position.set(
      ...this.motion.position(this.pick.body, this.pick.node, time, this.magnification));
  }
}
