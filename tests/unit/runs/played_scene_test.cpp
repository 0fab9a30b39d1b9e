// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/played_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::runs::played_scene_test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

TEST(PlaySettings, AreKeysOfFilesAndFourOfTheirOwn) {
  const PlaySettings settings = parse_play_settings(
      "load.strike.force.2=-50\nlevel=one-way\nmodes=6\ndamping=0.02\n"
      "steps=0.5\ntime.duration=1\n");
  ASSERT_THAT(settings.overrides.settings, SizeIs(2));
  EXPECT_EQ(settings.overrides.settings[0].path, "load.strike.force.2");
  EXPECT_EQ(settings.overrides.settings[1].value, "1");
  EXPECT_EQ(settings.overrides.fidelity, dynamics::Fidelity::one_way);
  EXPECT_EQ(settings.modes, 6);
  EXPECT_EQ(settings.damping, 0.02);
  EXPECT_EQ(settings.step_factor, 0.5);
}

TEST(PlaySettings, AreRefusedOutOfBounds) {
  for (const char* line :
       {"modes=0", "modes=x", "damping=0.6", "damping=-1", "steps=0",
        "steps=nan", "steps=1 2", "level=soft", "nothing"}) {
    EXPECT_THROW((void)parse_play_settings(line), InputError) << line;
  }
  EXPECT_THAT([] { (void)parse_play_settings("damping=0.6"); },
              ThrowsMessage<InputError>(
                  HasSubstr("damping = 0.6: expected a number from 0 to 0.5")));
}

TEST(PlayedScene, HasAllItsStepsTimesTheFactor) {
  const scene::test::SceneFolder folder;
  (void)folder.load(scene::test::rigid_link("ball", 2.0, 1.0),
                    "[time]\nduration = 1.0\noutput_interval = 0.1\n"
                    "steps = { from = [0, 0.5], size = [1e-3, 4e-3] }\n");
  const scene::Scene scene = load_played_scene(folder.path() / "scenario.toml",
                                               {.step_factor = 0.5}, {});
  EXPECT_EQ(scene.scenario.settings.step, 5e-4);
  ASSERT_THAT(scene.scenario.settings.step_changes, SizeIs(1));
  EXPECT_EQ(scene.scenario.settings.step_changes[0].step, 2e-3);
  EXPECT_THAT(scene.scenario.settings.output_times, SizeIs(11));
}

}  // namespace
}  // namespace limber::runs::played_scene_test
