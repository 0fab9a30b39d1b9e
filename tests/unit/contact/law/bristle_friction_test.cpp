// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/bristle_friction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/law/hertz_law.hpp"
#include "limber/contact/law/point_tangent.hpp"
#include "support/differences.hpp"
#include "support/draw_vector.hpp"
#include "unit/contact/law/make_friction.hpp"

namespace limber::contact::bristle_friction_test {
namespace {

using testing::differentiate;
using testing::draw_vector;
using testing::make_friction;
using testing::Margin;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// An arbitrary state of a contact, tangent or not.
struct Draw {
  BristleMemory memory;
  BristleMotion motion;
};

class DrawContact {
 public:
  explicit DrawContact(unsigned seed) : generator_(seed) {}

  double number() { return uniform_(generator_); }

  // With displacements of about `size` [m] on k = 1e5 and f about 100.
  Draw contact(double size) {
    Draw draw;
    const auto any = [this] { return number(); };
    const Vector3 normal = draw_vector(any).normalized();
    const Vector3 s = draw_vector(any);
    draw.memory.s_S = size * (s - normal * normal.dot(s));
    draw.memory.normal_S = normal;
    draw.motion.normal_S = (normal + 0.3 * draw_vector(any)).normalized();
    draw.motion.increment_S = size * draw_vector(any);
    draw.motion.velocity_S = 0.2 * draw_vector(any);
    draw.motion.normal_force = 100.0 * (1.5 + number());
    return draw;
  }

 private:
  std::mt19937_64 generator_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST(BristleFriction, ASmallDisplacementMeetsTheStiffnessAndNoMore) {
  const BristleFriction friction = make_friction(0.3, 8e5, 0.0);
  const BristleResponse r =
      friction.evaluate({}, {.normal_S = Vector3::UnitZ(),
                             .increment_S = {1e-6, -2e-6, 5e-3},
                             .normal_force = 100.0});
  EXPECT_LT((r.force_S - Vector3(-0.8, 1.6, 0.0)).norm(), 1e-14);
  EXPECT_FALSE(r.slips);
  EXPECT_NEAR(r.energy, 0.5 * 8e5 * 5e-12, 1e-18);
  EXPECT_EQ(r.slip_work, 0.0);
}

TEST(BristleFriction, BeyondTheConeTheForceIsOnIt) {
  DrawContact draw(3);
  const BristleFriction friction = make_friction(0.4, 1e5, 30.0);
  int slips = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto [memory, motion] = draw.contact(1e-3);
    const BristleResponse r = friction.evaluate(memory, motion);
    const double limit = 0.4 * motion.normal_force;
    EXPECT_LE(r.force_S.norm(), limit * (1.0 + 1e-14));
    EXPECT_LE(1e5 * r.next.s_S.norm(), limit * (1.0 + 1e-14));
    EXPECT_NEAR(r.force_S.dot(motion.normal_S), 0.0, 1e-12 * limit);
    EXPECT_NEAR(r.next.s_S.dot(motion.normal_S), 0.0, 1e-16);
    if (!r.slips) continue;
    EXPECT_GE(r.force_S.norm() + r.slip_work, 1e-3 * limit);
    ++slips;
  }
  EXPECT_GT(slips, 100);
  EXPECT_LT(slips, 1000);
}

TEST(BristleFriction, WithoutNormalForceItForgets) {
  DrawContact draw(4);
  const BristleFriction friction = make_friction(0.4, 1e5, 30.0);
  auto [memory, motion] = draw.contact(1e-4);
  motion.normal_force = 0.0;
  const BristleResponse r = friction.evaluate(memory, motion);
  EXPECT_EQ(r.force_S.norm(), 0.0);
  EXPECT_EQ(r.next.s_S.norm(), 0.0);
  EXPECT_EQ(r.energy, 0.0);
}

TEST(BristleFriction, WithoutFrictionThereIsNoForce) {
  DrawContact draw(5);
  const BristleFriction friction = make_friction(0.0, 1e5, 30.0);
  const auto [memory, motion] = draw.contact(1e-4);
  EXPECT_EQ(friction.evaluate(memory, motion).force_S.norm(), 0.0);
}

// What a trial of Newton's method evaluates leaves no trace.
TEST(BristleFriction, EvaluationsChangeNoMemory) {
  DrawContact draw(6);
  const BristleFriction friction = make_friction(0.4, 1e5, 30.0);
  const auto [memory, motion] = draw.contact(1e-3);
  const BristleResponse first = friction.evaluate(memory, motion);
  static_cast<void>(friction.evaluate(memory, draw.contact(1e-1).motion));
  const BristleResponse again = friction.evaluate(memory, motion);
  EXPECT_EQ(first.force_S, again.force_S);
  EXPECT_EQ(first.next.s_S, again.next.s_S);
}

// mu = 0.3 + 0.2 exp(-(v / 0.2)^2), differentiated by hand.
TEST(BristleFriction, SlidingFollowsStribecksCurveHoweverSlow) {
  const BristleFriction friction(
      {.limit = {.sliding = 0.3, .excess = 0.2, .speed = 0.2},
       .stiffness = 1e5,
       .damping = 40.0});
  for (const double v : {1e-6, 1e-3, 0.05, 0.4}) {
    const BristleResponse r =
        friction.evaluate({}, {.normal_S = Vector3::UnitZ(),
                               .increment_S = {0.1, 0.0, 0.0},
                               .velocity_S = {v, 0.0, 0.0},
                               .normal_force = 100.0});
    const double bump = 20.0 * std::exp(-25.0 * v * v);
    EXPECT_LT((r.force_S + Vector3(30.0 + bump, 0.0, 0.0)).norm(), 1e-12);
    EXPECT_NEAR(r.by_velocity(0, 0), 50.0 * v * bump, 1e-12 * 50.0 * v * bump);
  }
}

TEST(BristleFriction, DerivativesAreConsistentWithTheReturn) {
  for (const double excess : {0.0, 0.2}) {
    DrawContact draw(8);
    const BristleFriction friction(
        {.limit = {.sliding = 0.3, .excess = excess, .speed = 0.2},
         .stiffness = 1e5,
         .damping = 40.0});
    Margin margin;
    int sticks = 0;
    int spring_slips = 0;
    int damper_slips = 0;
    for (int i = 0; i < 400; ++i) {
      const Draw d = draw.contact(i % 2 == 0 ? 3e-4 : 3e-3);
      const BristleResponse r = friction.evaluate(d.memory, d.motion);
      const auto force = [&](const BristleMotion& m) {
        return friction.evaluate(d.memory, m);
      };
      // Away from the corners of the law.
      bool smooth = true;
      for (int k = 0; k < 3; ++k) {
        for (const double side : {-1.0, 1.0}) {
          BristleMotion m = d.motion;
          m.increment_S[k] += side * 1e-5;
          const BristleResponse near = force(m);
          smooth = smooth && near.slips == r.slips &&
                   (near.slip_work > 0.0) == (r.slip_work > 0.0);
        }
      }
      if (!smooth) continue;
      const double scale = d.motion.normal_force;
      for (int k = 0; k < 3; ++k) {
        const auto by_increment = [&](double x) -> Vector3 {
          BristleMotion m = d.motion;
          m.increment_S[k] += x * 1e-5;
          return force(m).force_S;
        };
        const auto by_velocity = [&](double x) -> Vector3 {
          BristleMotion m = d.motion;
          m.velocity_S[k] += x * 1e-2;
          return force(m).force_S;
        };
        margin.add(
            (differentiate(by_increment, 1e-2) - 1e-5 * r.by_increment.col(k))
                .norm(),
            scale);
        margin.add(
            (differentiate(by_velocity, 1e-2) - 1e-2 * r.by_velocity.col(k))
                .norm(),
            scale);
      }
      const auto by_force = [&](double x) -> Vector3 {
        BristleMotion m = d.motion;
        m.normal_force += x;
        return force(m).force_S;
      };
      margin.add((differentiate(by_force, 1e-2) - r.by_normal_force).norm(),
                 scale);
      sticks += r.slips ? 0 : 1;
      spring_slips += r.slip_work > 0.0 ? 1 : 0;
      damper_slips += r.slips && r.slip_work == 0.0 ? 1 : 0;
    }
    margin.expect_below(1e-10);
    EXPECT_GT(sticks, 20);
    EXPECT_GT(spring_slips, 20);
    EXPECT_GT(damper_slips, 3);
  }
}

TEST(BristleFriction, ThePointsTangentIsTheForcesDerivative) {
  DrawContact draw(9);
  const HertzLaw law({.stiffness = 1e9, .residual = 1e-6});
  const BristleFriction friction = make_friction(0.3, 1e5, 40.0);
  Margin margin;
  int unsymmetric = 0;
  for (int i = 0; i < 100; ++i) {
    const Draw d = draw.contact(i % 2 == 0 ? 1e-4 : 3e-3);
    const Vector3 n = d.motion.normal_S;
    const Vector3 u0 = d.motion.increment_S;
    const double depth = 1e-4 * (1.5 + draw.number());
    struct Point {
      DampedForce pressed;
      BristleResponse friction;
      Vector3 force;
    };
    const auto at = [&](const Vector3& u, const Vector3& v) {
      const HertzLaw::Response r = law.evaluate(depth - n.dot(u - u0));
      Point point;
      point.pressed = damp({r.force, r.stiffness}, -n.dot(v), {.s = 0.5});
      BristleMotion m = d.motion;
      m.increment_S = u;
      m.velocity_S = v;
      m.normal_force = point.pressed.force;
      point.friction = friction.evaluate(d.memory, m);
      point.force = point.pressed.force * n + point.friction.force_S;
      return point;
    };
    const Vector3 v0 = d.motion.velocity_S;
    const Point point = at(u0, v0);
    if (!(point.friction.slip_work > 0.0) && point.friction.slips) continue;
    const PointTangent tangent =
        find_point_tangent(n, point.pressed, point.friction);
    for (int k = 0; k < 3; ++k) {
      const Vector3 e = Vector3::Unit(k);
      const Vector3 by_u = differentiate(
          [&](double x) -> Vector3 { return at(u0 + 1e-6 * x * e, v0).force; },
          1e-2);
      const Vector3 by_v = differentiate(
          [&](double x) -> Vector3 { return at(u0, v0 + 1e-4 * x * e).force; },
          1e-2);
      margin.add((by_u + 1e-6 * tangent.stiffness.col(k)).norm(), 100.0);
      margin.add((by_v + 1e-4 * tangent.damping.col(k)).norm(), 100.0);
    }
    const Matrix3& K = tangent.stiffness;
    unsymmetric += (K - K.transpose()).norm() > 0.1 * K.norm() ? 1 : 0;
  }
  margin.expect_below(1e-9);
  EXPECT_GT(unsymmetric, 10);
}

// Everything turned by a rotation gives the force and derivatives turned.
TEST(BristleFriction, ItDoesNotDependOnTheFrame) {
  DrawContact draw(12);
  const BristleFriction friction = make_friction(0.3, 1e5, 40.0);
  for (int i = 0; i < 50; ++i) {
    const auto [memory, motion] = draw.contact(i % 2 == 0 ? 3e-4 : 3e-3);
    const Matrix3 R =
        exp_rotation(3.0 * draw_vector([&] { return draw.number(); }));
    const BristleResponse r = friction.evaluate(memory, motion);
    const BristleResponse turned =
        friction.evaluate({R * memory.s_S, R * memory.normal_S},
                          {.normal_S = R * motion.normal_S,
                           .increment_S = R * motion.increment_S,
                           .velocity_S = R * motion.velocity_S,
                           .normal_force = motion.normal_force});
    const double size = motion.normal_force;
    EXPECT_LT((turned.force_S - R * r.force_S).norm(), 1e-13 * size);
    EXPECT_LT((turned.by_increment - R * r.by_increment * R.transpose()).norm(),
              1e-12 * 1e5);
    EXPECT_NEAR(turned.energy, r.energy, 1e-13 * (r.energy + 1e-9));
  }
}

// A tangent plane that turns by half a turn and more, in steps, takes the
// bristle with it: nothing is lost, and along a great circle its angle to the
// path stays.
TEST(BristleFriction, ABristleTurnsWithTheTangentPlane) {
  const BristleFriction friction = make_friction(0.5, 1e5, 0.0);
  const Vector3 axis = Vector3::UnitY();
  const Vector3 s0(3e-4, 4e-4, 0.0);
  BristleMemory memory{s0, Vector3::UnitZ()};
  const int count = 40;
  for (int i = 1; i <= count; ++i) {
    const Matrix3 R = exp_rotation(4.0 * i / count * axis);
    const BristleResponse r = friction.evaluate(
        memory, {.normal_S = R * Vector3::UnitZ(), .normal_force = 1000.0});
    EXPECT_LT((r.next.s_S - R * s0).norm(), 1e-17);
    EXPECT_NEAR(r.energy, 0.5 * 1e5 * 25e-8, 1e-14);
    EXPECT_EQ(r.slip_work, 0.0);
    memory = r.next;
  }
}

TEST(BristleFriction, ANormalThatTurnsOverForgetsTheBristle) {
  const BristleFriction friction = make_friction(0.5, 1e5, 0.0);
  const BristleResponse r =
      friction.evaluate({{1e-4, 0.0, 0.0}, Vector3::UnitZ()},
                        {.normal_S = -Vector3::UnitZ(), .normal_force = 1e3});
  EXPECT_EQ(r.force_S.norm(), 0.0);
}

// What is left over k |s - Q s_0|^2 / 2 is round-off: at every step of an
// arbitrary history with a normal that turns and a load that comes and goes.
struct History {
  double work = 0.0;
  double lost = 0.0;
  double stored = 0.0;
  int slips = 0;
  [[nodiscard]] double gap() const { return work - lost - stored; }
};

History run_history(const BristleFriction& friction, unsigned seed, int count) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto any = [&] { return uniform(generator); };
  std::vector<Vector3> ways;
  std::vector<Vector3> turns;
  for (int i = 0; i < 4; ++i) {
    ways.emplace_back(2e-3 * draw_vector(any));
    turns.emplace_back(0.4 * draw_vector(any));
  }
  const auto sum = [](const std::vector<Vector3>& terms, double t) {
    Vector3 total = Vector3::Zero();
    for (std::size_t i = 0; i < terms.size(); ++i) {
      total += terms[i] * std::sin((2.0 * i + 1.0) * t + i * i);
    }
    return total;
  };
  const double h = 5.0 / count;
  const double k = friction.parameters().stiffness;
  History history;
  BristleMemory memory;
  for (int i = 1; i <= count; ++i) {
    const double t = h * i;
    const Vector3 increment = sum(ways, t) - sum(ways, t - h);
    BristleMotion motion;
    motion.normal_S = exp_rotation(sum(turns, t)) * Vector3::UnitZ();
    motion.increment_S = increment;
    motion.velocity_S = increment / h;
    motion.normal_force = std::max(0.0, 60.0 + 100.0 * std::sin(3.0 * t));
    const BristleResponse r = friction.evaluate(memory, motion);
    const double before = 0.5 * k * memory.s_S.squaredNorm();
    const double work = -r.force_S.dot(increment);
    const double lost = r.slip_work + h * r.damper_power;
    EXPECT_GE(r.slip_work, 0.0);
    EXPECT_GE(r.damper_power, -1e-15);
    const BristleResponse carried = friction.evaluate(
        memory, {.normal_S = motion.normal_S, .normal_force = 1e9});
    const double rest = 0.5 * k * (r.next.s_S - carried.next.s_S).squaredNorm();
    EXPECT_NEAR(work, r.energy - before + lost + rest,
                1e-13 * (before + r.energy + lost + std::abs(work)) + 1e-18);
    history.work += work;
    history.lost += lost;
    history.slips += r.slips ? 1 : 0;
    history.stored = r.energy;
    memory = r.next;
  }
  return history;
}

TEST(BristleFriction, WorkIsStoredOrLostToTheOrderOfTheStep) {
  const BristleFriction friction = make_friction(0.4, 1e5, 20.0);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const History coarse = run_history(friction, seed, 4000);
    const History fine = run_history(friction, seed, 16000);
    EXPECT_GT(coarse.slips, 100);
    EXPECT_LT(coarse.slips, 4000);
    EXPECT_GT(coarse.gap(), 0.0);
    EXPECT_LT(coarse.gap(), 0.01 * coarse.lost);
    EXPECT_NEAR(fine.gap() / coarse.gap(), 0.25, 0.08);
  }
}

TEST(BristleFriction, BadValuesAreRefused) {
  const auto expect_refused = [](const BristleFriction::Parameters& p) {
    EXPECT_THROW(static_cast<void>(BristleFriction(p)), InputError);
  };
  EXPECT_NO_THROW(static_cast<void>(make_friction(0.0, 1.0, 0.0)));
  for (const double bad : {-0.1, kNaN, kInf}) {
    expect_refused({.limit = {.sliding = bad}, .stiffness = 1.0});
    expect_refused({.limit = {.excess = bad}, .stiffness = 1.0});
    expect_refused({.stiffness = 1.0, .damping = bad});
  }
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    expect_refused({.stiffness = bad});
    expect_refused({.limit = {.speed = bad}, .stiffness = 1.0});
  }
  EXPECT_THROW(static_cast<void>(find_bristle_damping(-1.0, 1.0)),
               ContractError);
  EXPECT_THROW(static_cast<void>(find_bristle_damping(1.0, kNaN)),
               ContractError);
}

TEST(BristleFriction, NaNGoesThrough) {
  DrawContact draw(13);
  const BristleFriction friction = make_friction(0.3, 1e5, 40.0);
  const Draw d = draw.contact(1e-3);
  Draw bad = d;
  bad.motion.increment_S[1] = kNaN;
  EXPECT_TRUE(friction.evaluate(bad.memory, bad.motion).force_S.hasNaN());
  bad = d;
  bad.motion.velocity_S[1] = kNaN;
  EXPECT_TRUE(friction.evaluate(bad.memory, bad.motion).force_S.hasNaN());
  bad = d;
  bad.memory.s_S[1] = kNaN;
  EXPECT_TRUE(friction.evaluate(bad.memory, bad.motion).force_S.hasNaN());
}

}  // namespace
}  // namespace limber::contact::bristle_friction_test
