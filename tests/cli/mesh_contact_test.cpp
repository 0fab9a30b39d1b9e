// SPDX-License-Identifier: BSD-3-Clause
// Links whose collisions are meshes, as the command reports them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "cli/collision_link.hpp"
#include "cli/command.hpp"

namespace limber::test::mesh_contact_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// A cube of 0.1 m as text of an OBJ file. @param faces how many of its six
/// @param shift of its middle along each axis [m] @param before corners of
/// others before it
std::string make_cube(std::size_t faces = 6, double shift = 0.0,
                      int before = 0) {
  std::string text;
  for (const double z : {-0.05, 0.05}) {
    for (const double y : {-0.05, 0.05}) {
      for (const double x : {-0.05, 0.05}) {
        text += fmt::format("v {} {} {}\n", x + shift, y + shift, z + shift);
      }
    }
  }
  const std::vector<std::array<int, 4>> all = {{1, 3, 4, 2}, {5, 6, 8, 7},
                                               {1, 2, 6, 5}, {3, 7, 8, 4},
                                               {1, 5, 7, 3}, {2, 4, 8, 6}};
  for (std::size_t i = 0; i < faces; ++i) {
    const auto& [p, q, r, s] = all[i];
    text += fmt::format("f {} {} {} {}\n", p + before, q + before, r + before,
                        s + before);
  }
  return text;
}

/// A cube above a table, whose top is at z = -0.05 - gap.
CommandResult run_cube(const Workspace& place, const std::string& mesh,
                       double gap) {
  place.write("cube.obj", mesh);
  place.write("cube.urdf", make_link("cube", "2", "0.0033",
                                     "<mesh filename='cube.obj'/>", "1e10"));
  place.write("scene.toml",
              "robot = 'cube.urdf'\n[output]\npictures = false\n"
              "[[probe]]\nname = 'p'\nlink = 'cube'\nquantity = 'position'\n"
              "[[obstacle]]\nname = 'table'\nshape = 'box'\n"
              "size = [0.5, 0.5, 0.1]\nposition = [0.0, 0.0, " +
                  std::to_string(-0.1 - gap) +
                  "]\n[[contact]]\nbetween = ['cube', 'table']\n"
                  "friction = 0.3\nrestitution = 0.2\n[gravity]\n"
                  "acceleration = [1.70354, 0.0, -9.66136]\n"
                  "[time]\nduration = 0.3\nstep = 1e-3\n");
  return place.limber("run scene.toml --out o --json");
}

// A slope of 10 degrees, on which a cube without friction slides 77 mm.
TEST(MeshOnABox, HoldsOnASlope) {
  const Workspace place;
  const CommandResult result = run_cube(place, make_cube(), 1e-6);
  ASSERT_EQ(result.status, 0) << result.errors;
  const json run = json::parse(result.out, nullptr, false);
  EXPECT_LT(std::abs(run["probes"]["p.x"]["final"].get<double>()), 3e-6);
  ASSERT_EQ(run["contacts"].size(), 1U);
  EXPECT_NEAR(run["contacts"][0]["impulse"].get<double>(), 0.6 * 9.66136, 0.05);
}

TEST(MeshOnABox, IsRefusedWhereItIsOpen) {
  const Workspace place;
  const CommandResult result = run_cube(place, make_cube(5), 1e-6);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("cube.obj' is open: the edge from ("));
}

// Two cubes, one of which reaches half into the other.
TEST(MeshOnABox, IsRefusedWhereItCrossesItself) {
  const Workspace place;
  const std::string both = make_cube() + make_cube(6, 0.03, 8);
  const CommandResult result = run_cube(place, both, 1e-6);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("crosses itself at ("));
}

TEST(MeshOnABox, IsRefusedWhereItOverlapsDeeply) {
  const Workspace place;
  const CommandResult result = run_cube(place, make_cube(), -0.02);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors,
              HasSubstr("the bodies overlap by 0.02 m at the start"));
}

// Of the audit, too: the last iteration before a state had 3.6 % more, in a
// contact that steps of 450 of its durations do not resolve.
TEST(MeshOnABox, GainsNoEnergyAtLongSteps) {
  const Workspace place;
  place.write("cube.obj", make_cube());
  place.write("a.urdf", make_link("a", "0.0247804441", "1.51737287e-07",
                                  "<mesh filename='cube.obj' scale='"
                                  "0.0782513096 0.0782513096 0.0782513096'/>",
                                  "195769920"));
  place.write("b.urdf", make_link("b", "15.3181225", "0.000135208616",
                                  "<box size='0.00939505689 0.00413009086 "
                                  "0.00495918342'/>",
                                  "2.93369997e+09"));
  const std::string scene =
      "[[robot]]\nname = 'a'\nfile = 'a.urdf'\n"
      "orientation_rpy = [-2.20910703, 0.0540190744, 1.02419925]\n"
      "[[robot]]\nname = 'b'\nfile = 'b.urdf'\n"
      "position = [0.0164383052, -0.0144975198, 0.013667754]\n"
      "velocity = [-0.000131873679, 0.000116304038, -0.000109647374]\n"
      "angular_velocity = [-0.00078531255, -2.29244698e-05, "
      "-0.000966492714]\n"
      "[[contact]]\nbetween = ['a.a', 'b.b']\n"
      "friction = 0.1249051\n[output]\npictures = false\n"
      "[time]\nduration = 186.977857\nstep = 9.34889283\n";
  place.write("scene.toml", scene);
  int ended = 0;
  for (const char* e : {"0.2", "0.65", "0.751292909", "1"}) {
    const CommandResult result = place.limber(
        std::string("run scene.toml --out o --set contact.0.restitution=") + e);
    if (result.status == 0) ++ended;
    EXPECT_TRUE(result.status == 0 ||
                result.errors.find("a smaller step may help") !=
                    std::string::npos)
        << result.errors;
    const json run = json::parse(read_text(place.folder() / "o/summary.json"));
    EXPECT_GE(run["contacts"].size(), 1U);
    const json& energy = run["energy"];
    EXPECT_LT(energy["peaks"]["stored"]["value"].get<double>(),
              1.005 * energy["initial"].get<double>())
        << e;
  }
  EXPECT_GE(ended, 3);
}

// A ball of 40 x 20 facets.
std::string make_globe(double radius) {
  constexpr int kColumns = 40;
  constexpr int kRows = 20;
  std::string text = fmt::format("v 0 0 {}\n", -radius);
  for (int i = 1; i < kRows; ++i) {
    const double b = std::numbers::pi * (static_cast<double>(i) / kRows - 0.5);
    for (int j = 0; j < kColumns; ++j) {
      const double a = 2.0 * std::numbers::pi * j / kColumns;
      text += fmt::format(
          "v {:.15g} {:.15g} {:.15g}\n", radius * std::cos(b) * std::cos(a),
          radius * std::cos(b) * std::sin(a), radius * std::sin(b));
    }
  }
  text += fmt::format("v 0 0 {}\n", radius);
  const auto at = [](int i, int j) {
    return 2 + (i - 1) * kColumns + j % kColumns;
  };
  const int top = 2 + (kRows - 1) * kColumns;
  for (int j = 0; j < kColumns; ++j) {
    text += fmt::format("f 1 {} {}\nf {} {} {}\n", at(1, j + 1), at(1, j), top,
                        at(kRows - 1, j), at(kRows - 1, j + 1));
    for (int i = 1; i + 1 < kRows; ++i) {
      text += fmt::format("f {} {} {} {}\n", at(i, j), at(i, j + 1),
                          at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return text;
}

// It has more planes than a cylinder's potential takes, and is covered by
// hulls.
TEST(MeshOfManyFacets, PartsFromACylinderAtItsRestitution) {
  const Workspace place;
  place.write("globe.obj", make_globe(0.05));
  place.write("globe.urdf", make_link("globe", "2", "0.002",
                                      "<mesh filename='globe.obj'/>", "1e9"));
  place.write("scene.toml",
              "[[robot]]\nname = 'r'\nfile = 'globe.urdf'\n"
              "velocity = [0.0, 0.0, -1.0]\n[output]\npictures = false\n"
              "[[obstacle]]\nname = 'post'\nshape = 'cylinder'\nradius = 0.1\n"
              "length = 0.5\nposition = [0.0, 0.0, -0.152]\n"
              "orientation_rpy = [1.5707963267948966, 0.0, 0.0]\n"
              "[[contact]]\nbetween = ['r.globe', 'post']\n"
              "friction = 0.3\nrestitution = 0.6\n"
              "[gravity]\nacceleration = [0.0, 0.0, 0.0]\n"
              "[time]\nduration = 0.01\nstep = 1e-4\n");
  const CommandResult result = place.limber("run scene.toml --out o --json");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json run = json::parse(result.out, nullptr, false);
  ASSERT_EQ(run["contacts"].size(), 1U);
  EXPECT_NEAR(run["contacts"][0]["restitution"].get<double>(), 0.6, 0.01);
  EXPECT_NEAR(run["contacts"][0]["impulse"].get<double>(), 2.0 * 1.6, 0.05);
}

// Two legs at a right angle, of two convex parts.
std::string make_angle() {
  const std::vector<std::array<double, 2>> outline = {
      {-0.04, -0.04}, {0.04, -0.04}, {0.04, -0.02},
      {-0.02, -0.02}, {-0.02, 0.04}, {-0.04, 0.04}};
  std::string text;
  for (const double z : {-0.03, 0.03}) {
    for (const auto& p : outline) {
      text += fmt::format("v {} {} {}\n", p[0], p[1], z);
    }
  }
  for (int i = 1; i <= 6; ++i) {
    const int next = i % 6 + 1;
    text += fmt::format("f {} {} {} {}\n", i, next, next + 6, i + 6);
  }
  const std::vector<std::array<int, 3>> ends = {
      {1, 2, 3}, {1, 3, 4}, {1, 4, 5}, {1, 5, 6}};
  for (const auto& [a, b, c] : ends) {
    text +=
        fmt::format("f {} {} {}\nf {} {} {}\n", a + 6, b + 6, c + 6, a, c, b);
  }
  return text;
}

TEST(TwoMeshes, StrikeEachOtherWhateverTheirNames) {
  const Workspace place;
  place.write("angle.obj", make_angle());
  place.write("angle.urdf", make_link("angle", "2", "0.0015",
                                      "<mesh filename='angle.obj'/>", "1e10"));
  const auto run = [&](const std::string& between) {
    place.write("scene.toml",
                "[[robot]]\nname = 'a'\nfile = 'angle.urdf'\n"
                "[[robot]]\nname = 'b'\nfile = 'angle.urdf'\n"
                "position = [0.01, -0.02, 0.12]\n"
                "orientation_rpy = [0.6, 0.4, 0.1]\n"
                "velocity = [0.1, 0.05, -0.8]\n"
                "[output]\npictures = false\n"
                "[[probe]]\nname = 'a'\nlink = 'a.angle'\n"
                "quantity = 'velocity'\n"
                "[[probe]]\nname = 'b'\nlink = 'b.angle'\n"
                "quantity = 'velocity'\n[[contact]]\nbetween = [" +
                    between +
                    "]\nfriction = 0.4\nrestitution = 0.6\n[gravity]\n"
                    "acceleration = [0.0, 0.0, 0.0]\n"
                    "[time]\nduration = 0.2\nstep = 1e-3\n");
    const CommandResult result = place.limber("run scene.toml --out o --json");
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.out, nullptr, false);
  };
  const json one = run("'a.angle', 'b.angle'");
  const json other = run("'b.angle', 'a.angle'");
  const auto find = [](const json& result, const std::string& probe) {
    return result["probes"][probe]["final"].get<double>();
  };
  const std::array<double, 3> start{0.1, 0.05, -0.8};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string axis = ".v" + std::string(1, "xyz"[k]);
    EXPECT_NEAR(find(one, "a" + axis), find(other, "a" + axis), 1e-10);
    EXPECT_NEAR(find(one, "a" + axis) + find(one, "b" + axis), start[k], 1e-9);
  }
  EXPECT_LT(find(one, "a.vz"), -0.1);
}

}  // namespace
}  // namespace limber::test::mesh_contact_test
