// SPDX-License-Identifier: BSD-3-Clause
// Two links that bend strike each other: whole meshes against their modes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"

namespace limber::test {
namespace {

using nlohmann::json;

/// Two bars of 200 x 20 x 10 mm across each other; the upper one comes down
/// tilted by 10 degrees with 1 m/s, and aside with 0.5 m/s.
json strike(const std::string& level) {
  const Workspace place;
  const std::string robot =
      "file = '" LIMBER_SOURCE_DIR "/models/struck_bar.urdf'\n";
  place.write("bars.toml",
              "[[robot]]\nname = 'a'\n" + robot + "[[robot]]\nname = 'b'\n" +
                  robot +
                  "position = [0.0, 0.0, 0.0119]\n"
                  "orientation_rpy = [0.0, 3.3161256, 1.5707963]\n"
                  "velocity = [0.5, 0.0, -1.0]\n"
                  "[[contact]]\nbetween = ['a.bar', 'b.bar']\n"
                  "friction = 0.3\n[basis]\neigenmodes = 40\n"
                  "[fidelity]\ndefault = '" +
                  level +
                  "'\n[output]\npictures = false\n[time]\nduration = 2.5e-4\n"
                  "step = 1e-6\noutput_interval = 1e-5\n");
  const CommandResult result = place.limber(
      "run bars.toml --out o --json --set 'robot.flexible.a.bar.mesh.size=0.01'"
      " --set 'robot.flexible.b.bar.mesh.size=0.01'");
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out, nullptr, false);
}

TEST(TwoBars, StrikeEachOtherAtLevelFullAsWithTheirModes) {
  const json coupled = strike("coupled");
  const json full = strike("full");
  ASSERT_EQ(coupled["contacts"].size(), 1U);
  ASSERT_EQ(full["contacts"].size(), 1U);
  for (const char* key : {"peak_force", "impulse", "duration"}) {
    EXPECT_NEAR(full["contacts"][0][key].get<double>() /
                    coupled["contacts"][0][key].get<double>(),
                1.0, 0.05)
        << key;
  }
  for (const json* run : {&coupled, &full}) {
    const json& energy = (*run)["energy"];
    EXPECT_LT(energy["peaks"]["stored"]["value"].get<double>(),
              1.005 * energy["initial"].get<double>());
  }
}

}  // namespace
}  // namespace limber::test
