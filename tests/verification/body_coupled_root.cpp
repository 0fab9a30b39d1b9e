// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/mesh/node_weights.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/flexbody/model/interface_motion.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// The table of design.md, section 1: the report's beam, its root held by a
/// stiff coupler, a force across its tip; reduced against full. The table is
/// for interfaces whose nodes weigh the same: by area, free-free eigenmodes
/// alone give 0.678 and 1.307 (10), 0.816 and 1.145 (20) instead.
namespace limber::body_coupled_root {
namespace {

/// [N/m], [N m/rad]: 1e4 times the beam's own axial stiffness.
constexpr double kCoupler = 4e14;

struct Answer {
  double tip = 0.0;     ///< deflection per unit force [m/N]
  double lambda = 0.0;  ///< lowest eigenvalue [rad^2/s^2]
};

Answer solve(const MatrixX& M, const MatrixX& K, const VectorX& tip) {
  const VectorX answer = dense::solve(K, tip);
  return {tip.dot(answer), dense::find_eigenpairs(K, M).values[0]};
}

/// Rigid velocities at a point p_B: [I, -skew(p)] over [0, I].
Matrix6 rigid_table(const Vector3& p_B) {
  Matrix6 table = Matrix6::Identity();
  table.topRightCorner<3, 3>() = -skew(p_B);
  return table;
}

Answer solve_reduced(int eigenmodes, bool root, bool tip) {
  flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
  recipe.basis.eigenmodes = eigenmodes;
  recipe.interfaces = {
      {"root", flexbody::GroupNodes{"root"}, flexbody::Weighting::equal, root},
      {"tip", flexbody::GroupNodes{"tip"}, flexbody::Weighting::equal, tip}};
  const auto body = flexbody::reduce(recipe);
  const Eigen::Index m = body.lambda.size();
  EXPECT_EQ(m, eigenmodes + (root ? 6 : 0) + (tip ? 6 : 0));
  MatrixX M = MatrixX::Identity(6 + m, 6 + m);
  M.topLeftCorner<3, 3>() *= body.mass;
  M.block<3, 3>(3, 3) = body.inertia();
  MatrixX K = MatrixX::Zero(6 + m, 6 + m);
  K.bottomRightCorner(m, m) = body.lambda.asDiagonal();
  std::vector<Matrix6X> tables;
  for (const auto& interface : body.interfaces) {
    Matrix6X table(6, 6 + m);
    table.leftCols<6>() = rigid_table(interface.p_B);
    table.topRightCorner(3, m) = interface.Phi_B;
    table.bottomRightCorner(3, m) = interface.Psi_B;
    tables.push_back(table);
  }
  K += kCoupler * tables[0].transpose() * tables[0];
  return solve(M, K, tables[1].row(0).transpose());
}

Answer solve_full() {
  const fem::Mesh mesh = fem::read_mesh(test::beam_file("beam579_v41.msh"));
  const auto matrices = fem::assemble(mesh, {{200e9, 0.0, 8000.0}});
  const auto motion = [&](const std::string& name) {
    const auto selection = fem::weigh_equally(
        mesh, mesh.groups[fem::find_group(mesh, name)].nodes);
    return flexbody::InterfaceMotion(selection.nodes, selection.weights,
                                     selection.moments, mesh.x,
                                     mesh.size().maxCoeff());
  };
  const MatrixX lower = matrices.K;
  MatrixX K = lower.selfadjointView<Eigen::Lower>();
  const MatrixX M =
      fem::multiply_mass(matrices.M_s, MatrixX::Identity(K.rows(), K.cols()));
  const MatrixX root = motion("root").spread(Matrix6::Identity());
  K += kCoupler * root * root.transpose();
  return solve(M, K, motion("tip").spread(Matrix6::Identity()).col(0));
}

TEST(BodyHeldByItsRoot, MatchesTheDesignsTableOfBases) {
  struct Row {
    int eigenmodes;
    bool root, tip;
    double deflection, frequency;
    double deflection_unit, frequency_unit;  ///< of the last printed digit
  };
  const std::vector<Row> table{
      {10, false, false, 0.644, 1.353, 1e-3, 1e-3},
      {20, false, false, 0.777, 1.185, 1e-3, 1e-3},
      {0, true, false, 0.987, 1.0000, 1e-3, 1e-4},
      {4, true, false, 0.998, 1.0000, 1e-3, 1e-4},
      {0, true, true, 1.0000, 1.0000, 1e-4, 1e-4},
  };
  const Answer full = solve_full();
  for (const Row& row : table) {
    const Answer reduced = solve_reduced(row.eigenmodes, row.root, row.tip);
    SCOPED_TRACE(row.eigenmodes);
    EXPECT_NEAR(reduced.tip / full.tip, row.deflection,
                2.0 * row.deflection_unit);
    EXPECT_NEAR(std::sqrt(reduced.lambda / full.lambda), row.frequency,
                2.0 * row.frequency_unit);
  }
}

}  // namespace
}  // namespace limber::body_coupled_root
