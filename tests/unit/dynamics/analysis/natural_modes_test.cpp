// SPDX-License-Identifier: BSD-3-Clause
// Small motion about rest and about steady motion, against closed forms.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/linked_bodies.hpp"

namespace limber::dynamics::natural_modes_test {
namespace {

using testing::make_all_links;
using testing::make_linked_bodies;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kGravity = 9.81;

joints::Bushing make_bushing(const Vector3& translation,
                             const Vector3& rotation,
                             const Vector3& damping = Vector3::Zero()) {
  joints::Bushing::Parameters p;
  p.translational_stiffness = translation.asDiagonal();
  p.rotational_stiffness = rotation.asDiagonal();
  p.translational_damping = damping.asDiagonal();
  return joints::Bushing(p);
}

joints::Joint make_hinge(const Vector3& axis, double stiffness) {
  return joints::make_joint(joints::JointKind::revolute, axis,
                            axis.unitOrthogonal(),
                            {.translational_stiffness = stiffness,
                             .rotational_stiffness = stiffness});
}

/// The mode whose frequency is nearest.
NaturalMode find_mode(const NaturalModes& modes, double frequency) {
  NaturalMode best;
  double gap = 1e300;
  for (const NaturalMode& m : modes.modes) {
    if (std::abs(m.frequency() - frequency) >= gap) continue;
    gap = std::abs(m.frequency() - frequency);
    best = m;
  }
  return best;
}

/// Of the modes of one frequency [rad/s].
std::vector<double> find_orbits(const NaturalModes& modes, double omega) {
  std::vector<double> orbits;
  for (const NaturalMode& m : modes.modes) {
    if (std::abs(m.value.imag() - omega) < 1e-8 * omega) {
      orbits.push_back(m.orbit);
    }
  }
  return orbits;
}

auto is_one_each_way() {
  return ::testing::UnorderedElementsAre(::testing::DoubleNear(1.0, 1e-6),
                                         ::testing::DoubleNear(-1.0, 1e-6));
}

long count_free(const NaturalModes& modes) {
  return std::count_if(modes.modes.begin(), modes.modes.end(),
                       [](const NaturalMode& m) { return m.is_free(); });
}

// A disc on a bushing: what its bearings are to a stiff shaft.
struct Rotor {
  Rotor(const Vector3& bearing, double spin, const Vector3& damping,
        const Matrix3& R = Matrix3::Identity()) {
    SystemBuilder builder;
    const BodyIndex disc = builder.add_rigid_body(
        "disc",
        {kMass, Matrix3(Vector3(kAcross, kAcross, kPolar).asDiagonal())});
    builder.add_coupler("bearings",
                        make_bushing(bearing, {kTilt, kTilt, 0.0}, damping),
                        builder.attach_world("ground", {R, Vector3::Zero()}),
                        builder.attach_frame("hub", disc, {}));
    model = builder.build();
    state = make_state(model);
    state.bodies[0].quat_WB = Quaternion(R);
    state.bodies[0].w_WB_B = Vector3(0, 0, spin);
  }
  static constexpr double kMass = 2.0;
  static constexpr double kAcross = 0.02;
  static constexpr double kPolar = 0.03;
  static constexpr double kTilt = 50.0;
  SystemModel model;
  SystemState state;
};

// kAcross s^2 -+ i spin kPolar s + kTilt = 0 of the tilts' circles.
TEST(NaturalModes, OfASpinningDiscAreTheClosedFormsOfItsWhirls) {
  for (const double spin : {0.01, 20.0, 400.0}) {
    const Rotor rotor({8e3, 8e3, 1e7}, spin, Vector3::Zero());
    const NaturalModes found = find_natural_modes(rotor.model, rotor.state);
    EXPECT_TRUE(found.is_moving);
    EXPECT_TRUE(found.axes.w_W.isZero(0.0));
    EXPECT_LT(found.change, 1e-9);
    EXPECT_FALSE(found.imbalance.matters);
    const double half = 0.5 * spin * Rotor::kPolar / Rotor::kAcross;
    const double root =
        std::hypot(half, std::sqrt(Rotor::kTilt / Rotor::kAcross));
    const NaturalMode forward = find_mode(found, (root + half) / kTurn);
    const NaturalMode backward = find_mode(found, (root - half) / kTurn);
    EXPECT_NEAR(forward.value.imag(), root + half, 1e-9 * root);
    EXPECT_NEAR(backward.value.imag(), root - half, 1e-9 * root);
    EXPECT_NEAR(forward.orbit, 1.0, 1e-6);
    EXPECT_NEAR(backward.orbit, -1.0, 1e-6);
    EXPECT_NEAR(forward.damping_ratio(), 0.0, 1e-9);
    EXPECT_EQ(count_free(found), 1);  // it spins freely
    // The places' two circles, of one frequency.
    EXPECT_THAT(find_orbits(found, std::sqrt(4e3)), is_one_each_way());
  }
}

// The places' two circles share one frequency, high or low, to round-off.
TEST(NaturalModes, OfEqualBearingsAreCirclesInBothDirections) {
  const Matrix3 R = exp_rotation(Vector3(0.4, -0.7, 0.3));
  for (const double bearing : {8.0, 8e3, 8e7, 8e11}) {
    const Rotor rotor({bearing, bearing, 3.0 * bearing}, 20.0, Vector3::Zero(),
                      R);
    const double place = std::sqrt(bearing / Rotor::kMass);
    EXPECT_THAT(
        find_orbits(find_natural_modes(rotor.model, rotor.state), place),
        is_one_each_way())
        << bearing;
  }
}

TEST(NaturalModes, OfARoundRotorInUnequalBearingsAreExactInAxesThatRest) {
  const Rotor rotor({8e3, 5e4, 1e7}, 300.0, Vector3::Zero());
  const NaturalModes found = find_natural_modes(rotor.model, rotor.state);
  EXPECT_LT(found.change, 1e-9);
  for (const double k : {8e3, 5e4}) {
    const double w = std::sqrt(k / Rotor::kMass);
    EXPECT_NEAR(find_mode(found, w / kTurn).value.imag(), w, 1e-9 * w);
  }
}

// m s^2 + c s + k = 0 along each axis.
TEST(NaturalModes, HaveTheDampingRatiosOfTheirDampers) {
  const Vector3 k(8e3, 5e4, 2e5);
  const Vector3 c(3.0, 90.0, 2000.0);  // the last beyond critical
  const Rotor rotor(k, 0.0, c);
  const NaturalModes found = find_natural_modes(rotor.model, rotor.state);
  EXPECT_FALSE(found.is_moving);
  for (const int i : {0, 1}) {
    const double w = std::sqrt(k[i] / Rotor::kMass);
    const NaturalMode mode = find_mode(found, w / kTurn);
    EXPECT_NEAR(mode.frequency(), w / kTurn, 1e-9 * w);
    EXPECT_NEAR(mode.damping_ratio(), c[i] / (2.0 * w * Rotor::kMass), 1e-9);
  }
  const double half = 0.5 * c[2] / Rotor::kMass;
  const double root = std::sqrt(half * half - k[2] / Rotor::kMass);
  for (const double s : {-half + root, -half - root}) {
    const NaturalMode mode = find_mode(found, -s / kTurn);
    EXPECT_NEAR(mode.value.real(), s, 1e-7 * half);
    EXPECT_EQ(mode.value.imag(), 0.0);
  }
}

// Hung with the sag of its hinge: m g l = J w^2; the hinge itself is up to 1e14
// times as stiff.
TEST(NaturalModes, OfAPendulumAreFoundBesideAHingeOfAnyStiffness) {
  for (const double stiffness : {1e5, 1e8, 1e11, 1e14}) {
    SystemBuilder builder;
    builder.set_gravity({0, 0, -kGravity});
    const BodyIndex bar = builder.add_rigid_body(
        "bar", {2.0, Matrix3(Vector3(0.3, 0.3, 0.01).asDiagonal())});
    builder.add_coupler(
        "hinge", make_hinge(Vector3::UnitX(), stiffness),
        builder.attach_world("pivot", {}),
        builder.attach_frame("end", bar,
                             {Matrix3::Identity(), Vector3(0, 0, 0.6)}));
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].p_WB.z() = -0.6;
    const NaturalModes started = find_natural_modes(model, state);
    EXPECT_TRUE(started.imbalance.matters);
    EXPECT_NEAR(started.imbalance.force, 2.0 * kGravity, 1e-3);
    EXPECT_EQ(started.imbalance.force_body, "bar");
    state = find_equilibrium(model, state).state;
    const NaturalModes found = find_natural_modes(model, state);
    EXPECT_FALSE(found.imbalance.matters) << stiffness;
    EXPECT_EQ(count_free(found), 0) << stiffness;
    const double w = std::sqrt(2.0 * kGravity * 0.6 / (0.3 + 2.0 * 0.36));
    EXPECT_NEAR(found.modes[0].value.imag(), w, 1e-4 * w) << stiffness;
    EXPECT_NEAR(find_natural_frequencies(model, state)[0], w / kTurn, 1e-4 * w);
  }
}

// A slide that is free, one that is 1e-12 as stiff as its guide.
TEST(NaturalModes, CountAsFreeWhatNothingHoldsAndNothingElse) {
  for (const double soft : {0.0, 0.1, 1e3}) {
    SystemBuilder builder;
    const BodyIndex block =
        builder.add_rigid_body("block", {4.0, 0.1 * Matrix3::Identity()});
    builder.add_coupler("guide",
                        make_bushing({soft, 1e11, 1e11}, {1e10, 1e10, 1e10}),
                        builder.attach_world("ground", {}),
                        builder.attach_frame("hub", block, {}));
    const SystemModel model = builder.build();
    const NaturalModes found = find_natural_modes(model, make_state(model));
    EXPECT_EQ(count_free(found), soft == 0.0 ? 1 : 0);
    EXPECT_NEAR(found.modes[0].frequency(), std::sqrt(soft / 4.0) / kTurn,
                1e-9);
  }
}

// In axes that turn, (k_1/m - spin^2 - s)(k_2/m - spin^2 - s) = 4 spin^2 s with
// s the square of a frequency: a mass on a shaft that is not round.
TEST(NaturalModes, OfAShaftThatIsNotRoundAreThoseOfAxesThatTurn) {
  const double k1 = 2e4;
  const double k2 = 8e4;
  constexpr double kMass = 2.0;
  for (const double spin : {50.0, 150.0, 300.0}) {
    SystemBuilder builder;
    const Matrix3 J = Vector3(0.1, 0.1, 0.15).asDiagonal();
    const BodyIndex shaft = builder.add_rigid_body("shaft", {5.0, J});
    const BodyIndex mass = builder.add_rigid_body("mass", {kMass, J});
    builder.add_coupler("bearing", make_hinge(Vector3::UnitZ(), 1e10),
                        builder.attach_world("ground", {}),
                        builder.attach_frame("hub", shaft, {}));
    builder.add_coupler("shaft",
                        make_bushing({k1, k2, 1e10}, {1e10, 1e10, 1e10}),
                        builder.attach_frame("seat", shaft, {}),
                        builder.attach_frame("eye", mass, {}));
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    for (BodyState& b : state.bodies) b.w_WB_B = Vector3(0, 0, spin);
    const NaturalModes found = find_natural_modes(model, state);
    EXPECT_NEAR(found.axes.w_W.z(), spin, 1e-12);
    EXPECT_LT(found.change, 1e-6);
    const double a = k1 / kMass - spin * spin;
    const double b = k2 / kMass - spin * spin;
    const double half = 0.5 * (a + b + 4.0 * spin * spin);
    const double root = std::sqrt(half * half - a * b);
    for (const double s : {half + root, half - root}) {
      const double size = std::sqrt(std::abs(s));
      const NaturalMode mode = find_mode(found, size / kTurn);
      EXPECT_NEAR(std::abs(mode.value), size, 1e-4 * size) << spin;
      // Between the two critical speeds it is unstable.
      EXPECT_NEAR(s < 0.0 ? std::abs(mode.value.real()) : mode.value.imag(),
                  size, 1e-4 * size);
    }
  }
}

// Euler's equations: (J_1 - J_3)(J_2 - J_3) spin^2 / (J_1 J_2) = - s^2.
TEST(NaturalModes, OfAFreeTopAreEulersAndUnstableAboutTheMiddleAxis) {
  const Vector3 J(1.0, 2.0, 2.5);
  for (int axis = 0; axis < 3; ++axis) {
    SystemBuilder builder;
    builder.add_rigid_body("top", {3.0, Matrix3(J.asDiagonal())});
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].v_WB_W = Vector3(1, 2, 3);
    state.bodies[0].w_WB_B = 7.0 * Vector3::Unit(axis);
    const NaturalModes found = find_natural_modes(model, state);
    EXPECT_FALSE(found.imbalance.matters);
    EXPECT_LT(found.change, 1e-6);
    EXPECT_EQ(count_free(found), 4) << axis;  // three places and its phase
    const double a = J[(axis + 1) % 3];
    const double b = J[(axis + 2) % 3];
    const double s = 49.0 * (a - J[axis]) * (b - J[axis]) / (a * b);
    const double size = std::sqrt(std::abs(s));
    const NaturalMode mode = find_mode(found, size / kTurn);
    if (s < 0.0) {
      EXPECT_NEAR(std::abs(mode.value.real()), size, 1e-9);
    } else {
      EXPECT_NEAR(mode.value.imag(), size, 1e-9);
    }
  }
}

// M x'' + D x' + S x = 0 against differences of the accelerations, of every
// kind of link between bodies that bend and move, in world axes and in others.
TEST(SmallMotion, IsThatOfDifferencesOfTheAccelerations) {
  constexpr double kStep = 1e-6;
  const auto links = make_all_links(2.0);
  for (const auto& link : links) {
    const auto linked = make_linked_bodies(link, {true, false, true}, 3, 1.0);
    const SystemModel& model = linked.model;
    const SystemState& state = linked.state;
    const TurningAxes axes{exp_rotation(Vector3(0.3, -1.0, 0.7)),
                           Vector3(0.5, 2.0, -1.0)};
    const SmallMotion motion = find_small_motion(model, state, axes);
    const Eigen::Index n = motion.size();
    const VectorX x = VectorX::LinSpaced(n, -1.0, 1.3).array().sin();
    const VectorX v = VectorX::LinSpaced(n, 2.0, -1.0).array().cos();
    SystemTerms terms = make_terms(model);
    const auto accelerate = [&](double h) {
      SystemState moved = state;
      for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        BodyState& body = moved.bodies[b];
        const Eigen::Index p = motion.places[b];
        const int m = model.bodies[b].modes;
        moved.eta.segment(model.bodies[b].offset, m) +=
            h * x.segment(motion.modes[b], m);
        moved.etadot.segment(model.bodies[b].offset, m) +=
            h * v.segment(motion.modes[b], m);
        const Matrix3 R_WB = body.quat_WB.toRotationMatrix();
        const Vector3 place = x.segment<3>(p);
        const Vector3 turn = x.segment<3>(p + 3);
        const Vector3 w = axes.R.transpose() * axes.w_W;
        body.p_WB += h * (axes.R * place);
        body.v_WB_W += h * (axes.R * (v.segment<3>(p) + w.cross(place)));
        body.quat_WB = body.quat_WB *
                       exp_quaternion(h * (R_WB.transpose() * axes.R * turn));
        body.w_WB_B += h * (R_WB.transpose() * axes.R *
                            (v.segment<3>(p + 3) + w.cross(turn)));
      }
      calc_terms(model, moved, Side::right, terms);
      VectorX a = make_unknowns(model);
      solve_accelerations(model, terms, a);
      return a;
    };
    const VectorX change =
        (accelerate(kStep) - accelerate(-kStep)) / (2.0 * kStep);
    VectorX xddot(n);
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const Eigen::Index p = motion.places[b];
      const int m = model.bodies[b].modes;
      const BodyState& body = state.bodies[b];
      const Matrix3 R_AB = axes.R.transpose() * body.quat_WB.toRotationMatrix();
      const Vector3 w = axes.R.transpose() * axes.w_W;
      xddot.segment(motion.modes[b], m) = mode_rows(model.bodies[b], change);
      // u' = (axes)' d(v') - w x u, x'' = u' - w x x', with u = x' + w x x.
      for (const int part : {0, 3}) {
        const Vector3 at = x.segment<3>(p + part);
        const Vector3 rate = v.segment<3>(p + part);
        const Vector3 u = rate + w.cross(at);
        Vector3 du;
        if (part == 0) {
          du = axes.R.transpose() * translation_rows(model.bodies[b], change);
        } else {
          du = R_AB * rotation_rows(model.bodies[b], change) +
               (R_AB * body.w_WB_B).cross(u);
        }
        xddot.segment<3>(p + part) = du - w.cross(u) - w.cross(rate);
      }
    }
    const MatrixX one = MatrixX::Identity(n, n);
    const VectorX stiff = motion.project_stiffness(one) * x;
    const VectorX left = motion.M * xddot + motion.D * v + stiff;
    EXPECT_LT(left.norm(), 1e-6 * (stiff.norm() + (motion.D * v).norm()))
        << link.name;
  }
}

TEST(SmallMotionAtAJump, HasTheLoadThatBeginsThenAlsoAfterHours) {
  for (const double start : {0.0, 3.0, 1e4}) {
    SystemBuilder builder;
    const auto body = builder.add_rigid_body("b", {1.0, Matrix3::Identity()});
    const auto centre = builder.attach_frame("centre", body, {});
    builder.add_load("thrust", centre, {7.0, 0.0, 0.0}, Vector3::Zero(),
                     LoadFrame::body, Constant{.from = start});
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    const auto find_rest = [&](double t) {
      state.t = t;
      return find_small_motion(model, state, {}).rest;
    };
    // It turns with the body: the force changes by theta x f.
    MatrixX expected = MatrixX::Zero(6, 6);
    expected.block<3, 3>(0, 3) = skew(Vector3(7.0, 0.0, 0.0));
    EXPECT_LT((find_rest(start) - expected).norm(), 1e-12) << start;
    EXPECT_LT(find_rest(start - 1.0).norm(), 1e-12) << start;
  }
}

}  // namespace
}  // namespace limber::dynamics::natural_modes_test
