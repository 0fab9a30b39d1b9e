// SPDX-License-Identifier: BSD-3-Clause
// Plates that bend into two curvatures, which stretches them in their plane: at
// level nonlinear against the whole mesh.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "cli/command.hpp"

namespace limber::test::plate_slow {
namespace {

using nlohmann::json;

// 1 m x 1 m x 10 mm, held at its middle, pulled at its corners.
void write_plate(const Workspace& place) {
  place.write("plate.geo",
              "Point(1) = {-0.5, -0.5, -0.005};\n"
              "a[] = Extrude {0.45, 0, 0} { Point{1}; Layers{4}; };\n"
              "b[] = Extrude {0.1, 0, 0} { Point{a[0]}; Layers{2}; };\n"
              "c[] = Extrude {0.45, 0, 0} { Point{b[0]}; Layers{4}; };\n"
              "p[] = Extrude {0, 0.45, 0} { Line{a[1], b[1], c[1]}; Layers{4}; "
              "Recombine; };\n"
              "q[] = Extrude {0, 0.1, 0} { Line{p[0], p[4], p[8]}; Layers{2}; "
              "Recombine; };\n"
              "r[] = Extrude {0, 0.45, 0} { Line{q[0], q[4], q[8]}; Layers{4}; "
              "Recombine; };\n"
              "v[] = Extrude {0, 0, 0.01} { Surface{p[1], p[5], p[9], q[1], "
              "q[5], q[9], r[1], r[5], r[9]}; Layers{1}; Recombine; };\n"
              "Physical Surface(\"middle\") = {q[5]};\n"
              "Physical Volume(\"plate\") = Volume{:};\n"
              "Mesh.ElementOrder = 2;\nMesh.SecondOrderIncomplete = 1;\n");
  place.write("plate.urdf",
              "<robot name='r'><link name='world'/><link name='plate'/>"
              "<joint name='hold' type='fixed'><parent link='world'/>"
              "<child link='plate'/></joint>"
              "<coupler joint='hold' translational_stiffness='5e12' "
              "rotational_stiffness='1e9'/>"
              "<flexible link='plate'><mesh file='plate.geo'/>"
              "<material youngs_modulus='7e10' poisson_ratio='0.3' "
              "density='2700'/><basis eigenmodes='12'/>"
              "<attach joint='hold' interface='middle'/></flexible></robot>\n");
}

/// @param twists pulls diagonal corners against each other, else all alike
void write_scene(const Workspace& place, double force, bool twists) {
  std::string text =
      "robot = 'plate.urdf'\n[time]\nduration = 0.01\nstep = 1e-4\n"
      "[output]\npictures = false\n";
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), std::pair(0.5, -0.5),
                             std::pair(0.5, 0.5), std::pair(-0.5, 0.5)}) {
    const std::string where =
        fmt::format("link = 'plate'\nnearest = [{}, {}, 0.005]\n", x, y);
    const double pull = twists && x * y < 0.0 ? -force : force;
    text += fmt::format(
        "[[load]]\nname = 'f{0}{1}'\n{2}force = [0.0, 0.0, {3:.1f}]\n"
        "time = {{ kind = 'constant' }}\n"
        "[[probe]]\nname = 'p{0}{1}'\n{2}quantity = 'displacement'\n",
        x > 0.0, y > 0.0, where, pull);
  }
  place.write("s.toml", text);
}

double find_rise(const Workspace& place, const std::string& level) {
  const CommandResult r = place.limber(
      "static s.toml --json --cache c --out o "
      "--fidelity " +
      level);
  EXPECT_EQ(r.status, 0) << r.errors;
  const json summary = json::parse(r.out, nullptr, false);
  return summary.at("probes").at("ptruetrue.uz").at("value").get<double>();
}

TEST(PlateAtLevelNonlinear, BendsAsTheWholeMeshDoes) {
  const Workspace place;
  write_plate(place);
  for (const bool twists : {false, true}) {
    write_scene(place, 2000.0, twists);
    const double truth = find_rise(place, "full");
    EXPECT_GT(std::abs(truth), 0.03);  // three thicknesses
    EXPECT_NEAR(find_rise(place, "nonlinear") / truth, 1.0, 0.01) << twists;
    EXPECT_GT(std::abs(find_rise(place, "coupled") / truth - 1.0), 0.2);
  }
}

}  // namespace
}  // namespace limber::test::plate_slow
