// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// A body at level `full` without a mesher: point-like and bar-like masses held
/// by springs that are linear in Green's strain,
///
///     W = k (|d|^2 - L^2)^2 / (8 L^2)  a spring,
///
/// so that forces, tangent and modes are sums that a reader can check.
namespace limber::testing {

struct Spring {
  int a = 0;
  int b = 0;
  double stiffness = 0.0;  ///< [N/m]
};

struct SpringNetwork {
  Matrix3X x_B;  ///< 3 x N, from the centre of mass [m]
  MatrixX M_s;   ///< N x N, positive definite, not diagonal [kg]
  std::vector<Spring> springs;
  std::vector<char> held;      ///< N
  double least_stretch = 0.0;  ///< shorter than this fraction of L: inside out

  [[nodiscard]] int size() const { return static_cast<int>(x_B.cols()); }
  [[nodiscard]] VectorX node_mass() const { return M_s.rowwise().sum(); }

  [[nodiscard]] std::vector<Eigen::Index> free_dofs() const;
  /// M (x) I, 3N x 3N.
  [[nodiscard]] MatrixX mass() const;
  /// Forces at u; @returns the energy [J].
  double calc_force(const Eigen::Ref<const Matrix3X>& u,
                    Eigen::Ref<Matrix3X> force) const;
  /// Its derivative, 3N x 3N.
  [[nodiscard]] MatrixX calc_tangent(const Eigen::Ref<const Matrix3X>& u) const;
};

struct LatticeOptions {
  int layers = 4;           ///< of four nodes each, along z
  double edge = 0.1;        ///< of a cell [m]
  double mass = 2.0;        ///< [kg]
  double stiffness = 4e4;   ///< of a spring [N/m]
  bool is_clamped = false;  ///< the first layer
};

/// A square bar of braced cells; no two of its masses and springs are alike, so
/// that no symmetry hides a mistake. Interfaces: "first", "last" (planar),
/// "edge" (a line), "node", "block" (two layers).
SpringNetwork make_lattice(const LatticeOptions& options = {});

std::shared_ptr<const flexbody::FullBody> make_full(
    const SpringNetwork& network);

/// Its reduced body, with rows of all nodes and the lowest `modes` of it.
std::shared_ptr<const flexbody::ReducedBody> make_reduced(
    const SpringNetwork& network, int modes);

}  // namespace limber::testing
