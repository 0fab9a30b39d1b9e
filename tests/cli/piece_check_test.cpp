// SPDX-License-Identifier: BSD-3-Clause
// Pieces of a link against the whole: what commands report of the difference,
// and what the two scenes themselves give.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"

namespace limber::test::piece_check_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Bars of 200 mm: six layers of 20 x 8 mm, and tetrahedra as large as the
/// section of 20 x 20 mm.
const std::string kLayers =
    "Point(1) = {0, -0.01, -0.004};\n"
    "l[] = Extrude {0, 0.02, 0} { Point{1}; Layers{2}; };\n"
    "s[] = Extrude {0, 0, 0.008} { Line{l[1]}; Layers{1}; Recombine; };\n"
    "v[] = Extrude {0.2, 0, 0} { Surface{s[1]}; Layers{6}; Recombine; };\n"
    "Physical Surface(\"root\") = {s[1]}; Physical Surface(\"tip\") = {v[0]};\n"
    "Physical Volume(\"body\") = {v[1]};\nMesh.ElementOrder = 2;\n";
const std::string kTetrahedra =
    "SetFactory(\"OpenCASCADE\"); Box(1)={0,-0.01,-0.01,0.2,0.02,0.02};\n"
    "Physical Volume(\"body\")={1};\n"
    "e()=Surface In BoundingBox{-1e-6,-1,-1,1e-6,1,1};\n"
    "Physical Surface(\"root\")={e()};\n"
    "f()=Surface In BoundingBox{0.2-1e-6,-1,-1,0.2+1e-6,1,1};\n"
    "Physical Surface(\"tip\")={f()};\n"
    "Mesh.ElementOrder=2; Mesh.MeshSizeMax=0.02; Mesh.MeshSizeMin=0.02;\n";

std::string robot(const std::string& joint, const std::string& mesh = "") {
  return "<robot name='r'><link name='world'/><link name='bar'/>"
         "<joint name='hold' type='" +
         joint +
         "'><parent link='world'/><child link='bar'/></joint>"
         "<coupler joint='hold' translational_stiffness='1e12' "
         "rotational_stiffness='1e9'/>"
         "<flexible link='bar'><mesh file='bar.geo'" +
         mesh +
         "/><material youngs_modulus='3e9' poisson_ratio='0.3' "
         "density='1500'/><basis eigenmodes='6'/>"
         "<interface name='root' group='root'/>"
         "<interface name='tip' group='tip'/>"
         "<attach joint='hold' interface='root'/></flexible></robot>\n";
}

class CheckOfPieces : public ::testing::Test {
 protected:
  void write(const std::string& geometry, const std::string& robot) const {
    place_.write("bar.geo", geometry);
    place_.write("r.urdf", robot);
    place_.write("s.toml",
                 "robot = 'r.urdf'\n[time]\nduration = 1e-3\nstep = 1e-4\n"
                 "[output]\npictures = false\n"
                 "[[load]]\nname = 'pull'\nlink = 'bar'\ninterface = 'tip'\n"
                 "force = [0.0, 1.0, 0.0]\ntime = { kind = 'constant' }\n"
                 "[[probe]]\nname = 'tip'\nlink = 'bar'\ninterface = 'tip'\n"
                 "quantity = 'displacement'\n");
  }

  CommandResult call(const std::string& command, int pieces) const {
    const CommandResult r = place_.limber(fmt::format(
        "{} s.toml --cache c --set basis.pieces={}", command, pieces));
    EXPECT_EQ(r.status, 0) << r.errors;
    return r;
  }

  json read_summary() const {
    return json::parse(read_text(place_.folder() / "o/summary.json"));
  }

  json differences(int pieces) const {
    static_cast<void>(call("run --out o", pieces));
    return read_summary()["pieces"]["bar"]["differences"];
  }

  double bend(int pieces) const {
    static_cast<void>(call("static --out o", pieces));
    return read_summary()["probes"]["tip.uy"]["value"].get<double>();
  }

  Workspace place_;
};

TEST_F(CheckOfPieces, ReportsTheFlexibilityThatTheScenesHave) {
  write(kTetrahedra, robot("fixed"));
  const json along = differences(4)[1];
  EXPECT_THAT(along["quantity"].get<std::string>(),
              HasSubstr("flexibility along (0, 1, 0"));
  EXPECT_NEAR(along["whole"].get<double>(), bend(1), 1e-3 * bend(1));
  EXPECT_NEAR(along["error"].get<double>(), bend(4) / bend(1) - 1.0, 5e-4);
  EXPECT_GT(along["error"].get<double>(), 0.01);
}

TEST_F(CheckOfPieces, ReportsTheFrequenciesThatTheFreeScenesHave) {
  write(kTetrahedra, robot("floating"));
  const json first = differences(4)[0];
  const std::string name = first["quantity"];
  const auto number = static_cast<std::size_t>(
      std::stoi(name.substr(std::string("elastic frequency ").size())));
  const auto frequency = [&](int pieces) {
    const json found = json::parse(
        call("frequencies --json --set load.pull.force=[0,0,0]", pieces).out);
    std::size_t elastic = 0;
    for (const json& mode : found["modes"]) {
      constexpr double kRigid = 1.0;  // [Hz]
      if (mode["frequency"].get<double>() < kRigid) continue;
      if (++elastic == number) return mode["frequency"].get<double>();
    }
    return 0.0;
  };
  EXPECT_NEAR(first["whole"].get<double>(), frequency(1), 1e-4 * frequency(1));
  EXPECT_NEAR(first["pieces"].get<double>(), frequency(4), 1e-4 * frequency(4));
}

TEST_F(CheckOfPieces, WarnsInEachCommandAlsoWithBodiesFromTheCache) {
  write(kTetrahedra, robot("fixed"));
  const auto warning =
      AllOf(HasSubstr("link 'bar': its 4 pieces differ from the whole link"),
            HasSubstr("m/N (+1."), HasSubstr("fewer pieces"));
  EXPECT_THAT(call("run --out o", 4).errors, warning);
  EXPECT_THAT(call("run --out o", 4).errors, warning);
  EXPECT_EQ(read_summary()["bodies_reduced"], 0);
  EXPECT_THAT(call("static --out o", 4).errors, warning);
  EXPECT_THAT(call("frequencies", 4).errors, warning);
}

TEST_F(CheckOfPieces, OfLayersReportsTheDifferenceWithoutAWarning) {
  write(kLayers, robot("fixed"));
  const CommandResult r = call("run --out o", 2);
  EXPECT_THAT(r.errors, Not(HasSubstr("pieces")));
  EXPECT_THAT(r.out, HasSubstr("its 2 pieces differ from the whole link by"));
  for (const json& one : read_summary()["pieces"]["bar"]["differences"])
    EXPECT_LT(std::abs(one["error"].get<double>()), 0.01) << one;
  EXPECT_FALSE((call("run --out o", 1), read_summary()).contains("pieces"));
}

// Sections that rotate about the bar's axis also warp; bending carries on.
TEST_F(CheckOfPieces, OfLayersFindsTorsionSofterThanBending) {
  write(kLayers, robot("fixed"));
  const json found = differences(4);
  EXPECT_LT(std::abs(found[1]["error"].get<double>()), 0.001);
  EXPECT_THAT(found[2]["quantity"].get<std::string>(),
              HasSubstr("about (1, 0, 0)"));
  EXPECT_GT(found[2]["error"].get<double>(), 0.01);
}

// Locking is that of the whole link, once.
TEST_F(CheckOfPieces, OfFirstOrderReportsTheLockingOfTheWhole) {
  write(kTetrahedra, robot("fixed", " order='1'"));
  const std::string errors = call("run --out o", 2).errors;
  const CommandResult modes = place_.limber(
      "modes bar.geo --order 1 --json --youngs-modulus 3e9 "
      "--poisson-ratio 0.3 --density 1500");
  ASSERT_EQ(modes.status, 0) << modes.errors;
  const double known =
      json::parse(modes.out)["locking"]["frequency_hz"].get<double>();
  EXPECT_THAT(errors, HasSubstr(fmt::format(
                          "its first elastic frequency, {:.4g} Hz", known)));
  EXPECT_EQ(errors.find("first order"), errors.rfind("first order"));
}

}  // namespace
}  // namespace limber::test::piece_check_test
