// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/pairs/touching.hpp"
#include "unit/contact/draw.hpp"

/// Impacts of random shapes, sizes, masses, speeds and steps.
namespace limber::contact::random_impacts_test {
namespace {

using dynamics::SystemBuilder;
using dynamics::SystemModel;
using dynamics::SystemState;
using test::Draw;

struct Impact {
  SystemModel model;
  SystemState state;
  double step = 0.0;  // [s]
  double time = 0.0;  // [s]
  std::string words;
};

Shape draw_shape(Draw& draw, int kind, double size) {
  const Pose pose{exp_rotation(draw.vector()), 0.1 * size * draw.vector()};
  switch (kind) {
    case 0:
      return {Sphere{size}, pose};
    case 1:
      return {Box{size *
                  Vector3(1.0, draw.between(0.5, 1.0), draw.between(0.5, 1.0))},
              pose};
    case 2:
      return {Cylinder{size, size * draw.between(0.3, 2.0)}, pose};
    default:
      return {Capsule{size, size * draw.between(0.3, 2.0)}, pose};
  }
}

// A ball, or a body of any shape, flies at another, which turns.
Impact draw_impact(unsigned seed, bool strikes_with_ball) {
  Draw draw(seed);
  Impact out;
  const int kind = static_cast<int>(draw.between(0.0, 4.0));
  const double size = draw.log_between(1e-3, 1.0);
  const double radius = size * draw.log_between(0.1, 10.0);
  const double mass = draw.log_between(1e-3, 10.0);
  const double ball_mass = mass * draw.log_between(1e-4, 1e4);
  const double speed = draw.log_between(1e-4, 100.0);
  const ContactParameters parameters{
      .friction = {.sliding = draw.between(0.0, 1.0)},
      .restitution = draw.between(0.0, 1.0)};
  const SurfaceMaterial soft{draw.log_between(1e6, 2e11), 0.3};
  SystemBuilder builder;
  const Matrix3 inertia = mass * size * size * Matrix3::Identity();
  const Matrix3 ball_inertia =
      0.4 * ball_mass * radius * radius * Matrix3::Identity();
  const auto body = builder.add_rigid_body("body", {mass, inertia});
  const auto ball = builder.add_rigid_body("ball", {ball_mass, ball_inertia});
  const Shape struck = draw_shape(draw, kind, size);
  const int striker = static_cast<int>(draw.between(1.0, 4.0));
  const auto contact =
      make_contact({struck, soft, mass, inertia},
                   {strikes_with_ball ? Shape{Sphere{radius}, {}}
                                      : draw_shape(draw, striker, radius),
                    soft, ball_mass, ball_inertia},
                   parameters);
  builder.add_pair("body/ball", body, ball, contact);
  out.model = builder.build();
  out.state = make_state(out.model);
  const Vector3 way = draw.vector().normalized();
  out.state.bodies[0].w_WB_B = 0.1 * speed / size * draw.vector();
  // A free impact's duration, and steps of a hundredth to thirty of it.
  const double reduced = 1.0 / (1.0 / mass + 1.0 / ball_mass);
  const double k = 4.0 / 3.0 * soft.youngs_modulus / (2.0 * 0.91) *
                   std::sqrt(std::min(radius, size));
  const double duration =
      3.218 * std::pow(reduced * reduced / (k * k * speed), 0.2);
  out.step = duration * draw.log_between(0.01, 30.0);
  out.time = 20.0 * out.step + 10.0 * duration;
  // Beyond the largest extent of any shape above, then as near as the ball
  // flies in five steps.
  double distance = 4.0 * (size + radius) + 5.0 * speed * out.step;
  for (int i = 0; i < 100; ++i) {
    joints::PairBody target;
    joints::PairBody flying;
    flying.p_WB = distance * way;
    distance -= contact->touching()->find_clearance({target, flying}) -
                5.0 * speed * out.step;
  }
  out.state.bodies[1].p_WB = distance * way;
  out.state.bodies[1].v_WB_W = -speed * way;
  out.words = fmt::format(
      "seed {}: kinds {} {}, size {:.3g}, radius {:.3g}, masses {:.3g} {:.3g}, "
      "speed {:.3g}, e {:.3g}, step {:.3g} of {:.3g}",
      seed, kind, strikes_with_ball ? 0 : striker, size, radius, mass,
      ball_mass, speed, parameters.restitution, out.step, duration);
  return out;
}

// Steps of up to thirty durations. Some are refused in words: where a body
// would pass through the other, as one does that meets a soft one at 80 m/s and
// sinks in by its own size, or spin by radians a step, and where Newton's
// method fails.
void expect_good_impacts(unsigned hundred, bool strike_with_ball,
                         int most_refused, int most_gains) {
  int refused = 0;
  int gains = 0;
  for (unsigned i = 0; i < 100; ++i) {
    Impact impact = draw_impact(100 * hundred + i, strike_with_ball);
    const double before = calc_energy(impact.model, impact.state).total();
    const auto momentum = [&] {
      Vector3 sum = Vector3::Zero();
      for (std::size_t b = 0; b < 2; ++b) {
        sum += impact.model.bodies[b].mass * impact.state.bodies[b].v_WB_W;
      }
      return sum;
    };
    const Vector3 p = momentum();
    dynamics::SimulationStatistics statistics;
    dynamics::RunRecord record;
    try {
      simulate(impact.model, impact.state,
               {.end_time = impact.time, .step = impact.step}, {}, {},
               statistics, {}, {}, record);
    } catch (const NumericalError& error) {
      ++refused;
      EXPECT_FALSE(std::string(error.what()).empty());
      continue;
    }
    const double after = calc_energy(impact.model, impact.state).total();
    if (!(after < 1.005 * before)) {
      ++gains;
      EXPECT_THAT(statistics.warnings, ::testing::Contains(::testing::AllOf(
                                           ::testing::HasSubstr("energy error"),
                                           ::testing::HasSubstr("gained"))))
          << impact.words;
    }
    EXPECT_LT((momentum() - p).norm(), 1e-9 * p.norm()) << impact.words;
    EXPECT_FALSE(record.contacts.empty()) << impact.words;
  }
  EXPECT_LE(refused, most_refused);
  EXPECT_LE(gains, most_gains);
}

class RandomImpact : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomImpact, OfABallGainsNoEnergyKeepsMomentumAndIsNotMissed) {
  expect_good_impacts(GetParam(), true, 10, 0);
}

TEST_P(RandomImpact, OfTwoBodiesKeepsMomentumIsNotMissedAndWarnsOfAGain) {
  expect_good_impacts(GetParam(), false, 15, 1);
}

INSTANTIATE_TEST_SUITE_P(Of40, RandomImpact, ::testing::Range(0U, 4U));

}  // namespace
}  // namespace limber::contact::random_impacts_test
