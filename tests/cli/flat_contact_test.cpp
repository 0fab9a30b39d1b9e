// SPDX-License-Identifier: BSD-3-Clause
// Flat ends of meshed rods through the command, against the wave solution:
// force E A v / c for 2 L / c, of two rods half of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "cli/command.hpp"
#include "cli/impact_run.hpp"

namespace limber::test::flat_contact_test {
namespace {

using nlohmann::json;

constexpr double kLength = 1.0;  // [m]
constexpr double kArea = 1e-4;   // [m^2]
constexpr double kModulus = 210e9;
constexpr double kDensity = 7850.0;

// 10 x 10 mm, 60 elements along x, 2 x 2 across.
constexpr const char* kGeometry = R"(
Point(1) = {0, -0.005, -0.005};
Point(2) = {0, 0.005, -0.005};
Point(3) = {0, 0.005, 0.005};
Point(4) = {0, -0.005, 0.005};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = 3;
Transfinite Surface {1};
Recombine Surface {1};
swept[] = Extrude {1, 0, 0} { Surface{1}; Layers{60}; Recombine; };
Physical Surface("root") = {1};
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};
Mesh.ElementOrder = 2;
)";

void write_rod(const Workspace& place, const std::string& file,
               const std::string& end) {
  place.write(file, fmt::format(R"(<robot name="r"><link name="rod"/>
<flexible link="rod"><mesh file="rod.geo"/>
<material youngs_modulus="{}" poisson_ratio="0.3" density="{}"/>
<basis eigenmodes="60"/></flexible>
<contact link="rod" surface="{}"/></robot>)",
                                kModulus, kDensity, end));
}

/// A rod that moves along x, its tip ahead, towards what is there.
std::string write_scene(double speed, const std::string& target,
                        const std::string& link) {
  return fmt::format(
      "[[robot]]\nname = 'a'\nfile = 'tip.urdf'\nvelocity = [{}, 0, 0]\n{}"
      "[[contact]]\nbetween = ['a.rod', '{}']\n"
      "[time]\nduration = 1e-3\nstep = 1e-6\noutput_interval = 1e-5\n"
      "[output]\npictures = false\n",
      speed, target, link);
}

json strike(const Workspace& place, const std::string& scene) {
  place.write("scene.toml", scene);
  return run_for_summary(place, "scene.toml");
}

class FlatEnds : public ::testing::Test {
 protected:
  void SetUp() override {
    place_.write("rod.geo", kGeometry);
    write_rod(place_, "tip.urdf", "tip");
    write_rod(place_, "root.urdf", "root");
    place_.write("box.urdf", R"(<robot name="r"><link name="box"><inertial>
<mass value="1e7"/><inertia ixx="1e7" iyy="1e7" izz="1e7" ixy="0" ixz="0"
iyz="0"/></inertial><collision><geometry><box size="0.1 0.08 0.06"/>
</geometry></collision></link></robot>)");
  }
  Workspace place_;
};

TEST_F(FlatEnds, OfTwoRodsStrikeOnceAsTheWaveSolutionSays) {
  const json run = strike(
      place_, write_scene(0.5,
                          "[[robot]]\nname = 'b'\nfile = 'root.urdf'\n"
                          "position = [1.00001, 0, 0]\nvelocity = [-0.5, 0, "
                          "0]\n",
                          "b.rod"));
  ASSERT_EQ(run["contacts"].size(), 1U);
  const json& impact = run["contacts"][0];
  const double waves = std::sqrt(kModulus / kDensity);  // [m/s]
  const double force = 0.5 * kModulus * kArea / waves;
  const double duration = 2.0 * kLength / waves;
  EXPECT_EQ(impact["touches"], 1);
  const double longer = impact["duration"].get<double>() / duration;
  EXPECT_GE(longer, 1.0);
  EXPECT_LE(longer, 1.07);  // with five axial modes
  EXPECT_NEAR(impact["impulse"].get<double>() / (force * duration), 1.0, 0.002);
  EXPECT_GE(impact["restitution"].get<double>(), 0.998);
  EXPECT_GE(impact["peak_force"].get<double>() / force, 1.0);
  EXPECT_LE(impact["peak_force"].get<double>() / force, 1.1);
}

TEST_F(FlatEnds, MeetAHeavyBoxAsAWall) {
  const json wall = strike(
      place_, write_scene(1.0,
                          "[[obstacle]]\nname = 'w'\nshape = 'plane'\n"
                          "position = [1.00001, 0, 0]\nnormal = [-1, 0, 0]\n",
                          "w"));
  const json box =
      strike(place_, write_scene(1.0,
                                 "[[robot]]\nname = 'b'\nfile = 'box.urdf'\n"
                                 "position = [1.05001, 0.01, 0.02]\n",
                                 "b.box"));
  expect_same_impact(box, wall, 1e-4, 1e-4, 1e-6);
}

// By 1.3 degrees, so that a corner strikes first.
TEST_F(FlatEnds, StrikeABoxTiltedAsATiltedWallAndGainNoEnergy) {
  const std::string turn = "orientation_rpy = [0, 0.02, 0.01]\n";
  const json box =
      strike(place_, write_scene(1.0,
                                 "[[robot]]\nname = 'b'\nfile = 'box.urdf'\n"
                                 "position = [1.0505, 0, 0]\n" +
                                     turn,
                                 "b.box"));
  // The box's face, 50 mm from its middle.
  const double y = std::sin(0.01) * std::cos(0.02);
  const double x = std::cos(0.01) * std::cos(0.02);
  const double z = -std::sin(0.02);
  const json wall = strike(
      place_,
      write_scene(
          1.0,
          fmt::format("[[obstacle]]\nname = 'w'\nshape = 'plane'\n"
                      "position = [{}, {}, {}]\nnormal = [{}, {}, {}]\n",
                      1.0505 - 0.05 * x, -0.05 * y, -0.05 * z, -x, -y, -z),
          "w"));
  expect_same_impact(box, wall, 1e-4, 1e-4);
  const json& energy = box["energy"];
  EXPECT_LT(energy["peaks"]["stored"]["value"].get<double>(),
            1.001 * energy["initial"].get<double>());
}

// Half over each other, with friction.
TEST_F(FlatEnds, OfTwoRodsThatCoverEachOtherByHalfGainNoEnergy) {
  const json run = strike(
      place_, write_scene(0.5,
                          "[[robot]]\nname = 'b'\nfile = 'root.urdf'\n"
                          "position = [1.0003, 0.005, 0.002]\nvelocity = "
                          "[-0.5, 0.3, 0]\norientation_rpy = [0.2, 0, 0.01]\n",
                          "b.rod") +
                  "[contact_default]\nfriction = 0.3\n");
  ASSERT_EQ(run["contacts"].size(), 1U);
  EXPECT_GT(run["contacts"][0]["impulse"].get<double>(), 0.1);
  const json& energy = run["energy"];
  EXPECT_LT(energy["peaks"]["stored"]["value"].get<double>(),
            1.005 * energy["initial"].get<double>());
}

// Two bars of 200 x 20 x 8 mm, four second-order elements long, one on its back
// across the other's end.
json cross_bars(const std::string& first, const std::string& second) {
  const Workspace place;
  place.write("bar.geo", R"(
Point(1) = {0, -0.01, -0.004}; Point(2) = {0, 0.01, -0.004};
Point(3) = {0, 0.01, 0.004}; Point(4) = {0, -0.01, 0.004};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 3; Transfinite Curve {2, 4} = 2;
Transfinite Surface {1}; Recombine Surface {1};
swept[] = Extrude {0.2, 0, 0} { Surface{1}; Layers{4}; Recombine; };
Physical Surface("top") = {swept[4]};
Physical Volume("body") = {swept[1]};
Mesh.ElementOrder = 2;
)");
  place.write("bar.urdf", R"(<robot name="b"><link name="b"/>
<flexible link="b"><mesh file="bar.geo"/>
<material youngs_modulus="3e9" poisson_ratio="0.3" density="1500"/>
<damping rayleigh_stiffness="1e-6"/><basis eigenmodes="6"/></flexible>
<contact link="b" surface="top"/></robot>)");
  place.write("scene.toml", fmt::format(R"(
[time]
duration = 0.0025
step = 2e-6
output_interval = 1.25e-4
[[robot]]
name = "A"
file = "bar.urdf"
angular_velocity = [0.3, 0.2, 0.1]
[[robot]]
name = "B"
file = "bar.urdf"
position = [0.1, -0.099997550010004147, 0.0073907051392707416]
orientation_rpy = [3.141592653589793, -0.007, 1.5707963267948966]
velocity = [0.0, 0.1, -1.0]
angular_velocity = [0.5, 0.2, 0.3]
[[contact]]
between = ["{}", "{}"]
friction = 0.3
restitution = 0.8
[[probe]]
name = "p"
link = "B.b"
group = "top"
quantity = "position"
[output]
pictures = false
)",
                                        first, second));
  return run_for_summary(place, "scene.toml");
}

TEST(CrossedBars, StrikeAlikeWhicheverNameStandsFirst) {
  const json one = cross_bars("A.b", "B.b");
  const json other = cross_bars("B.b", "A.b");
  ASSERT_EQ(one["contacts"].size(), other["contacts"].size());
  ASSERT_GE(one["contacts"].size(), 1U);
  for (std::size_t i = 0; i < one["contacts"].size(); ++i) {
    for (const char* what : {"peak_force", "impulse", "time", "duration"}) {
      const double a = one["contacts"][i][what].get<double>();
      const double b = other["contacts"][i][what].get<double>();
      EXPECT_NEAR(b / a, 1.0, 1e-7) << what << " of " << i;
    }
  }
  for (const char* probe : {"p.x", "p.y", "p.z"}) {
    EXPECT_NEAR(one["probes"][probe]["final"].get<double>(),
                other["probes"][probe]["final"].get<double>(), 1e-10);
  }
}

// Two clamped fingers of 200 x 30 x 20 mm press a box of 1 kg by N each.
json press_box(double force, double duration) {
  const Workspace place;
  place.write("finger.geo", R"(
Point(1) = {-0.01, -0.015, -0.05};
l[] = Extrude {0, 0.03, 0} { Point{1}; Layers{1}; };
r[] = Extrude {0, 0, 0.2} { Line{l[1]}; Layers{10}; Recombine; };
s[] = Extrude {0.02, 0, 0} { Surface{r[1]}; Layers{1}; Recombine; };
Physical Surface("xmin") = {r[1]};
Physical Surface("xmax") = {s[0]};
Physical Surface("zmax") = {s[4]};
Physical Volume("body") = {s[1]};
Mesh.ElementOrder = 2;
)");
  for (const auto& [file, x, surface] :
       {std::tuple{"left.urdf", -0.06, "xmax"},
        std::tuple{"right.urdf", 0.06, "xmin"}}) {
    place.write(file, fmt::format(R"(<robot name="f"><link name="world"/>
<joint name="slide" type="prismatic"><parent link="world"/>
<child link="carriage"/><origin xyz="{} 0 0"/><axis xyz="1 0 0"/>
<limit lower="0" upper="0" effort="0" velocity="0"/></joint>
<link name="carriage"><inertial><origin xyz="0 0 0.2"/><mass value="0.2"/>
<inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial>
</link><joint name="root" type="fixed"><parent link="carriage"/>
<child link="finger"/></joint><link name="finger"/>
<flexible link="finger"><mesh file="finger.geo"/>
<material youngs_modulus="70e9" poisson_ratio="0.33" density="2700"/>
<damping ratio="0.02"/><basis eigenmodes="6"/>
<interface name="top" group="zmax"/><attach joint="root" interface="top"/>
</flexible><contact link="finger" surface="{}"/></robot>)",
                                  x, surface));
  }
  place.write("box.urdf", R"(<robot name="b"><link name="box"><inertial>
<mass value="1"/><inertia ixx="0.0016667" iyy="0.0016667" izz="0.0016667"
ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>
<box size="0.1 0.1 0.1"/></geometry></collision></link>
<contact link="box" youngs_modulus="70e9" poisson_ratio="0.33"/></robot>)");
  place.write("scene.toml", fmt::format(R"(
[[robot]]
name = "L"
file = "left.urdf"
[[robot]]
name = "R"
file = "right.urdf"
[[robot]]
name = "B"
file = "box.urdf"
[time]
duration = {}
step = 5e-4
[gravity]
acceleration = [0.0, 0.0, -9.81]
[[drive]]
joint = "L.slide"
mode = "effort"
signal = {{ kind = "constant", value = {} }}
[[drive]]
joint = "R.slide"
mode = "effort"
signal = {{ kind = "constant", value = -{} }}
[[contact]]
between = ["L.finger", "B.box"]
friction = 0.5
restitution = 0.0
[[contact]]
between = ["R.finger", "B.box"]
friction = 0.5
restitution = 0.0
[[probe]]
name = "v"
link = "B.box"
quantity = "velocity"
[output]
pictures = false
)",
                                        duration, force, force));
  return run_for_summary(place, "scene.toml");
}

// 2 mu N = 9 N < m g = 9.81 N.
TEST(Fingers, LetABoxSlideAsCoulombSays) {
  const double early =
      press_box(9.0, 0.1)["probes"]["v.vz"]["final"].get<double>();
  const double late =
      press_box(9.0, 0.3)["probes"]["v.vz"]["final"].get<double>();
  EXPECT_NEAR((late - early) / 0.2, -0.81, 0.005);
}

TEST(Fingers, HoldABoxWithoutCreep) {
  const json run = press_box(20.0, 0.3);
  EXPECT_LT(std::abs(run["probes"]["v.vz"]["final"].get<double>()), 1e-9);
}

}  // namespace
}  // namespace limber::test::flat_contact_test
