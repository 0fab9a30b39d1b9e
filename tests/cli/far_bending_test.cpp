// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "cli/command.hpp"
#include "cli/stress_answers.hpp"

/// A slender bar that bends far, at level nonlinear.
namespace limber::test::far_bending_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

// A slender bar on a stiff joint, bent across by a fifth of its length. That it
// keeps its length is in products of modes alone: without their stress there
// would be gigapascals of stretch.
void write_thin_bar(const Workspace& place) {
  place.write("thin.geo",
              "Point(1) = {0, -0.025, -0.01};\n"
              "l[] = Extrude {0, 0.05, 0} { Point{1}; Layers{1}; };\n"
              "s[] = Extrude {0, 0, 0.02} { Line{l[1]}; Layers{1}; "
              "Recombine; };\n"
              "v[] = Extrude {1, 0, 0} { Surface{s[1]}; Layers{20}; "
              "Recombine; };\n"
              "Physical Surface(\"root\") = {s[1]};\n"
              "Physical Surface(\"tip\") = {v[0]};\n"
              "Physical Volume(\"bar\") = {v[1]};\n"
              "Mesh.ElementOrder = 2;\n");
  place.write("thin.urdf",
              "<robot name='thin'><link name='world'/><link name='bar'/>"
              "<joint name='hold' type='fixed'><parent link='world'/>"
              "<child link='bar'/></joint>"
              "<coupler joint='hold' translational_stiffness='5e12' "
              "rotational_stiffness='1e9'/>"
              "<flexible link='bar'><mesh file='thin.geo'/>"
              "<material youngs_modulus='2e11' poisson_ratio='0.0' "
              "density='7800'/><basis eigenmodes='8'/>"
              "<attach joint='hold' interface='root'/></flexible></robot>\n");
  std::string text =
      "robot = 'thin.urdf'\n[output]\npictures = false\nstress = true\n"
      "[time]\nduration = 0.01\nstep = 1e-4\n[[load]]\nname = 'pull'\n"
      "link = 'bar'\ngroup = 'tip'\nforce = [0.0, 0.0, 4000.0]\n"
      "time = { kind = 'constant' }\n[[probe]]\nname = 'tip'\nlink = 'bar'\n"
      "group = 'tip'\nquantity = 'displacement'\n";
  for (const char* x : {"0.25", "0.45"}) {
    text += probe_text("a" + std::string(x).substr(2), "von_mises",
                       fmt::format("nearest = [{}, 0.0, 0.01]", x));
  }
  place.write("thin.toml", text);
}

TEST(Stress, OfABarThatBendsFarIsThatOfTheWholeMesh) {
  const Workspace place;
  write_thin_bar(place);
  const auto solve = [&](const std::string& arguments) {
    return answer(place, "static thin.toml --fidelity " + arguments);
  };
  const json full = solve("full");
  EXPECT_GT(value(full, "tip.uz"), 0.19);
  const json nonlinear = solve("nonlinear");
  const json pieces = solve("nonlinear --set basis.pieces=2");
  for (const char* probe : {"a25.von_mises", "a45.von_mises"}) {
    const double truth = value(full, probe);
    EXPECT_NEAR(value(nonlinear, probe), truth, 0.005 * truth) << probe;
    EXPECT_NEAR(value(pieces, probe), truth, 0.005 * truth) << probe;
  }
  // At the root, where the section warps as it likes.
  const double largest = full.at("stress").at(0).at("von_mises").get<double>();
  EXPECT_NEAR(value(nonlinear, "bar.surface.von_mises"), largest,
              0.05 * largest);
  EXPECT_NEAR(value(pieces, "bar.1.surface.von_mises"), largest,
              0.05 * largest);
}

// A saved body has the second order of the default law.
TEST(SavedBodyAtLevelNonlinear, TellsThatALawChangesNothing) {
  const Workspace place;
  write_thin_bar(place);
  const CommandResult made = place.limber(
      "reduce thin.geo -o thin.h5 --interface root --interface tip "
      "--second-order --stress --youngs-modulus 2e11 --poisson-ratio 0 "
      "--density 7800");
  ASSERT_EQ(made.status, 0) << made.errors;
  std::string robot = read_text(place.folder() / "thin.urdf");
  const auto first = robot.find("<mesh");
  const auto last = robot.find("<attach");
  robot.replace(first, last - first, "<reduced file='thin.h5'/>");
  place.write("thin.urdf", robot);
  // Interfaces of a saved body have the names that it was made with.
  place.write("thin.toml",
              std::regex_replace(read_text(place.folder() / "thin.toml"),
                                 std::regex("group"), "interface"));
  const CommandResult r = place.limber(
      "static thin.toml --cache c --out o --set fidelity.default=nonlinear "
      "--set full.law=neo-hookean");
  EXPECT_EQ(r.status, 0) << r.errors;
  EXPECT_THAT(r.errors, HasSubstr("[full] law of link 'bar' changes nothing: "
                                  "its saved body has the second order of "
                                  "st-venant-kirchhoff"));
}

}  // namespace
}  // namespace limber::test::far_bending_test
