// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "places.hpp"

namespace limber::test::failing_run_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// Explicit steps over a thousand times too long for the beam's tenth mode, so
/// that they are not divided, and a push after 0.5 s of rest.
void write_blow_up(const Workspace& place) {
  place.write("s.toml",
              "robot = '" LIMBER_SOURCE_DIR
              "/models/beam.urdf'\n"
              "[time]\nduration = 2.0\nstep = 0.45\n"
              "integrator = 'runge-kutta-4'\noutput_interval = 0.1\n"
              "[output]\npictures = false\n"
              "[[load]]\nname = 'push'\nlink = 'beam'\ngroup = 'tip'\n"
              "force = [1e3, 0.0, 0.0]\nframe = 'world'\n"
              "time = { kind = 'constant', from = 0.5 }\n"
              "[[probe]]\nname = 'p'\nlink = 'beam'\nnode = 1\n");
}

TEST(FailingRun, NamesTheBodyAndTheTimeAndEndsWithStatus3) {
  const Workspace place;
  write_blow_up(place);
  const CommandResult result = place.limber("run s.toml --out o --json");
  EXPECT_EQ(result.status, 3) << result.errors;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.errors, HasSubstr("beam"));
  EXPECT_THAT(result.errors, HasSubstr("t = 0.6"));  // an output later
}

TEST(FailingRun, KeepsWhatWasComputed) {
  const Workspace place;
  write_blow_up(place);
  ASSERT_EQ(place.limber("run s.toml --out o").status, 3);
  const json summary =
      json::parse(read_text(place.folder() / "o/summary.json"), nullptr, false);
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["completed"], false);
  EXPECT_GE(summary["steps"], 5);  // those of the half second of rest
  ASSERT_EQ(summary["events"].size(), 1U);
  EXPECT_EQ(summary["events"][0]["time"], 0.5);
  EXPECT_EQ(summary["events"][0]["source"], "push");
  const std::string csv = read_text(place.folder() / "o/probes.csv");
  EXPECT_THAT(csv, HasSubstr("\n0.5,"));
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "o/results.h5"));
}

TEST(FailingRun, DrawsNoPicturesWhereNoneAreWanted) {
  const Workspace place;
  write_blow_up(place);
  ASSERT_EQ(place.limber("run s.toml --out o").status, 3);
  for (const auto& file :
       std::filesystem::directory_iterator(place.folder() / "o")) {
    EXPECT_NE(file.path().extension(), ".png") << file.path();
  }
}

}  // namespace
}  // namespace limber::test::failing_run_test
