// Deformation of surfaces by the processor, for renderers that are the processor
// themselves: they run a vertex shader, with its sum over modes, up to six times a
// node, and fetch textures slowly.
import * as THREE from 'three';

/// sum_k factors[k] shapes[k] into `out`.
export function sumShapes(shapes, factors, out) {
  out.fill(0);
  for (let k = 0; k < shapes.length; ++k) {
    const f = factors[k];
    if (f === 0) continue;
    const shape = shapes[k];
    for (let i = 0; i < out.length; ++i) out[i] += f * shape[i];
  }
}

function addVectors(geometry, name, count) {
  const attribute = new THREE.BufferAttribute(new Float32Array(count), 3);
  attribute.setUsage(THREE.DynamicDrawUsage);
  geometry.setAttribute(name, attribute);
  return attribute;
}

/// Attributes of one body's geometry that take the place of its shader's sums.
export class Deformer {
  /// @param start modal coordinates of the start
  constructor(geometry, shapes, start) {
    this.shapes = shapes;
    const count = geometry.getAttribute('position').array.length;
    this.now = addVectors(geometry, 'limberDeformation', count);
    this.rate = addVectors(geometry, 'limberDeformationRate', count);
    sumShapes(shapes, start, addVectors(geometry, 'limberDeformationStart', count).array);
  }

  /// @param rates modal velocities, or null where no field needs them
  update(eta, magnification, rates) {
    sumShapes(this.shapes, eta.map((value) => magnification * value), this.now.array);
    this.now.needsUpdate = true;
    if (!rates) return;
    sumShapes(this.shapes, rates, this.rate.array);
    this.rate.needsUpdate = true;
  }
}
