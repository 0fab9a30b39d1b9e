// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "fem/hyperelastic.hpp"
#include "fem/mesh.hpp"

namespace limber::fem {

/// Internal forces of a whole mesh in large displacement and rotation.
///
/// Equation   f_a = sum_q w_q F S grad N_a,  F = I + sum_a u_a grad N_a^T
/// Source     total Lagrangian, [@belytschko2000, ch. 4]
/// Limits     the gradients at all quadrature points are kept: 1 kB a
///            second-order tetrahedron
///
/// Elements are worked on four at a time, one a lane, and in parallel; the
/// result does not depend on the number of threads.
class NonlinearSolid {
 public:
  /// Room for the forces of single elements. One a thread of the caller.
  struct Workspace {
    std::vector<double> forces;
    std::vector<double> energies;
  };

  /// @param materials one a region of the mesh
  NonlinearSolid(const Mesh& mesh,
                 const std::vector<ElasticMaterial>& materials, Elasticity law);

  [[nodiscard]] Eigen::Index node_count() const { return node_count_; }
  [[nodiscard]] Workspace make_workspace() const;

  /// Internal force [N] at nodal displacements u [m], both 3 x N in the
  /// mesh's axes. @returns the strain energy [J].
  /// @throws NumericalError naming an element that is turned inside out.
  double calc_force(const Eigen::Ref<const Matrix3X>& u,
                    Eigen::Ref<Matrix3X> force, Workspace& workspace) const;

 private:
  static constexpr int kLanes = 4;
  using Lane = Eigen::Array<double, kLanes, 1>;

  /// Four elements of one type. Where one is missing the last is repeated
  /// without measure.
  struct Batch {
    std::size_t nodes = 0;          // of an element
    std::size_t points = 0;         // of an element
    std::vector<int> node;          // nodes x lanes, lanes together
    std::vector<std::size_t> tags;  // of elements, a lane
    std::vector<Lane> gradients;    // points x nodes x 3
    std::vector<Lane> measures;     // points [m^3]
    LameConstants<Lane> lame;
    std::size_t place = 0;  // of its forces in the workspace
  };

  void add_block(const Mesh& mesh, const ElementBlock& block,
                 const std::vector<ElasticMaterial>& materials);
  static void fill_lane(const Mesh& mesh, const ElementBlock& block,
                        std::size_t e, const Quadrature& rule, int lane,
                        Batch& batch);
  void link_nodes();
  double calc_batch(const Batch& batch, const Eigen::Ref<const Matrix3X>& u,
                    double* forces) const;
  [[noreturn]] void refuse(const Batch& batch, const Lane& J) const;

  std::string source_;
  Elasticity law_;
  Eigen::Index node_count_;
  std::vector<Batch> batches_;
  std::size_t force_count_ = 0;
  // Places of the forces on each node, node by node: first_link_ N + 1.
  std::vector<std::size_t> first_link_;
  std::vector<std::size_t> links_;
};

}  // namespace limber::fem
