// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "limber/common/rotation.hpp"
#include "limber/contact/patches/patch_sides.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/pair_scene.hpp"

/// Boxes that rest, slide, land and strike each other: against Coulomb's
/// acceleration, rigid impulses and the conserved quantities.
namespace limber::contact::patch_pair_test {
namespace {

using Scene = test::PairScene;
using dynamics::IntegratorKind;
using dynamics::kWorld;
using dynamics::SystemBuilder;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGravity = 9.81;
const Vector3 kHalf(0.05, 0.04, 0.03);

struct Block {
  double mass = 10.0;
  double modulus = 1e10;  // Young's [Pa]

  [[nodiscard]] Matrix3 inertia() const {
    const Vector3 q = kHalf.cwiseProduct(kHalf);
    return mass / 3.0 *
           Vector3(q.y() + q.z(), q.x() + q.z(), q.x() + q.y()).asDiagonal();
  }
  [[nodiscard]] ContactSide side() const {
    return {Shape{Box{kHalf}, {}}, SurfaceMaterial{modulus, 0.3}, mass,
            inertia()};
  }
};

// A block on the plane z <= 0, gravity at `slope` [rad] towards x.
Scene make_resting(const Block& block, double slope,
                   const ContactParameters& parameters) {
  SystemBuilder builder;
  const auto body =
      builder.add_rigid_body("block", {block.mass, block.inertia()});
  builder.add_pair(
      "table/block", kWorld, body,
      std::make_shared<PatchPair>(
          ContactSide{Shape{HalfSpace{}, {}},
                      SurfaceMaterial{block.modulus, 0.3}, kInfinity},
          block.side(), parameters));
  builder.set_gravity(
      {kGravity * std::sin(slope), 0.0, -kGravity * std::cos(slope)});
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].p_WB.z() = kHalf.z();
  return scene;
}

// Static indentation N / (2 E* sqrt(S / pi)).
double find_depth(const Block& block, double load) {
  const double modulus = 0.5 * block.modulus / 0.91;
  const double area = 4.0 * kHalf.x() * kHalf.y();
  return load / (2.0 * modulus * std::sqrt(area / std::numbers::pi));
}

TEST(PatchPair, HoldsABlockAtRestWhateverItsRestitution) {
  for (const double modulus : {1e9, 1e11}) {
    for (const double e : {1.0, 0.5, 0.0}) {
      SCOPED_TRACE(::testing::Message() << modulus << ", e " << e);
      const Block block{.modulus = modulus};
      Scene scene = make_resting(
          block, 0.0, {.friction = {.sliding = 0.5}, .restitution = e});
      scene.go(2.0, 1e-3);
      const dynamics::BodyState& body = scene.state.bodies[0];
      const double depth = find_depth(block, block.mass * kGravity);
      EXPECT_NEAR((kHalf.z() - body.p_WB.z()) / depth, 1.0, 1e-3);
      EXPECT_LT(body.p_WB.head<2>().norm(), 1e-14);
      EXPECT_LT(body.quat_WB.vec().norm(), 1e-12);
      EXPECT_LT(body.v_WB_W.norm() + body.w_WB_B.norm(), 1e-9);
      const dynamics::EnergyDrift& energy = scene.record.energy.worst;
      EXPECT_LT(std::abs(energy.drift.value), 0.01 * energy.throughput);
    }
  }
}

// A corner dives in only in the second half of a step, or leaves in the first;
// the work of the step's force is minus the rise of the energy.
TEST(PatchPair, BalancesTheEnergyOfAPatchThatOnlyOneEndHas) {
  const Block block;
  const PatchPair pair(
      {Shape{HalfSpace{}, {}}, SurfaceMaterial{block.modulus, 0.3}, kInfinity},
      block.side(), {.restitution = 1.0});
  const std::vector<double> memory(pair.memory_size(), 0.0);
  const auto place = [](double z, double turn) {
    return joints::PairBody{exp_rotation({turn, 0.3, 0.0}), {0.0, 0.0, z}};
  };
  const double standing =
      kHalf.x() * std::sin(0.3) + kHalf.z() * std::cos(0.3) + kHalf.y() * 0.02;
  for (const bool enters : {true, false}) {
    const joints::PairBody apart = place(standing + 3e-5, 0.019);
    const joints::PairBody deep = place(standing - 2e-5, 0.021);
    const joints::PairBody middle = place(standing + 0.5e-5, 0.02);
    const joints::PairBody A;
    const joints::PairBody& first = enters ? apart : deep;
    const joints::PairBody& last = enters ? deep : apart;
    const auto evaluate = [&](const joints::PairBody& B) {
      joints::PairResponse out(pair.most_points(), 0, 0, true);
      pair.evaluate({A, B}, {0.0, Side::right}, memory, out);
      return out;
    };
    const joints::PairResponse at_begin = evaluate(first);
    const joints::PairResponse at_end = evaluate(last);
    const joints::PairStep step{{A, first},        {A, middle}, {A, last},
                                {0.0, 1e-5, 1e-5}, at_begin,    at_end};
    const double rise = at_end.energy - at_begin.energy;
    ASSERT_GT(std::abs(rise), 0.0);
    ASSERT_EQ(evaluate(middle).energy, 0.0);
    joints::PairResponse out(pair.most_points(), 0, 0, true);
    pair.evaluate_over_step(step, memory, out);
    double work = 0.0;
    for (const joints::PairPoint& point : out.points()) {
      work += point.force_W.dot(find_position(last, point.on_B) -
                                find_position(first, point.on_B));
    }
    EXPECT_NEAR(work / rise, -1.0, 1e-9) << enters;
  }
}

// tan = 0.42 < mu = 0.5: one elastic deflection, then none.
TEST(PatchPair, HoldsABlockOnASlopeWithoutCreep) {
  for (const double e : {1.0, 0.5, 0.0}) {
    Scene scene = make_resting(
        {}, std::atan(0.42), {.friction = {.sliding = 0.5}, .restitution = e});
    scene.go(0.5, 1e-3);
    const Vector3 early = scene.state.bodies[0].p_WB;
    EXPECT_LT(std::abs(early.x()), 1e-6);
    scene.go(5.0, 1e-3);
    EXPECT_LT((scene.state.bodies[0].p_WB - early).norm(), 1e-11) << e;
  }
}

TEST(PatchPair, SlidesAsCoulombSays) {
  const double slope = std::atan(0.6);
  for (const double mu : {0.5, 0.1, 0.0}) {
    for (const double e : {1.0, 0.0}) {
      Scene scene = make_resting(
          {}, slope, {.friction = {.sliding = mu}, .restitution = e});
      scene.go(0.2, 1e-3);
      const double first = scene.state.bodies[0].v_WB_W.x();
      scene.go(0.7, 1e-3);
      const double found = (scene.state.bodies[0].v_WB_W.x() - first) / 0.5;
      const double right = kGravity * (std::sin(slope) - mu * std::cos(slope));
      EXPECT_NEAR(found / right, 1.0, 1e-6) << mu << ", e " << e;
      EXPECT_LT(scene.state.bodies[0].quat_WB.vec().norm(), 1e-3);
      const dynamics::EnergyDrift& energy = scene.record.energy.worst;
      EXPECT_LT(std::abs(energy.drift.value), 1e-7 * energy.throughput)
          << mu << ", e " << e;
    }
  }
}

// The mean distance of a face's points from its middle: uniform pressure has
// the moment mu N of it.
double find_mean_arm() {
  constexpr int kCount = 400;
  double sum = 0.0;
  for (int i = 0; i < kCount; ++i) {
    for (int k = 0; k < kCount; ++k) {
      sum += std::hypot(kHalf.x() * (i + 0.5) / kCount,
                        kHalf.y() * (k + 0.5) / kCount);
    }
  }
  return sum / (kCount * kCount);
}

TEST(PatchPair, StopsASpinAsUniformPressureDoes) {
  const Block block;
  const double mu = 0.3;
  const double rate =
      mu * block.mass * kGravity * find_mean_arm() / block.inertia()(2, 2);
  for (const auto scheme :
       {IntegratorKind::generalized_alpha, IntegratorKind::energy_conserving}) {
    for (const double start : {5.0, -5.0}) {
      Scene scene = make_resting(block, 0.0, {.friction = {.sliding = mu}});
      scene.go(0.01, 5e-4, scheme);
      scene.state.bodies[0].w_WB_B.z() = start;
      const double lasts = std::abs(start) / rate;
      scene.go(0.01 + 0.5 * lasts, 5e-4, scheme);
      EXPECT_NEAR(scene.state.bodies[0].w_WB_B.z() / start, 0.5, 0.01);
      scene.go(0.01 + 1.02 * lasts, 5e-4, scheme);
      EXPECT_NEAR(scene.state.bodies[0].w_WB_B.z() / start, 0.0, 0.01);
      EXPECT_LT(scene.state.bodies[0].v_WB_W.head<2>().norm(), 1e-6);
    }
  }
}

// One cone holds both: neither ends before the other.
TEST(PatchPair, StopsSpinAndSlideTogether) {
  Scene scene = make_resting({}, 0.0, {.friction = {.sliding = 0.3}});
  scene.go(0.01, 5e-4);
  scene.state.bodies[0].w_WB_B.z() = 10.0;
  scene.state.bodies[0].v_WB_W.x() = 0.3;
  double slides = 0.0;
  double spins = 0.0;
  for (int i = 1; i <= 200; ++i) {
    const double t = 0.01 + 1e-3 * i;
    scene.go(t, 5e-4);
    if (scene.state.bodies[0].v_WB_W.head<2>().norm() > 3e-3) slides = t;
    if (std::abs(scene.state.bodies[0].w_WB_B.z()) > 0.1) spins = t;
  }
  // Longer than the slide alone.
  EXPECT_GT(slides, 0.01 + 0.3 / (0.3 * kGravity) + 5e-3);
  EXPECT_LT(slides, 0.2);
  EXPECT_NEAR(slides, spins, 5e-3);
}

// Two boxes that strike with an edge, a corner or a face, turning.
Scene make_strike(const Vector3& turn, double friction, double e,
                  bool is_swapped, const Pose& X = {}) {
  const Block block{.mass = 1.0};
  const ContactParameters parameters{.friction = {.sliding = friction},
                                     .restitution = e};
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", {block.mass, block.inertia()});
  const auto b = builder.add_rigid_body("b", {block.mass, block.inertia()});
  const auto law =
      std::make_shared<PatchPair>(block.side(), block.side(), parameters);
  is_swapped ? builder.add_pair("b/a", b, a, law)
             : builder.add_pair("a/b", a, b, law);
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  dynamics::BodyState& fixed = scene.state.bodies[0];
  fixed.p_WB = X.p;
  fixed.quat_WB = Quaternion(X.R);
  dynamics::BodyState& flying = scene.state.bodies[1];
  flying.quat_WB = Quaternion(Matrix3(X.R * exp_rotation(turn)));
  flying.p_WB = X * Vector3(0.01, -0.02, 0.12);
  flying.v_WB_W = X.R * Vector3(0.1, 0.05, -0.8);
  flying.w_WB_B = Vector3(0.5, -1.0, 2.0);
  return scene;
}

const Vector3 kTurns[] = {{0.0, 0.0, 0.3}, {0.7, 0.0, 0.2}, {0.6, 0.4, 0.1}};

double find_energy(const Scene& scene) {
  return calc_energy(scene.model, scene.state).total();
}

// By the energy-conserving scheme: without damping and friction nothing is lost
// but round-off, with them nothing is gained; momenta in any case.
TEST(PatchPair, KeepsEnergyAndMomentaOfBoxesThatStrike) {
  for (const Vector3& turn : kTurns) {
    for (const double friction : {0.0, 0.4}) {
      for (const double e : {1.0, 0.6}) {
        SCOPED_TRACE(::testing::Message()
                     << turn.transpose() << ", mu " << friction << ", e " << e);
        Scene scene = make_strike(turn, friction, e, false);
        const auto find_momenta = [&] {
          Vector6 momenta = Vector6::Zero();
          for (const dynamics::BodyState& body : scene.state.bodies) {
            const Matrix3 R = body.quat_WB.toRotationMatrix();
            const Vector3 p = 1.0 * body.v_WB_W;
            momenta.head<3>() += p;
            momenta.tail<3>() +=
                body.p_WB.cross(p) +
                R * (Block{.mass = 1.0}.inertia() * body.w_WB_B);
          }
          return momenta;
        };
        const double before = find_energy(scene);
        const Vector6 momenta = find_momenta();
        scene.go(0.3, 1e-3, IntegratorKind::energy_conserving);
        EXPECT_GE(scene.record.contacts.size(), 1U);
        const double after = find_energy(scene);
        if (friction == 0.0 && e == 1.0) {
          EXPECT_NEAR(after / before, 1.0, 1e-9);
        } else {
          EXPECT_LT(after, before);
        }
        const dynamics::EnergyDrift& energy = scene.record.energy.worst;
        EXPECT_LT(std::abs(energy.drift.value), 5e-4 * energy.throughput);
        EXPECT_LT((find_momenta() - momenta).norm(), 1e-5 * momenta.norm());
      }
    }
  }
}

TEST(PatchPair, DoesNotDependOnNamesPlaceAndAxes) {
  const Pose X{exp_rotation(Vector3(0.3, -1.0, 2.0)), {1e3, -5e2, 2e3}};
  for (const Vector3& turn : kTurns) {
    Scene one = make_strike(turn, 0.4, 0.6, false);
    Scene swapped = make_strike(turn, 0.4, 0.6, true);
    Scene moved = make_strike(turn, 0.4, 0.6, false, X);
    for (Scene* scene : {&one, &swapped, &moved}) scene->go(0.12, 1e-3);
    for (std::size_t b = 0; b < 2; ++b) {
      const Vector3& v = one.state.bodies[b].v_WB_W;
      EXPECT_LT((swapped.state.bodies[b].v_WB_W - v).norm(), 1e-8);
      EXPECT_LT((moved.state.bodies[b].v_WB_W - X.R * v).norm(), 1e-5);
    }
  }
}

TEST(PatchPair, SuitsSolidsOfWhichOneIsBounded) {
  const ContactSide box = Block{}.side();
  const ContactSide plane{Shape{HalfSpace{}, {}}, {}, kInfinity};
  const ContactSide ball{Shape{Sphere{0.1}, {}}, SurfaceMaterial{1e9, 0.3},
                         1.0};
  EXPECT_TRUE(suits(plane, box));
  EXPECT_TRUE(suits(box, box));
  EXPECT_FALSE(suits(plane, plane));
  EXPECT_TRUE(suits(ball, box));
  EXPECT_TRUE(suits(ball, plane));
  EXPECT_TRUE(suits(ball, ball));
}

}  // namespace
}  // namespace limber::contact::patch_pair_test
