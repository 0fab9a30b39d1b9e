// SPDX-License-Identifier: BSD-3-Clause
// Friction in joints of flexible links at rest keeps Newton's method between
// its two slopes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::energy_conserving_test {
namespace {

TEST(EnergyConservingRun, GoesThroughFrictionOnFlexibleLinks) {
  const Workspace place;
  // A robot with a joint, tendon, gear and latch of every kind, without loads.
  place.write("s.toml", R"([time]
duration = 0.02
step = 1e-4
output_interval = 1e-3
integrator = "energy-conserving"
[fidelity]
default = "coupled"
[[robot]]
name = "arm"
file = ")" LIMBER_SOURCE_DIR R"(/tests/data/zoo/zoo.urdf"
position = [0.0, 0.0, 0.3]
orientation_rpy = [0.1, 0.2, 0.3]
[output]
pictures = false
)");
  for (const std::string step : {"1e-4", "2e-5"}) {
    const CommandResult result =
        place.limber("run s.toml --out out --set time.step=" + step);
    ASSERT_EQ(result.status, 0) << result.errors;
    const auto summary =
        nlohmann::json::parse(read_text(place.folder() / "out/summary.json"));
    EXPECT_EQ(summary.at("steps_halved"), 0) << step;
    EXPECT_LT(summary.at("newton_iterations"),
              12 * summary.at("steps").get<long>())
        << step;
  }
}

}  // namespace
}  // namespace limber::test::energy_conserving_test
