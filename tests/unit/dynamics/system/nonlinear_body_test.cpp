// SPDX-License-Identifier: BSD-3-Clause
// Bodies at level `nonlinear`: what they are made of, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/modal_forces.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/dynamics/monitors/linear_limit.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/terms/kinematics.hpp"
#include "support/elastic_kinds.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::nonlinear_body_test {
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

// What its file lacks if it was made before gravity on products was known.
TEST(NonlinearBody, NeedsWhatGravityDoesToItsSecondOrderIfClamped) {
  BentBody bent;
  bent.body.reduced.clamped = true;
  bent.body.reduced.integrals.P = Matrix3X::Zero(3, kModes);
  SystemBuilder builder;
  EXPECT_THAT(refuse([&] { add(bent, builder); }),
              HasSubstr("the second-order effect of gravity"));
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

// Modal forces are the derivatives of a work by the modes, the tangent theirs.
void expect_derivatives(const SystemModel& model, const SystemState& state,
                        const std::function<double(const SystemState&)>& work) {
  SystemTerms terms = make_terms(model);
  constexpr double h = 1e-6;
  const auto find_forces = [&](Eigen::Index k, double step) -> VectorX {
    SystemState moved = state;
    moved.eta[k] += step;
    calc_terms(model, moved, Side::right, terms);
    return terms.bodies[0].modal_force;
  };
  calc_terms(model, state, Side::right, terms);
  const VectorX forces = terms.bodies[0].modal_force;
  MatrixX stiffness = MatrixX::Zero(kModes, kModes);
  add_geometric_stiffness(model, 0, terms, stiffness);
  for (Eigen::Index k = 0; k < kModes; ++k) {
    SystemState more = state;
    SystemState less = state;
    more.eta[k] += h;
    less.eta[k] -= h;
    EXPECT_NEAR(forces[k], (work(more) - work(less)) / (2.0 * h), 1e-6);
    const VectorX slope = (find_forces(k, h) - find_forces(k, -h)) / (2.0 * h);
    EXPECT_LT((slope + stiffness.col(k)).norm(), 1e-6 * (1.0 + slope.norm()));
  }
  EXPECT_GT(stiffness.norm(), 0.1);
}

TEST(NonlinearBody, TakesForcesOnNodesByTheDerivativesOfTheirWork) {
  const BentBody bent;
  SystemBuilder builder;
  const BodyIndex body = add(bent, builder);
  const VectorX forces =
      4.0 * MatrixX::NullaryExpr(3 * 24, 1, [](Eigen::Index i, Eigen::Index) {
        return std::cos(1.7 * double(i));
      });
  builder.add_nodal_load(
      "push", body,
      flexbody::reduce_second_order_load(bent.body.reduced, {0.0}, forces));
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.eta << 0.02, -0.03, 0.05, 0.04;
  MatrixX u(3 * 24, 1);
  expect_derivatives(model, state, [&](const SystemState& at) {
    calc_node_deformations(model, body, {&at, 1}, u);
    return forces.dot(u.col(0));
  });
  // The moment is that about Bo of forces on the moved nodes.
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  calc_node_positions(model, body, {&state, 1}, u);
  Vector3 moment = Vector3::Zero();
  for (int n = 0; n < 24; ++n) {
    moment += Vector3(u.block<3, 1>(3 * n, 0)).cross(forces.segment<3>(3 * n));
  }
  EXPECT_LT((terms.bodies[0].moment_B - moment).norm(), 1e-12);
}

TEST(NonlinearBody, FallsInGravityByTheDerivativesOfItsWorkIfClamped) {
  BentBody bent;
  bent.body.reduced.clamped = true;
  const VectorX& masses = bent.body.masses;
  const auto sum = [&](const MatrixX& rows) {
    Matrix3X all = Matrix3X::Zero(3, rows.cols());
    for (int n = 0; n < 24; ++n) all += masses[n] * rows.middleRows<3>(3 * n);
    return all;
  };
  Matrix3X P(3, kModes + kPairs);
  P << sum(bent.body.reduced.rows.Phi_B),
      sum(bent.body.reduced.manifold->Theta_B);
  bent.body.reduced.integrals.P = P;
  SystemBuilder builder;
  const BodyIndex body = add(bent, builder);
  const Vector3 gravity(1.0, -3.0, 8.0);
  builder.set_gravity(gravity);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.eta << 0.02, -0.03, 0.05, 0.04;
  MatrixX u(3 * 24, 1);
  expect_derivatives(model, state, [&](const SystemState& at) {
    calc_node_deformations(model, body, {&at, 1}, u);
    double work = 0.0;
    for (int n = 0; n < 24; ++n) {
      work += masses[n] * gravity.dot(u.block<3, 1>(3 * n, 0));
    }
    return work;
  });
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

/// The body alone, with its tip.
struct BentArm {
  BentBody bent;
  SystemBuilder builder;
  BodyIndex body = add(bent, builder);
  AttachmentIndex tip = builder.attach_interface(
      "tip", body, bent.tip, {Matrix3::Identity(), bent.tip.p_B});
  SystemModel model = builder.build();
};

TEST(NonlinearBody, TellsOfAnInterfaceThatTurnsTooFar) {
  const BentArm arm;
  SystemState state = make_state(arm.model);
  int near = 0;
  int far = 0;
  for (double scale = 0.0; scale < 10.0; scale += 0.1) {
    state.eta << 0.02, -0.03, 0.05, 0.04;
    state.eta *= scale;
    const double turn =
        Eigen::AngleAxisd(find_frame_motion(arm.model, state, arm.tip).X_WF.R)
            .angle();
    const auto told = describe_large_rotation(arm.model, state, 0);
    EXPECT_EQ(told.has_value(), turn > 0.4) << turn;
    if (turn > 0.4) {
      EXPECT_THAT(*told, HasSubstr(fmt::format("rotated by {:.3g} rad", turn)));
    }
    ++(turn > 0.4 ? far : near);
    if (turn > 2.0) break;
  }
  EXPECT_GT(near, 3);
  EXPECT_GT(far, 3);
}

TEST(NonlinearBody, MovesItsNodesToSecondOrder) {
  const BentArm arm;
  SystemState state = make_state(arm.model);
  state.eta << 0.02, -0.03, 0.05, 0.04;
  MatrixX u(3 * 24, 1);
  calc_node_deformations(arm.model, arm.body, {&state, 1}, u);
  Vector3 mean = Vector3::Zero();
  for (int n = 6; n < 12; ++n) mean += u.block<3, 1>(3 * n, 0) / 6.0;
  const Vector3 moved =
      find_frame_motion(arm.model, state, arm.tip).X_WF.p - arm.bent.tip.p_B;
  EXPECT_LT((mean - moved).norm(), 1e-15);
  MatrixX p(3 * 24, 1);
  calc_node_positions(arm.model, arm.body, {&state, 1}, p);
  const VectorX from = arm.bent.body.reduced.rows.x_B.reshaped();
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
}  // namespace limber::dynamics::nonlinear_body_test
