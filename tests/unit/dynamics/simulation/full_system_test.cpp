// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/lattice_chain.hpp"

/// Bodies at level `full` in systems, beside other levels.
namespace limber::dynamics::full_system_test {
namespace {

using testing::LatticeChain;

struct Audit {
  double energy = 0.0;   ///< largest imbalance, of the first total
  double linear = 0.0;   ///< largest change of momentum, of the first
  double angular = 0.0;  ///< largest change of momentum, of the first
  EnergyBalance last;
  SystemState state;
};

Audit audit(const SystemModel& model, SystemState state,
            SimulationSettings settings) {
  for (int i = 0; i <= 50; ++i) {
    settings.output_times.push_back(settings.end_time * i / 50.0);
  }
  const EnergyBalance first = calc_energy(model, state);
  Audit result;
  simulate(model, state, settings,
           [&](const SystemState&, const EnergyBalance& now) {
             const double gap =
                 now.total() + now.dissipated - now.work - first.total();
             result.energy =
                 std::max(result.energy, std::abs(gap) / first.total());
             result.linear =
                 std::max(result.linear,
                          (now.linear_momentum - first.linear_momentum).norm() /
                              first.linear_momentum.norm());
             result.angular = std::max(
                 result.angular,
                 (now.angular_momentum - first.angular_momentum).norm() /
                     first.angular_momentum.norm());
             result.last = now;
           });
  result.state = state;
  return result;
}

const Vector3 kSpin(4.0, -2.0, 1.0);
constexpr auto kCentral = IntegratorKind::central_differences;

class FullChain : public ::testing::TestWithParam<const char*> {
 protected:
  static LatticeChain make() {
    LatticeChain chain;
    chain.last_set = GetParam();
    chain.add(Fidelity::full, 12, {.ratios = {0.02}});
    chain.add(Fidelity::full, 12);
    chain.join(2e4, 3.0);
    return chain;
  }
};

TEST_P(FullChain, KeepsItsMomentaToRoundOffWithCentralDifferences) {
  const LatticeChain chain = make();
  const SystemModel model = chain.build();
  const SystemState start = chain.place(model, 3e-3, kSpin, 2e-3);
  std::vector<Audit> audits;
  for (const double step : {2e-5, 1e-5}) {
    audits.push_back(audit(
        model, start, {.integrator = kCentral, .end_time = 0.1, .step = step}));
    EXPECT_LT(audits.back().linear, 1e-12);
    EXPECT_LT(audits.back().angular, 1e-12);
  }
  EXPECT_GT(audits[0].last.dissipated, 1e-3 * audits[0].last.total());
  EXPECT_NEAR(std::log2(audits[0].energy / audits[1].energy), 2.0, 0.3);
}

TEST_P(FullChain, KeepsItsMomentaAtSecondOrderWithImplicitSteps) {
  const LatticeChain chain = make();
  const SystemModel model = chain.build();
  const SystemState start = chain.place(model, 3e-3, kSpin, 2e-3);
  std::vector<Audit> audits;
  for (const double step : {1e-4, 5e-5}) {
    audits.push_back(
        audit(model, start, {.end_time = 0.05, .step = step, .rho_inf = 1.0}));
    EXPECT_LT(audits.back().linear, 1e-11);
  }
  EXPECT_NEAR(std::log2(audits[0].angular / audits[1].angular), 2.0, 0.3);
  EXPECT_NEAR(std::log2(audits[0].energy / audits[1].energy), 2.0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(JoinedAt, FullChain,
                         ::testing::Values("last", "edge", "node"),
                         [](const auto& i) { return std::string(i.param); });

// A full link between a coupled and a rigid one.
LatticeChain make_mixed() {
  LatticeChain chain;
  chain.add(Fidelity::coupled, 12);
  chain.add(Fidelity::full, 12, {.ratios = {0.01}});
  chain.join(2e4, 1.0);
  chain.add(Fidelity::rigid, 0);
  chain.join(1e4, 2.0);
  return chain;
}

TEST(MixedChain, KeepsItsMomentaAndItsEnergyToTheSchemesOrder) {
  const LatticeChain chain = make_mixed();
  const SystemModel model = chain.build();
  const SystemState start = chain.place(model, 3e-3, kSpin, 2e-3);
  for (const auto kind : {IntegratorKind::generalized_alpha, kCentral}) {
    std::vector<Audit> audits;
    for (const double step : {4e-5, 2e-5}) {
      audits.push_back(audit(model, start,
                             {.integrator = kind,
                              .end_time = 0.05,
                              .step = step,
                              .rho_inf = 1.0}));
      EXPECT_LT(audits.back().linear, 1e-11);
    }
    EXPECT_NEAR(std::log2(audits[0].angular / audits[1].angular), 2.0, 0.3);
    EXPECT_NEAR(std::log2(audits[0].energy / audits[1].energy), 2.0, 0.3);
  }
}

double find_distance(const SystemState& a, const SystemState& b) {
  double sum = (a.u_H - b.u_H).squaredNorm() + (a.eta - b.eta).squaredNorm();
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    sum +=
        (a.bodies[i].p_WB - b.bodies[i].p_WB).squaredNorm() +
        std::pow(0.1 * a.bodies[i].quat_WB.angularDistance(b.bodies[i].quat_WB),
                 2);
  }
  return std::sqrt(sum);
}

// Two schemes that share no line but the forces.
TEST(MixedChain, ImplicitStepsConvergeToRungeKuttasAnswerAtTheirOrder) {
  const LatticeChain chain = make_mixed();
  const SystemModel model = chain.build();
  const SystemState start = chain.place(model, 3e-3, kSpin, 2e-3);
  const auto run = [&](IntegratorKind kind, double step) {
    return audit(model, start,
                 {.integrator = kind,
                  .end_time = 0.02,
                  .step = step,
                  .rho_inf = 0.9})
        .state;
  };
  const SystemState exact = run(IntegratorKind::runge_kutta_4, 5e-6);
  EXPECT_LT(find_distance(run(IntegratorKind::runge_kutta_4, 1e-5), exact),
            1e-8);
  struct Case {
    IntegratorKind kind;
    double order;
    double step;
  };
  for (const Case& c : {Case{IntegratorKind::generalized_alpha, 2.0, 2e-5},
                        Case{kCentral, 2.0, 2e-5},
                        Case{IntegratorKind::implicit_euler, 1.0, 1e-6}}) {
    const double coarse = find_distance(run(c.kind, c.step), exact);
    const double fine = find_distance(run(c.kind, 0.5 * c.step), exact);
    EXPECT_NEAR(std::log2(coarse / fine), c.order, 0.2) << to_string(c.kind);
  }
}

// Modes of an `uncoupled` link are answered in closed form beside the steps of
// the full one.
TEST(MixedChain, MovesBesideModesInClosedForm) {
  for (const bool exact : {true, false}) {
    LatticeChain chain;
    chain.add(Fidelity::uncoupled, 6);
    chain.add(Fidelity::full, 6);
    chain.builder.set_gravity({0.0, 0.0, -9.81});
    const SystemModel model = chain.build();
    SystemState state = chain.place(model, 0.0, Vector3::Zero(), 1e-3);
    const SystemState start = state;
    std::vector<SystemState> states;
    const SimulationStatistics statistics =
        simulate(model, state,
                 {.end_time = 0.1,
                  .step = 1e-4,
                  .output_times = {0.0, 0.05, 0.1},
                  .exact_modes = exact},
                 [&](const SystemState& now, const EnergyBalance&) {
                   states.push_back(now);
                 });
    EXPECT_EQ(statistics.exact_modes, exact ? 6 : 0);
    ASSERT_EQ(states.size(), 3U);
    const Vector3 fall(0.01, 0.02, -0.03 - 0.5 * 9.81 * 0.01);
    for (const std::size_t b : {0U, 1U}) {
      EXPECT_LT((states[2].bodies[b].p_WB - start.bodies[b].p_WB - fall).norm(),
                1e-9);
      EXPECT_LT((state.bodies[b].p_WB - start.bodies[b].p_WB - fall).norm(),
                1e-9);
    }
    EXPECT_GT((states[2].u_H - start.u_H).norm(), 0.01);
    EXPECT_EQ(states[2].u_H, state.u_H);
  }
}

TEST(MixedChain, ClampedFullBodyMovesBesideModesInClosedForm) {
  const testing::SpringNetwork network =
      testing::make_lattice({.is_clamped = true});
  SystemBuilder builder;
  const auto reduced = testing::make_reduced(network, 6);
  builder.add_flexible_body("modal", reduced, Fidelity::uncoupled, {});
  builder.add_full_body("whole", reduced, testing::make_full(network), {});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  place_nodes(model, 1e-6 * reduced->rows.Phi_B.col(0), {}, state);
  const double end = 1.0 / std::sqrt(reduced->lambda[0]);
  simulate(model, state,
           {.integrator = IntegratorKind::runge_kutta_4,
            .end_time = end,
            .step = 1e-5},
           {});
  EXPECT_LT(
      (state.u_H - std::cos(1.0) * 1e-6 * reduced->rows.Phi_B.col(0)).norm(),
      1e-9 * 10.0);
}

}  // namespace
}  // namespace limber::dynamics::full_system_test
