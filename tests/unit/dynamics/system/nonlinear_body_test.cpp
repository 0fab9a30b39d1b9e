// SPDX-License-Identifier: BSD-3-Clause
// Bodies at level `nonlinear`: what they are made of, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/kinematics.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/dynamics/monitors/linear_limit.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/elastic_kinds.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics {
namespace {

using ::testing::HasSubstr;

constexpr int kModes = 4;
constexpr int kPairs = 6;  // of three

/// With made-up second-order tables of modes 1, 2 and 3 at every mass.
struct BentBody {
  testing::PointMassBody body =
      testing::make_point_mass_body(24, kModes, 4.0, 1.0, 60.0, 42);
  flexbody::InterfaceTable tip = testing::make_interface(body, 6, 12);

  BentBody() {
    flexbody::QuadraticManifold manifold;
    manifold.paired = {1, 2, 3};
    const auto made_up = [](Eigen::Index rows, double phase) {
      return MatrixX::NullaryExpr(
          rows, kPairs, [phase](Eigen::Index i, Eigen::Index j) {
            return std::sin(phase + 1.3 * static_cast<double>(i) +
                            2.1 * static_cast<double>(j));
          });
    };
    manifold.Q = 30.0 * made_up(3, 0.1);
    manifold.Theta_B = made_up(3 * 24, 0.7);
    manifold.S2 = made_up(6, 1.9);
    body.reduced.manifold = manifold;
    // The mean of its nodes, of equal weights, and any rotation.
    tip.Phi2_B = Matrix3X::Zero(3, kPairs);
    for (int n = 6; n < 12; ++n) {
      tip.Phi2_B += manifold.Theta_B.middleRows<3>(3 * n) / 6.0;
    }
    tip.Psi2_B = made_up(3, 2.3);
  }
};

std::string refuse(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

BodyIndex add(const BentBody& bent, SystemBuilder& builder) {
  return builder.add_flexible_body("arm", testing::share(bent.body),
                                   Fidelity::nonlinear, {});
}

TEST(NonlinearBody, NeedsSecondOrderTables) {
  BentBody bent;
  bent.body.reduced.manifold.reset();
  SystemBuilder builder;
  EXPECT_THAT(refuse([&] { add(bent, builder); }),
              HasSubstr("has no second-order tables"));
}

TEST(NonlinearBody, IsNotClampedYet) {
  BentBody bent;
  bent.body.reduced.clamped = true;
  SystemBuilder builder;
  EXPECT_THAT(refuse([&] { add(bent, builder); }),
              HasSubstr("does not support clamped groups yet"));
}

TEST(NonlinearBody, HasTheElasticityOfItsTablesAlone) {
  const BentBody bent;
  SystemBuilder builder;
  EXPECT_THAT(
      refuse([&] {
        builder.add_flexible_body(
            "arm", testing::share(bent.body), Fidelity::nonlinear, {},
            flexbody::DiagonalStiffness(flexbody::DiagonalStiffness::Parameters{
                bent.body.reduced.lambda}));
      }),
      HasSubstr("elasticity is that of its reduced body"));
}

TEST(NonlinearBody, RefusesInterfacesWithoutTables) {
  BentBody bent;
  bent.tip.Psi2_B.resize(3, 0);
  SystemBuilder builder;
  const BodyIndex body = add(bent, builder);
  EXPECT_THROW(builder.attach_interface("tip", body, bent.tip, {}),
               ContractError);
}

TEST(NonlinearBody, RefusesForcesOnSingleNodes) {
  const BentBody bent;
  SystemBuilder builder;
  const BodyIndex body = add(bent, builder);
  const flexbody::NodalLoad load = flexbody::reduce_nodal_load(
      bent.body.reduced, {0.0}, MatrixX::Ones(3 * 24, 1));
  EXPECT_THAT(refuse([&] { builder.add_nodal_load("push", body, load); }),
              HasSubstr("does not support forces on single nodes yet"));
}

// A load on the interface is the derivative of its work by the modes.
TEST(NonlinearBody, TakesLoadsByTheDerivativesOfItsInterface) {
  const BentBody bent;
  SystemBuilder builder;
  const BodyIndex body = add(bent, builder);
  const AttachmentIndex tip = builder.attach_interface(
      "tip", body, bent.tip,
      {Matrix3::Identity(), bent.tip.p_B + Vector3(0.1, -0.2, 0.3)});
  const Vector3 force(3.0, -2.0, 5.0);
  builder.add_load("push", tip, force, Vector3::Zero(), LoadFrame::world,
                   Constant{});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.eta << 0.02, -0.03, 0.05, 0.04;
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  constexpr double h = 1e-6;
  for (Eigen::Index k = 0; k < kModes; ++k) {
    const auto work = [&](double step) {
      SystemState moved = state;
      moved.eta[k] += step;
      return force.dot(find_frame_motion(model, moved, tip).X_WF.p);
    };
    EXPECT_NEAR(terms.bodies[0].modal_force[k], (work(h) - work(-h)) / (2 * h),
                1e-7);
  }
}

TEST(NonlinearBody, MovesItsNodesToSecondOrder) {
  const BentBody bent;
  SystemBuilder builder;
  const BodyIndex body = add(bent, builder);
  const AttachmentIndex tip = builder.attach_interface(
      "tip", body, bent.tip, {Matrix3::Identity(), bent.tip.p_B});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.eta << 0.02, -0.03, 0.05, 0.04;
  MatrixX u(3 * 24, 1);
  calc_node_deformations(model, body, {&state, 1}, u);
  Vector3 mean = Vector3::Zero();
  for (int n = 6; n < 12; ++n) mean += u.block<3, 1>(3 * n, 0) / 6.0;
  const Vector3 moved =
      find_frame_motion(model, state, tip).X_WF.p - bent.tip.p_B;
  EXPECT_LT((mean - moved).norm(), 1e-15);
  MatrixX p(3 * 24, 1);
  calc_node_positions(model, body, {&state, 1}, p);
  const VectorX from = bent.body.reduced.rows.x_B.reshaped();
  EXPECT_LT((p.col(0) - from - u.col(0)).norm(), 1e-15);
}

// What linear elasticity gives softening by spin for.
TEST(NonlinearBody, HasNoCriticalSpeedOfLinearElasticity) {
  const BentBody bent;
  SystemBuilder builder;
  add(bent, builder);
  const SystemModel model = builder.build();
  EXPECT_EQ(find_softening(model.bodies[0], {1e3, 2e3, -1e3}), 0.0);
}

}  // namespace
}  // namespace limber::dynamics
