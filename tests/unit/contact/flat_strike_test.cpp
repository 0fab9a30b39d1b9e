// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/flat_rod.hpp"

/// Flat ends that strike tilted, off the middle and sliding.
namespace limber::contact {
namespace {

using testing::Target;

struct Strike {
  testing::RodScene scene;
  std::string words;
};

/// Moves the second body along x until it is 1 um away from the first.
void approach(testing::RodScene& scene) {
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

Strike draw_strike(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto between = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const Target target = seed % 2 == 0 ? Target::box : Target::rod;
  const ContactParameters parameters{
      .friction = {.sliding = seed % 3 == 0 ? 0.0 : between(0.0, 1.0)},
      .restitution = seed % 5 == 0 ? between(0.2, 1.0) : 1.0};
  Strike strike{testing::make_rod_scene(5, target, parameters), {}};
  auto& bodies = strike.scene.state.bodies;
  // The faces are 10 mm wide, the box is 100 x 80 mm.
  const bool is_box = target == Target::box;
  const double y = between(-0.006, 0.006) + (is_box ? 0.05 : 0.0);
  const double z = between(-0.006, 0.006);
  const double tilt = std::pow(10.0, between(-4.0, -0.7));
  const double about = between(0.0, 2.0 * std::numbers::pi);
  const Vector3 turn(between(-1.0, 1.0), tilt * std::cos(about),
                     tilt * std::sin(about));
  bodies[1].quat_WB = Quaternion(exp_rotation(turn)) * bodies[1].quat_WB;
  const Vector3 face(is_box ? 0.1 : -0.5 * testing::kLength, 0.0, 0.0);
  bodies[1].p_WB = Vector3(-0.05, y, z) - bodies[1].quat_WB * face;
  approach(strike.scene);
  bodies[0].v_WB_W.y() = between(-0.5, 0.5);
  strike.words = fmt::format(
      "seed {}: {}, tilt {:.3g}, off by {:.3g} {:.3g} mm, friction {:.2g}, "
      "restitution {:.2g}",
      seed, is_box ? "box" : "rod", tilt, 1e3 * y, 1e3 * z,
      parameters.friction.sliding, parameters.restitution);
  return strike;
}

Vector3 calc_momentum(const testing::RodScene& scene) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t b = 0; b < 2; ++b) {
    sum += scene.model.bodies[b].mass * scene.state.bodies[b].v_WB_W;
  }
  return sum;
}

class FlatStrike : public ::testing::TestWithParam<unsigned> {};

TEST_P(FlatStrike, GainsNoEnergyAndKeepsMomentum) {
  Strike strike = draw_strike(GetParam());
  SCOPED_TRACE(strike.words);
  testing::RodScene& scene = strike.scene;
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

INSTANTIATE_TEST_SUITE_P(Draws, FlatStrike, ::testing::Range(0U, 60U));

}  // namespace
}  // namespace limber::contact
