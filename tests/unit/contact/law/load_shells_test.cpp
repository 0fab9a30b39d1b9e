// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/load_shells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "limber/common/errors.hpp"
#include "unit/contact/rings.hpp"

namespace limber::contact::load_shells_test {
namespace {

using test::Rings;

// Of a ball, f = C d^1.5.
constexpr double kHertz = 1e9;  // C [N/m^1.5]

ShellLoad press(double depth) {
  const double f = kHertz * std::pow(depth, 1.5);
  return {.force = f, .stiffness = 1.5 * f / depth, .exponent = 1.5};
}

LoadShells make(double friction, double reference = 1e4) {
  return LoadShells({.limit = {.sliding = friction},
                     .tangential_ratio = 0.8,
                     .spin_ratio = 1.9,
                     .reference_stiffness = reference});
}

TEST(LoadShells, RejectValuesOutsideTheirRange) {
  EXPECT_THROW(LoadShells({.limit = {.sliding = -0.1}}), InputError);
  EXPECT_THROW(LoadShells({.tangential_ratio = 0.0}), InputError);
  EXPECT_THROW(LoadShells({.spin_ratio = -1.0}), InputError);
  EXPECT_THROW(LoadShells({.reference_stiffness = 0.0}), InputError);
}

TEST(LoadShells, TogetherStickWithTheStiffnessOfTheWholeArea) {
  const LoadShells shells = make(1e6);
  for (const double depth : {1e-9, 3e-7, 1e-5, 1e-3}) {
    const ShellLoad load = press(depth);
    const auto out =
        shells.evaluate({}, load, {.increment = {1e-9, 2e-9, 3e-9}});
    EXPECT_NEAR(out.force.x(), -0.8 * load.stiffness * 1e-9,
                1e-12 * load.stiffness * 1e-9);
    EXPECT_NEAR(out.force.y(), 2.0 * out.force.x(),
                1e-12 * load.stiffness * 1e-9);
    EXPECT_NEAR(out.force.z(), 1.9 * 3.0 * out.force.x(),
                1e-11 * load.stiffness * 1e-9);
    EXPECT_FALSE(out.slips);
  }
}

TEST(LoadShells, TogetherSlipAtCoulombsLimitAgainstTheMotion) {
  const LoadShells shells = make(0.3);
  for (const double depth : {1e-9, 3e-7, 1e-5, 1e-3}) {
    const ShellLoad load = press(depth);
    const Vector3 way(0.3, -0.4, 1.2 / 1.9);
    const auto out = shells.evaluate({}, load, {.increment = way});
    EXPECT_TRUE(out.slips);
    EXPECT_NEAR(out.force.norm(), 0.3 * load.force, 1e-12 * load.force);
    EXPECT_NEAR(out.force.y() / out.force.x(), -4.0 / 3.0, 1e-9);
    EXPECT_NEAR(out.force.z() / out.force.x(), 4.0, 1e-9);
  }
}

// Cattaneo and Mindlin: T = mu N (1 - (1 - 2 k_t u / (3 mu N))^1.5). A shell
// whose parts slip over a range r of ways is off by k_s r / 8 at most, of k / 3
// and 5/9 of the way to full slip: 5/144 mu N.
TEST(LoadShells, SlipFromTheRimInwardsAtConstantLoad) {
  const LoadShells shells = make(0.3);
  for (const double depth : {1e-6, 1.1e-6, 1.3e-6, 1.6e-6, 1.9e-6, 2.2e-6}) {
    const ShellLoad load = press(depth);
    const double most = 0.3 * load.force;
    ShellMemory memory;
    const double way = 1.5 * most / (0.8 * load.stiffness);
    for (int i = 1; i <= 100; ++i) {
      const auto out =
          shells.evaluate(memory, load, {.increment = {0.01 * way, 0.0, 0.0}});
      memory = out.next;
      const double exact = most * (1.0 - std::pow(1.0 - 0.01 * i, 1.5));
      EXPECT_NEAR(-out.force.x(), exact, 5.0 / 144.0 * most) << i;
    }
  }
}

TEST(LoadShells, GiveTheSameInAllUnits) {
  const ShellLoad load = press(2e-6);
  const auto out =
      make(0.3, 7e3).evaluate({}, load, {.increment = {1e-7, 0.0, 2e-7}});
  ShellLoad other = load;
  other.force *= 1e3;
  other.stiffness *= 1e-3;
  const auto scaled =
      make(0.3, 7.0).evaluate({}, other, {.increment = {0.1, 0.0, 0.2}});
  EXPECT_NEAR((1e-3 * scaled.force - out.force).norm(), 0.0,
              1e-12 * out.force.norm());
}

TEST(LoadShells, ForgetAllWithoutLoad) {
  const LoadShells shells = make(0.3);
  const auto held =
      shells.evaluate({}, press(1e-6), {.increment = {1e-8, 0.0, 0.0}});
  EXPECT_GT(shells.find_energy(held.next), 0.0);
  const auto free = shells.evaluate(held.next, {}, {});
  EXPECT_EQ(free.force, Vector3::Zero());
  EXPECT_EQ(shells.find_energy(free.next), 0.0);
}

TEST(LoadShells, OfAFlatAreOneSpringThatKeepsItsStiffness) {
  const LoadShells shells = make(0.3);
  ShellMemory memory;
  const ShellLoad load{.force = 10.0, .stiffness = 1e6};
  for (int i = 1; i <= 10; ++i) {
    const auto out =
        shells.evaluate(memory, load, {.increment = {3e-7, 0.0, 0.0}});
    EXPECT_NEAR(-out.force.x(), std::min(0.24 * i, 3.0), 1e-12);
    EXPECT_EQ(out.slips, 0.24 * i > 3.0);
    memory = out.next;
  }
}

// Releasing and pressing again only loses energy, and what is lost is counted.
TEST(LoadShells, LoseEnergyOnlyAndCountIt) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const LoadShells shells = make(0.3);
  ShellMemory memory;
  for (int i = 0; i < 20000; ++i) {
    const double depth = 1e-6 * std::pow(10.0, 2.0 * draw(engine));
    const ShellLoad load = press(depth);
    const double size = 0.5 * load.force / load.stiffness;
    const Vector3 way =
        size * Vector3(draw(engine), draw(engine), draw(engine));
    const double before = shells.find_energy(memory);
    const auto out = shells.evaluate(memory, load, {.increment = way});
    const double work = -out.force.dot(way);
    const double scale = before + out.energy + std::abs(work);
    EXPECT_NEAR(out.energy, shells.find_energy(out.next), 1e-12 * scale);
    EXPECT_GE(out.slip_work, -1e-12 * scale);
    // With the forces at the end the springs take no more than the work.
    EXPECT_LE(out.energy + out.slip_work, before + work + 1e-12 * scale);
    memory = out.next;
  }
}

// The tangent against central differences, for rising and falling loads, with
// and without slip, damper and residual flexibility.
TEST(LoadShells, HaveTheirDerivatives) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const LoadShells shells({.limit = {0.3, 0.2, 0.01},
                           .tangential_ratio = 0.8,
                           .spin_ratio = 1.9,
                           .reference_stiffness = 1e4});
  int slips = 0;
  for (int i = 0; i < 400; ++i) {
    const auto vector = [&] {
      return Vector3(draw(engine), draw(engine), draw(engine));
    };
    const double depth = 1e-6 * (1.5 + draw(engine));
    const ShellLoad before = press(depth);
    const ShellMemory memory =
        shells
            .evaluate(
                {}, before,
                {.increment = 0.3 * before.force / before.stiffness * vector()})
            .next;
    const auto find_load = [&](double force) {
      ShellLoad load = press(std::pow(force / kHertz, 2.0 / 3.0));
      load.residual = i % 3 == 0 ? 0.2 / before.stiffness : 0.0;
      load.grip = 1.2;
      return load;
    };
    const double damping = i % 2 == 0 ? 0.0 : 0.5 * before.force;
    const double N = before.force * (1.0 + 0.5 * draw(engine));
    const ShellMotion motion{0.5 * before.force / before.stiffness * vector(),
                             0.02 * vector()};
    const auto force = [&](const ShellLoad& load, const ShellMotion& at) {
      return shells.evaluate(memory, load, at, damping).force;
    };
    const ShellLoad load = find_load(N);
    const auto out = shells.evaluate(memory, load, motion, damping);
    slips += out.slips ? 1 : 0;
    const double way = 1e-7 * before.force / before.stiffness;
    const double tolerance = 2e-5;
    const double k = load.stiffness;
    for (int j = 0; j < 3; ++j) {
      ShellMotion plus = motion;
      ShellMotion minus = motion;
      plus.increment[j] += way;
      minus.increment[j] -= way;
      EXPECT_NEAR(((force(load, plus) - force(load, minus)) / (2.0 * way) -
                   out.by_increment.col(j))
                      .norm(),
                  0.0, tolerance * k);
      plus = minus = motion;
      plus.velocity[j] += 1e-8;
      minus.velocity[j] -= 1e-8;
      EXPECT_NEAR(((force(load, plus) - force(load, minus)) / 2e-8 -
                   out.by_velocity.col(j))
                      .norm(),
                  0.0, tolerance * (damping + N / 0.01));
    }
    const double dN = 1e-7 * N;
    EXPECT_NEAR(
        ((force(find_load(N + dN), motion) - force(find_load(N - dN), motion)) /
             (2.0 * dN) -
         out.by_load)
            .norm(),
        0.0, tolerance);
    ShellLoad plus = load;
    ShellLoad minus = load;
    plus.grip += 1e-7;
    minus.grip -= 1e-7;
    EXPECT_NEAR(
        ((force(plus, motion) - force(minus, motion)) / 2e-7 - out.by_grip)
            .norm(),
        0.0, tolerance * N);
  }
  EXPECT_GT(slips, 20);
  EXPECT_LT(slips, 380);
}

constexpr double kRadius = 0.05;  // of a ball of 1 kg [m]

// Of an impact at 1 m/s [m].
double find_most_depth() { return std::pow(1.25 / kHertz, 0.4); }

// An oblique impact of this ball.
struct Impact {
  double ratio = 0.8;  // kappa
  double friction = 0.3;
  double damping = 0.0;  // beta
  double psi = 0.0;      // kappa v_t / (mu v_n) before
  int steps = 6000;
};

struct Outcome {
  double psi = 0.0;   // after
  double rise = 0.0;  // of the energy, over the first [-]
};

class Shells {
 public:
  Shells(double ratio, double friction)
      : law_({.limit = {.sliding = friction},
              .tangential_ratio = ratio,
              .reference_stiffness = 1e8}) {}

  double move(double depth, double way, double grip) {
    const double f = kHertz * std::pow(depth, 1.5);
    const ShellLoad load{.force = f,
                         .stiffness = 1.5 * f / depth,
                         .exponent = 1.5,
                         .grip = grip};
    const auto out =
        law_.evaluate(memory_, load, {.increment = {way, 0.0, 0.0}});
    memory_ = out.next;
    return -out.force.x();
  }
  [[nodiscard]] double energy() const { return law_.find_energy(memory_); }

 private:
  LoadShells law_;
  ShellMemory memory_;
};

// Leapfrog; the ball's rim has 2/7 of the mass.
template <typename Friction>
Outcome strike(const Impact& impact, Friction friction) {
  const double h = 2.94 * find_most_depth() / impact.steps;
  const auto find_grip = [&](double d, double rate) {
    const double speed =
        std::sqrt(rate * rate + 0.8 * kHertz * std::pow(d, 2.5));
    return std::max(0.0, 1.0 + impact.damping * rate / speed);
  };
  const auto press = [&](double d, double rate) {
    if (d <= 0.0) return 0.0;
    return kHertz * std::pow(d, 1.5) * find_grip(d, rate);
  };
  const double psi_per_speed = impact.ratio / impact.friction;
  double v = impact.psi / psi_per_speed;
  double d = 0.0;
  double w = 1.0;
  double T = 0.0;
  const double first = 0.5 + v * v / 7.0;
  double least = first;
  Outcome out;
  for (;;) {
    w -= 0.5 * h * press(d, w);
    v -= 0.5 * h * 3.5 * T;
    d += h * w;
    if (d <= 0.0) break;
    T = friction.move(d, h * v, find_grip(d, w));
    w -= 0.5 * h * press(d, w);
    v -= 0.5 * h * 3.5 * T;
    const double energy = 0.5 * w * w + v * v / 7.0 +
                          0.4 * kHertz * std::pow(d, 2.5) + friction.energy();
    least = std::min(least, energy);
    out.rise = std::max(out.rise, (energy - least) / first);
  }
  out.psi = v * psi_per_speed;
  return out;
}

Outcome strike_shells(const Impact& impact) {
  return strike(impact, Shells(impact.ratio, impact.friction));
}

Outcome strike_rings(const Impact& impact) {
  return strike(impact, Rings({kRadius, 0.75 * kHertz / std::sqrt(kRadius),
                               impact.ratio, impact.friction},
                              find_most_depth()));
}

// psi_1 and psi_2 of Maw, Barber and Fawcett [1976], nu = 0.3.
TEST(LoadShells, TurnAnObliqueImpactAsManyRings) {
  for (const double psi :
       {0.2, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0}) {
    Impact impact{.ratio = 1.4 / 1.7, .psi = psi, .steps = 2000};
    const double exact = strike_rings(impact).psi;
    EXPECT_NEAR(strike_shells(impact).psi, exact, 0.03) << psi;
    impact.steps = 50;
    EXPECT_NEAR(strike_shells(impact).psi, exact, 0.05) << psi;
  }
}

// With a damped normal force, by which the friction is limited.
TEST(LoadShells, TurnADampedObliqueImpactAsManyRings) {
  for (const double damping : {0.33190, 1.67063}) {  // e 0.8, 0.3
    for (const double psi : {0.2, 1.0, 2.0, 3.0, 5.0}) {
      const Impact impact{
          .ratio = 0.8, .damping = damping, .psi = psi, .steps = 2000};
      EXPECT_NEAR(strike_shells(impact).psi, strike_rings(impact).psi, 0.03)
          << psi;
    }
  }
}

TEST(LoadShells, NeverAddEnergyToAnImpact) {
  for (const double nu : {0.0, 0.3, 0.49}) {
    for (const double friction : {0.05, 0.3, 1.0}) {
      for (const double damping : {0.0, 0.33, 1.67}) {  // e 1, 0.8, 0.3
        for (const double psi : {0.2, 1.0, 2.0, 4.0, 8.0}) {
          const Outcome out =
              strike_shells({.ratio = 2.0 * (1.0 - nu) / (2.0 - nu),
                             .friction = friction,
                             .damping = damping,
                             .psi = psi,
                             .steps = 6000});
          EXPECT_LT(out.rise, 1e-7) << nu << friction << damping << psi;
        }
      }
    }
  }
}

}  // namespace
}  // namespace limber::contact::load_shells_test
