// SPDX-License-Identifier: BSD-3-Clause
// Links in pieces, from scenarios and in what the commands report.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"

namespace limber::test::pieces_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr int kBadInput = 2;

/// A bar of 1 m x 50 x 50 mm, held at its root by a stiff joint, pulled across.
void write_bar(const Workspace& place, double force,
               const std::string& more = "") {
  place.write("bar.geo",
              "Point(1) = {0, -0.025, -0.025};\n"
              "l[] = Extrude {0, 0.05, 0} { Point{1}; Layers{1}; };\n"
              "s[] = Extrude {0, 0, 0.05} { Line{l[1]}; Layers{1}; "
              "Recombine; };\n"
              "v[] = Extrude {1, 0, 0} { Surface{s[1]}; Layers{20}; "
              "Recombine; };\n"
              "Physical Surface(\"root\") = {s[1]};\n"
              "Physical Surface(\"tip\") = {v[0]};\n"
              "Physical Volume(\"body\") = {v[1]};\n"
              "Mesh.ElementOrder = 2;\n");
  place.write("bar.urdf",
              "<robot name='r'><link name='world'/><link name='bar'/>"
              "<joint name='hold' type='fixed'><parent link='world'/>"
              "<child link='bar'/></joint>"
              "<coupler joint='hold' translational_stiffness='5e12' "
              "rotational_stiffness='1e9'/>"
              "<flexible link='bar'><mesh file='bar.geo'/>"
              "<material youngs_modulus='2e11' poisson_ratio='0.3' "
              "density='7800'/><basis eigenmodes='4'/>"
              "<attach joint='hold' interface='root'/></flexible></robot>\n");
  place.write("s.toml",
              "robot = 'bar.urdf'\n[time]\nduration = 0.02\nstep = 1e-4\n"
              "[output]\npictures = false\n[fidelity]\ndefault = 'nonlinear'\n"
              "[[load]]\nname = 'pull'\nlink = 'bar'\ngroup = 'tip'\n"
              "frame = 'world'\nforce = [0.0, 0.0, " +
                  fmt::format("{:.1f}", force) +
                  "]\ntime = { kind = 'constant' }\n"
                  "[[probe]]\nname = 'tip'\nlink = 'bar'\ngroup = 'tip'\n"
                  "quantity = 'displacement'\n" +
                  more);
}

json read_summary(const Workspace& place) {
  return json::parse(read_text(place.folder() / "o/summary.json"));
}

double bend(const Workspace& place, const std::string& options) {
  const CommandResult r =
      place.limber("static s.toml --out o --cache c " + options);
  EXPECT_EQ(r.status, 0) << r.errors;
  return read_summary(place)["probes"]["tip.uz"]["value"].get<double>();
}

// E I = 104 167 N m^2; what would bend it by 20 % is 20.65 % of 3 E I / L^2.
constexpr double kFar = 64531.0;

TEST(LinkInPieces, BendsByAFifthAsTheWholeMesh) {
  const Workspace place;
  write_bar(place, kFar);
  const double whole = bend(place, "--fidelity full");
  EXPECT_NEAR(bend(place, "--set basis.pieces=2"), whole, 1e-3 * whole);
  // In one piece it is off by more: the cut is what does it.
  EXPECT_GT(std::abs(bend(place, "--set basis.pieces=1") - whole),
            2e-3 * whole);
}

TEST(LinkInPieces, IsWholeAtLevelsThatNeedNoPieces) {
  const Workspace place;
  write_bar(place, 100.0);
  for (const char* level : {"rigid", "uncoupled", "full"}) {
    const std::string option = fmt::format("--fidelity {} ", level);
    const auto probes = [&](const std::string& pieces) {
      const CommandResult r = place.limber("run s.toml --out o --cache c " +
                                           option + "--set " + pieces);
      EXPECT_EQ(r.status, 0) << r.errors;
      return read_text(place.folder() / "o/probes.csv");
    };
    EXPECT_EQ(probes("basis.pieces=2"), probes("basis.pieces=1")) << level;
  }
}

// Beyond Euler's load, where Newton's method may jump to an unstable branch.
TEST(LinkInPieces, BucklesAsTheWholeMesh) {
  const Workspace place;
  write_bar(place, 0.0);
  const std::string load =
      "--set load.pull.force=[-308425.1,0.0,20833.3] ";  // 1.2 Euler, 0.2 E I
  const double whole = bend(place, load + "--fidelity full");
  EXPECT_GT(whole, 0.5);
  EXPECT_NEAR(bend(place, load + "--set basis.pieces=2"), whole, 0.01 * whole);
}

TEST(LinkInPieces, IsComparedWithTheWholeMesh) {
  const Workspace place;
  write_bar(place, kFar);
  const auto find_error = [&](int pieces) {
    const CommandResult r = place.limber(fmt::format(
        "compare s.toml --out o --cache c --fidelity nonlinear,full "
        "--reference "
        "full --set time.duration=0.03 --set basis.pieces={} --json",
        pieces));
    EXPECT_EQ(r.status, 0) << r.errors;
    const json runs = json::parse(r.out)["runs"];
    EXPECT_EQ(runs[0]["fidelity"], "nonlinear");
    return runs[0]["error"]["displacement"]["rms"].get<double>();
  };
  EXPECT_LT(find_error(2), 0.5 * find_error(1));
}

TEST(LinkInPieces, ShowsItsBodiesAndKeepsItsEnergy) {
  const Workspace place;
  write_bar(place, 2000.0);
  const CommandResult r = place.limber(
      "run s.toml --out o --cache c --set robot.flexible.bar.pieces=3");
  ASSERT_EQ(r.status, 0) << r.errors;
  const json summary = read_summary(place);
  EXPECT_EQ(summary["bodies"], 3);
  EXPECT_LT(std::abs(summary["energy"]["relative_drift"].get<double>()), 1e-3);
  EXPECT_EQ(place.limber("view o -o page.html").status, 0);
  EXPECT_EQ(place.limber("export o -o scene.glb").status, 0);
  EXPECT_THAT(read_text(place.folder() / "scene.glb"), HasSubstr("bar.3"));
}

TEST(LinkInPieces, RefusesNumbersThatItsMeshDoesNotHave) {
  const Workspace place;
  write_bar(place, 1.0);
  const auto errors = [&](const std::string& pieces) {
    const CommandResult r = place.limber("run s.toml --out o --cache c --set " +
                                         ("basis.pieces=" + pieces));
    EXPECT_EQ(r.status, kBadInput) << pieces;
    return r.errors;
  };
  EXPECT_THAT(errors("0"), HasSubstr("whole number in [1, 1000]"));
  EXPECT_THAT(errors("1.5"), HasSubstr("expected a whole number"));
  EXPECT_THAT(errors("'many'"), HasSubstr("a number of pieces or \"auto\""));
  EXPECT_THAT(errors("30"), HasSubstr("20 elements do not give 30 pieces"));
}

TEST(LinkInPieces, RefusesAProbeOfTheLargestStressOfAll) {
  const Workspace place;
  write_bar(place, 1.0,
            "[[probe]]\nname = 's'\nlink = 'bar'\nquantity = 'von_mises'\n");
  const CommandResult r = place.limber(
      "run s.toml --out o --cache c --fidelity coupled --set basis.pieces=2");
  EXPECT_EQ(r.status, kBadInput);
  EXPECT_THAT(r.errors,
              HasSubstr("cut into 2 pieces, which are separate bodies"));
}

}  // namespace
}  // namespace limber::test::pieces_test
