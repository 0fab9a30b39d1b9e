// SPDX-License-Identifier: BSD-3-Clause
// Two flexible rods strike each other crosswise and slide: their modes against
// their whole meshes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/impact_run.hpp"

namespace limber::test::full_contact_slow {
namespace {

using nlohmann::json;

constexpr const char* kRod = R"(
SetFactory("OpenCASCADE");
Cylinder(1) = {-0.06, 0, 0, 0.12, 0, 0, 0.005};
MeshSize{:} = 0.005;
Physical Surface("side") = {1};
Physical Volume("body") = {1};
)";

constexpr const char* kRobot = R"(
<robot name="rod">
  <link name="rod"/>
  <flexible link="rod">
    <mesh file="rod.geo" order="2"/>
    <material youngs_modulus="2e9" poisson_ratio="0.3" density="1200"/>
    <basis eigenmodes="30"/>
  </flexible>
  <contact link="rod" surface="side"/>
</robot>
)";

constexpr const char* kScenario = R"(
[[robot]]
name = 'a'
file = 'rod.urdf'
[[robot]]
name = 'b'
file = 'rod.urdf'
position = [0.012, 0.004, 0.01001]
orientation_rpy = [0, 0, 1.2]
velocity = [0.6, 0.3, -2.0]
[output]
pictures = false
[time]
duration = 4e-4
step = 5e-6
output_interval = 1e-4
[[contact]]
between = ['a.rod', 'b.rod']
friction = 0.2
restitution = 1.0
[[probe]]
name = 'end'
link = 'b.rod'
nearest = [0.06, 0, 0]
)";

json strike(const std::string& level) {
  const Workspace place;
  place.write("rod.geo", kRod);
  place.write("rod.urdf", kRobot);
  place.write("strike.toml", kScenario);
  return run_for_summary(place, "strike.toml --fidelity " + level);
}

TEST(FullContactRun, OfTwoFlexibleLinksIsThatOfTheirModes) {
  const json full = strike("full");
  const json coupled = strike("coupled");
  expect_same_impact(coupled, full, 0.005, 0.002);
  // Without friction the end would move by 240 and 120 um along x and y.
  for (const char* component : {"end.ux", "end.uy", "end.uz"}) {
    EXPECT_NEAR(coupled["probes"][component]["final"].get<double>(),
                full["probes"][component]["final"].get<double>(), 5e-6)
        << component;
  }
  EXPECT_LT(full["probes"]["end.uy"]["final"].get<double>(), 100e-6);
}

}  // namespace
}  // namespace limber::test::full_contact_slow
