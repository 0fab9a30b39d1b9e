// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"

/// Restitution of touches that begin at rest, meet others or strike with a
/// corner, an edge or a face: against Runge-Kutta solutions of springs on a
/// line, and against rigid bodies' impulses.
namespace limber::contact::touch_restitution_test {
namespace {

using dynamics::BodyIndex;
using dynamics::IntegratorKind;
using dynamics::kWorld;
using dynamics::SystemBuilder;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMass = 0.03;    // [kg]
constexpr double kRadius = 0.01;  // [m]
constexpr SurfaceMaterial kPlastic{2e9, 0.3};
constexpr double kModulus = 2e9 / (2.0 * 0.91);  // E* of two [Pa]

// beta of e, by an independent program.
constexpr std::pair<double, double> kDull{0.9, 0.15774};
constexpr std::pair<double, double> kHalf{0.5, 0.96355};
constexpr std::pair<double, double> kElastic{1.0, 0.0};

/// Balls of kMass above each other, and a floor.
struct Column {
  std::vector<double> x;  // of the balls' centres [m]
  std::vector<double> v;  // [m/s]
  bool has_floor = false;
  double gravity = 0.0;  // downwards [m/s^2]
};

/// By the classical Runge-Kutta scheme; f = k d^1.5 (1 + beta d' / sqrt(d'^2 +
/// 2 W / m)), k of both radii, m of both masses.
class Springs {
 public:
  Springs(Column column, double beta)
      : column_(std::move(column)), beta_(beta), count_(column_.x.size()) {}

  std::vector<double> run(double time, double h) {
    std::vector<double> state = column_.x;
    state.insert(state.end(), column_.v.begin(), column_.v.end());
    for (long i = std::lround(time / h); i > 0; --i) advance(h, state);
    return {state.begin() + static_cast<std::ptrdiff_t>(count_), state.end()};
  }

 private:
  using State = std::vector<double>;

  [[nodiscard]] double find_force(double depth, double rate, double radius,
                                  double mass) const {
    if (depth <= 0.0) return 0.0;
    const double f =
        4.0 / 3.0 * kModulus * std::sqrt(radius) * std::pow(depth, 1.5);
    const double W = 0.4 * f * depth;
    const double root = std::sqrt(rate * rate + 2.0 * W / mass);
    return f * std::max(0.0, 1.0 + beta_ * rate / root);
  }

  [[nodiscard]] State find_rate(const State& s) const {
    State rate(s.size());
    for (std::size_t i = 0; i < count_; ++i) {
      rate[i] = s[count_ + i];
      rate[count_ + i] = -column_.gravity;
    }
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      const double f = find_force(s[i] - s[i + 1] + 2.0 * kRadius,
                                  s[count_ + i] - s[count_ + i + 1],
                                  0.5 * kRadius, 0.5 * kMass);
      rate[count_ + i] -= f / kMass;
      rate[count_ + i + 1] += f / kMass;
    }
    if (column_.has_floor) {
      rate[count_] +=
          find_force(kRadius - s[0], -s[count_], kRadius, kMass) / kMass;
    }
    return rate;
  }

  void advance(double h, State& s) const {
    const auto shifted = [&](const State& by, double dt) {
      State out = s;
      for (std::size_t i = 0; i < s.size(); ++i) out[i] += dt * by[i];
      return out;
    };
    const State k1 = find_rate(s);
    const State k2 = find_rate(shifted(k1, 0.5 * h));
    const State k3 = find_rate(shifted(k2, 0.5 * h));
    const State k4 = find_rate(shifted(k3, h));
    for (std::size_t i = 0; i < s.size(); ++i) {
      s[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
  }

  Column column_;
  double beta_;
  std::size_t count_;
};

struct Scene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
  dynamics::RunRecord record = {};

  void go(double time, double step,
          IntegratorKind scheme = IntegratorKind::generalized_alpha,
          double impact_steps = 20.0) {
    dynamics::SimulationStatistics statistics;
    simulate(model, state,
             {.integrator = scheme,
              .end_time = time,
              .step = step,
              .impact_steps = impact_steps},
             {}, {}, statistics, {}, {}, record);
  }
};

ContactSide make_ball() {
  return {Shape{Sphere{kRadius}, {}}, kPlastic, kMass,
          0.4 * kMass * kRadius * kRadius * Matrix3::Identity()};
}

ContactSide make_floor() {
  return {Shape{HalfSpace{}, {}}, kPlastic, kInfinity};
}

Scene make_scene(const Column& column, double restitution,
                 bool has_names_swapped = false) {
  const ContactParameters parameters{.restitution = restitution};
  SystemBuilder builder;
  std::vector<BodyIndex> balls;
  for (std::size_t i = 0; i < column.x.size(); ++i) {
    const ContactSide ball = make_ball();
    balls.push_back(builder.add_rigid_body("b" + std::to_string(i),
                                           {ball.mass, ball.inertia_B}));
  }
  const auto add_pair = [&](const std::string& name, BodyIndex A, BodyIndex B,
                            const ContactSide& a, const ContactSide& b) {
    const auto law = has_names_swapped ? make_contact(b, a, parameters)
                                       : make_contact(a, b, parameters);
    if (has_names_swapped) std::swap(A, B);
    builder.add_pair(name, A, B, law);
  };
  for (std::size_t i = 0; i + 1 < balls.size(); ++i) {
    add_pair("balls " + std::to_string(i), balls[i], balls[i + 1], make_ball(),
             make_ball());
  }
  if (column.has_floor) {
    add_pair("floor", kWorld, balls[0], make_floor(), make_ball());
  }
  builder.set_gravity({0.0, 0.0, -column.gravity});
  Scene run{builder.build(), {}};
  run.state = make_state(run.model);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    run.state.bodies[i].p_WB = {0.0, 0.0, column.x[i]};
    run.state.bodies[i].v_WB_W = {0.0, 0.0, column.v[i]};
  }
  return run;
}

// Touch at 0.01 ms; b1 and b2 are `gap` apart.
Column make_cradle(double gap) {
  return {.x = {-1e-5, 2.0 * kRadius, 4.0 * kRadius + gap},
          .v = {1.0, 0.0, 0.0}};
}

// A ball against two that are apart by up to 1 mm, or not at all: continuous.
TEST(TouchRestitution, OfACradleDoesNotDependOnHowATouchBegan) {
  for (const auto& [e, beta] : {kDull, kElastic}) {
    for (const double gap : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0}) {
      const double time = gap > 5e-4 ? 2.5e-3 : 1e-3;
      Scene run = make_scene(make_cradle(gap), e);
      run.go(time, 1e-6);
      const auto right = Springs(make_cradle(gap), beta).run(time, 1e-7);
      double sum = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double v = run.state.bodies[i].v_WB_W.z();
        EXPECT_NEAR(v, right[i], 1e-3)
            << e << ", gap " << gap << ", ball " << i;
        sum += v;
      }
      EXPECT_NEAR(sum, 1.0, 1e-9);
    }
  }
}

TEST(TouchRestitution, OfACradleIsTheSameWithTheEnergyConservingScheme) {
  for (const double gap : {1e-5, 0.0}) {
    Scene run = make_scene(make_cradle(gap), kDull.first);
    run.go(1e-3, 1e-6, IntegratorKind::energy_conserving);
    const auto right = Springs(make_cradle(gap), kDull.second).run(1e-3, 1e-7);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(run.state.bodies[i].v_WB_W.z(), right[i], 1e-3) << gap;
    }
  }
}

TEST(TouchRestitution, DoesNotDependOnTheOrderOfTheSides) {
  Scene run = make_scene(make_cradle(1e-6), 0.9);
  Scene swapped = make_scene(make_cradle(1e-6), 0.9, true);
  run.go(1e-3, 2e-6);
  swapped.go(1e-3, 2e-6);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(run.state.bodies[i].v_WB_W.z(),
                swapped.state.bodies[i].v_WB_W.z(), 1e-12);
  }
}

// A touch of a second at rest has no memory of how it began.
TEST(TouchRestitution, OfARestingBallThatIsStruckIsThatOfTheStroke) {
  Column column{.x = {kRadius, 3.0 * kRadius + 0.05}, .v = {0.0, 0.0}};
  column.has_floor = true;
  column.gravity = 9.81;
  Scene run = make_scene(column, 0.5);
  run.state.bodies[1].p_WB.z() = 100.0;  // falls for a second from there
  run.go(1.0, 1e-3);
  const double rest = run.state.bodies[0].p_WB.z();
  EXPECT_LT(std::abs(run.state.bodies[0].v_WB_W.z()), 1e-6);
  const double weight = kMass * column.gravity;
  const double k = 4.0 / 3.0 * kModulus * std::sqrt(kRadius);
  EXPECT_NEAR(kRadius - rest, std::pow(weight / k, 2.0 / 3.0), 1e-9);
  column.x = {rest, 3.0 * kRadius + 1e-5};
  column.v = {0.0, -1.5};
  run.state.bodies[1].p_WB.z() = column.x[1];
  run.state.bodies[1].v_WB_W.z() = column.v[1];
  run.go(1.0 + 1e-3, 1e-6);
  const auto right = Springs(column, kHalf.second).run(1e-3, 1e-7);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(run.state.bodies[i].v_WB_W.z(), right[i], 2e-3) << i;
  }
}

// Its weight takes more of a slow bounce: 0.35 % of the fifth, as springs say.
TEST(TouchRestitution, OfEveryBounceIsThatAskedForUnderItsWeight) {
  Column column{.x = {kRadius + 0.02}, .v = {0.0}};
  column.has_floor = true;
  column.gravity = 9.81;
  Scene scene = make_scene(column, 0.8);
  scene.go(0.45, 2e-6);  // a hundredth of an impact
  ASSERT_GE(scene.record.contacts.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const dynamics::ContactRecord& bounce = scene.record.contacts[i];
    ASSERT_TRUE(bounce.restitution().has_value());
    column.x = {kRadius};
    column.v = {-bounce.touch_speed};
    const auto right =
        Springs(column, 0.33190).run(bounce.duration, 1e-3 * bounce.duration);
    EXPECT_NEAR(*bounce.restitution(), right[0] / bounce.touch_speed, 5e-4)
        << i;
    EXPECT_NEAR(*bounce.restitution(), 0.8, i == 0 ? 1e-3 : 4e-3) << i;
  }
}

/// A box that flies at the floor with one corner, one edge or one face.
struct Landing {
  const char* part = "";
  Vector3 turn = Vector3::Zero();  // about the world's axes [rad]
};

const Vector3 kHalfBox(0.05, 0.04, 0.03);

std::vector<Landing> make_landings() {
  return {{"corner", {0.5, 0.3, 0.1}},
          {"edge", {0.6, 0.0, 0.0}},
          {"face", {0.0, 0.0, 0.4}}};
}

// Only the normal impulse at the place acts, whatever its lever arm: its point
// parts with e times its approach. J = (1 + e) v / (1/m + (r x n) . J^-1 (r x
// n))
TEST(TouchRestitution, OfABoxsCornerEdgeOrFaceIsThatOfRigidBodies) {
  const double mass = 1.2;
  const Vector3 squares = kHalfBox.cwiseProduct(kHalfBox);
  const Matrix3 inertia =
      mass / 3.0 *
      Vector3(squares.y() + squares.z(), squares.x() + squares.z(),
              squares.x() + squares.y())
          .asDiagonal()
          .toDenseMatrix();
  for (const Landing& landing : make_landings()) {
    for (const double e : {0.9, 0.5, 0.2}) {
      SCOPED_TRACE(std::string(landing.part) + " " + std::to_string(e));
      SystemBuilder builder;
      const auto box = builder.add_rigid_body("box", {mass, inertia});
      builder.add_pair(
          "floor/box", kWorld, box,
          std::make_shared<PatchPair>(
              ContactSide{Shape{HalfSpace{}, {}}, SurfaceMaterial{2.1e11, 0.3},
                          kInfinity},
              ContactSide{Shape{Box{kHalfBox}, {}},
                          SurfaceMaterial{2.1e11, 0.3}, mass, inertia},
              ContactParameters{.restitution = e}));
      Scene run{builder.build(), {}};
      run.state = make_state(run.model);
      dynamics::BodyState& body = run.state.bodies[0];
      const Matrix3 R = exp_rotation(landing.turn);
      body.quat_WB = Quaternion(R);
      // What is lowest: the mean of all corners within a nanometre of it.
      double least = 0.0;
      std::vector<Vector3> corners;
      for (int i = 0; i < 8; ++i) {
        const Vector3 signs((i & 1) != 0 ? 1.0 : -1.0,
                            (i & 2) != 0 ? 1.0 : -1.0,
                            (i & 4) != 0 ? 1.0 : -1.0);
        corners.emplace_back(R * kHalfBox.cwiseProduct(signs));
        least = std::min(least, corners.back().z());
      }
      Vector3 r = Vector3::Zero();
      double lowest = 0.0;
      for (const Vector3& corner : corners) {
        if (corner.z() > least + 1e-9) continue;
        r += corner;
        lowest += 1.0;
      }
      r /= lowest;
      body.p_WB.z() = -least + 1e-7;
      body.v_WB_W.z() = -0.1;
      run.go(4e-3, 1e-5, IntegratorKind::generalized_alpha, 150.0);
      const Vector3 n = Vector3::UnitZ();
      const Vector3 by_rotation = r.cross(n);
      const Matrix3 J_W = R * inertia * R.transpose();
      const double compliance =
          1.0 / mass + by_rotation.dot(J_W.ldlt().solve(by_rotation));
      const double impulse = (1.0 + e) * 0.1 / compliance;
      EXPECT_NEAR(body.v_WB_W.z(), impulse / mass - 0.1, 4e-4);
      ASSERT_GE(run.record.contacts.size(), 1U);
      EXPECT_NEAR(run.record.contacts[0].impulse / impulse, 1.0, 4e-3);
      ASSERT_TRUE(run.record.contacts[0].restitution().has_value());
      // An edge parts at the end that is lower then.
      const bool is_edge = landing.part == std::string("edge");
      EXPECT_NEAR(*run.record.contacts[0].restitution(), e,
                  is_edge ? 0.3 : 4e-3);
      const Vector3 r_B = R.transpose() * r;
      EXPECT_NEAR((body.v_WB_W + R * body.w_WB_B.cross(r_B)).z() / 0.1, e,
                  1e-3);
    }
  }
}

// Its effect would be a wrong restitution without a word.
TEST(TouchRestitution, OfABodyThatTurnsNeedsItsInertia) {
  const ContactSide box{Shape{Box{kHalfBox}, {}}, kPlastic, kMass};
  const ContactSide off{Shape{Sphere{kRadius}, {Matrix3::Identity(), kHalfBox}},
                        kPlastic, kMass};
  const ContactSide ball{Shape{Sphere{kRadius}, {}}, kPlastic, kMass};
  for (const ContactSide& side : {box, off}) {
    EXPECT_THROW((void)make_contact(make_floor(), side, {.restitution = 0.9}),
                 InputError);
    EXPECT_NO_THROW((void)make_contact(make_floor(), side, {}));
  }
  EXPECT_NO_THROW((void)make_contact(make_floor(), ball, {.restitution = 0.9}));
}

}  // namespace
}  // namespace limber::contact::touch_restitution_test
