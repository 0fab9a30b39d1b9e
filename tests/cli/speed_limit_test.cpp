// SPDX-License-Identifier: BSD-3-Clause
// Motors with a speed limit on flexible links.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/finger.hpp"

namespace limber::test::speed_limit_test {
namespace {

using nlohmann::json;

/// The angle after 0.1 s of a constant effort, long before the end stop.
double find_angle(const Workspace& place, double effort, const char* step) {
  place.write("s.toml", fmt::format(R"(robot = "claw.urdf"
[time]
duration = 0.1
step = {}
output_interval = 1e-2
[output]
pictures = false
[[drive]]
joint = "hinge"
mode = "effort"
signal = {{ kind = "constant", value = {} }}
[[probe]]
name = "angle"
joint = "hinge"
)",
                                    step, effort));
  const CommandResult result =
      place.limber("run s.toml --json --cache cache --out o");
  EXPECT_EQ(result.status, 0) << effort << result.errors;
  if (result.status != 0) return NAN;
  return json::parse(result.out)["probes"]["angle.q"]["final"].get<double>();
}

// Between the limit and a tenth above it the effort falls to zero: a law with
// kinks, between whose slopes Newton's method would alternate.
TEST(ASpeedLimit, IsKeptOnAFlexibleFingerAtAnyEffort) {
  const Workspace place;
  place.write("finger.geo", kFingerGeometry);
  place.write("claw.urdf", kFinger);
  for (const double effort : {1.0, 2.2, 2.5, 2.8, 3.0, 3.6, 4.0}) {
    const double coarse = find_angle(place, effort, "2e-4");
    const double fine = find_angle(place, effort, "2e-5");
    EXPECT_NEAR(coarse, fine, 0.02 * fine) << effort;
    // As a rigid finger: with effort / J to the limit, then between it and a
    // tenth above.
    constexpr double kJ = 2700.0 * 0.4 * 0.02 * 0.006 * 0.4 * 0.4 / 3.0;
    const double angle = 10.0 * (0.1 - 0.5 * 10.0 * kJ / effort);
    EXPECT_GT(fine, 0.98 * angle) << effort;
    EXPECT_LT(fine, 1.02 * 1.1 * angle) << effort;
  }
}

}  // namespace
}  // namespace limber::test::speed_limit_test
