// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of round flexible links through the command: a rod's end against the
// wave solution, and energy, momentum and names of rods that strike.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "cli/impact_run.hpp"
#include "cli/surface_link.hpp"

namespace limber::test::round_surface_test {
namespace {

using nlohmann::json;

// Of second-order tetrahedra with curved faces, along x from 0.
std::string make_rod(double length, double radius, int layers) {
  return fmt::format(R"(
Point(1) = {{0, 0, 0}}; Point(2) = {{0, {1}, 0}}; Point(3) = {{0, 0, {1}}};
Point(4) = {{0, -{1}, 0}}; Point(5) = {{0, 0, -{1}}};
Circle(1) = {{2, 1, 3}}; Circle(2) = {{3, 1, 4}};
Circle(3) = {{4, 1, 5}}; Circle(4) = {{5, 1, 2}};
Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
Transfinite Curve {{1, 2, 3, 4}} = 4;
swept[] = Extrude {{{0}, 0, 0}} {{ Surface{{1}}; Layers{{{2}}}; }};
Physical Volume("body") = {{swept[1]}};
Mesh.ElementOrder = 2;
)",
                     length, radius, layers);
}

TEST(EndOfARoundRod, StrikesOnceAsTheWaveSolutionSays) {
  const Workspace place;
  const double radius = 0.005641896;  // 1 cm^2
  place.write("rod.geo", make_rod(1.0, radius, 60));
  expect_wave_impact(place, 0.01, 0.99);
}

// Two rods of 200 x 12 mm, free, one across the other or along it, with
// restitution 1 and without friction.
json strike_rods(double yaw, const std::string& first,
                 const std::string& second) {
  const Workspace place;
  place.write("rod.geo", make_rod(0.2, 0.006, 16));
  place.write("rod.urdf", make_surface_link("rod.geo", 3e9, 1500.0, 8));
  place.write("scene.toml", fmt::format(R"(
[time]
duration = 0.003
step = 5e-6
output_interval = 1.25e-4
integrator = "energy-conserving"
[[robot]]
name = "A"
file = "rod.urdf"
[[robot]]
name = "B"
file = "rod.urdf"
position = [0.07, 0.002, 0.0125]
orientation_rpy = [0.02, -0.003, {}]
velocity = [0.0, 0.0, -1.0]
[[contact]]
between = ["{}", "{}"]
friction = 0
[output]
pictures = false
)",
                                        yaw, first, second));
  return run_for_summary(place, "scene.toml");
}

TEST(RoundRods, KeepEnergyWhicheverNameStandsFirst) {
  for (const double yaw : {0.0, 1.3}) {
    const json one = strike_rods(yaw, "A.b", "B.b");
    const json other = strike_rods(yaw, "B.b", "A.b");
    ASSERT_EQ(one["contacts"].size(), other["contacts"].size());
    ASSERT_GE(one["contacts"].size(), 1U);
    EXPECT_LT(one["energy"]["open_share"].get<double>(), 1e-6) << yaw;
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
}  // namespace limber::test::round_surface_test
