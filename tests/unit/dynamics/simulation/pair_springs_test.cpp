// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/energy_flows.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/paired_bodies.hpp"

/// Springs of a pair are those of as many couplers.
namespace limber::dynamics::pair_springs_test {
namespace {

using testing::make_paired_bodies;
using testing::PairedBodies;

double find_loss(const SystemModel& model, const SystemTerms& terms) {
  EnergyFlows powers = make_flows(model);
  add_powers(terms, 1.0, powers);
  return powers.dissipated.sum();
}

double find_distance(const SystemState& a, const SystemState& b) {
  double largest = (a.eta - b.eta).norm();
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    largest =
        std::max({largest, (a.bodies[i].p_WB - b.bodies[i].p_WB).norm(),
                  a.bodies[i].quat_WB.angularDistance(b.bodies[i].quat_WB)});
  }
  return largest;
}

// Rigid, flexible, and of second order in the modes.
std::vector<testing::PairedBodiesOptions> list_kinds(double damping) {
  return {{.is_flexible = false, .damping = damping},
          {.damping = damping},
          {.is_bent = true, .damping = damping}};
}
std::string name_of(const testing::PairedBodiesOptions& options) {
  return options.is_bent       ? ", nonlinear"
         : options.is_flexible ? ", flexible"
                               : ", rigid";
}

struct Ends {
  SystemState by_pairs;
  SystemState by_couplers;
  SimulationStatistics of_pairs;
  SimulationStatistics of_couplers;
};

Ends run_both(const SimulationSettings& settings,
              testing::PairedBodiesOptions options) {
  Ends ends;
  options.by_pairs = true;
  PairedBodies pairs = make_paired_bodies(options);
  ends.of_pairs = simulate(pairs.model, pairs.state, settings, {});
  ends.by_pairs = pairs.state;
  options.by_pairs = false;
  PairedBodies couplers = make_paired_bodies(options);
  ends.of_couplers = simulate(couplers.model, couplers.state, settings, {});
  ends.by_couplers = couplers.state;
  return ends;
}

// Couplers see the lines in turning frames, pairs in the world: the tangents
// that the start's accelerations come from differ by the lines' tension, and so
// do means over a step, both to second order in the step.
TEST(PairSprings, MoveBodiesAsCouplersDoWithEveryImplicitScheme) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::implicit_euler,
        IntegratorKind::energy_conserving}) {
    for (const testing::PairedBodiesOptions& options : list_kinds(0.0)) {
      std::vector<double> distances;
      for (const double step : {1e-3, 5e-4}) {
        const Ends ends = run_both({.integrator = kind,
                                    .end_time = 0.1,
                                    .step = step,
                                    .newton_tolerance = 1e-12},
                                   options);
        distances.push_back(find_distance(ends.by_pairs, ends.by_couplers));
      }
      const std::string what = to_string(kind) + name_of(options);
      if (kind == IntegratorKind::implicit_euler) {
        EXPECT_LT(distances[0], 1e-9) << what;
      } else {
        EXPECT_GT(distances[0] / distances[1], 3.5) << what;
      }
    }
  }
}

TEST(PairSprings, MoveBodiesAsCouplersDoWithEveryExplicitScheme) {
  for (const IntegratorKind kind :
       {IntegratorKind::runge_kutta_4, IntegratorKind::explicit_euler,
        IntegratorKind::central_differences, IntegratorKind::splitting}) {
    for (const testing::PairedBodiesOptions& options : list_kinds(3.0)) {
      const Ends ends = run_both(
          {.integrator = kind, .end_time = 0.05, .step = 1e-4}, options);
      EXPECT_LT(find_distance(ends.by_pairs, ends.by_couplers), 1e-11)
          << to_string(kind) << name_of(options);
      EXPECT_EQ(ends.of_pairs.steps, ends.of_couplers.steps);
      // By power iteration on differences.
      EXPECT_NEAR(ends.of_pairs.stable_step, ends.of_couplers.stable_step,
                  1e-3 * ends.of_couplers.stable_step);
    }
  }
}

TEST(PairSprings, StoreAndDissipateWhatCouplersDo) {
  for (testing::PairedBodiesOptions options : list_kinds(3.0)) {
    const PairedBodies pairs = make_paired_bodies(options);
    options.by_pairs = false;
    const PairedBodies couplers = make_paired_bodies(options);
    SystemTerms of_pairs = make_terms(pairs.model);
    SystemTerms of_couplers = make_terms(couplers.model);
    const EnergyBalance a = calc_energy(pairs.model, pairs.state, of_pairs);
    const EnergyBalance b =
        calc_energy(couplers.model, couplers.state, of_couplers);
    EXPECT_GT(b.coupler, 1.0);
    EXPECT_NEAR(a.coupler, b.coupler, 1e-13 * b.coupler);
    const double lost = find_loss(couplers.model, of_couplers);
    EXPECT_NEAR(find_loss(pairs.model, of_pairs), lost, 1e-12 * lost);
  }
}

TEST(PairSprings, KeepTheEnergyWithTheEnergyConservingScheme) {
  for (const testing::PairedBodiesOptions& options : list_kinds(0.0)) {
    PairedBodies bodies = make_paired_bodies(options);
    double work = 0.0;
    const double before = calc_energy(bodies.model, bodies.state).total();
    simulate(bodies.model, bodies.state,
             {.integrator = IntegratorKind::energy_conserving,
              .end_time = 1.0,
              .step = 2e-3,
              .output_times = {1.0}},
             [&](const SystemState& /*state*/, const EnergyBalance& energy) {
               work = energy.work;
             });
    const double after = calc_energy(bodies.model, bodies.state).total();
    EXPECT_NEAR(after - work, before, 1e-10 * before);
  }
}

// The error of a step's end, against half the step's.
TEST(PairSprings, AtLevelNonlinearHaveTheOrdersOfTheSchemes) {
  const auto run = [](IntegratorKind kind, double step) {
    PairedBodies bodies = make_paired_bodies({.is_bent = true, .damping = 1.0});
    simulate(bodies.model, bodies.state,
             {.integrator = kind,
              .end_time = 0.1,
              .step = step,
              .newton_tolerance = 1e-13},
             {});
    return bodies.state;
  };
  for (const auto& [kind, step, order] :
       {std::tuple{IntegratorKind::generalized_alpha, 1e-3, 2.0},
        std::tuple{IntegratorKind::energy_conserving, 1e-3, 2.0},
        std::tuple{IntegratorKind::implicit_euler, 1e-3, 1.0},
        std::tuple{IntegratorKind::runge_kutta_4, 1e-3, 4.0},
        std::tuple{IntegratorKind::explicit_euler, 1e-4, 1.0}}) {
    const SystemState coarse = run(kind, step);
    const SystemState middle = run(kind, 0.5 * step);
    const SystemState fine = run(kind, 0.25 * step);
    const double found =
        std::log2(find_distance(coarse, middle) / find_distance(middle, fine));
    EXPECT_NEAR(found, order, 0.15) << to_string(kind);
  }
}

// Dampers that end all relative motion within a step.
TEST(PairSprings, BringVelocitiesOntoWhatTheirDampersAllowAtTheStart) {
  const Ends ends =
      run_both({.end_time = 0.01, .step = 1e-3, .newton_tolerance = 1e-12},
               {.is_flexible = false, .damping = 1e7});
  ASSERT_FALSE(ends.of_couplers.warnings.empty());
  ASSERT_EQ(ends.of_pairs.warnings.size(), ends.of_couplers.warnings.size());
  EXPECT_NE(ends.of_pairs.warnings[0].find("an impulse"), std::string::npos);
  // The start's accelerations, as above: of 0.01 s.
  EXPECT_LT(find_distance(ends.by_pairs, ends.by_couplers), 1e-6);
}

}  // namespace
}  // namespace limber::dynamics::pair_springs_test
