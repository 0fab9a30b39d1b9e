// SPDX-License-Identifier: BSD-3-Clause
// The orders of all integrators, of rotation, translation and modes one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "support/chain.hpp"

namespace limber::dynamics::integrator_order_test {
namespace {

using testing::Chain;
using testing::make_loaded_chain;

/// Distances of two states, each over all bodies.
struct Distance {
  double rotation = 0.0;     ///< [rad] times the root of two
  double translation = 0.0;  ///< [m]
  double modes = 0.0;        ///< [kg^1/2 m]
};

Distance find_distance(const SystemState& a, const SystemState& b) {
  Distance d;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const Matrix3 turn = a.bodies[i].quat_WB.toRotationMatrix() -
                         b.bodies[i].quat_WB.toRotationMatrix();
    d.rotation = std::hypot(d.rotation, turn.norm());
    d.translation =
        std::hypot(d.translation, (a.bodies[i].p_WB - b.bodies[i].p_WB).norm());
  }
  d.modes = (a.eta - b.eta).norm();
  return d;
}

struct Orders {
  double rotation, translation, modes;
};

Orders find_orders(const Distance& coarse, const Distance& fine) {
  return {std::log2(coarse.rotation / fine.rotation),
          std::log2(coarse.translation / fine.translation),
          std::log2(coarse.modes / fine.modes)};
}

struct Problem {
  SystemModel model;
  SystemState start;
  double rho_inf = 1.0;

  [[nodiscard]] SystemState run(IntegratorKind kind, double step) const {
    SystemState state = start;
    SimulationSettings settings;
    settings.integrator = kind;
    settings.end_time = 0.4;
    settings.step = step;
    settings.rho_inf = rho_inf;
    settings.newton_tolerance = 1e-14;
    simulate(model, state, settings, {});
    return state;
  }
  /// Of steps h, h / 2 and h / 4, against `reference`.
  [[nodiscard]] std::array<Orders, 2> find_orders_of(
      IntegratorKind kind, double h, const SystemState& reference) const {
    std::array<Distance, 3> errors;
    for (std::size_t i = 0; i < 3; ++i) {
      errors[i] = find_distance(run(kind, h / (1 << i)), reference);
    }
    return {find_orders(errors[0], errors[1]),
            find_orders(errors[1], errors[2])};
  }
};

// --- A smooth problem -------------------------------------------------------

Problem make_smooth() {
  const Chain chain =
      make_loaded_chain(2e3, 2.0, Sinusoid{.frequency = 1.0, .phase = 0.4});
  Problem problem{chain.builder.build(), chain.state};
  const Vector3 w(1.0, 0.4, 0.3);
  for (BodyState& body : problem.start.bodies) {
    body.w_WB_B = w;
    body.v_WB_W = w.cross(body.p_WB);
  }
  for (Eigen::Index k = 0; k < problem.start.etadot.size(); ++k) {
    problem.start.etadot[k] = 0.1 * std::cos(static_cast<double>(k));
  }
  return problem;
}

struct Scheme {
  IntegratorKind kind;
  Orders orders;
  double step;  ///< the longest of three [s]
};

void PrintTo(const Scheme& scheme, std::ostream* out) {
  *out << to_string(scheme.kind);
}

std::string name_of(const ::testing::TestParamInfo<Scheme>& info) {
  std::string name = to_string(info.param.kind);
  std::erase(name, '-');
  return name;
}

class IntegratorOrder : public ::testing::TestWithParam<Scheme> {};

TEST_P(IntegratorOrder, IsMetByRotationTranslationAndModes) {
  const Problem problem = make_smooth();
  const SystemState reference =
      problem.run(IntegratorKind::runge_kutta_4, 1e-4);
  const Orders& expected = GetParam().orders;
  EXPECT_EQ(traits_of(GetParam().kind).order, expected.rotation);
  for (const Orders& found :
       problem.find_orders_of(GetParam().kind, GetParam().step, reference)) {
    EXPECT_NEAR(found.rotation, expected.rotation, 0.2);
    EXPECT_NEAR(found.translation, expected.translation, 0.2);
    EXPECT_NEAR(found.modes, expected.modes, 0.2);
  }
}

constexpr std::array kSchemes = {
    Scheme{IntegratorKind::generalized_alpha, {2, 2, 2}, 4e-3},
    Scheme{IntegratorKind::runge_kutta_4, {4, 4, 4}, 8e-3},
    Scheme{IntegratorKind::explicit_euler, {1, 1, 1}, 2e-4},
    Scheme{IntegratorKind::implicit_euler, {1, 1, 1}, 4e-4},
    Scheme{IntegratorKind::energy_conserving, {2, 2, 2}, 4e-3},
    Scheme{IntegratorKind::splitting, {2, 2, 2}, 4e-3},
    Scheme{IntegratorKind::central_differences, {2, 2, 2}, 4e-3}};
static_assert(kSchemes.size() == static_cast<std::size_t>(kLastIntegrator) + 1,
              "the order of each scheme is tested");

INSTANTIATE_TEST_SUITE_P(All, IntegratorOrder, ::testing::ValuesIn(kSchemes),
                         name_of);

// --- Stiff hinges -----------------------------------------------------------

// From unstrained hinges and velocities that do not strain them, so that slow
// motion alone is called for.
Problem make_stiff(double stiffness) {
  const Chain chain =
      make_loaded_chain(stiffness, 0.0, Sinusoid{.frequency = 1.0});
  Problem problem{chain.builder.build(), chain.state, 0.9};
  std::vector<BodyState>& bodies = problem.start.bodies;
  bodies[0].w_WB_B = Vector3(1.0, 0.4, 0.3);
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const Coupler& hinge = problem.model.couplers[i - 1];
    const auto arm = [&](AttachmentIndex at) {
      return problem.model.attachments[static_cast<std::size_t>(at)].p_BF;
    };
    bodies[i].w_WB_B =
        bodies[i - 1].w_WB_B + 0.7 * static_cast<double>(i) * Vector3::UnitX();
    bodies[i].v_WB_W = bodies[i - 1].v_WB_W +
                       bodies[i - 1].w_WB_B.cross(arm(hinge.frame_F)) -
                       bodies[i].w_WB_B.cross(arm(hinge.frame_M));
  }
  return problem;
}

class StiffHinges : public ::testing::TestWithParam<double> {};

TEST_P(StiffHinges, CostNoImplicitSchemeItsOrderInSlowMotion) {
  const Problem problem = make_stiff(GetParam());
  const joints::RelativeMotion first =
      find_relative_motion(problem.model, problem.start, CouplerIndex(1));
  ASSERT_LT(first.p_FM_F.norm() + first.v_FM_F.norm(), 1e-12);
  const SystemState reference =
      problem.run(IntegratorKind::generalized_alpha, 1e-4);
  for (const Scheme& scheme :
       {Scheme{IntegratorKind::generalized_alpha, {2, 2, 2}, 8e-3},
        Scheme{IntegratorKind::implicit_euler, {1, 1, 1}, 2e-3},
        Scheme{IntegratorKind::energy_conserving, {2, 2, 2}, 8e-3}}) {
    for (const Orders& found :
         problem.find_orders_of(scheme.kind, scheme.step, reference)) {
      const auto i = static_cast<std::size_t>(scheme.kind);
      EXPECT_NEAR(found.rotation, scheme.orders.rotation, 0.2)
          << integrator_names()[i];
      EXPECT_NEAR(found.translation, scheme.orders.translation, 0.2)
          << integrator_names()[i];
      EXPECT_NEAR(found.modes, scheme.orders.modes, 0.2)
          << integrator_names()[i];
    }
  }
}

// In units of N/m and N m/rad.
INSTANTIATE_TEST_SUITE_P(FromStiffToRigid, StiffHinges,
                         ::testing::Values(1e9, 1e10, 1e11, 1e12));

}  // namespace
}  // namespace limber::dynamics::integrator_order_test
