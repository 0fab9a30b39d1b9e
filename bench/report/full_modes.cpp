// SPDX-License-Identifier: BSD-3-Clause
#include "full_modes.hpp"

#include <Eigen/Eigenvalues>

#include "beam.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "sections.hpp"

namespace limber::bench {
namespace {

constexpr Eigen::Index kRigidMotions = 6;

void solve(FullModes& modes, bool is_clamped) {
  const Eigen::Index n = modes.matrices.dof_count();
  const MatrixX M =
      fem::multiply_mass(modes.matrices.M_s, MatrixX::Identity(n, n));
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(
      MatrixX(modes.matrices.K), M);
  const Eigen::Index elastic = is_clamped ? n : n - kRigidMotions;
  modes.lambda = solver.eigenvalues().tail(elastic);
  modes.Phi = solver.eigenvectors().rightCols(elastic);
}

}  // namespace

FullModes find_full_modes(bool is_clamped) {
  FullModes modes;
  modes.mesh = fem::read_mesh(make_recipe().mesh.file);
  const fem::StructuralMatrices whole = fem::assemble(
      modes.mesh,
      fem::assign_materials(modes.mesh, {{"", {kYoung, 0.0, kDensity}}}));
  for (Eigen::Index n = 0; n < modes.mesh.x.cols(); ++n) {
    if (is_clamped && is_at(modes.mesh.x(2, n), 0.0)) continue;
    modes.nodes.push_back(static_cast<int>(n));
  }
  modes.matrices = fem::restrict_to(whole, modes.nodes);
  modes.x = modes.mesh.x(Eigen::all, modes.nodes);
  solve(modes, is_clamped);
  return modes;
}

VectorX load_edge(const FullModes& modes, double x, double z,
                  const Vector3& force) {
  VectorX load = VectorX::Zero(modes.x.size());
  for (Eigen::Index n = 0; n < modes.x.cols(); ++n) {
    if (is_at(modes.x(0, n), x) && is_at(modes.x(2, n), z)) {
      load.segment<3>(3 * n) = force;
    }
  }
  return load;
}

const FullModes& Shared::clamped() {
  if (!clamped_) clamped_ = std::make_unique<FullModes>(find_full_modes(true));
  return *clamped_;
}

const FullModes& Shared::free() {
  if (!free_) free_ = std::make_unique<FullModes>(find_full_modes(false));
  return *free_;
}

const Body& Shared::beam() {
  if (!beam_) beam_ = reduce_beam(make_recipe());
  return beam_;
}

}  // namespace limber::bench
