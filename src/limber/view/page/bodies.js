// The bodies of one result as meshes that a time moves.
import * as THREE from 'three';
import { colourOfLink, kBare } from './colours.js';
import { Deformer } from './deform.js';
import { Detail } from './detail.js';
import { findSemiAxes } from './ellipsoid.js';
import { kDeformationField, kStressField, kVelocityField, makeMaterial } from './material.js';
import { locate } from './motion.js';
import { shorten } from './short_names.js';
import { Stress, stressModesOf } from './stress.js';

function makeSurface({ x, shapes, triangles }) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(x, 3));
  geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
  if (shapes.length > 0) {
    geometry.morphAttributes.position = shapes.map((s) => new THREE.BufferAttribute(s, 3));
    geometry.morphTargetsRelative = true;
  }
  geometry.computeBoundingSphere();
  return geometry;
}

// The surface's geometry, to which attributes of one body can be added.
function makeOwn(shared) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', shared.getAttribute('position'));
  geometry.setIndex(shared.getIndex());
  geometry.morphAttributes = shared.morphAttributes;
  geometry.morphTargetsRelative = shared.morphTargetsRelative;
  geometry.boundingSphere = shared.boundingSphere;
  return geometry;
}

function addStress(geometry, stress) {
  const attribute = new THREE.BufferAttribute(stress.values, 1);
  attribute.setUsage(THREE.DynamicDrawUsage);
  geometry.setAttribute('limberStress', attribute);
}

// Axes of cylinders, cones and capsules are z here, y in three.js.
const upright = (geometry) => geometry.rotateX(Math.PI / 2);

function makeShape(shape, extent) {
  const { kind, size } = shape;
  if (kind === 'mesh') {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(shape.x, 3));
    geometry.setIndex(new THREE.BufferAttribute(shape.triangles, 1));
    return geometry.clone(); // it may be moved, and a ghost has the same
  }
  if (kind === 'box') return new THREE.BoxGeometry(...size);
  if (kind === 'sphere') return new THREE.SphereGeometry(size[0], 32, 16);
  if (kind === 'cylinder') {
    return upright(new THREE.CylinderGeometry(size[0], size[0], size[1], 32));
  }
  if (kind === 'cone') return upright(new THREE.ConeGeometry(size[0], size[1], 32));
  if (kind === 'ellipsoid') return new THREE.SphereGeometry(1, 48, 24).scale(...size);
  if (kind === 'capsule') return upright(new THREE.CapsuleGeometry(size[0], size[1], 8, 24));
  return new THREE.PlaneGeometry(2 * extent, 2 * extent);
}

function makeEllipsoid(body) {
  const [x, y, z] = findSemiAxes(body).map((axis) => new THREE.Vector3(...axis));
  if (x.clone().cross(y).dot(z) < 0) z.negate();
  return new THREE.SphereGeometry(1, 48, 24).applyMatrix4(new THREE.Matrix4().makeBasis(x, y, z));
}

const hasField = ({ modes, stress }, field) =>
  (field !== kDeformationField || modes > 0) && (field !== kStressField || Boolean(stress));

const place = (object, p, q) => {
  object.position.set(...p);
  object.quaternion.set(q[1], q[2], q[3], q[0]);
};

function makeMesh(geometry, material, node) {
  const mesh = new THREE.Mesh(geometry, material);
  mesh.userData.link = node;
  return mesh;
}

/// Meshes of a result's bodies and of what is fixed in the world.
export class Bodies {
  /// @param ghost colour of a ghost, or null
  constructor(result, motion, shared, ghost, extent) {
    this.result = result;
    this.motion = motion;
    this.group = new THREE.Group();
    this.links = []; // what the tree lists
    this.moving = []; // what a time moves
    const start = locate(motion.times, motion.times[0]);
    result.bodies.forEach((body, b) => this.addBody(body, b, { shared, ghost, start, extent }));
    result.shapes
      .filter((shape) => shape.body < 0)
      .forEach((shape) => this.addFixed(shape, { shared: null, ghost, extent }));
    const short = shorten(this.links.map(({ name }) => name));
    this.links.forEach((link, i) => (link.short = short[i]));
  }

  addBody(body, b, { shared, ghost, start, extent }) {
    const link = {
      name: body.name,
      level: body.level,
      colour: ghost ?? colourOfLink(b),
      group: new THREE.Group(),
      body: b,
    };
    const modes = body.surface >= 0 ? body.modes : 0;
    const stressModes = ghost === null && modes > 0 ? stressModesOf(this.result, body) : null;
    const stress = stressModes
      ? new Stress(this.result.surfaces[body.surface], stressModes) : null;
    const material = makeMaterial(
      link.colour, modes, ghost === null ? shared : makeBlank());
    this.setGhost(material, ghost);
    const geometries = this.makeGeometries(body, b, extent);
    if (body.surface >= 0) geometries[0].geometry = makeOwn(geometries[0].geometry);
    if (stress) addStress(geometries[0].geometry, stress);
    const meshes = geometries.map(({ geometry, p, q, needsBake }) => {
      if (needsBake) {
        geometry.applyMatrix4(
          new THREE.Matrix4().compose(
            new THREE.Vector3(...p),
            new THREE.Quaternion(q[1], q[2], q[3], q[0]),
            new THREE.Vector3(1, 1, 1),
          ),
        );
      }
      const mesh = makeMesh(geometry, material, link);
      mesh.frustumCulled = false;
      mesh.userData.body = b;
      mesh.userData.isSurface = body.surface >= 0;
      link.group.add(mesh);
      return mesh;
    });
    const pose = this.motion.pose(b, start);
    const startMatrix = new THREE.Matrix4().compose(
      new THREE.Vector3(...pose.p),
      new THREE.Quaternion(pose.q[1], pose.q[2], pose.q[3], pose.q[0]),
      new THREE.Vector3(1, 1, 1),
    );
    const eta = new Float64Array(modes);
    if (modes > 0) {
      this.motion.eta(b, start, eta);
      material.userData.own.limberStart.value.set(eta);
    }
    link.material = material;
    this.links.push(link);
    this.group.add(link.group);
    this.moving.push({
      b, link, meshes, material, modes, eta, stress, rate: new Float64Array(modes),
      back: startMatrix.invert(),
    });
  }

  /// The field that colours them; those without it are grey.
  /// @returns the names of those
  setField(field) {
    const bare = this.moving.filter((item) => !hasField(item, field));
    for (const item of this.moving) {
      const { material, link } = item;
      const isBare = bare.includes(item);
      const shown = isBare ? 0 : field;
      material.color.set(isBare ? kBare : link.colour);
      if (material.defines.LIMBER_FIELD === shown) continue;
      material.defines.LIMBER_FIELD = shown;
      material.needsUpdate = true;
    }
    return bare.map(({ link }) => link.short);
  }

  /// Whether what is small on the screen is drawn by fewer triangles.
  setDetail(isSo) {
    this.chooseFine();
    for (const item of this.moving) {
      const [{ geometry, userData }] = item.meshes;
      item.detail = isSo && userData.isSurface ? new Detail(geometry) : null;
    }
  }

  /// @param findScale pixels a metre at a point
  chooseDetail(findScale) {
    for (const { detail, link } of this.moving) detail?.choose(findScale(link.group.position));
  }

  chooseFine() {
    for (const { detail } of this.moving) detail?.chooseFine();
  }

  /// Whether the processor deforms the surfaces, or their shaders do.
  setProcessor(isSo) {
    for (const item of this.moving.filter(({ modes }) => modes > 0)) {
      const { b, meshes, material } = item;
      const { shapes } = this.result.surfaces[this.result.bodies[b].surface];
      const start = material.userData.own.limberStart.value;
      item.deformer = isSo ? new Deformer(meshes[0].geometry, shapes, start) : null;
      if (isSo) material.defines.LIMBER_DEFORMED = '';
      else delete material.defines.LIMBER_DEFORMED;
      material.needsUpdate = true;
    }
  }

  makeGeometries(body, b, extent) {
    if (body.surface >= 0) {
      const surface = this.result.surfaces[body.surface];
      surface.geometry ??= makeSurface(surface);
      return [{ geometry: surface.geometry }];
    }
    const shapes = this.result.shapes.filter((shape) => shape.body === b);
    if (shapes.length === 0) return [{ geometry: makeEllipsoid(body) }];
    return shapes.map((shape) => ({
      geometry: makeShape(shape, extent), p: shape.p, q: shape.q, needsBake: true,
    }));
  }

  addFixed(shape, { ghost, extent }) {
    if (ghost !== null) return; // it would cover the shown result's
    const link = {
      name: shape.name, level: 'fixed', colour: 0x8a8f98, group: new THREE.Group(), body: -1,
    };
    link.material = new THREE.MeshLambertMaterial({
      color: link.colour, side: THREE.DoubleSide, flatShading: shape.kind === 'box',
    });
    if (shape.kind === 'plane') this.setPlane(link.material);
    const mesh = makeMesh(makeShape(shape, extent), link.material, link);
    place(link.group, shape.p, shape.q);
    link.group.add(mesh);
    this.links.push(link);
    this.group.add(link.group);
  }

  // Glows, so that its colour is the same on all its sides and in the dark.
  setGhost(material, ghost) {
    if (ghost === null) return;
    material.transparent = true;
    material.opacity = 0.75;
    material.emissive = new THREE.Color(ghost);
    material.emissiveIntensity = 0.6;
    // Where both are in one place, the shown result is in front.
    material.polygonOffset = true;
    material.polygonOffsetFactor = 1;
    material.polygonOffsetUnits = 4;
  }

  setPlane(material) {
    material.transparent = true;
    material.opacity = 0.3;
    material.depthWrite = false;
  }

  /// Places everything at a time; stress only for its field.
  update(t, magnification, field) {
    const at = locate(this.motion.times, t);
    this.largestStress = 0;
    for (const item of this.moving) {
      const { b, link, meshes, material, modes, eta, rate, back } = item;
      const pose = this.motion.pose(b, at);
      place(link.group, pose.p, pose.q);
      link.group.updateMatrix();
      const own = material.userData.own;
      const twist = this.motion.twist(b, at, pose);
      own.limberVelocity.value.set(...twist.v);
      own.limberSpin.value.set(...twist.w);
      own.limberBack.value.multiplyMatrices(back, link.group.matrix);
      if (modes === 0) continue;
      this.motion.eta(b, at, eta);
      this.motion.etadot(b, at, rate);
      own.limberRates.value.set(rate);
      if (item.stress && field === kStressField) {
        const coordinates = this.motion.stressCoordinates(b, at, eta);
        this.largestStress = Math.max(this.largestStress, item.stress.update(coordinates));
        meshes[0].geometry.getAttribute('limberStress').needsUpdate = true;
      }
      item.deformer?.update(eta, magnification, field === kVelocityField ? rate : null);
      for (const mesh of meshes) {
        for (let k = 0; k < modes; ++k) mesh.morphTargetInfluences[k] = magnification * eta[k];
      }
    }
  }
}

// Uniforms of a body that is never coloured by a field.
function makeBlank() {
  return {
    limberMagnification: { value: 1 },
    limberRange: { value: new THREE.Vector2(0, 1) },
    limberMap: { value: null },
  };
}
