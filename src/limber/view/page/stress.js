// Von Mises stress at the nodes of surfaces whose results have it.
import { locate } from './motion.js';

/// Components (xx, yy, zz, xy, yz, xz) at all nodes: 6n [Pa].
function addStress(stress, eta, all) {
  all.fill(0);
  for (let k = 0; k < stress.length; ++k) {
    const mode = stress[k];
    const e = eta[k];
    if (e === 0) continue;
    for (let i = 0; i < all.length; ++i) all[i] += e * mode[i];
  }
}

/// Of the six components that begin at s[i].
export function misesAt(s, i) {
  const a = s[i] - s[i + 1];
  const b = s[i + 1] - s[i + 2];
  const c = s[i + 2] - s[i];
  const shear = s[i + 3] * s[i + 3] + s[i + 4] * s[i + 4] + s[i + 5] * s[i + 5];
  return Math.sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear);
}

/// Stress per coordinate of a body: its surface's stress modes, or at level `full`
/// the shapes of its own; undefined without stress.
export function stressModesOf(result, body) {
  return body.stress ?? (body.surface >= 0 ? result.surfaces[body.surface].stress : undefined);
}

/// Of one body; `values` [Pa] are those of the last update.
export class Stress {
  constructor(surface, modes) {
    this.modes = modes;
    this.all = new Float32Array(6 * surface.nodes);
    this.values = new Float32Array(surface.nodes);
  }

  /// @param coordinates Motion.stressCoordinates()
  /// @returns the largest [Pa]
  update(coordinates) {
    addStress(this.modes, coordinates, this.all);
    let most = 0;
    for (let n = 0; n < this.values.length; ++n) {
      this.values[n] = misesAt(this.all, 6 * n);
      most = Math.max(most, this.values[n]);
    }
    return most;
  }
}

/// Components (xx, yy, zz, xy, yz, xz) at one node and time [Pa], in the axes of
/// its body; null if the result has no stress of it.
export function stressComponentsAt(motion, b, node, t) {
  const body = motion.result.bodies[b];
  const stress = stressModesOf(motion.result, body);
  if (!stress) return null;
  const at = locate(motion.times, t);
  const eta = motion.eta(b, at, new Float64Array(body.modes));
  const coordinates = motion.stressCoordinates(b, at, eta);
  return [0, 1, 2, 3, 4, 5].map((c) =>
    stress.reduce((sum, mode, k) => sum + mode[6 * node + c] * coordinates[k], 0));
}

/// Von Mises [Pa], null without stress.
export function stressAt(motion, b, node, t) {
  const s = stressComponentsAt(motion, b, node, t);
  return s && misesAt(s, 0);
}

export const hasStress = (result) => result.bodies.some((body) => stressModesOf(result, body));
