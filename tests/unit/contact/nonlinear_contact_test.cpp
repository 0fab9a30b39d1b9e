// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "limber/contact/make_contact.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/point_mass_body.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// A ball strikes a body whose surface products of modes move, too.
namespace limber::contact::nonlinear_contact_test {
namespace {

using dynamics::Fidelity;
using dynamics::IntegratorKind;

constexpr int kNodes = 24;
constexpr int kModes = 4;
constexpr int kPairs = 6;  // of three modes
constexpr double kMass = 0.5;
constexpr double kRadius = 0.05;
constexpr SurfaceMaterial kRubber{1e7, 0.3};

MatrixX make_up(Eigen::Index rows, double size, double phase) {
  return MatrixX::NullaryExpr(
      rows, kPairs, [size, phase](Eigen::Index i, Eigen::Index j) {
        return size * std::sin(phase + 1.3 * static_cast<double>(i) +
                               2.1 * static_cast<double>(j));
      });
}

/// @param bend size of the second order; 0: none
std::shared_ptr<const flexbody::ReducedBody> make_body(double bend) {
  limber::testing::PointMassBody body =
      limber::testing::make_point_mass_body(kNodes, kModes, 4.0, 1.0, 60.0, 42);
  flexbody::QuadraticManifold manifold;
  manifold.paired = {1, 2, 3};
  manifold.Q = make_up(3, 30.0 * bend, 0.1);
  manifold.Theta_B = make_up(3 * kNodes, bend, 0.7);
  manifold.S2 = make_up(6, bend, 1.9);
  body.reduced.manifold = manifold;
  return limber::testing::share(body);
}

// A box of 0.4 m; products move it as further modes would.
std::shared_ptr<const MeshSurface> make_mesh_surface(double bend,
                                                     bool has_products) {
  flexbody::ContactSurface box =
      test::make_box_surface(Vector3::Constant(0.2), 3, false);
  std::vector<test::Field> fields = test::make_fields();
  fields.resize(kModes, fields.front());
  for (int pair = 0; has_products && pair < kPairs; ++pair) {
    fields.emplace_back([bend, pair](const Vector3& x) -> Vector3 {
      return bend * Vector3(std::sin(2.0 * x.y() + pair), 0.5 * x.z(),
                            std::cos(3.0 * x.x() - pair));
    });
  }
  test::set_modes(box, fields);
  return std::make_shared<const MeshSurface>(box);
}

struct Impact {
  dynamics::SystemModel model;
  dynamics::SystemState state;
};

Impact make_impact(Fidelity level, double bend, double amplitude) {
  const auto reduced = make_body(bend);
  dynamics::SystemBuilder builder;
  const auto body = builder.add_flexible_body("body", reduced, level, {});
  const auto ball = builder.add_rigid_body(
      "ball", {kMass, 0.4 * kMass * kRadius * kRadius * Matrix3::Identity()});
  const auto mesh_surface =
      make_mesh_surface(bend, level == Fidelity::nonlinear);
  builder.add_pair(
      "body/ball", body, ball,
      make_contact(ContactSide{Shape{mesh_surface, {}}, kRubber, reduced->mass},
                   ContactSide{Shape{Sphere{kRadius}, {}}, kRubber, kMass},
                   ContactParameters{}));
  Impact impact{builder.build(), {}};
  impact.state = make_state(impact.model);
  impact.state.eta.setConstant(amplitude);
  impact.state.bodies[1].p_WB = Vector3(0.05, 0.03, 0.3);
  impact.state.bodies[1].v_WB_W = Vector3(0.1, 0.2, -2.0);
  return impact;
}

struct Outcome {
  dynamics::SystemState state;
  double gain = 0.0;  // of energy [-]
  double momentum_error = 0.0;
  double spin_error = 0.0;
  std::size_t contacts = 0;
};

Outcome strike(Impact impact, IntegratorKind kind, double step) {
  const auto before = calc_energy(impact.model, impact.state);
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::SimulationSettings settings;
  settings.integrator = kind;
  settings.step = step;
  settings.end_time = 0.06;
  settings.newton_tolerance = 1e-12;
  settings.impact_steps = 1.0;  // the order is that of the steps
  simulate(impact.model, impact.state, settings, {}, {}, statistics, {}, {},
           record);
  const auto after = calc_energy(impact.model, impact.state);
  return {impact.state, after.total() / before.total() - 1.0,
          (after.linear_momentum - before.linear_momentum).norm(),
          (after.angular_momentum - before.angular_momentum).norm(),
          record.contacts.size()};
}

double find_distance(const dynamics::SystemState& a,
                     const dynamics::SystemState& b) {
  double largest = (a.eta - b.eta).norm();
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    largest =
        std::max({largest, (a.bodies[i].p_WB - b.bodies[i].p_WB).norm(),
                  a.bodies[i].quat_WB.angularDistance(b.bodies[i].quat_WB)});
  }
  return largest;
}

TEST(NonlinearContact, WithoutSecondOrderIsThatOfLevelCoupled) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::energy_conserving,
        IntegratorKind::runge_kutta_4}) {
    const Outcome bent =
        strike(make_impact(Fidelity::nonlinear, 0.0, 0.02), kind, 2e-4);
    const Outcome plain =
        strike(make_impact(Fidelity::coupled, 0.0, 0.02), kind, 2e-4);
    EXPECT_EQ(plain.contacts, 1U) << to_string(kind);
    EXPECT_EQ(bent.contacts, 1U) << to_string(kind);
    EXPECT_LT(find_distance(bent.state, plain.state), 1e-11) << to_string(kind);
  }
}

// The momentum about the centre of mass to the order of the scheme, or exactly.
TEST(NonlinearContact, KeepsMomentaAtTheOrderOfTheScheme) {
  for (const auto& [kind, order] :
       {std::pair{IntegratorKind::generalized_alpha, 2.0},
        std::pair{IntegratorKind::energy_conserving, 0.0},
        std::pair{IntegratorKind::runge_kutta_4, 4.0}}) {
    const Impact impact = make_impact(Fidelity::nonlinear, 2.0, 0.03);
    const Outcome coarse = strike(impact, kind, 2e-4);
    const Outcome fine = strike(impact, kind, 1e-4);
    EXPECT_EQ(fine.contacts, 1U) << to_string(kind);
    EXPECT_LT(coarse.momentum_error, 1e-13) << to_string(kind);
    EXPECT_LT(fine.momentum_error, 1e-13) << to_string(kind);
    if (order == 0.0) {
      EXPECT_LT(std::max(coarse.spin_error, fine.spin_error), 1e-12);
      continue;
    }
    EXPECT_NEAR(std::log2(coarse.spin_error / fine.spin_error), order, 0.1)
        << to_string(kind);
  }
}

TEST(NonlinearContact, KeepsTheEnergyWithTheEnergyConservingScheme) {
  for (const double step : {4e-4, 2e-4, 1e-4}) {
    const Outcome out = strike(make_impact(Fidelity::nonlinear, 2.0, 0.03),
                               IntegratorKind::energy_conserving, step);
    EXPECT_EQ(out.contacts, 1U);
    EXPECT_NEAR(out.gain, 0.0, 1e-12) << step;
  }
}

TEST(NonlinearContact, DiffersFromThatOfLevelCoupled) {
  const auto end = [](Fidelity level) {
    return strike(make_impact(level, 2.0, 0.03),
                  IntegratorKind::generalized_alpha, 1e-4)
        .state.bodies[1]
        .v_WB_W;
  };
  EXPECT_GT((end(Fidelity::nonlinear) - end(Fidelity::coupled)).norm(), 1e-3);
}

}  // namespace
}  // namespace limber::contact::nonlinear_contact_test
