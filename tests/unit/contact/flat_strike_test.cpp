// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/draw.hpp"
#include "unit/contact/flat_rod.hpp"

/// Flat ends that strike tilted, off the middle and sliding.
namespace limber::contact::flat_strike_test {
namespace {

using test::Draw;
using test::Target;

struct Strike {
  test::RodScene scene;
  std::string words;
};

/// Moves the second body along x until it is 1 um away from the first.
void approach(test::RodScene& scene) {
  const dynamics::Pair& pair = scene.model.pairs.front();
  const auto view = [&scene](dynamics::BodyIndex body) {
    const dynamics::BodyState& state = scene.state.bodies[index(body)];
    const dynamics::BodyModel& model = scene.model.bodies[index(body)];
    return joints::PairBody{.R_WB = state.quat_WB.toRotationMatrix(),
                            .p_WB = state.p_WB,
                            .modes = model.modes,
                            .eta = scene.state.eta.data() + model.offset};
  };
  for (int i = 0; i < 100; ++i) {
    const double gap = pair.law->touching()->find_clearance(
        {view(pair.body_A), view(pair.body_B)});
    scene.state.bodies[1].p_WB.x() += gap - 1e-6;
  }
}

Strike make_strike(unsigned seed, Draw& draw) {
  const Target target = seed % 2 == 0 ? Target::box : Target::rod;
  const ContactParameters parameters{
      .friction = {.sliding = seed % 3 == 0 ? 0.0 : draw.between(0.0, 1.0)},
      .restitution = seed % 5 == 0 ? draw.between(0.2, 1.0) : 1.0};
  Strike strike{test::make_rod_scene(5, target, parameters), {}};
  strike.scene.state.bodies[0].v_WB_W.y() = draw.between(-0.5, 0.5);
  strike.words =
      fmt::format("seed {}: {}, friction {:.2g}, restitution {:.2g}", seed,
                  target == Target::box ? "box" : "rod",
                  parameters.friction.sliding, parameters.restitution);
  return strike;
}

// About in parallel; faces of 10 mm on one of 100 x 80 mm or as large.
Strike draw_flat_strike(unsigned seed) {
  Draw draw(seed);
  Strike strike = make_strike(seed, draw);
  dynamics::BodyState& other = strike.scene.state.bodies[1];
  const bool is_box = seed % 2 == 0;
  const double y = draw.between(-0.006, 0.006) + (is_box ? 0.05 : 0.0);
  const double z = draw.between(-0.006, 0.006);
  const double tilt = draw.in_decades(-4.0, -0.7);
  const double about = draw.between(0.0, 2.0 * std::numbers::pi);
  const Vector3 turn(draw.between(-1.0, 1.0), tilt * std::cos(about),
                     tilt * std::sin(about));
  other.quat_WB = Quaternion(exp_rotation(turn)) * other.quat_WB;
  const Vector3 face(is_box ? 0.1 : -0.5 * test::kLength, 0.0, 0.0);
  other.p_WB = Vector3(-0.05, y, z) - other.quat_WB * face;
  approach(strike.scene);
  strike.words += fmt::format(", tilt {:.3g}, off by {:.3g} {:.3g} mm", tilt,
                              1e3 * y, 1e3 * z);
  return strike;
}

// An edge along a face, inclined to it a little, or not so little.
Strike draw_edge_strike(unsigned seed) {
  Draw draw(seed);
  Strike strike = make_strike(seed, draw);
  dynamics::BodyState& other = strike.scene.state.bodies[1];
  const bool is_box = seed % 2 == 0;
  const double tilt = draw.in_decades(-1.5, -0.1);
  const double slope = draw.in_decades(-5.0, -0.5);
  const double roll = draw.between(-std::numbers::pi, std::numbers::pi);
  const Matrix3 R = exp_rotation(roll * Vector3::UnitX()) *
                    exp_rotation(tilt * Vector3::UnitY()) *
                    exp_rotation(slope * Vector3::UnitZ());
  other.quat_WB = Quaternion(R) * other.quat_WB;
  const Vector3 half = is_box ? Vector3(0.1, 0.05, 0.04)
                              : Vector3(-0.5 * test::kLength, 0.005, 0.005);
  // The edge that is pressed in, at a place of it.
  const Vector3 way = other.quat_WB.conjugate() * Vector3::UnitX();
  Vector3 place = half;
  place.z() *= way.z() > 0.0 ? 1.0 : -1.0;
  place.y() *= draw.between(-1.0, 1.0);
  const Vector3 off(-0.05, draw.between(-0.004, 0.004),
                    draw.between(-0.004, 0.004));
  other.p_WB = off - other.quat_WB * place;
  approach(strike.scene);
  strike.words += fmt::format(", tilt {:.3g}, slope {:.3g}", tilt, slope);
  return strike;
}

Vector3 calc_momentum(const test::RodScene& scene) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t b = 0; b < 2; ++b) {
    sum += scene.model.bodies[b].mass * scene.state.bodies[b].v_WB_W;
  }
  return sum;
}

void expect_no_gain_and_momentum(Strike strike) {
  SCOPED_TRACE(strike.words);
  test::RodScene& scene = strike.scene;
  const double before = calc_energy(scene.model, scene.state).total();
  const Vector3 p = calc_momentum(scene);
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  simulate(scene.model, scene.state,
           {.end_time = 0.0015, .step = 1e-6, .rho_inf = 1.0}, {}, {},
           statistics, {}, {}, record);
  EXPECT_FALSE(record.contacts.empty());
  const double after = calc_energy(scene.model, scene.state).total();
  EXPECT_LT(after, 1.005 * before);
  EXPECT_LT((calc_momentum(scene) - p).norm(), 1e-9 * p.norm());
}

class FlatStrike : public ::testing::TestWithParam<unsigned> {};

TEST_P(FlatStrike, GainsNoEnergyAndKeepsMomentum) {
  expect_no_gain_and_momentum(draw_flat_strike(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Draws, FlatStrike, ::testing::Range(0U, 60U));

class EdgeStrike : public ::testing::TestWithParam<unsigned> {};

TEST_P(EdgeStrike, GainsNoEnergyAndKeepsMomentum) {
  expect_no_gain_and_momentum(draw_edge_strike(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Draws, EdgeStrike, ::testing::Range(0U, 60U));

}  // namespace
}  // namespace limber::contact::flat_strike_test
