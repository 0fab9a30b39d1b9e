// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "limber/common/material/anisotropy.hpp"
#include "limber/common/types.hpp"
#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/material.hpp"

namespace limber::fem {

/// Properties of a mesh that make its stiffness matrix ill-conditioned.
struct StiffnessSpread {
  std::string flattest;   ///< tag and type of the element of largest `flatness`
  double flatness = 0.0;  ///< its |J| |J^-1|, J the Jacobian [-]
  double softest = 0.0;   ///< least Young's modulus [Pa]
  double stiffest = 0.0;  ///< largest Young's modulus [Pa]
};

inline constexpr int kMostElementNodes = 64;  ///< a hexahedron of order 3

/// Matrix-free stiffness K of a mesh: products K u summed from the elements'
/// strains. An element's rotation is subtracted from its displacements in
/// extended precision (x86's 64 bits), and the rest has all digits of the
/// strain.
///
/// Equation   f_a = sum_q w_q sigma(H_q) g_a, f_0 = -sum_{a > 0} f_a,
///            H_q = sum_a (u_a - u_0) g_a^T, g_a = grad N_a
/// Source     Hughes, The Finite Element Method, sec. 2.7 and 3.10;
///            K = B^T D B is never multiplied out
/// Limits     A matrix of doubles gives rigid motion forces of eps |K|.
///            A bar of slenderness s bends with s^-4 of |K|, so that eps s^4
///            of its bending stiffness is roundoff: 1e-4 at s = 1000. Here
///            rigid motion has almost no force, which leaves s eps.
class StiffnessProduct {
 public:
  /// @param materials one per region of the mesh
  StiffnessProduct(const Mesh& mesh,
                   const std::vector<ElasticMaterial>& materials);

  /// The same with all nodes fixed except those listed (sorted).
  [[nodiscard]] StiffnessProduct restrict_to(
      const std::vector<int>& nodes) const;

  /// F - K X, rounded at the end. 3N x k. [N for m]
  [[nodiscard]] MatrixX subtract_from(const MatrixX& F, const MatrixX& X) const;

  [[nodiscard]] const StiffnessSpread& spread() const { return spread_; }

 private:
  /// A quadrature point: J^-1 by rows [1/m] and w det J [m^3].
  struct Point {
    std::array<double, 9> inverse;
    double measure;
  };
  struct Element {
    const Quadrature* rule;
    const int* nodes;
    std::size_t first_point;
    int node_count;
    double lambda, mu;  ///< Lame's constants [Pa]
    bool is_anisotropic;
    std::size_t first_constants;  ///< of its first point in `constants`
  };
  struct Elements {
    Matrix3X x;  ///< node positions [m]
    std::vector<ElementBlock> blocks;
    std::vector<Element> list;
    std::vector<Point> points;
    std::vector<Constants21> constants;  ///< in mesh axes [Pa]
  };

  static void add_element(const ElementBlock& block, std::size_t e,
                          const Matrix3X& x, const ElasticMaterial& material,
                          Elements& to);
  void find_spread(const std::vector<ElasticMaterial>& materials);
  /// Vectors at an element's nodes, of C columns whose products are found at
  /// once. Of `u` and `forces`, they are side by side.
  template <int C>
  using NodalColumns =
      std::array<std::array<Eigen::Array<double, C, 1>, 3>, kMostElementNodes>;
  template <int C>
  void subtract_columns(const MatrixX& F, const MatrixX& X, Eigen::Index first,
                        MatrixX& rest) const;
  template <int C>
  void add_forces(const Element& element, const std::vector<double>& u,
                  std::vector<long double>& forces) const;
  template <int C>
  void find_deformation(const Element& element, const std::vector<double>& u,
                        NodalColumns<C>& d) const;

  std::shared_ptr<const Elements> elements_;
  std::vector<int> rows_;  ///< of each node; -1 if fixed
  int row_count_ = 0;
  StiffnessSpread spread_;
};

}  // namespace limber::fem
