// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/hyperelastic.hpp"

namespace limber::fem {

/// Internal forces of a whole mesh in large displacement and rotation.
///
/// Equation   f_a = sum_q w_q F S grad N_a,  F = I + sum_a u_a grad N_a^T
/// Source     total Lagrangian, [@belytschko2000, ch. 4]
/// Limits     the gradients at all quadrature points are stored: 1 kB a
///            second-order tetrahedron
///
/// Elements are processed four at a time (one a SIMD lane) and in parallel; the
/// result does not depend on the number of threads.
class NonlinearSolid {
 public:
  /// Buffers for the forces of single elements. One per calling thread.
  struct Workspace {
    std::vector<double> forces;    ///< [N]
    std::vector<double> energies;  ///< [J]
  };

  /// @param materials one per region of the mesh
  /// @throws InputError by require_law().
  NonlinearSolid(const Mesh& mesh,
                 const std::vector<ElasticMaterial>& materials, Elasticity law);

  [[nodiscard]] Eigen::Index node_count() const { return node_count_; }
  [[nodiscard]] Workspace make_workspace() const;

  /// Internal force [N] at nodal displacements u [m], both 3 x N in the
  /// mesh frame. @returns the strain energy [J].
  /// @throws NumericalError naming an inverted element.
  double calc_force(const Eigen::Ref<const Matrix3X>& u,
                    Eigen::Ref<Matrix3X> force, Workspace& workspace) const;

 private:
  static constexpr int kLanes = 4;
  using Lane = Eigen::Array<double, kLanes, 1>;

  /// Four elements of one type. An incomplete batch repeats its last element
  /// with measure 0.
  struct Batch {
    std::size_t nodes = 0;          // of an element
    std::size_t points = 0;         // of an element
    std::vector<int> node;          // nodes x lanes, lanes together
    std::vector<std::size_t> tags;  // of elements, a lane
    std::vector<Lane> gradients;    // points x nodes x 3
    std::vector<Lane> measures;     // points [m^3]
    LameConstants<Lane> lame;
    // Of a batch with an anisotropic element: 21 of each point, in mesh axes.
    std::vector<std::array<Lane, 21>> constants;
    std::size_t place = 0;  // index of its forces in the workspace
  };

  void add_block(const Mesh& mesh, const ElementBlock& block,
                 const std::vector<ElasticMaterial>& materials);
  static void fill_lane(const Mesh& mesh, const ElementBlock& block,
                        std::size_t e, const Quadrature& rule, int lane,
                        Batch& batch);
  static void fill_constants(const ElasticMaterial& material, const Matrix3X& x,
                             int lane, Batch& batch);
  void link_nodes();
  double calc_batch(const Batch& batch, const Eigen::Ref<const Matrix3X>& u,
                    double* forces) const;
  [[noreturn]] void refuse(const Batch& batch, const Lane& J) const;

  std::string source_;
  Elasticity law_;
  Eigen::Index node_count_;
  std::vector<Batch> batches_;
  std::size_t force_count_ = 0;
  // Indices of the forces on each node, node by node: first_link_ N + 1.
  std::vector<std::size_t> first_link_;
  std::vector<std::size_t> links_;
};

}  // namespace limber::fem
