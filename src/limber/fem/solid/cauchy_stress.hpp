// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/hooke.hpp"

namespace limber::fem {

/// Cauchy stress of large deformations at some nodes of a mesh: at quadrature
/// points by the law, fitted over each element and averaged over the elements
/// of one material as in stress_recovery.hpp.
///
/// Equation   sigma = F S F^T / det F, F = I + sum_a u_a grad N_a^T
/// Source     [@bonet2008, sec. 5.5]
class CauchyStress {
 public:
  /// @param materials one per region of the mesh
  /// @param nodes sorted indices
  CauchyStress(const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
               Elasticity law, const std::vector<int>& nodes);

  /// p: the node of each point, increasing. A node at a border of materials has
  /// a point for each of them.
  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }

  /// @param u 3 x N displacements [m], of elements that are not inverted
  /// @param stress 6 x p: components (xx, yy, zz, xy, yz, xz), axes of u [Pa]
  /// Threads may share this object.
  void evaluate(const Eigen::Ref<const Matrix3X>& u,
                Eigen::Ref<Matrix6X> stress) const;

 private:
  // A requested node of an element.
  struct Wanted {
    int point = 0;  // index in nodes_
    VectorX fit;    // a quadrature point, divided by the point's elements
  };
  struct Element {
    std::vector<int> nodes;
    std::vector<Matrix3X> gradients;  // a quadrature point: 3 x nodes [1/m]
    std::vector<Hooke> laws;          // a quadrature point
    std::vector<Wanted> wanted;
  };

  Elasticity law_;
  std::vector<int> nodes_;
  std::vector<Element> elements_;
};

}  // namespace limber::fem
