// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/equilibrium.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::equilibrium_test {
namespace {

using joints::JointKind;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kGravity = 9.81;

double bisect(double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == (f(high) > 0.0) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

std::string error_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

joints::Joint make_hinge(double stiffness,
                         std::vector<joints::JointElement> elements = {},
                         double damping = 1.0) {
  return joints::make_joint(JointKind::revolute, -Vector3::UnitY(),
                            Vector3::UnitX(),
                            {.translational_stiffness = stiffness,
                             .rotational_stiffness = stiffness,
                             .translational_damping = damping,
                             .rotational_damping = damping},
                            std::move(elements));
}

joints::ScalarSpring make_spring(double stiffness) {
  return joints::ScalarSpring(
      {.curve = joints::SpringCurve({.stiffness = stiffness, .extensions = {}}),
       .damping = 0.5});
}

/// A bar of 2 kg, 1 m to its centre of mass, on a hinge at the world's origin;
/// at `angle` from the horizontal.
struct Pendulum {
  /// @param unit of mass, and with it of all forces, the stiffness's apart
  explicit Pendulum(double angle, double stiffness,
                    std::vector<joints::JointElement> elements = {},
                    double unit = 1.0) {
    SystemBuilder builder;
    builder.set_gravity({0, 0, -kGravity});
    const BodyIndex bar = builder.add_rigid_body(
        "bar",
        {2.0 * unit, Matrix3((unit * Vector3(0.1, 0.7, 0.7)).asDiagonal())});
    builder.add_coupler(
        "hinge", make_hinge(stiffness, std::move(elements), unit),
        builder.attach_world("pivot", {}),
        builder.attach_frame("end", bar,
                             {Matrix3::Identity(), Vector3(-1, 0, 0)}));
    model = builder.build();
    state = make_state(model);
    state.bodies[0].quat_WB = exp_quaternion(Vector3(0, -angle, 0));
    state.bodies[0].p_WB = Vector3(std::cos(angle), 0, std::sin(angle));
  }
  SystemModel model;
  SystemState state;
};

double angle_of(const SystemState& state) {
  const Vector3& p = state.bodies[0].p_WB;
  return std::atan2(p.z(), p.x());
}

// k angle = -m g l cos(angle)
TEST(Equilibrium, OfAPendulumOnATorsionSpringIsTheClosedForm) {
  for (const double stiffness : {1e5, 1e8, 1e9, 3e9, 1e10, 3e10, 1e11, 3e11,
                                 5e11, 9e11, 1e12, 1.1e12, 2e12}) {
    const double k = 8.0;
    const Pendulum pendulum(0.0, stiffness, {{0, make_spring(k)}});
    const Equilibrium found = find_equilibrium(pendulum.model, pendulum.state);
    const double expected = bisect(-1.5, 0.0, [k](double angle) {
      return k * angle + 2.0 * kGravity * std::cos(angle);
    });
    // The hinge deflects by its force over its stiffness.
    EXPECT_NEAR(angle_of(found.state), expected, 1e-9 + 40.0 / stiffness);
    EXPECT_GE(found.load_steps, 1);
  }
}

TEST(Equilibrium, IsWhereTheStartIsIfNothingPushes) {
  const Pendulum pendulum(0.3, 1e8);
  SystemModel model = pendulum.model;
  model.gravity_W.setZero();
  SystemState start = pendulum.state;
  start.bodies[0].p_WB = Vector3(1, 0, 0);
  start.bodies[0].quat_WB.setIdentity();
  start.bodies[0].w_WB_B = Vector3(0, 3, 0);  // does not count
  const Equilibrium found = find_equilibrium(model, start);
  EXPECT_EQ(found.load_steps, 0);
  EXPECT_EQ(found.state.bodies[0].p_WB, start.bodies[0].p_WB);
  EXPECT_EQ(found.state.bodies[0].w_WB_B, Vector3(Vector3::Zero()));
}

// A free hinge has no equilibrium near the horizontal: Newton's method says
// so, relaxation falls until the bar hangs.
TEST(Equilibrium, OfAFreePendulumIsFoundByRelaxation) {
  const Pendulum pendulum(0.1, 1e8);
  EXPECT_THAT(
      error_of([&] { (void)find_equilibrium(pendulum.model, pendulum.state); }),
      AllOf(HasSubstr("body 'bar'"), HasSubstr("relaxation")));
  EquilibriumSettings settings;
  settings.method = EquilibriumMethod::relaxation;
  const Equilibrium found =
      find_equilibrium(pendulum.model, pendulum.state, settings);
  EXPECT_NEAR(angle_of(found.state), -0.5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(found.state.bodies[0].p_WB.z(), -1.0 - 2.0 * kGravity / 1e8,
              1e-11);
  EXPECT_EQ(found.state.t, pendulum.state.t);
}

TEST(Equilibrium, OfALightPendulumTakesNoMoreRelaxation) {
  EquilibriumSettings settings;
  settings.method = EquilibriumMethod::relaxation;
  const auto count_steps = [&](double unit) {
    const Pendulum pendulum(0.1, 1e8 * unit, {}, unit);
    return find_equilibrium(pendulum.model, pendulum.state, settings)
        .relaxation_steps;
  };
  const int steps = count_steps(1.0);
  EXPECT_NEAR(count_steps(1e-6), steps, 0.05 * steps);
  EXPECT_NEAR(count_steps(1e6), steps, 0.05 * steps);
}

// Two springs of length 1 m at rest span 2 a and meet in a ball that is loaded
// downwards from their apex: f = 2 k (1 - 1 / s) h with s = sqrt(a^2 + h^2).
struct Truss {
  static constexpr double kHalfSpan = 0.9;
  static constexpr double kStiffness = 1e4;
  explicit Truss(double force) {
    SystemBuilder builder;
    const BodyIndex ball =
        builder.add_rigid_body("ball", {1.0, 0.01 * Matrix3::Identity()});
    const AttachmentIndex center = builder.attach_frame("center", ball, {});
    for (const double side : {-1.0, 1.0}) {
      builder.add_coupler(
          side < 0 ? "left" : "right",
          joints::PointSpring({.stiffness = kStiffness, .free_length = 1.0}),
          builder.attach_world("support", {Matrix3::Identity(),
                                           Vector3(side * kHalfSpan, 0, 0)}),
          center);
    }
    // Keeps the ball in the plane, without rotation.
    joints::Bushing::Parameters guide;
    guide.translational_stiffness = Vector3(0, 1e3, 0).asDiagonal();
    guide.rotational_stiffness = 1e2 * Matrix3::Identity();
    builder.add_coupler("guide", joints::Bushing(guide),
                        builder.attach_world("origin", {}), center);
    builder.add_load("push", center, {0, 0, -force}, Vector3::Zero(),
                     LoadFrame::world, TimeFunction{});
    model = builder.build();
    state = make_state(model);
    state.bodies[0].p_WB = Vector3(0, 0, height());
  }
  static double height() { return std::sqrt(1.0 - kHalfSpan * kHalfSpan); }
  static double force_at(double h) {
    return 2.0 * kStiffness * (1.0 / std::hypot(kHalfSpan, h) - 1.0) * h;
  }
  SystemModel model;
  SystemState state;
};

double find_limit_load() {
  // s^3 = a^2
  const double s = std::cbrt(Truss::kHalfSpan * Truss::kHalfSpan);
  return Truss::force_at(
      std::sqrt(s * s - Truss::kHalfSpan * Truss::kHalfSpan));
}

TEST(Equilibrium, OfAShallowTrussBelowItsLimitLoadIsTheClosedForm) {
  for (const double fraction : {0.3, 0.9, 0.999}) {
    const double force = fraction * find_limit_load();
    const Truss truss(force);
    const Equilibrium found = find_equilibrium(truss.model, truss.state);
    const double h = bisect(
        std::sqrt(std::pow(Truss::kHalfSpan, 4.0 / 3.0) -
                  std::pow(Truss::kHalfSpan, 2.0)),
        Truss::height(), [&](double z) { return Truss::force_at(z) - force; });
    EXPECT_NEAR(found.state.bodies[0].p_WB.z(), h, 1e-9);
  }
}

TEST(Equilibrium, BeyondALimitLoadIsRefusedThereAndRelaxationSnapsThrough) {
  const double force = 1.25 * find_limit_load();
  const Truss truss(force);
  // The limit is at 0.8 of the load.
  const std::string error =
      error_of([&] { (void)find_equilibrium(truss.model, truss.state); });
  EXPECT_THAT(error, AllOf(HasSubstr("body 'ball': no equilibrium beyond 0.79"),
                           HasSubstr("limit point")));
  EquilibriumSettings settings;
  settings.method = EquilibriumMethod::relaxation;
  const Equilibrium found =
      find_equilibrium(truss.model, truss.state, settings);
  const double h = bisect(-2.0, -Truss::height(),
                          [&](double z) { return Truss::force_at(z) - force; });
  EXPECT_NEAR(found.state.bodies[0].p_WB.z(), h, 1e-9);
}

TEST(Equilibrium, OfAFreeBodyThatIsPushedIsRefusedWithTheDirection) {
  SystemBuilder builder;
  const BodyIndex a =
      builder.add_rigid_body("a", {1.0, 0.01 * Matrix3::Identity()});
  const BodyIndex b =
      builder.add_rigid_body("b", {1.0, 0.01 * Matrix3::Identity()});
  const AttachmentIndex on_a = builder.attach_frame("a", a, {});
  builder.add_coupler("hinge", make_hinge(1e6), on_a,
                      builder.attach_frame("b", b, {}));
  const auto error_with = [&](const Vector3& force, const Vector3& moment) {
    SystemBuilder loaded = builder;
    loaded.add_load("push", on_a, force, moment, LoadFrame::world,
                    TimeFunction{});
    const SystemModel model = loaded.build();
    return error_of([&] { (void)find_equilibrium(model, make_state(model)); });
  };
  EXPECT_THAT(error_with({0, 0, -3}, Vector3::Zero()),
              AllOf(HasSubstr("body 'a' and 1 with it"),
                    HasSubstr("force of 3 N along (0, 0, -1)")));
  EXPECT_THAT(error_with(Vector3::Zero(), {0, 2, 0}),
              HasSubstr("moment of 2 N m about (0, 1, 0)"));
}

/// Two flexible bodies on hinges with drives, under gravity.
struct Arm {
  Arm() {
    const auto body = testing::make_point_mass_body(20, 6, 5.0, 1.0, 60.0, 7);
    const auto near = testing::make_interface(body, 0, 8);
    const auto far = testing::make_interface(body, 8, 16);
    joints::Drive::Parameters hold;
    hold.stiffness = 2e3;
    hold.damping = 20.0;
    SystemBuilder builder;
    builder.set_gravity({0, 0, -kGravity});
    AttachmentIndex at = builder.attach_world("base", {});
    Vector3 p = Vector3::Zero();
    for (const char* name : {"upper", "lower"}) {
      const BodyIndex b = builder.add_flexible_body(
          name, testing::share(body), Fidelity::coupled,
          ModalDamping{.ratios = {0.01}});
      builder.add_coupler(
          std::string(name) + "_hinge",
          make_hinge(1e7, {{0, joints::Drive(hold)}}), at,
          builder.attach_interface(std::string(name) + "_near", b, near,
                                   {Matrix3::Identity(), near.p_B}));
      origins.emplace_back(p - near.p_B);
      p += far.p_B - near.p_B;
      at = builder.attach_interface(std::string(name) + "_far", b, far,
                                    {Matrix3::Identity(), far.p_B});
    }
    model = builder.build();
    state = make_state(model);
    for (std::size_t b = 0; b < 2; ++b) state.bodies[b].p_WB = origins[b];
  }
  std::vector<Vector3> origins;
  SystemModel model;
  SystemState state;
};

double find_fastest(const SystemState& state) {
  double fastest = state.etadot.cwiseAbs().maxCoeff();
  for (const BodyState& body : state.bodies) {
    fastest = std::max({fastest, body.v_WB_W.norm(), body.w_WB_B.norm()});
  }
  return fastest;
}

TEST(Equilibrium, OfAnArmUnderGravityIsWhereItStays) {
  const Arm arm;
  const SimulationSettings settings{.end_time = 1.0, .step = 1e-3};
  SystemState ringing = arm.state;
  simulate(arm.model, ringing, settings, {});
  const Equilibrium found = find_equilibrium(arm.model, arm.state);
  SystemState state = found.state;
  simulate(arm.model, state, settings, {});
  EXPECT_LT(find_fastest(state), 1e-8);
  EXPECT_GT(find_fastest(ringing), 1e-3);
  EXPECT_LT((state.eta - found.state.eta).norm(), 1e-9);
  EXPECT_GT(found.state.eta.norm(), 1e-3);
}

TEST(Equilibrium, OfAnArmIsTheSameByBothMethods) {
  const Arm arm;
  EquilibriumSettings relaxation;
  relaxation.method = EquilibriumMethod::relaxation;
  const SystemState a = find_equilibrium(arm.model, arm.state).state;
  const SystemState b =
      find_equilibrium(arm.model, arm.state, relaxation).state;
  EXPECT_LT((a.eta - b.eta).norm(), 1e-9);
  EXPECT_LT((a.bodies[1].p_WB - b.bodies[1].p_WB).norm(), 1e-9);
}

// eta_k = Phi_k . f / lambda_k once the body hangs along the force.
TEST(Equilibrium, OfAFreeBodyThatIsPulledAtBothEndsIsItsModesClosedForm) {
  const auto body = testing::make_point_mass_body(20, 6, 5.0, 1.0, 60.0, 7);
  const auto near = testing::make_interface(body, 0, 8);
  const auto far = testing::make_interface(body, 8, 16);
  SystemBuilder builder;
  const BodyIndex b = builder.add_flexible_body("bar", testing::share(body),
                                                Fidelity::coupled, {});
  const Vector3 force(3, 4, 12);
  const auto pull = [&](const char* name, const auto& table, double sign) {
    builder.add_load(name,
                     builder.attach_interface(name, b, table,
                                              {Matrix3::Identity(), table.p_B}),
                     sign * force, Vector3::Zero(), LoadFrame::world,
                     TimeFunction{});
  };
  pull("near", near, -1.0);
  pull("far", far, 1.0);
  const SystemModel model = builder.build();
  SystemState start = make_state(model);
  // So that no moment is left but what the deformation makes.
  start.bodies[0].quat_WB =
      Quaternion::FromTwoVectors(far.p_B - near.p_B, force);
  const Equilibrium found = find_equilibrium(model, start);
  const Vector3 force_B = found.state.bodies[0].quat_WB.conjugate() * force;
  const VectorX expected = ((far.Phi_B - near.Phi_B).transpose() * force_B)
                               .cwiseQuotient(body.reduced.lambda);
  EXPECT_LT((found.state.eta - expected).norm(), 1e-12 * expected.norm());
  const Vector3 along_B =
      far.p_B + far.Phi_B * expected - near.p_B - near.Phi_B * expected;
  EXPECT_LT(along_B.normalized().cross(force_B.normalized()).norm(), 1e-11);
}

// Rows of n bars of weight w between two supports: bar i hangs at the slope
// (n/2 - 1/2 - i) w / H, and H is such that they span the distance.
TEST(Equilibrium, OfAHangingChainIsTheDiscreteCatenary) {
  constexpr int kBars = 8;
  constexpr double kLength = 0.25;
  constexpr double kSpan = 1.5;
  SystemBuilder builder;
  builder.set_gravity({0, 0, -kGravity});
  std::vector<AttachmentIndex> ends = {builder.attach_world("left", {})};
  for (int i = 0; i < kBars; ++i) {
    const BodyIndex bar = builder.add_rigid_body(
        "bar" + std::to_string(i),
        {1.0, Matrix3(Vector3(1e-3, 5e-3, 5e-3).asDiagonal())});
    for (const double side : {-0.5, 0.5}) {
      ends.push_back(builder.attach_frame(
          "end", bar, {Matrix3::Identity(), Vector3(side * kLength, 0, 0)}));
    }
  }
  ends.push_back(builder.attach_world(
      "right", {Matrix3::Identity(), Vector3(kSpan, 0, 0)}));
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    builder.add_coupler("hinge" + std::to_string(i), make_hinge(1e12), ends[i],
                        ends[i + 1]);
  }
  const SystemModel model = builder.build();
  // A V of the right span, which is no equilibrium.
  SystemState start = make_state(model);
  const double slope = std::acos(kSpan / (kBars * kLength));
  Vector3 p = Vector3::Zero();
  for (int i = 0; i < kBars; ++i) {
    const double turn = i < kBars / 2 ? slope : -slope;
    const Vector3 half =
        0.5 * kLength * Vector3(std::cos(turn), 0, -std::sin(turn));
    BodyState& bar = start.bodies[static_cast<std::size_t>(i)];
    bar.quat_WB = exp_quaternion(Vector3(0, turn, 0));
    bar.p_WB = p + half;
    p += 2.0 * half;
  }
  const auto angle = [](int i, double H) {
    return std::atan((0.5 * kBars - 0.5 - i) * kGravity / H);
  };
  const double H = bisect(1e-3, 1e3, [&](double pull) {
    double span = 0.0;
    for (int i = 0; i < kBars; ++i) span += kLength * std::cos(angle(i, pull));
    return span - kSpan;
  });
  EquilibriumSettings settings;
  settings.method = EquilibriumMethod::relaxation;
  const Equilibrium found = find_equilibrium(model, start, settings);
  for (int i = 0; i < kBars; ++i) {
    const Vector3 x = found.state.bodies[static_cast<std::size_t>(i)].quat_WB *
                      Vector3::UnitX();
    EXPECT_NEAR(std::atan2(-x.z(), x.x()), angle(i, H), 1e-8) << i;
  }
}

}  // namespace
}  // namespace limber::dynamics::equilibrium_test
