// Fewer triangles for surfaces far away, for renderers that are the processor: their
// time grows with the number of triangles, of any size.
import * as THREE from 'three';

// A triangle on corners and mid-side nodes that is smaller is drawn by its
// face's corners alone [pixels^2].
const kSmall = 6;

/// Corners of faces of six nodes, each of which is four triangles in sequence: its
/// mid-side nodes are in three of them, its corners in one. Null for other faces.
export function findCorners(triangles) {
  if (triangles.length % 12 !== 0) return null;
  const corners = new Uint32Array(triangles.length / 4);
  for (let first = 0; first < triangles.length; first += 12) {
    const four = Array.from(triangles.subarray(first, first + 12));
    const count = (node) => four.filter((other) => other === node).length;
    const middle = [0, 3, 6, 9]
      .map((i) => four.slice(i, i + 3))
      .find((triangle) => triangle.every((node) => count(node) === 3));
    if (!middle) return null;
    // A corner shares a triangle with the two mid-side nodes beside it.
    const found = [0, 1, 2].map((i) => {
      const beside = [middle[i], middle[(i + 1) % 3]];
      const outer = [0, 3, 6, 9].map((at) => four.slice(at, at + 3)).find(
        (triangle) => beside.every((node) => triangle.includes(node)) &&
          triangle.some((node) => count(node) === 1));
      return outer?.find((node) => count(node) === 1);
    });
    if (found.includes(undefined)) return null;
    corners.set(found, first / 4);
  }
  return corners;
}

function findMeanArea(x, triangles) {
  const [a, b, c] = [0, 1, 2].map(() => new THREE.Vector3());
  let area = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    [a, b, c].forEach((point, k) => point.fromArray(x, 3 * triangles[i + k]));
    area += 0.5 * b.sub(a).cross(c.sub(a)).length();
  }
  return (3 * area) / triangles.length;
}

/// The triangles of one geometry, by what they measure on the screen.
export class Detail {
  constructor(geometry) {
    this.geometry = geometry;
    this.fine = geometry.getIndex();
    const corners = findCorners(this.fine.array);
    this.coarse = corners && new THREE.BufferAttribute(corners, 1);
    this.area = findMeanArea(geometry.getAttribute('position').array, this.fine.array);
  }

  /// @param scale pixels a metre where the body is
  choose(scale) {
    const isSmall = this.coarse && this.area * scale * scale < kSmall;
    this.geometry.setIndex(isSmall ? this.coarse : this.fine);
  }

  chooseFine() {
    this.geometry.setIndex(this.fine);
  }
}
