// SPDX-License-Identifier: BSD-3-Clause
// A soft ball bends a strip far: levels coupled and nonlinear against the whole
// mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/impact_run.hpp"

namespace limber::test::nonlinear_contact_slow {
namespace {

using nlohmann::json;

constexpr const char* kStrip = R"(
Point(1) = {0, -0.01, -0.002};
line[] = Extrude {0, 0.02, 0} { Point{1}; Layers{2}; };
root[] = Extrude {0, 0, 0.004} { Line{line[1]}; Layers{1}; Recombine; };
swept[] = Extrude {0.3, 0, 0} { Surface{root[1]}; Layers{30}; Recombine; };
Physical Surface("root") = {root[1]};
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};
)";

constexpr const char* kRobot = R"(
<robot name="strip">
  <link name="world"/>
  <link name="strip"/>
  <flexible link="strip">
    <mesh file="strip.geo" order="2"/>
    <material youngs_modulus="2e9" poisson_ratio="0.3" density="1200"/>
    <interface name="root" group="root"/>
    <interface name="tip" group="tip"/>
  </flexible>
  <joint name="root" type="fixed">
    <parent link="world"/><child link="strip"/>
  </joint>
</robot>
)";

constexpr const char* kScenario = R"(
robot = 'strip.urdf'
[time]
duration = 6e-3
step = 2e-5
output_interval = 1e-3
[output]
pictures = false
[basis]
eigenmodes = 30
[[projectile]]
name = 'ball'
radius = 0.03
density = 18.52
position = [0.29, 0.0, 0.03201]
velocity = [0.0, 0.0, -17.0]
[[contact]]
between = ['strip', 'ball']
stiffness = 2e6
[[probe]]
name = 'tip'
link = 'strip'
interface = 'tip'
)";

json strike(const std::string& level) {
  const Workspace place;
  place.write("strip.geo", kStrip);
  place.write("strip.urdf", kRobot);
  place.write("strike.toml", kScenario);
  return run_for_summary(place, "strike.toml --fidelity " + level);
}

double read_tip(const json& summary, const char* component) {
  return summary["probes"][component]["final"].get<double>();
}

TEST(NonlinearContactRun, OfALinkThatBendsFarIsThatOfItsMesh) {
  const json full = strike("full");
  const json nonlinear = strike("nonlinear");
  const json coupled = strike("coupled");
  expect_same_impact(nonlinear, full, 0.005, 0.01);
  // By 12 % of its length, so that the tip comes nearer by 1.6 %.
  const double across = read_tip(full, "tip.uz");
  const double along = read_tip(full, "tip.ux");
  EXPECT_LT(across, -0.1 * 0.3);
  EXPECT_NEAR(read_tip(nonlinear, "tip.uz"), across, 0.005 * std::abs(across));
  EXPECT_NEAR(read_tip(nonlinear, "tip.ux"), along, 0.01 * std::abs(along));
  EXPECT_GT(read_tip(coupled, "tip.ux"), 0.6 * along);  // linear elasticity
}

}  // namespace
}  // namespace limber::test::nonlinear_contact_slow
