// SPDX-License-Identifier: BSD-3-Clause
// Motion with Maxwell elements, by every integrator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/integrators/make_integrator.hpp"
#include "limber/dynamics/simulation/modal_loads.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/interpolation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::maxwell_motion_test {
namespace {

constexpr double kLossFactor = 0.1;
constexpr double kLowest = 10.0;  // [rad/s]
constexpr int kModes = 3;         // 10, 15, 20 rad/s

flexbody::MaxwellElements find_elements() {
  return flexbody::find_maxwell_elements(kLossFactor, {kLowest, 20.0});
}

testing::PointMassBody make_body(bool is_clamped) {
  testing::PointMassBody body =
      testing::make_point_mass_body(12, kModes, 1.0, 1.0, kLowest, 3);
  body.reduced.clamped = is_clamped;
  return body;
}

SystemModel make_model(bool is_clamped, Fidelity level = Fidelity::coupled) {
  SystemBuilder builder;
  builder.add_flexible_body("bar", share(make_body(is_clamped)), level,
                            {.maxwell = find_elements()});
  return builder.build();
}

// A deflected body, let go.
SystemState deflect(const SystemModel& model) {
  SystemState state = make_state(model);
  state.eta << 0.01, -0.004, 0.003;
  return state;
}

// The same equations of one mode, integrated here by the midpoint rule with
// extrapolation from very small steps.
struct Oscillation {
  double q, v;
  VectorX d;
};
Oscillation integrate(double lambda, double q0, double time, int steps) {
  const flexbody::MaxwellElements e = find_elements();
  const auto slope = [&](const Oscillation& x) {
    return Oscillation{
        x.v, -lambda * (x.q + e.strengths.dot(x.d)),
        VectorX::Constant(e.size(), x.v) - x.d.cwiseQuotient(e.times)};
  };
  const auto move = [](const Oscillation& x, const Oscillation& k, double h) {
    return Oscillation{x.q + h * k.q, x.v + h * k.v, x.d + h * k.d};
  };
  Oscillation x{q0, 0.0, VectorX::Zero(e.size())};
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Oscillation a = slope(x);
    const Oscillation b = slope(move(x, a, 0.5 * h));
    const Oscillation c = slope(move(x, b, 0.5 * h));
    const Oscillation d = slope(move(x, c, h));
    x = move(move(move(move(x, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
  }
  return x;
}

SystemState run(const SystemModel& model, IntegratorKind kind, double end,
                int steps) {
  SystemState state = deflect(model);
  SimulationSettings settings;
  settings.integrator = kind;
  settings.end_time = end;
  settings.step = end / steps;
  settings.rho_inf = 1.0;
  simulate(model, state, settings, {});
  return state;
}

std::vector<IntegratorKind> list_schemes() {
  std::vector<IntegratorKind> schemes;
  for (const std::string& name : integrator_names()) {
    schemes.push_back(parse_integrator(name));
  }
  return schemes;
}

// Of a clamped body without couplers, for any step.
bool moves_modes_exactly(IntegratorKind kind) {
  return kind == IntegratorKind::splitting ||
         kind == IntegratorKind::explicit_euler;
}

class MaxwellMotionBy : public ::testing::TestWithParam<IntegratorKind> {};

INSTANTIATE_TEST_SUITE_P(EveryScheme, MaxwellMotionBy,
                         ::testing::ValuesIn(list_schemes()),
                         [](const auto& i) {
                           std::string name = to_string(i.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(MaxwellMotionBy, ConvergesToTheEquationsWithItsOrder) {
  const SystemModel model = make_model(true);
  const VectorX& lambda = flexbody::rest_stiffness(model.bodies[0].elasticity);
  constexpr double kEnd = 0.7;
  const int order = traits_of(GetParam()).order;
  const int steps = order == 1 ? 8000 : order == 2 ? 600 : 60;
  const auto find_error = [&](int n) {
    const SystemState state = run(model, GetParam(), kEnd, n);
    double error = 0.0;
    for (int k = 0; k < kModes; ++k) {
      const Oscillation exact =
          integrate(lambda[k], deflect(model).eta[k], kEnd, 4000);
      error = std::hypot(error, state.eta[k] - exact.q);
      for (Eigen::Index j = 0; j < exact.d.size(); ++j) {
        error = std::hypot(error, state.maxwell[j * kModes + k] - exact.d[j]);
      }
    }
    return error;
  };
  if (moves_modes_exactly(GetParam())) {
    for (const int few : {1, 7, 60}) EXPECT_LT(find_error(few), 1e-12) << few;
    return;
  }
  const double coarse = find_error(steps);
  const double fine = find_error(2 * steps);
  EXPECT_LT(fine, order == 1 ? 1e-4 : 2e-6);
  EXPECT_NEAR(std::log2(coarse / fine), order, 0.15) << coarse << ' ' << fine;
}

TEST_P(MaxwellMotionBy, EnergyIsThatLostInItsDampers) {
  const SystemModel model = make_model(true);
  const double start = calc_energy(model, deflect(model)).total();
  const auto find_imbalance = [&](int n) {
    SystemState state = deflect(model);
    SimulationSettings settings;
    settings.integrator = GetParam();
    settings.rho_inf = 1.0;
    const auto integrator = make_integrator(model, settings);
    const double h = 1.0 / n;
    integrator->start(state, h);
    double dissipated = 0.0;
    for (int i = 0; i < n; ++i) {
      dissipated += integrator->step(state, h, (i + 1) * h).dissipated;
    }
    const double end = calc_energy(model, state).total();
    EXPECT_LT(end, 0.8 * start);
    return std::abs(end + dissipated - start) / start;
  };
  const int order = traits_of(GetParam()).order;
  if (GetParam() == IntegratorKind::energy_conserving ||
      GetParam() == IntegratorKind::splitting) {
    EXPECT_LT(find_imbalance(50), 1e-14);
    EXPECT_LT(find_imbalance(1000), 1e-13);
    return;
  }
  const double coarse = find_imbalance(order == 1 ? 4000 : 100);
  const double fine = find_imbalance(order == 1 ? 8000 : 200);
  EXPECT_LT(fine, order == 1 ? 2e-2 : 2e-3);
  EXPECT_LT(fine, 0.6 * coarse);
}

// From rest in the deformed body's equilibrium nothing moves.
TEST_P(MaxwellMotionBy, TranslationIsNotDamped) {
  const SystemModel model = make_model(false);
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W = {3.0, -1.0, 2.0};
  SimulationSettings settings;
  settings.integrator = GetParam();
  settings.end_time = 1.0;
  settings.step = 1e-3;
  simulate(model, state, settings, {});
  EXPECT_NEAR((state.bodies[0].v_WB_W - Vector3(3.0, -1.0, 2.0)).norm(), 0.0,
              1e-13);
  EXPECT_LT(state.maxwell.cwiseAbs().maxCoeff(), 1e-15);
}

// A free body that tumbles, whose modes and rotation drive each other, against
// runge-kutta-4 with small steps.
TEST_P(MaxwellMotionBy, ConvergesWithItsOrderInATumblingBody) {
  const SystemModel model = make_model(false);
  constexpr double kEnd = 0.5;
  const auto find_end = [&](IntegratorKind kind, int steps) {
    SystemState state = deflect(model);
    state.bodies[0].w_WB_B = {0.8, 0.5, -0.4};
    state.maxwell.setLinSpaced(-1e-3, 2e-3);
    SimulationSettings settings;
    settings.integrator = kind;
    settings.end_time = kEnd;
    settings.step = kEnd / steps;
    settings.rho_inf = 1.0;
    simulate(model, state, settings, {});
    return state;
  };
  const SystemState exact = find_end(IntegratorKind::runge_kutta_4, 2000);
  const auto find_error = [&](int steps) {
    const SystemState state = find_end(GetParam(), steps);
    return (state.eta - exact.eta).norm() +
           (state.maxwell - exact.maxwell).norm() +
           (state.bodies[0].w_WB_B - exact.bodies[0].w_WB_B).norm();
  };
  const int order = traits_of(GetParam()).order;
  const int steps = order == 1 ? 4000 : order == 2 ? 200 : 30;
  const double coarse = find_error(steps);
  const double fine = find_error(2 * steps);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(std::log2(coarse / fine), order, 0.2) << coarse << ' ' << fine;
}

// Internal damping keeps the momenta of a tumbling body, and takes energy only
// while it deforms.
TEST(MaxwellMotion, KeepsMomentaOfATumblingBody) {
  const SystemModel model = make_model(false);
  SystemState state = deflect(model);
  state.bodies[0].v_WB_W = {0.3, -0.1, 0.2};
  state.bodies[0].w_WB_B = {0.8, 0.5, -0.4};
  const EnergyBalance start = calc_energy(model, state);
  SimulationSettings settings;
  settings.integrator = IntegratorKind::energy_conserving;
  settings.end_time = 5.0;
  settings.step = 1e-2;
  simulate(model, state, settings, {});
  const EnergyBalance end = calc_energy(model, state);
  EXPECT_LT((end.angular_momentum - start.angular_momentum).norm(),
            1e-11 * start.angular_momentum.norm());
  EXPECT_LT((end.linear_momentum - start.linear_momentum).norm(),
            1e-12 * start.linear_momentum.norm());
  EXPECT_LT(end.total(), 0.999 * start.total());
}

TEST(MaxwellMotion, StaticStiffnessIsTheScaledOne) {
  const SystemModel model = make_model(true);
  const VectorX& lambda = flexbody::rest_stiffness(model.bodies[0].elasticity);
  EXPECT_NEAR(lambda[0], find_elements().scale * kLowest * kLowest, 1e-12);
}

TEST(MaxwellMotion, HasNoClosedFormOfModes) {
  EXPECT_FALSE(has_closed_modal_loads(make_model(true, Fidelity::uncoupled),
                                      BodyIndex{0}));
}

TEST(MaxwellMotion, IsInterpolatedBetweenTheEndsOfAStep) {
  const SystemModel model = make_model(true);
  SystemState begin = deflect(model);
  SystemState end = begin;
  end.t = 0.1;
  end.maxwell.setConstant(2.0);
  SystemState state = begin;
  interpolate(model, begin, end, 0.25, state);
  EXPECT_EQ(state.maxwell, VectorX::Constant(model.maxwell_count, 0.5));
}

}  // namespace
}  // namespace limber::dynamics::maxwell_motion_test
