// SPDX-License-Identifier: BSD-3-Clause
// Loss factors in small motion, in the band of the system that they hold in.
#include "limber/dynamics/analysis/elastic_band.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/dense/general_eigen.hpp"
#include "limber/dynamics/analysis/linear_system.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "support/chain.hpp"

namespace limber::dynamics::elastic_band_test {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kLossFactor = 0.04;
constexpr double kLowest = 60.0;

testing::Chain make_free_chain(int bodies, const ModalDamping& damping = {}) {
  return testing::make_chain({.bodies = bodies,
                              .modes = 3,
                              .stiffness = 1e6,
                              .lowest = kLowest,
                              .body_damping = damping});
}

// Held at its first body's far end by a stiff fixed joint.
SystemModel hold(testing::Chain chain) {
  const auto& frames = chain.last_interfaces;
  const FrameMotion held =
      find_frame_motion(chain.builder.build(), chain.state, frames.front());
  chain.builder.add_coupler(
      "root",
      joints::make_joint(
          joints::JointKind::fixed, Vector3::UnitY(), Vector3::UnitX(),
          {.translational_stiffness = 1e8, .rotational_stiffness = 1e8}),
      chain.builder.attach_world("ground", held.X_WF), frames.front());
  return chain.builder.build();
}

// Undamped frequencies other than 0, increasing [rad/s].
VectorX find_omega(const SystemModel& model, const SystemState& state) {
  const VectorX f = find_natural_frequencies(model, state);
  const auto free = (f.array() <= 0.0).count();
  return kTurn * f.tail(f.size() - free);
}

// The bodies of another model's state.
SystemState place(const SystemModel& model, const SystemState& bodies) {
  SystemState state = make_state(model);
  std::copy(bodies.bodies.begin(), bodies.bodies.end(), state.bodies.begin());
  return state;
}

TEST(ElasticBand, OfAFreeBodyIsThatOfItsModes) {
  const testing::Chain chain = make_free_chain(1);
  const auto band =
      find_elastic_bands(chain.builder.build(), chain.state).front();
  ASSERT_TRUE(band.has_value());
  EXPECT_NEAR(band->low, kLowest, 1e-6 * kLowest);
  EXPECT_NEAR(band->high, 2.0 * kLowest, 1e-6 * kLowest);
}

TEST(ElasticBand, BeginsWithTheLowestModeOfTheSystem) {
  const testing::Chain chain = make_free_chain(4);
  for (const SystemModel& model : {chain.builder.build(), hold(chain)}) {
    const SystemState state = place(model, chain.state);
    const auto band = find_elastic_bands(model, state).front();
    ASSERT_TRUE(band.has_value());
    EXPECT_NEAR(band->low, find_omega(model, state)[0], 1e-6 * kLowest);
    EXPECT_LT(band->low, kLowest);
  }
}

TEST(ElasticBand, LeavesOutRigidMotionOnSoftSprings) {
  testing::Chain chain = make_free_chain(1);
  chain.builder.add_coupler(
      "soft",
      joints::make_joint(
          joints::JointKind::fixed, Vector3::UnitY(), Vector3::UnitX(),
          {.translational_stiffness = 1e-3, .rotational_stiffness = 1e-3}),
      chain.builder.attach_world("ground", {}), chain.last_interfaces[0]);
  const SystemModel model = chain.builder.build();
  const auto band =
      find_elastic_bands(model, place(model, chain.state)).front();
  ASSERT_TRUE(band.has_value());
  EXPECT_NEAR(band->low, kLowest, 1e-3 * kLowest);
}

// One of the same bodies, free beside the chain, which vibrates more slowly.
TEST(ElasticBand, IsThatOfALinkedGroup) {
  testing::Chain chain = make_free_chain(4);
  const auto links = find_elastic_bands(chain.builder.build(), chain.state);
  const auto reduced = chain.builder.build().bodies.front().reduced;
  chain.builder.add_flexible_body("free", reduced, Fidelity::coupled, {});
  const SystemModel model = chain.builder.build();
  const SystemState state = place(model, chain.state);
  const auto bands = find_elastic_bands(model, state);
  ASSERT_EQ(bands.size(), 5U);
  EXPECT_NEAR(bands[4]->low, kLowest, 1e-6 * kLowest);
  EXPECT_LT(bands[0]->low, 0.9 * kLowest);
  EXPECT_EQ(bands[0]->low, bands[3]->low);
  EXPECT_NEAR(bands[0]->low, links[0]->low, 1e-9 * kLowest);
}

TEST(ElasticBand, NeedsAFlexibleBody) {
  const testing::Chain chain = testing::make_chain(
      {.bodies = 2, .modes = 3, .fidelity = Fidelity::rigid});
  EXPECT_FALSE(find_elastic_bands(chain.builder.build(), chain.state)
                   .front()
                   .has_value());
}

// Every mode below the top of the band whose strain is in the bodies.
TEST(LossFactor, DampsEveryModeAlikeHoweverTheBodiesAreHeld) {
  for (const int bodies : {1, 2, 4}) {
    for (const bool is_held : {false, true}) {
      const auto make = [&](const ModalDamping& damping) {
        testing::Chain chain = make_free_chain(bodies, damping);
        return is_held ? hold(chain) : chain.builder.build();
      };
      const SystemModel elastic = make({});
      const SystemState state = place(elastic, make_free_chain(bodies).state);
      const auto band = find_elastic_bands(elastic, state).front();
      const SystemModel model = make(
          {.maxwell = flexbody::find_maxwell_elements(kLossFactor, *band)});
      SystemState start = state;
      start.maxwell = VectorX::Zero(model.maxwell_count);
      const NaturalModes found = find_natural_modes(model, start);
      const VectorX undamped = find_omega(elastic, state);
      std::size_t i =
          found.modes.size() - static_cast<std::size_t>(undamped.size());
      for (const double omega : undamped) {
        const NaturalMode& mode = found.modes[i++];
        if (omega > band->high) break;
        EXPECT_NEAR(mode.damping_ratio(), 0.5 * kLossFactor,
                    0.05 * 0.5 * kLossFactor)
            << bodies << ' ' << is_held << ' ' << omega;
        EXPECT_NEAR(kTurn * mode.frequency(), omega, 0.06 * omega);
      }
      const auto free =
          std::count_if(found.modes.begin(), found.modes.end(),
                        [](const NaturalMode& mode) { return mode.is_free(); });
      EXPECT_EQ(free, is_held ? 0 : 6);
    }
  }
}

// Relaxation of the material is no mode: there are as many as coordinates.
TEST(LossFactor, AddsNoModes) {
  const testing::Chain chain =
      make_free_chain(1, {.maxwell = flexbody::find_maxwell_elements(
                              kLossFactor, {kLowest, 4 * kLowest})});
  const SystemModel model = chain.builder.build();
  EXPECT_EQ(find_natural_modes(model, chain.state).modes.size(), 9U);
}

TEST(LossFactor, LinearModelHasTheSameEigenvalues) {
  const ModalDamping damping{
      .maxwell = flexbody::find_maxwell_elements(kLossFactor, {20.0, 200.0})};
  testing::Chain chain = make_free_chain(2, damping);
  const SystemModel model = hold(chain);
  chain.state.memory = make_state(model).memory;
  const NaturalModes found = find_natural_modes(model, chain.state);
  const LinearSystem linear = linearise(model, chain.state);
  EXPECT_EQ(linear.A.rows(), 2 * (12 + 6) + model.maxwell_count);
  EXPECT_EQ(std::ssize(linear.states), linear.A.rows());
  const auto values = dense::find_general_eigenpairs(linear.A, false).values;
  for (const NaturalMode& mode : found.modes) {
    EXPECT_LT((values.array() - mode.value).abs().minCoeff(),
              1e-8 * std::abs(mode.value));
  }
}

}  // namespace
}  // namespace limber::dynamics::elastic_band_test
