// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/simulation/simulator.hpp"
#include "support/paired_bodies.hpp"

/// Points that come and go, and what pairs remember.
namespace limber::dynamics::pair_contact_test {
namespace {

using ::testing::HasSubstr;
using testing::SphereContact;

constexpr double kMass = 0.5;       // [kg]
constexpr double kStiffness = 2e4;  // [N/m]
constexpr double kRadius = 0.05;    // [m]
constexpr double kSpeed = 1.0;      // [m/s]
constexpr double kHeight = 0.02;    // above the plane [m]
const double kContactTime =
    std::numbers::pi * std::sqrt(kMass / kStiffness);  // 15.7 ms

RigidInertia make_inertia(double mass) {
  return {mass, 0.4 * mass * kRadius * kRadius * Matrix3::Identity()};
}

struct Ball {
  SystemModel model;
  SystemState state;
};

Ball make_ball_over_plane() {
  SystemBuilder builder;
  const auto ball = builder.add_rigid_body("ball", make_inertia(kMass));
  builder.add_pair("floor", kWorld, ball,
                   std::make_shared<SphereContact>(kStiffness, 0.0, kRadius));
  Ball out{builder.build(), {}};
  out.state = make_state(out.model);
  out.state.bodies[0].p_WB = {0.3, -0.2, kRadius + kHeight};
  out.state.bodies[0].v_WB_W = {0.5, 0.0, -kSpeed};
  out.state.bodies[0].w_WB_B = {0.0, 3.0, 1.0};
  return out;
}

// Free flight, half a period of the spring, and free flight: from where the
// ball is later follows how long it touched.
double find_contact_time(const SystemState& end) {
  const double rise = end.bodies[0].p_WB.z() - kRadius;
  return end.t - kHeight / kSpeed - rise / kSpeed;
}

TEST(PairContact, ABallBouncesInHalfAPeriodOfItsSpring) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::energy_conserving,
        IntegratorKind::runge_kutta_4, IntegratorKind::central_differences,
        IntegratorKind::splitting}) {
    Ball ball = make_ball_over_plane();
    const double h = kContactTime / 400.0;
    const SimulationStatistics statistics = simulate(
        ball.model, ball.state,
        {.integrator = kind, .end_time = 0.08, .step = h, .rho_inf = 1.0}, {});
    const BodyState& end = ball.state.bodies[0];
    // A touch within a step is off by less than the step.
    EXPECT_NEAR(find_contact_time(ball.state), kContactTime, 1.5 * h)
        << to_string(kind);
    EXPECT_NEAR(end.v_WB_W.z(), kSpeed, 0.01 * kSpeed) << to_string(kind);
    // Without friction. Over a step that turns the ball, the mean of a point's
    // positions is off the line of the centres to second order.
    const bool is_mean = kind == IntegratorKind::energy_conserving;
    EXPECT_NEAR(end.v_WB_W.x(), 0.5, 1e-12);
    EXPECT_LT((end.w_WB_B - Vector3(0.0, 3.0, 1.0)).norm(),
              is_mean ? 1e-6 : 1e-9);
    if (kind == IntegratorKind::runge_kutta_4) {
      ASSERT_FALSE(statistics.warnings.empty());
      EXPECT_THAT(statistics.warnings[0], HasSubstr("pair 'floor'"));
    }
  }
}

TEST(PairContact, IsReachedAtFirstOrderWhereTouchIsNotLocated) {
  double last = 0.0;
  for (const double parts : {100.0, 400.0, 1600.0}) {
    Ball ball = make_ball_over_plane();
    simulate(ball.model, ball.state,
             {.end_time = 0.08, .step = kContactTime / parts, .rho_inf = 1.0},
             {});
    const double error = std::abs(find_contact_time(ball.state) - kContactTime);
    EXPECT_LT(error, kContactTime / parts);
    last = error;
  }
  EXPECT_LT(last, 1e-3 * kContactTime);
}

// A discrete gradient of the law: the energy is the same at every end of a
// step, and so is the speed in flight.
TEST(PairContact, KeepsTheEnergyWithTheEnergyConservingScheme) {
  Ball ball = make_ball_over_plane();
  const double before = calc_energy(ball.model, ball.state).total();
  double worst = 0.0;
  std::vector<double> times;
  for (int i = 1; i <= 80; ++i) times.push_back(1e-3 * i);
  simulate(ball.model, ball.state,
           {.integrator = IntegratorKind::energy_conserving,
            .end_time = 0.08,
            .step = 1e-3,
            .output_times = times},
           [&](const SystemState& /*state*/, const EnergyBalance& energy) {
             worst = std::max(worst, std::abs(energy.total() - before));
           });
  EXPECT_LT(worst, 1e-11 * before);
  EXPECT_NEAR(ball.state.bodies[0].v_WB_W.z(), kSpeed, 1e-9);
}

TEST(PairContact, OfTwoBallsExchangesTheirVelocitiesAndKeepsMomenta) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::energy_conserving,
        IntegratorKind::runge_kutta_4}) {
    SystemBuilder builder;
    const auto a = builder.add_rigid_body("a", make_inertia(kMass));
    const auto b = builder.add_rigid_body("b", make_inertia(kMass));
    builder.add_pair(
        "touch", a, b,
        std::make_shared<SphereContact>(kStiffness, kRadius, kRadius));
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].v_WB_W = {1.0, 0.3, 0.0};
    state.bodies[1].p_WB = {2.0 * kRadius + 0.01, 0.03, 0.0};
    const EnergyBalance before = calc_energy(model, state);
    simulate(
        model, state,
        {.integrator = kind, .end_time = 0.05, .step = 2e-5, .rho_inf = 1.0},
        {});
    const EnergyBalance after = calc_energy(model, state);
    EXPECT_GT(state.bodies[1].v_WB_W.norm(), 0.5);
    EXPECT_LT((after.linear_momentum - before.linear_momentum).norm(), 1e-13);
    // The others keep it to their order.
    if (kind == IntegratorKind::energy_conserving) {
      EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(),
                1e-13);
    }
    EXPECT_NEAR(after.total(), before.total(), 2e-3 * before.total());
    // Equal masses: the velocity along the line of the touch changes hands.
    const Vector3 n = (state.bodies[1].v_WB_W).normalized();
    EXPECT_NEAR(state.bodies[0].v_WB_W.dot(n), 0.0, 0.01);
  }
}

/// A spring from where B's origin was at the last accepted step but some share
/// of it: creeps. Counts its commits.
class Creep final : public joints::PairInteraction {
 public:
  [[nodiscard]] std::string_view kind() const override { return "creep"; }
  void describe_parameters(Manifest& /*out*/) const override {}
  [[nodiscard]] std::size_t most_points() const override { return 1; }
  [[nodiscard]] std::size_t memory_size() const override { return 5; }
  void check(int /*modes_A*/, int /*modes_B*/) const override {}
  void evaluate(const joints::PairBodies& bodies, const EvaluationTime& /*now*/,
                std::span<const double> memory,
                joints::PairResponse& out) const override {
    const Vector3 rest(memory[0], memory[1], memory[2]);
    joints::PairPoint& point = out.add();
    point.on_A.x_B = bodies.B.p_WB;
    out.energy = 25.0 * (bodies.B.p_WB - rest).squaredNorm();
    point.force_W = -50.0 * (bodies.B.p_WB - rest);
    point.stiffness = 50.0 * Matrix3::Identity();
  }
  void commit(const joints::PairBodies& bodies, double t,
              std::span<double> memory,
              joints::PairResponse& /*scratch*/) const override {
    for (int i = 0; i < 3; ++i) {
      double& rest = memory[static_cast<std::size_t>(i)];
      rest += 1e-4 * (bodies.B.p_WB[i] - rest);
    }
    memory[3] += 1.0;
    memory[4] = t;
  }
};

Ball make_creeping_ball() {
  SystemBuilder builder;
  const auto ball = builder.add_rigid_body("ball", make_inertia(kMass));
  builder.add_pair("creep", kWorld, ball, std::make_shared<Creep>());
  builder.add_load("push", builder.attach_frame("at", ball, {}),
                   {1.0, 2.0, 0.0}, Vector3::Zero(), LoadFrame::world,
                   Pulse{.start = 0.2, .duration = 0.01});
  Ball out{builder.build(), {}};
  out.state = make_state(out.model);
  out.state.bodies[0].v_WB_W = {0.1, 0.0, 0.2};
  return out;
}

TEST(PairMemory, ChangesOnceAnAcceptedStepAlone) {
  for (const double tolerance : {0.0, 1e-7}) {
    Ball ball = make_creeping_ball();
    Simulator simulator(
        ball.model, ball.state,
        {.end_time = 1.0, .step = 0.02, .tolerance = tolerance});
    EXPECT_TRUE(simulator.advance_to(1.0));
    const std::span<const double> memory =
        simulator.state().pair_memory.at(0, 5);
    if (tolerance > 0.0) {
      EXPECT_GT(simulator.statistics().rejected_steps, 0);
    }
    EXPECT_EQ(memory[3], static_cast<double>(simulator.statistics().steps));
    EXPECT_EQ(memory[4], 1.0);
  }
}

TEST(PairMemory, GoesOnToTheBitFromACheckpoint) {
  for (const double tolerance : {0.0, 1e-7}) {
    const Ball ball = make_creeping_ball();
    const SimulationSettings settings{
        .end_time = 1.0, .step = 0.02, .tolerance = tolerance};
    Simulator first(ball.model, ball.state, settings);
    first.advance_to(0.5);
    const Checkpoint checkpoint = first.save();
    first.advance_to(1.0);
    Simulator second(ball.model, ball.state, settings);
    second.restore(checkpoint);
    second.advance_to(1.0);
    EXPECT_EQ(first.state().pair_memory, second.state().pair_memory);
    EXPECT_EQ(first.state().bodies[0].p_WB, second.state().bodies[0].p_WB);
    EXPECT_EQ(first.state().bodies[0].v_WB_W, second.state().bodies[0].v_WB_W);
    EXPECT_GT(first.state().pair_memory.at(0, 1)[0], 0.0);
  }
}

// A checkpoint while points are there.
TEST(PairContact, GoesOnToTheBitFromACheckpointWithinATouch) {
  const Ball ball = make_ball_over_plane();
  const SimulationSettings settings{.end_time = 0.08, .step = 1e-4};
  Simulator first(ball.model, ball.state, settings);
  first.advance_to(0.025);
  ASSERT_GT(first.calc_energy().coupler, 0.0);
  const Checkpoint checkpoint = first.save();
  first.advance_to(0.08);
  Simulator second(ball.model, ball.state, settings);
  second.restore(checkpoint);
  second.advance_to(0.08);
  EXPECT_EQ(first.state().bodies[0].p_WB, second.state().bodies[0].p_WB);
  EXPECT_EQ(first.state().bodies[0].v_WB_W, second.state().bodies[0].v_WB_W);
}

/// Its force is not a number.
class Broken final : public joints::PairInteraction {
 public:
  [[nodiscard]] std::string_view kind() const override { return "broken"; }
  void describe_parameters(Manifest& /*out*/) const override {}
  [[nodiscard]] std::size_t most_points() const override { return 1; }
  void check(int /*modes_A*/, int /*modes_B*/) const override {}
  void evaluate(const joints::PairBodies& /*bodies*/,
                const EvaluationTime& /*now*/,
                std::span<const double> /*memory*/,
                joints::PairResponse& out) const override {
    out.add().force_W.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
};

TEST(PairContact, NamesThePairWhoseForceIsNoNumber) {
  SystemBuilder builder;
  const auto ball = builder.add_rigid_body("ball", make_inertia(kMass));
  builder.add_pair("bad", ball, kWorld, std::make_shared<Broken>());
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  try {
    simulate(model, state, {.end_time = 0.1, .step = 0.01}, {});
    FAIL() << "it ran";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("pair 'bad'"));
  }
}

}  // namespace
}  // namespace limber::dynamics::pair_contact_test
