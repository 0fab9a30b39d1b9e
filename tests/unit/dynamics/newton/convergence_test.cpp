// SPDX-License-Identifier: BSD-3-Clause
// What ending Newton's method by the step's error does to results and cost, and
// what other bodies do to its end.
#include "limber/dynamics/newton/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/joints/bushing.hpp"
#include "limber/joints/point_spring.hpp"
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

// --- Groups -----------------------------------------------------------------

/// Two free bodies, each a group of its own, with a radius of gyration of 1 m,
/// that turn by 1 rad.
class TwoBodies : public ::testing::Test {
 protected:
  TwoBodies() {
    SystemBuilder builder;
    const Matrix3 J = 2.0 / 3.0 * Matrix3::Identity();
    builder.add_rigid_body("a", {1.0, J});
    builder.add_rigid_body("b", {1.0, J});
    model_ = builder.build();
    state_ = make_state(model_);
    terms_ = make_terms(model_);
    motion_ = make_unknowns(model_);
    for (const BodyModel& body : model_.bodies) {
      rotation_rows(body, motion_) = Vector3(1.0, 0.0, 0.0);
    }
    progress_.emplace(model_);
    start();
  }

  void start() {
    progress_->start(state_, motion_);
    progress_->measure_motion(state_, terms_, motion_);
  }

  static VectorX make_correction(double a, double b) {
    VectorX x = VectorX::Zero(12);
    x[1] = a;
    x[7] = b;
    return x;
  }

  void correct(double a, double b, bool compares = true) {
    progress_->include(make_correction(a, b), compares);
    progress_->judge();
  }

  [[nodiscard]] const GroupProgress& group(std::size_t g) const {
    return progress_->groups()[g];
  }

  SystemModel model_;
  SystemState state_;
  SystemTerms terms_;
  VectorX motion_;
  std::optional<NewtonProgress> progress_;
};

TEST_F(TwoBodies, AreDoneWhenEachIs) {
  progress_->groups()[0].limit.rigid = 1e-9;
  progress_->groups()[1].limit.rigid = 1e-13;
  correct(1e-5, 1e-12);
  EXPECT_FALSE(group(0).is_done);
  EXPECT_FALSE(group(1).is_done);
  EXPECT_EQ(progress_->find_worst().now.body, 0U);
  correct(1e-8, 0.9e-12);
  EXPECT_TRUE(group(0).is_done);  // 1e-11 is left
  EXPECT_FALSE(group(1).is_done);
  EXPECT_FALSE(progress_->is_done());
  EXPECT_EQ(progress_->find_worst().now.body, 1U);
  correct(1e-11, 1e-14);
  EXPECT_TRUE(progress_->is_done());
}

// b stagnates, as it may at round-off.
TEST_F(TwoBodies, ContractAsSlowlyAsTheOneThatIsNotDone) {
  for (GroupProgress& g : progress_->groups()) g.limit.rigid = 1e-9;
  correct(1e-3, 1e-12);
  correct(1e-4, 0.9e-12);
  EXPECT_NEAR(progress_->find_contraction(0.3).value(), 0.1, 1e-12);
  EXPECT_FALSE(progress_->may_be_noise(0.3));
  EXPECT_TRUE(progress_->may_be_noise(0.05));
}

TEST_F(TwoBodies, RoundAtTheirOwnPlacesAndSpeeds) {
  const double near = group(0).roundoff.rigid;
  state_.bodies[1].p_WB.x() = 1e6;
  start();
  EXPECT_EQ(group(0).roundoff.rigid, near);
  EXPECT_GT(group(1).roundoff.rigid, 2e-16 * 1e6);
  state_.bodies[1].p_WB.x() = 0.0;
  translation_rows(model_.bodies[1], motion_).x() = 7.5;
  start();
  EXPECT_EQ(group(0).roundoff.rigid, near);
  EXPECT_GT(group(1).roundoff.rigid, 2e-16 * 7.5);
  EXPECT_NEAR(group(1).motion, group(0).motion, 1e-12);
}

TEST_F(TwoBodies, AreNotFiniteIfOneIsNot) {
  correct(1.0, 1.0);
  EXPECT_TRUE(progress_->is_finite());
  correct(1.0, NAN);
  EXPECT_FALSE(progress_->is_finite());
  EXPECT_EQ(progress_->find_worst().now.body, 1U);
}

TEST_F(TwoBodies, AlternateWhereASmallCorrectionTakesTheLastOneBack) {
  const auto alternates = [&](double next, double size) {
    start();
    correct(size, 1.0);
    correct(next * size, 2.0);
    EXPECT_FALSE(group(1).alternates());
    return group(0).alternates();
  };
  EXPECT_TRUE(alternates(-1.0, 1e-3));  // of 1 m
  EXPECT_FALSE(alternates(-1.0, 1.1e-3));
  EXPECT_TRUE(alternates(-0.92, 1e-3));
  EXPECT_FALSE(alternates(-0.8, 1e-3));
  EXPECT_FALSE(alternates(1.0, 1e-3));
  start();
  correct(-1e-3, 1.0);  // the next step's first
  EXPECT_FALSE(group(0).alternates());
  correct(1e-3, 1.0, false);  // they have parted
  EXPECT_FALSE(group(0).alternates());
  correct(-1e-3, 1.0);
  EXPECT_FALSE(group(0).alternates());
}

// --- Company ----------------------------------------------------------------

/// Two bodies on a nonlinear spring along x, pushed apart, that move at a
/// common velocity; and a third that moves 1e6 m away, on a spring.
class Company : public ::testing::TestWithParam<IntegratorKind> {
 protected:
  static double find_gap(double velocity, std::optional<double> stranger) {
    SystemBuilder builder;
    const auto a = builder.add_rigid_body("a", {4.0, Matrix3::Identity()});
    const auto b = builder.add_rigid_body("b", {4.0, Matrix3::Identity()});
    builder.add_coupler("spring",
                        joints::PointSpring({.stiffness = 1e4,
                                             .damping = 1.0,
                                             .free_length = 0.1,
                                             .quadratic = 1e6}),
                        builder.attach_frame("a", a, {}),
                        builder.attach_frame("b", b, {}));
    const Vector3 far(0.0, 1e6, 0.0);
    if (stranger) {
      const auto c = builder.add_rigid_body("c", {4.0, Matrix3::Identity()});
      builder.add_coupler(
          "hold",
          joints::Bushing(
              {.translational_stiffness = 1e4 * Matrix3::Identity()}),
          builder.attach_world("wall", {Matrix3::Identity(), far}),
          builder.attach_frame("c", c, {}));
    }
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[1].p_WB.x() = 0.1;
    state.bodies[0].v_WB_W.z() = state.bodies[1].v_WB_W.z() = velocity;
    state.bodies[1].v_WB_W.x() = 0.01;
    if (stranger) {
      state.bodies[2].p_WB = far;
      state.bodies[2].v_WB_W.x() = *stranger;
    }
    SimulationSettings settings;
    settings.integrator = GetParam();
    settings.end_time = 0.2;
    settings.step = 1e-3;
    simulate(model, state, settings, {});
    return state.bodies[1].p_WB.x() - state.bodies[0].p_WB.x() - 0.1;
  }
};

TEST_P(Company, DoesNotMatter) {
  const double alone = find_gap(0.0, {});
  EXPECT_GT(std::abs(alone), 1e-5);
  EXPECT_NEAR(find_gap(0.0, 0.0), alone, 1e-15);
  EXPECT_NEAR(find_gap(0.0, 7500.0), alone, 1e-15);
}

// Beyond round-off of places on a way of 1.5 km.
TEST_P(Company, InFlightDoesNotMatter) {
  EXPECT_NEAR(find_gap(7500.0, {}), find_gap(0.0, {}), 2.2e-16 * 1500.0);
}

INSTANTIATE_TEST_SUITE_P(Implicit, Company,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::implicit_euler,
                                           IntegratorKind::energy_conserving));

}  // namespace
}  // namespace limber::dynamics::convergence_test
