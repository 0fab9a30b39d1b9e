// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "limber/common/types.hpp"
#include "limber/fem/mesh/reference_element.hpp"

namespace limber::fem {

/// Values of a face's functions at places on it, with weights of quadrature.
struct FaceTable {
  VectorX weights;  ///< area of the reference face [-]
  MatrixX shape;    ///< nodes x places [-]
  MatrixX along_u;  ///< nodes x places, derivatives by u [-]
  MatrixX along_v;  ///< the same by v [-]
};

/// Lagrange functions of an element's face at any place (u, v) on it: its first
/// corner is at (0, 0), the second at (1, 0), the last at (0, 1).
///
/// Equation   N = V^-T m(u, v), V_kj = m_j at node k, m the monomials that the
///            element's functions span on the face
/// Source     [@zienkiewicz2013, ch. 6]
/// Limits     Of third-order triangles without a middle node only the corners
///            are used, with linear functions.
class FaceShape {
 public:
  /// @param element a solid; @param face local index
  FaceShape(const ReferenceElement& element, std::size_t face);

  [[nodiscard]] int corner_count() const { return corners_; }  ///< 3 or 4
  [[nodiscard]] int order() const { return order_; }           ///< [-]
  /// 2 x nodes, u and v of each node, corners first [-]
  [[nodiscard]] const MatrixX& places() const { return places_; }
  /// Functions and derivatives at 2 x k places; weights are not set.
  [[nodiscard]] FaceTable tabulate(const MatrixX& places) const;
  /// The same at a rule of second degree on each of `divisions`^2 equal cells.
  [[nodiscard]] FaceTable make_rule(int divisions) const;

 private:
  int corners_ = 0;
  int order_ = 0;
  MatrixX places_;
  Eigen::Matrix2Xi powers_;  // of u and v in each monomial
  MatrixX inverse_;          // V^-T, nodes x monomials
};

}  // namespace limber::fem
