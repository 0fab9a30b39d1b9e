// SPDX-License-Identifier: BSD-3-Clause
// What ending Newton's method by the step's error does to results and cost.
#include "limber/dynamics/newton/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/simulation/simulation.hpp"
#include "support/chain.hpp"

namespace limber::dynamics::convergence_test {
namespace {

using testing::Chain;

struct Outcome {
  SystemState end;
  SimulationStatistics statistics;
};

/// Three flexible bodies on hinges that spin, under a load that swings.
class SpinningChain {
 public:
  explicit SpinningChain(IntegratorKind kind) : kind_(kind) {
    const Chain chain = testing::make_loaded_chain(
        2e3, 2.0, Sinusoid{.frequency = 1.0, .phase = 0.4});
    model_ = chain.builder.build();
    start_ = chain.state;
    const Vector3 w(1.0, 0.4, 0.3);
    for (BodyState& body : start_.bodies) {
      body.w_WB_B = w;
      body.v_WB_W = w.cross(body.p_WB);
    }
  }

  [[nodiscard]] Outcome run(double step, double newton_tolerance) const {
    Outcome run{start_, {}};
    SimulationSettings settings;
    settings.integrator = kind_;
    settings.end_time = 0.4;
    settings.step = step;
    settings.newton_tolerance = newton_tolerance;
    run.statistics = simulate(model_, run.end, settings, {});
    return run;
  }

 private:
  IntegratorKind kind_;
  SystemModel model_;
  SystemState start_;
};

double find_distance(const SystemState& a, const SystemState& b) {
  double squared = (a.eta - b.eta).squaredNorm();
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    squared += (a.bodies[i].p_WB - b.bodies[i].p_WB).squaredNorm() +
               (a.bodies[i].quat_WB.toRotationMatrix() -
                b.bodies[i].quat_WB.toRotationMatrix())
                   .squaredNorm();
  }
  return std::sqrt(squared);
}

class NewtonsMethod : public ::testing::TestWithParam<IntegratorKind> {};

TEST_P(NewtonsMethod, LeavesAHundredthOfTheErrorOfTheSteps) {
  const SpinningChain chain(GetParam());
  const SystemState reference = chain.run(5e-5, 1e-13).end;
  for (const double step : {4e-3, 1e-3, 2.5e-4}) {
    SCOPED_TRACE(step);
    const Outcome exact = chain.run(step, 1e-13);
    const Outcome run = chain.run(step, 0.0);
    const double error = find_distance(exact.end, reference);
    EXPECT_LT(find_distance(run.end, exact.end), 0.01 * error);
    EXPECT_LT(run.statistics.newton_iterations,
              exact.statistics.newton_iterations);
  }
}

TEST_P(NewtonsMethod, ContinuesToTheToleranceThatIsSet) {
  const SpinningChain chain(GetParam());
  const SystemState exact = chain.run(4e-3, 1e-14).end;
  long iterations = 0;
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    const Outcome run = chain.run(4e-3, tolerance);
    // In each of 100 steps of at most a few millimetres.
    EXPECT_LT(find_distance(run.end, exact), 100.0 * tolerance);
    EXPECT_GT(run.statistics.newton_iterations, iterations);
    iterations = run.statistics.newton_iterations;
  }
}

INSTANTIATE_TEST_SUITE_P(Implicit, NewtonsMethod,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::implicit_euler));

TEST(FaceCycle, EndsWhereASmallCorrectionTakesTheLastOneBack) {
  const VectorX first = VectorX::LinSpaced(5, -1.0, 3.0);
  const auto ends = [&](const VectorX& next, double size) {
    FaceCycle cycle(5);
    cycle.include(first, true, true);
    cycle.include(next, false, true);
    return cycle.ends(size, 1.0);
  };
  VectorX back = -first;
  EXPECT_TRUE(ends(back, 1e-3));
  EXPECT_FALSE(ends(back, 1.1e-3));
  back[4] += 0.09 * first.norm();
  EXPECT_TRUE(ends(back, 1e-3));
  EXPECT_FALSE(ends(-0.8 * first, 1e-3));
  EXPECT_FALSE(ends(first, 1e-3));
  FaceCycle other(5);
  other.include(first, true, true);
  other.include(-first, true, true);  // of the next step
  EXPECT_FALSE(other.ends(1e-3, 1.0));
  other.include(first, false, true);
  EXPECT_TRUE(other.ends(1e-3, 1.0));
  other.include(-first, false, false);  // they have parted
  EXPECT_FALSE(other.ends(1e-3, 1.0));
  other.include(-first, false, true);
  EXPECT_FALSE(other.ends(1e-3, 1.0));
}

}  // namespace
}  // namespace limber::dynamics::convergence_test
