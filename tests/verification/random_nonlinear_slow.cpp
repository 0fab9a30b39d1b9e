// SPDX-License-Identifier: BSD-3-Clause
// Random scenes of meshed bodies at level nonlinear, which spin up to three
// times as fast as their lowest frequency.
#include <gtest/gtest.h>

#include "support/meshed_bodies.hpp"
#include "support/random_scene_end.hpp"

namespace limber::testing {
namespace {

class RandomNonlinearScene : public ::testing::Test {
 protected:
  static RandomSceneOptions make_options(dynamics::Fidelity level) {
    static const BodyMaker bodies = make_meshed_bodies();
    return {.make_body = bodies, .level = level};
  }
};

TEST_F(RandomNonlinearScene, EndsWithNumbersOrWordsAfterBoundedWork) {
  const auto options = make_options(dynamics::Fidelity::nonlinear);
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    expect_good_end(seed, options);
  }
}

// The refusals of linear elasticity that stiffening by spin takes away.
TEST_F(RandomNonlinearScene, HasNoCriticalSpeedOfLinearElasticity) {
  const auto count = [](dynamics::Fidelity level) {
    const auto options = make_options(level);
    int refused = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
      const RandomOutcome outcome = run_random_scene(seed, options);
      if (outcome.text.find("critical speed") != std::string::npos) ++refused;
    }
    return refused;
  };
  EXPECT_GT(count(dynamics::Fidelity::coupled), 0);
  EXPECT_EQ(count(dynamics::Fidelity::nonlinear), 0);
}

}  // namespace
}  // namespace limber::testing
