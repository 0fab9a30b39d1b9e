// SPDX-License-Identifier: BSD-3-Clause
// Joints whose constrained directions do not deflect, against closed forms and
// stiff ones.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/roll_pitch_yaw.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/joint_state.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/chain.hpp"

namespace limber::dynamics::ideal_joint_test {
namespace {

using joints::JointKind;
using ::testing::HasSubstr;

constexpr double kLength = 1.2;  // of a rod [m]
constexpr double kMass = 2.5;    // [kg]
constexpr double kGravity = 9.81;
const JointOptions kIdeal{.held = {.is_ideal = true}};

RigidInertia make_rod(double mass = kMass, double length = kLength) {
  const double I = mass * length * length / 12.0;
  return {mass, Vector3(1e-3 * I, I, I).asDiagonal()};
}

Pose at(const Vector3& p, const Matrix3& R = Matrix3::Identity()) {
  return {R, p};
}

/// A chain of rods along x that begins at `origin`, on hinges about y.
struct Chain {
  SystemModel model;
  SystemState state;
};
Chain make_chain(int rods, const JointOptions& options = kIdeal,
                 const Vector3& gravity = {0, 0, -kGravity},
                 const Vector3& origin = Vector3::Zero(), double scale = 1.0) {
  SystemBuilder builder;
  BodyIndex last = kWorld;
  for (int i = 0; i < rods; ++i) {
    const std::string n = std::to_string(i);
    const BodyIndex rod =
        builder.add_rigid_body("rod_" + n, make_rod(scale * kMass));
    builder.add_joint("hinge_" + n, JointKind::revolute,
                      {last, at(i == 0 ? origin : Vector3(kLength / 2, 0, 0))},
                      {rod, at({-kLength / 2, 0, 0})}, Vector3::UnitY(),
                      options);
    last = rod;
  }
  builder.set_gravity(gravity);
  SystemModel model = builder.build();
  SystemState state = make_state(model, {});
  return {std::move(model), std::move(state)};
}

SimulationSettings make_settings(IntegratorKind kind, double step, double end) {
  SimulationSettings settings;
  settings.integrator = kind;
  settings.step = step;
  settings.end_time = end;
  return settings;
}

SystemState run(const Chain& chain, IntegratorKind kind, double step,
                double end) {
  SystemState state = chain.state;
  SimulationSettings settings = make_settings(kind, step, end);
  settings.newton_tolerance = 1e-13;
  simulate(chain.model, state, settings, {});
  return state;
}

/// Largest deflection of the joints [m or rad].
double find_deflection(const SystemModel& model, const SystemState& state) {
  double largest = 0.0;
  for (CouplerIndex c(0); c < std::ssize(model.couplers); ++c) {
    const auto& law = model.couplers[static_cast<std::size_t>(c)].law;
    if (!joints::is_ideal(law)) continue;
    const joints::ConstraintGap gap =
        joints::find_constraint_gap(law, find_relative_motion(model, state, c));
    largest = std::max(largest, gap.gap.norm());
  }
  return largest;
}

/// Wrench on the child of a joint, in the parent's frame of it.
Vector6 find_wrench(const Chain& chain, const SystemState& state,
                    std::size_t joint) {
  SystemTerms terms = make_terms(chain.model);
  calc_terms(chain.model, state, Side::left, terms);
  return terms.couplers[joint].applied;
}

/// Kinetic energy and that in the uniform field.
double find_total(const SystemModel& model, const SystemState& state) {
  double energy = calc_energy(model, state).total();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    energy -= model.bodies[b].mass * model.gravity_W.dot(state.bodies[b].p_WB);
  }
  return energy;
}

class IdealJoint : public ::testing::TestWithParam<IntegratorKind> {};

std::string name_of(const ::testing::TestParamInfo<IntegratorKind>& info) {
  std::string name = to_string(info.param);
  std::erase(name, '-');
  return name;
}

// Released level, the rod hangs after a quarter of the period,
// K(sin(45 deg)) / omega.
TEST_P(IdealJoint, LetsAPendulumSwingAsTheEllipticIntegralDoes) {
  const double omega = std::sqrt(1.5 * kGravity / kLength);
  const double quarter =
      std::comp_ellint_1(std::sin(std::numbers::pi / 4.0)) / omega;
  const Chain chain = make_chain(1);
  std::vector<double> errors;
  for (const int steps : {400, 800, 1600}) {
    const SystemState end = run(chain, GetParam(), quarter / steps, quarter);
    errors.push_back((end.bodies[0].p_WB + Vector3(0, 0, kLength / 2)).norm());
    EXPECT_LT(find_deflection(chain.model, end), 1e-12);
  }
  EXPECT_LT(errors[2], 1e-3 * kLength);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), traits_of(GetParam()).order,
              0.1);
}

TEST_P(IdealJoint, CarriesAQuarterOfTheWeightOfALevelRodThatIsReleased) {
  const Chain chain = make_chain(1);
  const SystemState end = run(chain, GetParam(), 1e-5, 2e-4);
  const Vector6 wrench = find_wrench(chain, end, 0);
  EXPECT_NEAR(wrench[2], kMass * kGravity / 4.0, 1e-4 * kMass * kGravity);
  EXPECT_LT((wrench - Vector6::Unit(2) * wrench[2]).norm(),
            1e-2 * kMass * kGravity);
}

TEST_P(IdealJoint, HoldsASpinningRodByItsCentripetalForce) {
  constexpr double kSpin = 7.0;
  Chain chain = make_chain(1, kIdeal, Vector3::Zero());
  chain.state = make_state(chain.model, {{"hinge_0", {{0.0}, {kSpin}}}});
  const double expected = kMass * kSpin * kSpin * kLength / 2.0;
  std::vector<double> errors;
  for (const double step : {1e-3, 5e-4}) {
    const SystemState end = run(chain, GetParam(), step, 0.2);
    const double spin = std::abs(end.bodies[0].w_WB_B.y());
    // On the rod, towards the pin, in the world.
    const Vector3 force = find_wrench(chain, end, 0).head<3>();
    const Vector3 inwards = -end.bodies[0].p_WB.normalized();
    const double now = expected * spin * spin / (kSpin * kSpin);
    errors.push_back((force - now * inwards).norm() / now);
  }
  const double order = traits_of(GetParam()).order;
  EXPECT_LT(errors[0], order == 2.0 ? 2e-4 : 2e-2);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, 0.3);
}

struct Shape {
  JointKind kind;
  std::vector<double> velocity;
};

std::vector<Shape> all_shapes() {
  return {{JointKind::fixed, {}},
          {JointKind::revolute, {1.3}},
          {JointKind::continuous, {-2.1}},
          {JointKind::prismatic, {0.4}},
          {JointKind::planar, {0.3, -0.2, 1.1}},
          {JointKind::universal, {0.7, -1.4}},
          {JointKind::ball, {0.5, -0.8, 1.2}}};
}

/// A block on a joint of the kind, and a second on the first, both about tilted
/// axes.
Chain make_tilted(const Shape& shape, const JointOptions& options,
                  BodyIndex parent = kWorld,
                  const Vector3& place = Vector3::Zero()) {
  SystemBuilder builder;
  if (parent != kWorld) {
    parent = builder.add_rigid_body("base",
                                    {4.0, Vector3(0.3, 0.4, 0.5).asDiagonal()});
  }
  const Matrix3 tilt = rotation_rpy({0.3, -0.7, 1.9});
  const BodyIndex first = builder.add_rigid_body(
      "first", {1.5, Vector3(0.02, 0.03, 0.04).asDiagonal()});
  const BodyIndex second = builder.add_rigid_body(
      "second", {0.8, Vector3(0.01, 0.012, 0.008).asDiagonal()});
  JointOptions tilted = options;
  tilted.second_F = Vector3(2.0, -1.0, 0.0);
  const Vector3 axis(1.0, 2.0, 2.0);
  builder.add_joint("a", shape.kind, {parent, at(place, tilt)},
                    {first, at({-0.2, 0.1, 0.05})}, axis, tilted);
  builder.add_joint("b", shape.kind, {first, at({0.3, 0.1, -0.1}, tilt)},
                    {second, at({-0.1, -0.2, 0.1})}, axis, tilted);
  if (parent == kWorld) builder.set_gravity({0.0, 0.0, -kGravity});
  SystemModel model = builder.build();
  const std::vector<double> zero(shape.velocity.size());
  SystemState state = make_state(
      model, {{"a", {zero, shape.velocity}}, {"b", {zero, shape.velocity}}});
  return {std::move(model), std::move(state)};
}

TEST_P(IdealJoint, OfEveryKindDoesNotDeflectAtAnyPlace) {
  for (const Shape& shape : all_shapes()) {
    for (const double far : {0.0, 1e4}) {
      SCOPED_TRACE(fmt::format("{} {}", to_string(shape.kind), far));
      const Chain chain = make_tilted(shape, kIdeal, kWorld, {far, -far, far});
      SystemState end;
      EXPECT_NO_THROW(end = run(chain, GetParam(), 1e-3, 0.5));
      if (end.bodies.empty()) continue;
      EXPECT_LT(find_deflection(chain.model, end), 1e-12 + 1e-15 * far)
          << to_string(shape.kind);
    }
  }
}

TEST_P(IdealJoint, OfEveryKindIsTheLimitOfStiffOnes) {
  // Dampers of implicit Euler's first step take velocity from the motion.
  const double damping =
      GetParam() == IntegratorKind::implicit_euler ? 0.0 : 1e-3;
  for (const Shape& shape : all_shapes()) {
    if (shape.kind == JointKind::fixed) continue;
    const SystemState limit =
        run(make_tilted(shape, kIdeal), GetParam(), 5e-4, 0.25);
    std::vector<double> gaps;
    for (const double stiffness : {1e6, 1e7, 1e8}) {
      const Chain stiff = make_tilted(
          shape, {.held = {.translational_stiffness = stiffness,
                           .rotational_stiffness = stiffness,
                           .translational_damping = damping * stiffness,
                           .rotational_damping = damping * stiffness}});
      const SystemState end = run(stiff, GetParam(), 5e-4, 0.25);
      double gap = 0.0;
      for (std::size_t b = 0; b < 2; ++b) {
        gap = std::max(gap, (end.bodies[b].p_WB - limit.bodies[b].p_WB).norm());
        gap = std::max(gap, end.bodies[b].quat_WB.angularDistance(
                                limit.bodies[b].quat_WB));
      }
      gaps.push_back(gap);
    }
    EXPECT_LT(gaps[0], 1e-3) << to_string(shape.kind);
    EXPECT_LT(gaps[1], 0.3 * gaps[0]) << to_string(shape.kind);
    EXPECT_LT(gaps[2], 0.3 * gaps[1] + 1e-11) << to_string(shape.kind);
  }
}

INSTANTIATE_TEST_SUITE_P(Implicit, IdealJoint,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::implicit_euler,
                                           IntegratorKind::energy_conserving),
                         name_of);

TEST(IdealJoints, OfAFreeTreeKeepEnergyAndMomentaInConservingSteps) {
  for (const Shape& shape : all_shapes()) {
    const Chain chain = make_tilted(shape, kIdeal, BodyIndex(0));
    const SystemState end =
        run(chain, IntegratorKind::energy_conserving, 2e-3, 2.0);
    const double energy = find_total(chain.model, chain.state);
    EXPECT_NEAR(find_total(chain.model, end), energy, 1e-10 * energy + 1e-20)
        << to_string(shape.kind);
    const EnergyBalance before = calc_energy(chain.model, chain.state);
    const EnergyBalance after = calc_energy(chain.model, end);
    EXPECT_LT((after.linear_momentum - before.linear_momentum).norm(), 1e-12);
    EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), 1e-12);
  }
}

// Of double the mass and a thousand times it, in the same motion.
TEST(IdealJoints, ScaleTheirWrenchesWithTheMass) {
  const Chain light = make_chain(3);
  const Chain heavy =
      make_chain(3, kIdeal, {0, 0, -kGravity}, Vector3::Zero(), 1000.0);
  const SystemState a = run(light, IntegratorKind::generalized_alpha, 1e-3, 1.);
  const SystemState b = run(heavy, IntegratorKind::generalized_alpha, 1e-3, 1.);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((a.bodies[i].p_WB - b.bodies[i].p_WB).norm(), 1e-9);
    const Vector6 wrench = find_wrench(light, a, i);
    EXPECT_LT((find_wrench(heavy, b, i) - 1000.0 * wrench).norm(),
              1e-5 * 1000.0 * wrench.norm());
  }
}

TEST(IdealJoints, LetSpringsFrictionAndDampingActAlongTheirCoordinates) {
  // A mass on a slide with a spring: x = x0 e^(-d t) (cos w t + d / w sin w t).
  SystemBuilder builder;
  const BodyIndex mass =
      builder.add_rigid_body("mass", {2.0, 0.1 * Matrix3::Identity()});
  joints::SpringCurve::Parameters curve;
  curve.stiffness = 200.0;
  joints::ScalarSpring::Parameters spring;
  spring.curve = joints::SpringCurve(curve);
  builder.add_joint("slide", JointKind::prismatic, {}, {mass}, {1.0, 1.0, 0.0},
                    {.held = {.free_damping = 3.0, .is_ideal = true},
                     .elements = {{0, joints::ScalarSpring(spring)},
                                  {0, joints::Friction({.viscous = 1.0})}}});
  Chain chain{builder.build(), {}};
  chain.state = make_state(chain.model, {{"slide", {{0.1}, {0.0}}}});
  const SystemState end =
      run(chain, IntegratorKind::energy_conserving, 1e-4, 0.7);
  const double d = 1.0;  // (3 + 1) / (2 * 2) [1/s]
  const double w = std::sqrt(100.0 - d * d);
  const double x = 0.1 * std::exp(-d * 0.7) *
                   (std::cos(w * 0.7) + d / w * std::sin(w * 0.7));
  const Vector3 along = Vector3(1.0, 1.0, 0.0).normalized();
  EXPECT_LT((end.bodies[0].p_WB - x * along).norm(), 1e-7);
}

TEST(IdealJoints, OfFlexibleChainsMoveThemAsVeryStiffOnesDo) {
  for (const Fidelity level :
       {Fidelity::uncoupled, Fidelity::one_way, Fidelity::coupled}) {
    std::vector<SystemState> ends;
    for (const bool is_ideal : {true, false}) {
      testing::Chain chain = testing::make_chain({.bodies = 3,
                                                  .stiffness = 1e11,
                                                  .damping = 1e7,
                                                  .joint = JointKind::revolute,
                                                  .fidelity = level});
      SystemModel model = chain.builder.build();
      for (Coupler& coupler : model.couplers) {
        joints::Bushing::Parameters held =
            std::get<joints::Bushing>(coupler.law).parameters();
        if (is_ideal) {
          held.translational_damping.setZero();
          held.rotational_damping.setZero();
        }
        coupler.law = joints::Joint(joints::Bushing(held), {}, {}, is_ideal);
      }
      model.gravity_W = {1.0, -3.0, 2.0};
      SystemState state = chain.state;
      state.etadot[0] += 0.05;
      simulate(model, state,
               make_settings(IntegratorKind::generalized_alpha, 5e-4, 0.2), {});
      ends.push_back(state);
    }
    EXPECT_LT((ends[0].eta - ends[1].eta).norm(), 1e-4 * ends[0].eta.norm());
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_LT((ends[0].bodies[b].p_WB - ends[1].bodies[b].p_WB).norm(), 1e-6);
    }
  }
}

// Enough arms that Newton's matrix would retain the palm.
TEST(IdealJoints, HoldAPalmWithManyArmsToTheWorldAndInFreeFlight) {
  for (const bool is_free : {true, false}) {
    SystemBuilder builder;
    const BodyIndex palm =
        builder.add_rigid_body("palm", {20.0, 2.0 * Matrix3::Identity()});
    if (!is_free) {
      builder.add_joint("base", JointKind::fixed, {}, {palm}, Vector3::UnitZ(),
                        kIdeal);
    }
    JointStates start;
    for (int i = 0; i < 16; ++i) {
      const std::string name = "arm_" + std::to_string(i);
      const Matrix3 R =
          rotation_rpy({0.0, 0.0, 2.0 * std::numbers::pi * i / 16.0});
      const BodyIndex arm = builder.add_rigid_body(name, make_rod(1.0, 0.5));
      builder.add_joint(name, JointKind::revolute,
                        {palm, at(R * Vector3(0.4, 0, 0), R)},
                        {arm, at({-0.25, 0, 0})}, Vector3::UnitY(), kIdeal);
      start[name] = {{0.0}, {0.1 * i}};
    }
    builder.set_gravity({0, 0, -kGravity});
    Chain chain{builder.build(), {}};
    chain.state = make_state(chain.model, start);
    const SystemState end =
        run(chain, IntegratorKind::energy_conserving, 1e-3, 0.5);
    const double energy = find_total(chain.model, chain.state);
    EXPECT_LT(find_deflection(chain.model, end), 1e-13);
    EXPECT_NEAR(find_total(chain.model, end), energy, 1e-10);
  }
}

TEST(IdealJoints, AreStiffInEquilibriaAndFrequencies) {
  Chain chain = make_chain(2);
  chain.state = make_state(chain.model, {{"hinge_0", {{1.5}, {}}}});
  const Equilibrium found =
      find_equilibrium(chain.model, chain.state, {.tolerance = 1e-10});
  EXPECT_LT((found.state.bodies[0].p_WB - Vector3(0, 0, -0.5 * kLength)).norm(),
            1e-7);
  EXPECT_LT((found.state.bodies[1].p_WB - Vector3(0, 0, -1.5 * kLength)).norm(),
            1e-7);
  // Small swings of a rod on a pin.
  const Chain one = make_chain(1);
  SystemState hanging =
      make_state(one.model, {{"hinge_0", {{std::numbers::pi / 2.0}, {0.0}}}});
  hanging = find_equilibrium(one.model, hanging).state;
  const VectorX f = find_natural_frequencies(one.model, hanging);
  EXPECT_NEAR(f[0],
              std::sqrt(1.5 * kGravity / kLength) / (2.0 * std::numbers::pi),
              1e-7);
}

TEST(IdealJoints, AreRefusedWhereTheyCannotBeSolvedFor) {
  const Chain chain = make_chain(1);
  for (const IntegratorKind kind :
       {IntegratorKind::runge_kutta_4, IntegratorKind::explicit_euler,
        IntegratorKind::central_differences, IntegratorKind::splitting}) {
    SystemState state = chain.state;
    try {
      simulate(chain.model, state, make_settings(kind, 1e-3, 0.1), {});
      ADD_FAILURE() << to_string(kind);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("joint 'hinge_0' is ideal"));
      EXPECT_THAT(error.what(), HasSubstr("energy-conserving"));
    }
  }
}

TEST(IdealJoints, CannotHaveAStiffnessOrCloseALoop) {
  SystemBuilder builder;
  const BodyIndex a = builder.add_rigid_body("a", make_rod());
  const BodyIndex b = builder.add_rigid_body("b", make_rod());
  JointOptions both = kIdeal;
  both.held.translational_stiffness = 1e6;
  EXPECT_THROW(
      builder.add_joint("j", JointKind::ball, {}, {a}, Vector3::UnitZ(), both),
      InputError);
  builder.add_joint("j", JointKind::ball, {}, {a}, Vector3::UnitZ(), kIdeal);
  builder.add_joint("k", JointKind::ball, {a}, {b}, Vector3::UnitZ(), kIdeal);
  (void)builder.build();
  builder.add_joint("l", JointKind::ball, {b}, {}, Vector3::UnitZ(), kIdeal);
  try {
    (void)builder.build();
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("joint 'l'"));
    EXPECT_THAT(error.what(), HasSubstr("loop of ideal joints"));
  }
}

}  // namespace
}  // namespace limber::dynamics::ideal_joint_test
