// SPDX-License-Identifier: BSD-3-Clause
// Two flexible rods strike each other crosswise and slide: their modes against
// their whole meshes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/impact_run.hpp"
#include "cli/surface_link.hpp"

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

struct Options {
  std::string size = "0.005";
  std::string friction = "0.2";
  std::string between = "['a.rod', 'b.rod']";
};

json strike(const std::string& level, const Options& options = {}) {
  const Workspace place;
  const auto replace = [](std::string text, const std::string& part,
                          const std::string& by) {
    return text.replace(text.find(part), part.size(), by);
  };
  place.write("rod.geo", replace(kRod, "MeshSize{:} = 0.005",
                                 "MeshSize{:} = " + options.size));
  place.write("rod.urdf", kRobot);
  const std::string rubbed =
      replace(kScenario, "friction = 0.2", "friction = " + options.friction);
  place.write("strike.toml",
              replace(rubbed, "['a.rod', 'b.rod']", options.between));
  return run_for_summary(place, "strike.toml --fidelity " + level);
}

// Without friction by two free Timoshenko beams of 120 elements and 30 modes
// each, Hertz's law of crossed cylinders (k = 1.086e8 N / m^1.5) between them:
// impulse 8.206 mN s, 288 us, peak 66.0 N. A slice's motion is its mean, so
// that the peak depends on the place in it.
TEST(FullContactRun, OfTwoFlexibleLinksIsThatOfBeams) {
  for (const char* level : {"coupled", "full"}) {
    SCOPED_TRACE(level);
    const json run = strike(level, {.friction = "0.0"});
    const json impact = run["contacts"].at(0);
    EXPECT_NEAR(impact["impulse"].get<double>(), 8.206e-3, 0.005 * 8.206e-3);
    EXPECT_NEAR(impact["duration"].get<double>(), 288e-6, 0.07 * 288e-6);
    EXPECT_NEAR(impact["peak_force"].get<double>(), 66.0, 0.15 * 66.0);
  }
}

TEST(FullContactRun, OfTwoWholeMeshesDoesNotDependOnNames) {
  const json one = strike("full");
  const json other = strike("full", {.between = "['b.rod', 'a.rod']"});
  expect_same_impact(other, one, 1e-3, 1e-3);
}

constexpr const char* kEnd = R"(
Point(1) = {0, -0.005, -0.005}; Point(2) = {0, 0.005, -0.005};
Point(3) = {0, 0.005, 0.005}; Point(4) = {0, -0.005, 0.005};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = 2; Transfinite Surface {1};
Recombine Surface {1};
swept[] = Extrude {1, 0, 0} { Surface{1}; Layers{60}; Recombine; };
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};
Mesh.ElementOrder = 2;
)";

TEST(FullContactRun, OfARodsEndIsTheWaveSolution) {
  for (const char* surface : {"skin", "tip"}) {
    SCOPED_TRACE(surface);
    const Workspace place;
    place.write("rod.geo", kEnd);
    expect_wave_impact(place, 0.01, 0.985, " --fidelity full", surface);
  }
}

// Without friction the end would move by 240 and 120 um along x and y.
TEST(FullContactRun, SlidesTwoFlexibleLinksAsTheirModesDo) {
  const json full = strike("full");
  const json coupled = strike("coupled");
  for (const char* component : {"end.ux", "end.uy"}) {
    EXPECT_NEAR(coupled["probes"][component]["final"].get<double>(),
                full["probes"][component]["final"].get<double>(), 5e-6)
        << component;
  }
  EXPECT_LT(full["probes"]["end.uy"]["final"].get<double>(), 100e-6);
}

// The facets of a round rod's side lean by a hundredth along and about its
// axis.
TEST(FullContactRun, OfRoundLinksRubsAlikeOnOtherMeshes) {
  const json coarse = strike("coupled")["contacts"].at(0);
  const json fine = strike("coupled", {.size = "0.003"})["contacts"].at(0);
  const double impulse = fine["impulse"].get<double>();
  EXPECT_NEAR(coarse["impulse"].get<double>(), impulse, 0.01 * impulse);
  const double lost = fine["energy"]["friction"].get<double>();
  EXPECT_NEAR(coarse["energy"]["friction"].get<double>(), lost, 0.01 * lost);
}

}  // namespace
}  // namespace limber::test::full_contact_slow
