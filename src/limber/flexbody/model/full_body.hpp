// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// Material law at level `full`. Both reduce to Hooke's for small strain.
enum class MaterialLaw {
  st_venant_kirchhoff,  ///< linear in Green's strain; softens in compression
  neo_hookean,          ///< compressible; resists collapse
};
/// "st-venant-kirchhoff", "neo-hookean".
[[nodiscard]] std::string_view to_string(MaterialLaw law);
/// @throws InputError naming the nearest.
[[nodiscard]] MaterialLaw parse_material_law(std::string_view name);

/// Nodal mass matrix of a body at level `full`.
enum class NodalMassKind {
  consistent,  ///< int rho N_a N_b dV: as the reduced levels
  lumped,      ///< diagonal, positive, of the same total
};
/// "consistent", "lumped".
[[nodiscard]] std::string_view to_string(NodalMassKind kind);
/// @throws InputError naming the nearest.
[[nodiscard]] NodalMassKind parse_nodal_mass(std::string_view name);

/// Options of level `full`.
struct FullOptions {
  MaterialLaw law = MaterialLaw::st_venant_kirchhoff;
  NodalMassKind mass = NodalMassKind::consistent;
};

/// A named set of weighted nodes of a whole mesh.
struct NodeSet {
  std::string name;
  std::vector<int> nodes;  ///< node indices
  VectorX weights;         ///< w of InterfaceMotion, sum to one [-]
  Matrix3X moments;        ///< y of InterfaceMotion, sum to zero [m]
};

/// Forces, mass and stiffness of a body's whole mesh, with workspace. Not to be
/// shared by threads. Nodal fields are 3 x N, expressed in the body frame.
class FullBodySolver {
 public:
  using Field = Eigen::Ref<Matrix3X>;
  using ConstField = Eigen::Ref<const Matrix3X>;

  FullBodySolver() = default;
  FullBodySolver(const FullBodySolver&) = delete;
  FullBodySolver& operator=(const FullBodySolver&) = delete;
  virtual ~FullBodySolver() = default;

  /// Internal force [N] at displacements u [m] from x_B. @returns the strain
  /// energy [J]. @throws NumericalError naming an inverted element.
  virtual double calc_internal_force(ConstField u, Field force) = 0;
  /// force = M a [N] of accelerations a [m/s^2].
  virtual void multiply_mass(ConstField a, Field force) const = 0;
  /// a = M^-1 force; zero at clamped nodes.
  virtual void divide_mass(ConstField force, Field a) const = 0;
  /// Factors c M + K(u), c in [1/s^2], on the free nodes.
  /// @throws NumericalError if it is not positive definite.
  virtual void factor(ConstField u, double c) = 0;
  /// x <- (c M + K)^-1 x for 3N x k; zero at clamped nodes.
  virtual void solve(Eigen::Ref<MatrixX> x) const = 0;
};

/// A body without reduction: immutable, shared by threads. Finite elements are
/// behind `make_solver`, so that nothing here depends on a mesher or a sparse
/// solver.
///
/// The body frame B is that of the reduced body of the same mesh: the mesh's
/// axes at the undeformed centre of mass of the consistent mass.
struct FullBody {
  Matrix3X x_B;            ///< 3 x N undeformed nodes, relative to the c.m. [m]
  VectorX node_mass;       ///< M_s 1, N [kg]; may be negative at a vertex
  Matrix3X first_moment;   ///< 3 x N, (x_B - its mean) M_s [kg m]
  std::vector<char> held;  ///< N: 1 if the node is clamped
  std::vector<NodeSet> interfaces;
  std::function<std::unique_ptr<FullBodySolver>()> make_solver;

  [[nodiscard]] Eigen::Index node_count() const { return x_B.cols(); }
  [[nodiscard]] bool is_clamped() const {
    return std::find(held.begin(), held.end(), 1) != held.end();
  }
};

/// @throws InputError naming the nearest interface.
[[nodiscard]] const NodeSet& find_node_set(const FullBody& body,
                                           const std::string& name);

}  // namespace limber::flexbody
