// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/explicit_limit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/dynamics/integrators/runge_kutta.hpp"
#include "limber/dynamics/integrators/splitting.hpp"
#include "limber/dynamics/integrators/stable_step.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/terms/energy_balance.hpp"
#include "limber/joints/bushing.hpp"
#include "limber/joints/point_spring.hpp"

namespace limber::dynamics::explicit_limit_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kReducedMass = 2.0 * 5.0 / (2.0 + 5.0);  // [kg]
constexpr double kOmega = 150.0;                          // [rad/s]
constexpr double kStretch = 1e-3;                         // [m]

/// Two rigid bodies that swing against each other along x at kOmega, with
/// relative velocities that fade with the rate `damping` [1/s].
SystemModel make_pair_of_masses(double damping, double omega = kOmega) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", {2.0, Matrix3::Identity()});
  const auto b = builder.add_rigid_body("b", {5.0, Matrix3::Identity()});
  builder.add_coupler(
      "spring",
      joints::PointSpring({.stiffness = kReducedMass * omega * omega,
                           .damping = kReducedMass * damping}),
      builder.attach_frame("a", a, {}), builder.attach_frame("b", b, {}));
  return builder.build();
}

SystemState stretch(const SystemModel& model, double speed = 0.0) {
  SystemState state = make_state(model);
  state.bodies[0].p_WB.x() = kStretch * 5.0 / 7.0;
  state.bodies[1].p_WB.x() = -kStretch * 2.0 / 7.0;
  state.bodies[0].v_WB_W.x() = speed * 5.0 / 7.0;
  state.bodies[1].v_WB_W.x() = -speed * 2.0 / 7.0;
  return state;
}

double find_gap(const SystemState& state) {
  return state.bodies[0].p_WB.x() - state.bodies[1].p_WB.x();
}

SimulationSettings make_settings(IntegratorKind kind, double end, double step) {
  SimulationSettings settings;
  settings.integrator = kind;
  settings.end_time = end;
  settings.step = step;
  settings.output_times = {0.0, end};
  return settings;
}

/// Whether a thousand steps leave the motion bounded.
template <typename Scheme>
bool is_stable(const SystemModel& model, double step) {
  SystemState state = stretch(model, kStretch / step);
  Scheme scheme(model);
  try {
    for (int i = 1; i <= 1000; ++i) scheme.step(state, step, i * step);
  } catch (const NumericalError&) {
    return false;
  }
  return std::abs(find_gap(state)) < 1.0;
}

TEST(ExplicitLimit, OfRungeKuttaIsStableAndAThirdOfTheLongestAtLeast) {
  for (const double ratio : {0.0, 0.05, 0.2, 0.5, 1.0, 20.0}) {
    const SystemModel model = make_pair_of_masses(2.0 * ratio * kOmega);
    const double step = find_stable_step(model, make_state(model),
                                         IntegratorKind::runge_kutta_4);
    EXPECT_TRUE(is_stable<RungeKutta4>(model, 0.999 * step)) << ratio;
    EXPECT_FALSE(is_stable<RungeKutta4>(model, 3.0 * step)) << ratio;
  }
}

TEST(ExplicitLimit, OfRungeKuttaIsNearlyTheLongestOfASpringAndOfADamper) {
  const SystemModel spring = make_pair_of_masses(0.0);
  EXPECT_NEAR(find_stable_step(spring, make_state(spring),
                               IntegratorKind::runge_kutta_4),
              2.6 / kOmega, 1e-5 / kOmega);
  const SystemModel damper = make_pair_of_masses(100.0, 0.0);
  EXPECT_NEAR(find_stable_step(damper, make_state(damper),
                               IntegratorKind::runge_kutta_4),
              2.6 / 100.0, 1e-7);
}

TEST(ExplicitLimit, OfSplittingIsTheLongestOfASpringAndOfADamper) {
  const SystemModel spring = make_pair_of_masses(0.0);
  const SystemModel damper = make_pair_of_masses(100.0, 0.0);
  for (const SystemModel* model : {&spring, &damper}) {
    const double step =
        find_stable_step(*model, make_state(*model), IntegratorKind::splitting);
    EXPECT_TRUE(is_stable<Splitting>(*model, 0.99 * step));
    EXPECT_FALSE(is_stable<Splitting>(*model, 1.02 * step));
  }
}

/// A body that swings about all axes at kOmega.
SystemModel make_balance_wheel() {
  SystemBuilder builder;
  const auto wheel =
      builder.add_rigid_body("wheel", {1.0, 0.3 * Matrix3::Identity()});
  builder.add_coupler(
      "hairspring",
      joints::Bushing({.translational_stiffness = Matrix3::Identity(),
                       .rotational_stiffness =
                           0.3 * kOmega * kOmega * Matrix3::Identity()}),
      builder.attach_world("ground", {}),
      builder.attach_frame("hub", wheel, {}));
  return builder.build();
}

class GrowthOf : public ::testing::TestWithParam<bool> {
 protected:
  SystemModel model =
      GetParam() ? make_balance_wheel() : make_pair_of_masses(0.0);
  SystemState state = make_state(model);
};

INSTANTIATE_TEST_SUITE_P(Motion, GrowthOf, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Rotation" : "Translation";
                         });

// Of the classic tableau, and of drift, kick and drift.
TEST_P(GrowthOf, IsThatOfTheAmplificationMatrix) {
  for (const double y : {2.9, 3.0, 5.0, 40.0}) {
    const std::complex<double> z(0.0, y);
    const double exact = std::abs(1.0 + z + z * z / 2.0 + z * z * z / 6.0 +
                                  z * z * z * z / 24.0);
    const double growth = find_growth(
        model, state,
        make_settings(IntegratorKind::runge_kutta_4, 1.0, y / kOmega));
    EXPECT_NEAR(growth, exact, 0.03 * exact) << y;
  }
  for (const double y : {2.1, 3.0, 40.0}) {
    const double half_trace = 0.5 * y * y - 1.0;  // of -1 times the matrix
    const double exact = half_trace + std::sqrt(half_trace * half_trace - 1.0);
    const double growth =
        find_growth(model, state,
                    make_settings(IntegratorKind::splitting, 1.0, y / kOmega));
    EXPECT_NEAR(growth, exact, 0.03 * exact) << y;
  }
}

// Changes are small against turns of the lightest body, too.
TEST(ExplicitLimit, GrowthDoesNotDependOnTheUnitOfMass) {
  const auto find_growth_of = [](double unit) {
    SystemBuilder builder;
    const auto body = builder.add_rigid_body(
        "body", {2.0 * unit, unit * Matrix3::Identity()});
    const Pose arm{Matrix3::Identity(), {0.0, 0.7, 0.4}};
    builder.add_coupler(
        "spring", joints::PointSpring({.stiffness = unit * kOmega * kOmega}),
        builder.attach_world("wall", arm),
        builder.attach_frame("end", body, arm));
    const SystemModel model = builder.build();
    return find_growth(
        model, make_state(model),
        make_settings(IntegratorKind::runge_kutta_4, 1.0, 5.0 / kOmega));
  };
  const double growth = find_growth_of(1.0);
  EXPECT_GT(growth, 2.0);
  for (const double unit : {1e-8, 1e6}) {
    EXPECT_NEAR(find_growth_of(unit) / growth, 1.0, 1e-3) << unit;
  }
}

TEST(ExplicitLimit, GrowthOfMotionThatIsResolvedIsNone) {
  const SystemModel model = make_pair_of_masses(5.0);
  for (const IntegratorKind kind :
       {IntegratorKind::runge_kutta_4, IntegratorKind::splitting}) {
    EXPECT_LT(find_growth(model, stretch(model, 1.0),
                          make_settings(kind, 1.0, 1.5 / kOmega)),
              1.03);
  }
}

// The gap of an undamped spring is kStretch cos(omega t).
TEST(ExplicitLimit, DividesAStepThatIsTooLongAndSaysSo) {
  const SystemModel model = make_pair_of_masses(0.0);
  const double end = 12.0 / kOmega;
  for (const IntegratorKind kind :
       {IntegratorKind::runge_kutta_4, IntegratorKind::splitting}) {
    SystemState state = stretch(model);
    const auto statistics =
        simulate(model, state, make_settings(kind, end, end), {});
    EXPECT_NEAR(
        find_gap(state), kStretch * std::cos(12.0),
        kind == IntegratorKind::splitting ? 0.1 * kStretch : 1e-3 * kStretch);
    EXPECT_THAT(statistics.warnings,
                Contains(AllOf(HasSubstr("is stable up to"), HasSubstr("'a'"),
                               HasSubstr("are divided, into"))));
    EXPECT_GT(statistics.stable_step, 1.9 / kOmega);
  }
}

TEST(ExplicitLimit, LeavesAStepThatIsStableAsItWasAskedFor) {
  const SystemModel model = make_pair_of_masses(0.0);
  for (const IntegratorKind kind :
       {IntegratorKind::runge_kutta_4, IntegratorKind::splitting}) {
    SystemState state = stretch(model);
    const auto statistics = simulate(
        model, state, make_settings(kind, 8.0 / kOmega, 1.0 / kOmega), {});
    EXPECT_EQ(statistics.steps, 8);
    EXPECT_THAT(statistics.warnings, Each(Not(HasSubstr("divided"))));
  }
}

TEST(ExplicitLimit, DividesEveryStepOfAScheduleThatIsTooLong) {
  const SystemModel model = make_pair_of_masses(0.0);
  SystemState state = stretch(model);
  SimulationSettings settings =
      make_settings(IntegratorKind::runge_kutta_4, 12.0 / kOmega, 1.0 / kOmega);
  settings.step_changes = {{6.0 / kOmega, 6.0 / kOmega}};
  simulate(model, state, settings, {});
  EXPECT_NEAR(find_gap(state), kStretch * std::cos(12.0), 1e-3 * kStretch);
}

// Two bodies with different initial velocities, connected by a damper only, end
// with equal velocity; it dissipates the energy of their relative motion.
TEST(ExplicitLimit, FollowsAStartAgainstAStiffDamper) {
  constexpr double kRate = 1e5;  // [1/s]
  constexpr double kSpeed = 2.0;
  const SystemModel model = make_pair_of_masses(kRate, 0.0);
  for (const IntegratorKind kind :
       {IntegratorKind::runge_kutta_4, IntegratorKind::splitting}) {
    SystemState state = stretch(model, kSpeed);
    EnergyBalance last;
    simulate(model, state, make_settings(kind, 1e-3, 1e-3),
             [&](const SystemState&, const EnergyBalance& e) { last = e; });
    const double energy = 0.5 * kReducedMass * kSpeed * kSpeed;
    EXPECT_NEAR(last.dissipated, energy, 0.05 * energy);
    EXPECT_NEAR(find_gap(state), kStretch + kSpeed / kRate,
                0.05 * kSpeed / kRate);
  }
}

TEST(ExplicitLimit, SaysWhereAThousandPartsDoNotSuffice) {
  const SystemModel model = make_pair_of_masses(0.0);
  SystemState state = make_state(model);  // nothing moves
  const auto statistics = simulate(
      model, state,
      make_settings(IntegratorKind::runge_kutta_4, 1e5 / kOmega, 1e4 / kOmega),
      {});
  EXPECT_EQ(statistics.steps, 10);
  ASSERT_THAT(statistics.warnings,
              ElementsAre(HasSubstr("steps are not divided so often")));
  const std::string& text = statistics.warnings[0];
  double longest = 0.0;
  double times = 0.0;
  double step = 0.0;
  ASSERT_EQ(std::sscanf(text.substr(text.find("up to")).c_str(),
                        "up to %lf s here, %lf times less than the step of %lf",
                        &longest, &times, &step),
            3);
  EXPECT_NEAR(step, 1e4 / kOmega, 0.01 * step);
  EXPECT_NEAR(times * longest, step, 0.01 * step);
}

}  // namespace
}  // namespace limber::dynamics::explicit_limit_test
