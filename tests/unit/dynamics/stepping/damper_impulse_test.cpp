// SPDX-License-Identifier: BSD-3-Clause
// Starts against dampers that a step is far too long to follow.
#include "limber/dynamics/stepping/damper_impulse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "limber/dynamics/equations/energy.hpp"
#include "support/point_mass_body.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::damper_impulse_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::run_from;
using testing::RunOutcome;

constexpr double kMassA = 3.0;
constexpr double kMassB = 1.0;
constexpr double kSpeed = 4.0;  // of B towards A [m/s]

// Two bodies, free in space, with a bushing between their centres.
struct Pair {
  SystemModel model;
  SystemState state;
};

Pair make_pair(double stiffness, double damping) {
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", {kMassA, Matrix3::Identity()});
  const auto b = builder.add_rigid_body("b", {kMassB, Matrix3::Identity()});
  builder.add_coupler("pad",
                      joints::make_joint(joints::JointKind::fixed,
                                         Vector3::UnitZ(), Vector3::UnitX(),
                                         {.translational_stiffness = stiffness,
                                          .rotational_stiffness = stiffness,
                                          .translational_damping = damping,
                                          .rotational_damping = damping}),
                      builder.attach_frame("at_a", a, {}),
                      builder.attach_frame("at_b", b, {}));
  Pair pair{builder.build(), {}};
  pair.state = make_state(pair.model);
  pair.state.bodies[1].v_WB_W = {kSpeed, 0, 0};
  return pair;
}

SimulationSettings make_settings(IntegratorKind integrator, double end,
                                 double step) {
  SimulationSettings settings;
  settings.integrator = integrator;
  settings.end_time = end;
  settings.step = step;
  settings.output_times = {0.0, end};
  return settings;
}

constexpr std::array kImplicit = {IntegratorKind::generalized_alpha,
                                  IntegratorKind::implicit_euler,
                                  IntegratorKind::energy_conserving};

TEST(DamperImpulse, IsTheInelasticImpactOfTwoBodies) {
  const double common = kMassB * kSpeed / (kMassA + kMassB);
  const double lost =
      0.5 * kMassA * kMassB / (kMassA + kMassB) * kSpeed * kSpeed;
  // m / c is 7.5e-9 s and the spring has 400 periods in a step: any energy
  // stored there is an artefact of the scheme.
  const Pair pair = make_pair(1e14, 1e8);
  for (const IntegratorKind integrator : kImplicit) {
    SCOPED_TRACE(static_cast<int>(integrator));
    const RunOutcome run =
        run_from(pair.model, pair.state, make_settings(integrator, 0.1, 1e-3));
    EXPECT_NEAR(run.state.bodies[0].v_WB_W.x(), common, 1e-6 * common);
    EXPECT_NEAR(run.state.bodies[1].v_WB_W.x(), common, 1e-6 * common);
    EXPECT_NEAR(run.state.bodies[0].p_WB.x(), 0.1 * common, 1e-6);
    EXPECT_NEAR(run.state.bodies[1].p_WB.x(), 0.1 * common, 1e-6);
    const EnergyBalance& start = run.energies.front();
    const EnergyBalance& end = run.energies.back();
    EXPECT_NEAR(end.dissipated, lost, 1e-6 * lost);
    EXPECT_NEAR(end.total() + end.dissipated, start.total(),
                1e-6 * start.total());
    EXPECT_THAT(run.statistics.warnings, ElementsAre(HasSubstr("'pad'")));
    EXPECT_THAT(run.statistics.warnings,
                ElementsAre(HasSubstr("6 J of the 8 J")));
  }
}

TEST(DamperImpulse, LeavesDampersAloneThatTheStepFollows) {
  // h c / m from 1e-4 to 0.7.
  for (const double damping : {0.075, 7.5, 75.0, 525.0}) {
    Pair pair = make_pair(1e3, damping);
    EXPECT_FALSE(apply_damper_impulse(pair.model, 1e-3, pair.state));
    EXPECT_EQ(pair.state.bodies[1].v_WB_W.x(), kSpeed);
    EXPECT_EQ(pair.state.bodies[0].v_WB_W.x(), 0.0);
  }
}

// 1 mm/s beside a common velocity, a common rotation or another body's motion
// with energies 1e14 times as large: 1e-6 of all kinetic energy would be more
// than a damper can take.
struct Company {
  Vector3 velocity = Vector3::Zero();  // of all [m/s]
  double spin = 0.0;                   // about the pair's centre [rad/s]
  double stranger = 0.0;               // mass of a third body [kg]
};

DamperImpulse impulse_in(const Company& company, Vector3& gap) {
  SystemBuilder builder;
  const testing::Mass a = testing::add_mass(builder, "a", kMassA);
  const testing::Mass b = testing::add_mass(builder, "b", kMassB);
  joints::Bushing::Parameters pad;
  pad.translational_damping = 1e8 * Matrix3::Identity();
  builder.add_coupler("pad", joints::Bushing(pad), a.frame, b.frame);
  if (company.stranger > 0.0) {
    testing::add_mass(builder, "stranger", company.stranger);
  }
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  for (BodyState& body : state.bodies) {
    body.v_WB_W = company.velocity;
    body.w_WB_B = {0.0, 0.0, company.spin};
  }
  state.bodies[1].v_WB_W += Vector3(1e-3, 0.0, 0.0);
  if (company.stranger > 0.0) state.bodies[2].v_WB_W = {0.0, 7500.0, 0.0};
  const auto impulse = apply_damper_impulse(model, 1e-3, state);
  if (!impulse) return {};
  gap = state.bodies[1].v_WB_W - state.bodies[0].v_WB_W;
  return *impulse;
}

TEST(DamperImpulse, DoesNotDependOnCommonMotionOrStrangers) {
  const double lost = 0.5 * kMassA * kMassB / (kMassA + kMassB) * 1e-6;
  for (const Company& company :
       {Company{}, Company{.velocity = {7500.0, 0.0, 0.0}},
        Company{.velocity = {-3000.0, 6000.0, 1000.0}, .spin = 100.0},
        Company{.stranger = 1e4},
        Company{.velocity = {0.0, 0.0, 7500.0}, .stranger = 1e-3}}) {
    Vector3 gap = Vector3::Ones();
    const DamperImpulse impulse = impulse_in(company, gap);
    EXPECT_EQ(impulse.coupler, "pad");
    EXPECT_LT(gap.norm(), 1e-11);  // round-off at 7500 m/s is 1e-12
    EXPECT_NEAR(impulse.dissipated, lost, 1e-6 * lost);
  }
}

// The relative velocity of a rigid motion is round-off.
TEST(DamperImpulse, DoesNotActOnRoundOff) {
  Pair pair = make_pair(1e14, 1e12);
  const Vector3 w(0.3, -1.0, 2.0);
  const Vector3 v(7.1e3, -3.3e3, 1.7);
  for (std::size_t b = 0; b < 2; ++b) {
    pair.state.bodies[b].w_WB_B = w;
    pair.state.bodies[b].v_WB_W = v + 1e-15 * v * static_cast<double>(b);
  }
  EXPECT_FALSE(apply_damper_impulse(pair.model, 1e-3, pair.state));
}

TEST(DamperImpulse, LeavesMotionAloneThatDampersAllow) {
  Pair pair = make_pair(1e14, 1e8);
  const Vector3 w(0.3, -1.0, 2.0);
  for (std::size_t b = 0; b < 2; ++b) {
    pair.state.bodies[b].w_WB_B = w;
    pair.state.bodies[b].v_WB_W = {kSpeed, 1.0, 0.1};
  }
  EXPECT_FALSE(apply_damper_impulse(pair.model, 1e-3, pair.state));
  EXPECT_EQ(pair.state.bodies[0].w_WB_B, w);
}

TEST(DamperImpulse, BringsABodyToTheRateOfItsDrive) {
  constexpr double kMass = 2.0;
  constexpr double kRate = 0.7;  // [m/s]
  joints::Drive::Parameters drive;
  drive.mode = joints::DriveMode::velocity;
  drive.signal.base = joints::ConstantSignal{kRate};
  drive.damping = 1e9;
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "sledge", kMass);
  testing::add_rail(builder, mass, "rail", {{0, joints::Drive(drive)}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  const auto impulse = apply_damper_impulse(model, 1e-3, state);
  ASSERT_TRUE(impulse);
  EXPECT_NEAR(state.bodies[0].v_WB_W.x(), kRate, 1e-9);
  // A body that slips into motion takes as much heat as energy.
  const double kinetic = 0.5 * kMass * kRate * kRate;
  EXPECT_NEAR(impulse->work, 2.0 * kinetic, 1e-6 * kinetic);
  EXPECT_NEAR(impulse->dissipated, kinetic, 1e-6 * kinetic);
}

TEST(DamperImpulse, NamesTheCouplerHoweverLittlePowerItTakes) {
  SystemBuilder builder;
  const testing::Mass a = testing::add_mass(builder, "a", kMassA);
  const testing::Mass b = testing::add_mass(builder, "b", kMassB);
  for (const double damping : {1.0, 1e8}) {
    joints::Bushing::Parameters pad;
    pad.translational_damping = damping * Matrix3::Identity();
    builder.add_coupler(damping > 1.0 ? "firm" : "loose", joints::Bushing(pad),
                        a.frame, b.frame);
  }
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[1].v_WB_W = {1e-6, 0, 0};  // at most 0.1 mW
  const auto impulse = apply_damper_impulse(model, 1e-3, state);
  ASSERT_TRUE(impulse);
  EXPECT_EQ(impulse->coupler, "firm");
}

TEST(DamperImpulse, KeepsMomentaOfAFreeChainThatBends) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(24, 6, 4.0, 1.0, 60.0, 42);
  const auto reduced = testing::share(body);
  const auto near = testing::make_interface(body, 0, 6);
  const auto far = testing::make_interface(body, 6, 12);
  SystemBuilder builder;
  std::array<AttachmentIndex, 2> ends{};
  for (int b = 0; b < 2; ++b) {
    const auto link = builder.add_flexible_body("link" + std::to_string(b),
                                                reduced, Fidelity::coupled, {});
    const auto& end = b == 0 ? far : near;
    ends[static_cast<std::size_t>(b)] = builder.attach_interface(
        "end" + std::to_string(b), link, end, {Matrix3::Identity(), end.p_B});
  }
  builder.add_coupler("hinge",
                      joints::make_joint(joints::JointKind::revolute,
                                         Vector3::UnitX(), Vector3::UnitY(),
                                         {.translational_stiffness = 1e10,
                                          .rotational_stiffness = 1e10,
                                          .translational_damping = 1e8,
                                          .rotational_damping = 1e8}),
                      ends[0], ends[1]);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[1].p_WB = far.p_B - near.p_B;
  state.bodies[0].w_WB_B = {1.0, 3.0, -2.0};
  state.bodies[1].v_WB_W = {0.0, 5.0, 1.0};
  const EnergyBalance before = calc_energy(model, state);
  ASSERT_TRUE(apply_damper_impulse(model, 1e-3, state));
  const EnergyBalance after = calc_energy(model, state);
  EXPECT_LT((after.linear_momentum - before.linear_momentum).norm(),
            1e-12 * before.linear_momentum.norm());
  EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(),
            1e-12 * before.angular_momentum.norm());
  EXPECT_LT(after.total(), before.total());
  const joints::RelativeMotion motion =
      find_relative_motion(model, state, CouplerIndex(0));
  EXPECT_LT(motion.v_FM_F.norm(), 1e-6);
  EXPECT_LT(motion.w_FM_F.tail<2>().norm(), 1e-6);  // held
  EXPECT_GT(std::abs(motion.w_FM_F.x()), 0.1);      // free
}

}  // namespace
}  // namespace limber::dynamics::damper_impulse_test
