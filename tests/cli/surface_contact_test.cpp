// SPDX-License-Identifier: BSD-3-Clause
// Whole surfaces of flexible links through the command: a rod's end against the
// wave solution, and energy, momentum and names of bars and angles that strike.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "cli/impact_run.hpp"
#include "cli/surface_link.hpp"

namespace limber::test::surface_contact_test {
namespace {

using nlohmann::json;

// x0, size of a block of `cells` second-order elements along x, 2 x 1 across.
std::string make_bar(double length, double width, double height, int cells) {
  return fmt::format(R"(
Point(1) = {{0, {1}, {2}}}; Point(2) = {{0, -{1}, {2}}};
Point(3) = {{0, -{1}, -{2}}}; Point(4) = {{0, {1}, -{2}}};
Line(1) = {{1, 4}}; Line(2) = {{4, 3}}; Line(3) = {{3, 2}}; Line(4) = {{2, 1}};
Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
Transfinite Curve {{2, 4}} = 3; Transfinite Curve {{1, 3}} = 2;
Transfinite Surface {{1}}; Recombine Surface {{1}};
swept[] = Extrude {{{0}, 0, 0}} {{ Surface{{1}}; Layers{{{3}}}; Recombine; }};
Physical Volume("body") = {{swept[1]}};
Mesh.ElementOrder = 2;
)",
                     length, 0.5 * width, 0.5 * height, cells);
}

TEST(SurfaceOfARod, StrikesOnceAsTheWaveSolutionSays) {
  const Workspace place;
  place.write("rod.geo", make_bar(1.0, 0.01, 0.01, 60));
  expect_wave_impact(place, 0.002, 0.998);
}

// Two bars of 200 x 20 x 8 mm, free, one across the other or along it, with
// restitution 1.
json strike_bars(double yaw, const std::string& first,
                 const std::string& second, const std::string& options) {
  const Workspace place;
  place.write("bar.geo", make_bar(0.2, 0.02, 0.008, 6));
  place.write("bar.urdf", make_surface_link("bar.geo", 3e9, 1500.0, 6));
  place.write("scene.toml", fmt::format(R"(
[time]
duration = 0.003
step = 5e-6
output_interval = 1.25e-4
[[robot]]
name = "A"
file = "bar.urdf"
[[robot]]
name = "B"
file = "bar.urdf"
position = [0.07, 0.004, 0.0095]
orientation_rpy = [0.02, -0.007, {}]
velocity = [0.0, 0.0, -1.0]
[[contact]]
between = ["{}", "{}"]
{}
[output]
pictures = false
)",
                                        yaw, first, second, options));
  return run_for_summary(place, "scene.toml");
}

TEST(SurfacesOfBars, StrikeAlikeWhicheverNameStandsFirst) {
  for (const double yaw : {0.0, 1.3}) {
    const json one = strike_bars(yaw, "A.b", "B.b", "friction = 0.3");
    const json other = strike_bars(yaw, "B.b", "A.b", "friction = 0.3");
    ASSERT_EQ(one["contacts"].size(), other["contacts"].size());
    ASSERT_GE(one["contacts"].size(), 1U);
    for (std::size_t i = 0; i < one["contacts"].size(); ++i) {
      for (const char* what : {"peak_force", "impulse", "time", "duration"}) {
        const double a = one["contacts"][i][what].get<double>();
        const double b = other["contacts"][i][what].get<double>();
        EXPECT_NEAR(b / a, 1.0, 1e-7) << what << " of " << i << ", " << yaw;
      }
    }
  }
}

}  // namespace
}  // namespace limber::test::surface_contact_test
