// SPDX-License-Identifier: BSD-3-Clause
// Newton's method where elasticity couples modes: its dense block.
#include "limber/dynamics/bodies/coupled_modes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/newton/retained_bodies.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/elastic_kinds.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::coupled_modes_test {
namespace {

TEST(CoupledModes, SolvesAsTheInverseDoes) {
  for (const Eigen::Index m : {1, 5, 19}) {
    const MatrixX K = testing::make_basis(m, 4);  // neither symmetric nor > 0
    const VectorX diagonal = VectorX::LinSpaced(m, 0.3, 0.4);
    CoupledModes factor(m);
    ASSERT_TRUE(factor.factor(diagonal, K));
    const MatrixX A = K + MatrixX(diagonal.asDiagonal());
    EXPECT_EQ((factor.matrix() - A).norm(), 0.0);
    const MatrixX inverse = dense::find_inverse(A);
    VectorX x = VectorX::LinSpaced(m, -1.0, 2.0);
    const VectorX solved = inverse * x;
    factor.solve(x);
    EXPECT_LE((x - solved).norm(), 1e-11 * solved.norm());
    Matrix6X rows(6, m);
    for (Eigen::Index k = 0; k < m; ++k) {
      for (Eigen::Index i = 0; i < 6; ++i) {
        rows(i, k) = std::sin(static_cast<double>(1 + i + 7 * k));
      }
    }
    Matrix6X answer(6, m);
    factor.solve_rows(rows, answer);
    const Matrix6X expected = rows * inverse.transpose();
    EXPECT_LE((answer - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST(CoupledModes, TellThatTheyAreSingular) {
  CoupledModes factor(2);
  EXPECT_FALSE(factor.factor(VectorX::Zero(2), MatrixX::Zero(2, 2)));
  EXPECT_FALSE(
      factor.factor(VectorX::Constant(2, std::nan("")), MatrixX::Zero(2, 2)));
}

// --- Newton's method --------------------------------------------------------

constexpr int kModes = 5;

struct Scene {
  SystemModel model;
  SystemState state;
};

Scene make_clamped() {
  testing::PointMassBody body =
      testing::make_point_mass_body(24, kModes, 4.0, 1.0, 30.0, 42);
  body.reduced.clamped = true;
  SystemBuilder builder;
  builder.add_flexible_body(
      "arm", share(body), Fidelity::coupled, {},
      testing::make_quadratic_strain(body.reduced.lambda, 4, 0.1, 2));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  return scene;
}

// A body alone: what NewtonMatrix neglects is not there.
TEST(CoupledModes, MakeNewtonsMethodConvergeQuadratically) {
  Scene scene = make_clamped();
  SystemTerms terms = make_terms(scene.model);
  const VectorX none = make_unknowns(scene.model);
  VectorX residual = none;
  VectorX x;
  NewtonMatrix matrix(scene.model);
  const VectorX load = 150.0 * VectorX::LinSpaced(kModes, 1.0, -0.5);
  std::vector<double> sizes;
  for (int i = 0; i < 12; ++i) {
    calc_terms(scene.model, scene.state, Side::right, terms);
    calc_residual(scene.model, none, terms, residual);
    residual.tail(kModes) -= load;
    matrix.factor(scene.model, scene.state, terms, none, {0.0, 0.0});
    matrix.solve(scene.model, terms, residual, x);
    scene.state.eta += x.tail(kModes);
    sizes.push_back(x.tail(kModes).norm() / scene.state.eta.norm());
    if (sizes.back() < 1e-14) break;
  }
  EXPECT_LT(sizes.back(), 1e-14);
  EXPECT_LE(sizes.size(), 9U);
  EXPECT_GT(sizes[1], 0.05);  // far from linear
  int quadratic = 0;
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    if (sizes[i] < 1e-12 || sizes[i - 1] > 0.3) continue;  // round-off, begin
    EXPECT_LT(sizes[i], 10.0 * sizes[i - 1] * sizes[i - 1]);
    ++quadratic;
  }
  EXPECT_GE(quadratic, 2);
}

// --- Many couplers ----------------------------------------------------------

constexpr int kCouplers = 12;

// A body on so many springs that its motion is kept among Newton's unknowns.
Scene make_panel(const MatrixX* basis) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(24, 8, 4.0, 1.0, 30.0, 42);
  flexbody::ReducedBody reduced = body.reduced;
  std::optional<flexbody::ModalElasticity> elasticity;
  if (basis != nullptr) {
    reduced = testing::turn_basis(body.reduced, *basis);
    elasticity = testing::turn_stiffness(body.reduced.lambda, *basis);
  }
  SystemBuilder builder;
  const BodyIndex panel = builder.add_flexible_body(
      "panel", std::make_shared<const flexbody::ReducedBody>(reduced),
      Fidelity::coupled, {}, elasticity);
  for (int i = 0; i < kCouplers; ++i) {
    flexbody::InterfaceTable table = make_interface(body, i, i + 6);
    if (basis != nullptr) table = testing::turn_basis(table, *basis);
    const Pose place{Matrix3::Identity(), table.p_B};
    builder.add_coupler(
        fmt::format("spring {}", i),
        joints::make_joint_bushing(joints::JointKind::fixed, Vector3::UnitX(),
                                   {.translational_stiffness = 3e4,
                                    .rotational_stiffness = 1e3,
                                    .translational_damping = 1.0,
                                    .rotational_damping = 0.1}),
        builder.attach_world("wall", place),
        builder.attach_interface("place", panel, table, place));
  }
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].v_WB_W = Vector3(1.0, -0.5, 0.3);
  scene.state.bodies[0].w_WB_B = Vector3(0.5, 2.0, -1.0);
  return scene;
}

TEST(CoupledModes, OfABodyWithManyCouplersMoveAsThoseThatElasticityLeaves) {
  const MatrixX basis = testing::make_basis(8, 6);
  std::vector<int> links(kCouplers);
  std::iota(links.begin(), links.end(), 0);
  ASSERT_EQ(
      choose_retained_bodies({.links = kCouplers,
                              .links_of_body = {links},
                              .blocks = {3},
                              .sizes = {14},
                              .moves = {true},
                              .grounded = std::vector<bool>(kCouplers, true),
                              .ideal = std::vector<bool>(kCouplers, false),
                              .anchored = std::vector<bool>(kCouplers, true)})
          .size(),
      1U);
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::energy_conserving}) {
    SimulationSettings settings;
    settings.integrator = kind;
    settings.end_time = 0.05;
    settings.step = 1e-3;
    settings.newton_tolerance = 1e-13;
    Scene plain = make_panel(nullptr);
    Scene turned = make_panel(&basis);
    simulate(plain.model, plain.state, settings, {});
    const SimulationStatistics statistics =
        simulate(turned.model, turned.state, settings, {});
    EXPECT_LT((plain.state.bodies[0].p_WB - turned.state.bodies[0].p_WB).norm(),
              1e-10);
    EXPECT_LT((plain.state.eta - basis * turned.state.eta).norm(),
              1e-9 * plain.state.eta.norm());
    EXPECT_GT(plain.state.eta.norm(), 1e-3);
    EXPECT_LT(statistics.newton_iterations, 10 * statistics.steps);
  }
}

}  // namespace
}  // namespace limber::dynamics::coupled_modes_test
