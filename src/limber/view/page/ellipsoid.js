// The body of a rigid link without a shape: a solid ellipsoid of its mass and inertia.

/// Principal moments and axes of a symmetric matrix (column by column) by
/// Jacobi's rotations: { moments, axes }, axes[i] a unit vector.
export function findPrincipal(inertia) {
  const a = [0, 1, 2].map((r) => [0, 1, 2].map((c) => inertia[3 * c + r]));
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 30; ++sweep) {
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (a[p][q] === 0) continue;
      const angle = 0.5 * Math.atan2(2 * a[p][q], a[q][q] - a[p][p]);
      const c = Math.cos(angle);
      const s = Math.sin(angle);
      for (let k = 0; k < 3; ++k) {
        [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
      }
      for (let k = 0; k < 3; ++k) {
        [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
        [axes[p][k], axes[q][k]] = [
          c * axes[p][k] - s * axes[q][k], s * axes[p][k] + c * axes[q][k],
        ];
      }
    }
  }
  return { moments: [a[0][0], a[1][1], a[2][2]], axes };
}

const kThinnest = 0.02; // of a thin rod, so that it can be seen

/// Semi-axes as vectors: m a_i^2 / 5 = tr(J) / 2 - J_ii.
export function findSemiAxes({ mass, inertia }) {
  const { moments, axes } = findPrincipal(inertia);
  const half = (moments[0] + moments[1] + moments[2]) / 2;
  const lengths = moments.map((j) => Math.sqrt(Math.max((5 * (half - j)) / mass, 0)));
  const most = Math.max(...lengths, 1e-9);
  return axes.map((axis, i) => axis.map((c) => c * Math.max(lengths[i], kThinnest * most)));
}
