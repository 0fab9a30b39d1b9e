// SPDX-License-Identifier: BSD-3-Clause
// Flat ends of meshed rods through the command, against the wave solution:
// force E A v / c for 2 L / c, of two rods half of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

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
  EXPECT_NEAR(impact["duration"].get<double>() / duration, 1.0, 0.01);
  EXPECT_NEAR(impact["impulse"].get<double>() / (force * duration), 1.0, 0.002);
  EXPECT_GE(impact["restitution"].get<double>(), 0.998);
  // Of a sum of waves cut off at a mode: 1.891 with five, 1.848 with twenty.
  EXPECT_NEAR(impact["peak_force"].get<double>() / force, 1.87, 0.04);
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
  expect_same_impact(box, wall, 1e-4, 1e-4);
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

}  // namespace
}  // namespace limber::test::flat_contact_test
