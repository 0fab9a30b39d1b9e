// SPDX-License-Identifier: BSD-3-Clause
// Random scenes of meshed bodies at level nonlinear, which spin up to three
// times as fast as their lowest frequency.
#include <gtest/gtest.h>

#include <map>

#include "support/meshed_bodies.hpp"
#include "support/random_scene_end.hpp"

namespace limber::testing::random_nonlinear_nightly {
namespace {

RandomSceneOptions make_options(dynamics::Fidelity level) {
  static const BodyMaker bodies = make_meshed_bodies();
  return {.make_body = bodies, .level = level};
}

/// Of a seed at level nonlinear; both tests look at it.
const RandomOutcome& run_nonlinear(unsigned seed) {
  static std::map<unsigned, RandomOutcome> outcomes;
  if (!outcomes.contains(seed)) {
    outcomes[seed] =
        run_random_scene(seed, make_options(dynamics::Fidelity::nonlinear));
  }
  return outcomes.at(seed);
}

bool has_critical_speed(const RandomOutcome& outcome) {
  return outcome.text.find("critical speed") != std::string::npos;
}

TEST(RandomNonlinearScene, EndsWithNumbersOrWordsAfterBoundedWork) {
  const auto options = make_options(dynamics::Fidelity::nonlinear);
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    expect_good_end(draw_scene(seed, options), run_nonlinear(seed));
  }
}

// The refusals of linear elasticity that stiffening by spin takes away.
TEST(RandomNonlinearScene, HasNoCriticalSpeedOfLinearElasticity) {
  const auto coupled = make_options(dynamics::Fidelity::coupled);
  int refused = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    if (has_critical_speed(run_random_scene(seed, coupled))) ++refused;
    EXPECT_FALSE(has_critical_speed(run_nonlinear(seed))) << seed;
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace limber::testing::random_nonlinear_nightly
