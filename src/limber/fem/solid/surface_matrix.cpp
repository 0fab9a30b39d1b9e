// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/surface_matrix.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"

namespace limber::fem {
namespace {

/// int N_a N_b dA over one face, for all nodes of the element.
MatrixX calc_face_area(const ReferenceElement& element, std::size_t face,
                       const Matrix3X& x) {
  const Quadrature& rule = element.face_rules[face];
  VectorX measure(rule.weights.size());
  for (Eigen::Index q = 0; q < measure.size(); ++q) {
    const MatrixX tangents =
        x * rule.gradients[static_cast<std::size_t>(q)].transpose();
    const Vector3 s = tangents.col(0);
    const Vector3 t = tangents.col(1);
    measure[q] = rule.weights[q] * s.cross(t).norm();
  }
  return rule.shape * measure.asDiagonal() * rule.shape.transpose();
}

void widen(const Matrix3& H, LargestGradient& largest) {
  const Matrix3 strain = 0.5 * (H + H.transpose());
  const Vector3 rotation(H(2, 1) - H(1, 2), H(0, 2) - H(2, 0),
                         H(1, 0) - H(0, 1));
  largest.strain = std::max(
      largest.strain, dense::find_eigenvalues(strain).cwiseAbs().maxCoeff());
  largest.rotation = std::max(largest.rotation, 0.5 * rotation.norm());
}

}  // namespace

SparseMatrix assemble_surface_matrix(const Mesh& mesh) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const ElementBlock& block =
        mesh.blocks[static_cast<std::size_t>(face.block)];
    const auto local = static_cast<std::size_t>(face.face);
    const MatrixX area = calc_face_area(
        *block.element, local, element_positions(mesh, block, face.element));
    const int* nodes = block.element_nodes(face.element);
    // Other functions of the element vanish on the face.
    for (const int a : block.element->faces[local])
      for (const int b : block.element->faces[local])
        entries.emplace_back(nodes[a], nodes[b], area(a, b));
  }
  const auto count = static_cast<Eigen::Index>(mesh.node_count());
  SparseMatrix mesh_surface(count, count);
  mesh_surface.setFromTriplets(entries.begin(), entries.end());
  return mesh_surface;
}

LargestGradient calc_largest_gradient(const Mesh& mesh, const Matrix3X& u) {
  LIMBER_EXPECT(u.cols() == mesh.x.cols());
  LargestGradient largest;
  for (const ElementBlock& block : mesh.blocks) {
    const int count = block.element->node_count;
    for (std::size_t e = 0; e < block.size(); ++e) {
      const Matrix3X x = element_positions(mesh, block, e);
      Matrix3X moved(3, count);
      for (int a = 0; a < count; ++a)
        moved.col(a) = u.col(block.element_nodes(e)[a]);
      for (const MatrixX& local : block.element->stiffness.gradients) {
        const Matrix3 jacobian = x * local.transpose();
        widen(moved * local.transpose() * jacobian.inverse(), largest);
      }
    }
  }
  return largest;
}

}  // namespace limber::fem
