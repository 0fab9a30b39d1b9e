// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "cli/impact_run.hpp"

namespace limber::test {

/// A robot of the flexible link `b`, which touches with a surface.
inline std::string make_surface_link(const std::string& mesh, double modulus,
                                     double density, int modes,
                                     const std::string& surface = "skin") {
  return fmt::format(R"(<robot name="b"><link name="b"/>
<flexible link="b"><mesh file="{}"/>
<material youngs_modulus="{}" poisson_ratio="0.3" density="{}"/>
<basis eigenmodes="{}"/></flexible>
<contact link="b" surface="{}"/></robot>)",
                     mesh, modulus, density, modes, surface);
}

/// Expects that the end of a steel rod, `rod.geo` of 1 m along x from 0 and
/// 1 cm^2, strikes a wall once as the wave solution says.
/// @param impulse fraction by which it may differ; @param restitution at least
/// @param options of the command @param surface that strikes
inline void expect_wave_impact(const Workspace& place, double impulse,
                               double restitution,
                               const std::string& options = "",
                               const std::string& surface = "skin") {
  place.write("rod.urdf",
              make_surface_link("rod.geo", 210e9, 7850.0, 60, surface));
  place.write("scene.toml", R"(
[[robot]]
name = 'a'
file = 'rod.urdf'
velocity = [1, 0, 0]
[[obstacle]]
name = 'w'
shape = 'plane'
position = [1.00001, 0, 0]
normal = [-1, 0, 0]
[[contact]]
between = ['a.b', 'w']
[time]
duration = 1e-3
step = 1e-6
output_interval = 1e-5
[output]
pictures = false
)");
  const nlohmann::json run = run_for_summary(place, "scene.toml" + options);
  ASSERT_EQ(run["contacts"].size(), 1U);
  const nlohmann::json& impact = run["contacts"][0];
  const double waves = std::sqrt(210e9 / 7850.0);  // [m/s]
  const double force = 210e9 * 1e-4 / waves;
  const double duration = 2.0 / waves;
  EXPECT_EQ(impact["touches"], 1);
  EXPECT_GE(impact["duration"].get<double>() / duration, 1.0);
  EXPECT_LE(impact["duration"].get<double>() / duration, 1.07);  // five modes
  EXPECT_NEAR(impact["impulse"].get<double>() / (force * duration), 1.0,
              impulse);
  EXPECT_GE(impact["restitution"].get<double>(), restitution);
  EXPECT_GE(impact["peak_force"].get<double>() / force, 1.0);
  EXPECT_LE(impact["peak_force"].get<double>() / force, 1.1);
}

}  // namespace limber::test
