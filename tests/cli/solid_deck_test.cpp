// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "places.hpp"

/// Decks of solids with their materials, masses and sets, and anisotropic
/// materials, by the command.
namespace limber::test::solid_deck_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kData = LIMBER_SOURCE_DIR "/tests/data/";

class SolidDecks : public ::testing::Test {
 protected:
  json find_modes(const std::string& arguments) const {
    const CommandResult result =
        place_.limber("modes " + arguments + " --json");
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.status == 0 ? json::parse(result.out) : json();
  }

  /// One error in one line, with status 2.
  void expect_refusal(const std::string& arguments,
                      const std::string& what) const {
    SCOPED_TRACE(arguments);
    const CommandResult result = place_.limber("modes " + arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.errors, HasSubstr(what));
  }

  /// In mm, N, s, tonnes: a tetrahedron of aluminium, and other cards.
  void write_tetrahedron(const std::string& others = "") const {
    place_.write("one.bdf",
                 "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,90.,0.,0.\n"
                 "GRID,3,,0.,60.,0.\nGRID,4,,0.,0.,50.\nCTETRA,1,1,1,2,3,4\n"
                 "PSOLID,1,1\nMAT1,1,70000.,,.3,2.7-9\n" +
                     others + "ENDDATA\n");
  }

  Workspace place_;
};

/// CalculiX 2.20: tests/data/anisotropic and tests/data/attachments.
TEST_F(SolidDecks, HaveTheFrequenciesOfCalculix) {
  const auto expect = [&](const std::string& arguments,
                          const std::vector<double>& eigenvalues) {
    SCOPED_TRACE(arguments);
    const json study = find_modes(arguments + " --count 3");
    for (std::size_t i = 0; i < eigenvalues.size(); ++i)
      EXPECT_NEAR(study["eigenvalues"][i].get<double>() / eigenvalues[i], 1.0,
                  5e-7);
  };
  const std::vector<double> block{3.214572e8, 4.276792e8, 5.043727e8};
  const std::vector<double> held{8.878801e6, 1.282718e7, 8.856904e7};
  expect(kData + "anisotropic/block.inp", block);
  expect(kData + "anisotropic/block.bdf --unit mm", block);
  expect(kData + "attachments/masses.inp --clamp boundary", held);
  expect(kData + "attachments/masses.bdf --unit mm --clamp spc:12", held);
}

TEST_F(SolidDecks, ReportTheirMaterialsAndMasses) {
  const CommandResult result =
      place_.limber("modes " + kData + "attachments/masses.inp --count 1");
  EXPECT_THAT(result.out, HasSubstr("found material CFRP of"));
  EXPECT_THAT(result.out,
              HasSubstr("found 2 nodes with point masses: 0.07 kg in all"));
}

TEST_F(SolidDecks, TakeAMaterialInPlaceOfTheirs) {
  write_tetrahedron();
  const double own = find_modes("one.bdf --unit mm --count 1")["mass"];
  const double volume = 0.09 * 0.06 * 0.05 / 6.0;
  EXPECT_NEAR(own, 2700.0 * volume, 1e-12);
  const double given = find_modes(
      "one.bdf --unit mm --count 1 --youngs-modulus 210e9 --poisson-ratio "
      "0.3 --density 7850")["mass"];
  EXPECT_NEAR(given, 7850.0 * volume, 1e-12);
}

TEST_F(SolidDecks, HaveAUnitOfForce) {
  // Inches, pounds, slinches: aluminium.
  write_tetrahedron();
  place_.write("inch.bdf",
               "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,3.,0.,0.\n"
               "GRID,3,,0.,2.,0.\nGRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n"
               "PSOLID,1,1\nMAT1,1,1.+7,,.33,2.59-4\nCONM2,9,2,,.001\n"
               "ENDDATA\n");
  const json study =
      find_modes("inch.bdf --unit in --force-unit lbf --count 1");
  // 1 slinch is 175.1268 kg.
  EXPECT_NEAR(study["mass"].get<double>(), (2.59e-4 + 1e-3) * 175.1268, 1e-6);
  expect_refusal("inch.bdf --unit in", "unit of force that is not known");
  expect_refusal("inch.bdf", "which no solid has");
  expect_refusal("one.bdf", "which no solid has");
}

TEST_F(SolidDecks, RefusePoissonsRatiosThatNoSolidHas) {
  for (const char* ratio : {".5", ".6", "-1."}) {
    place_.write("half.bdf", std::string("GRID,1,,0.,0.,0.\nGRID,2,,3.,0.,0.\n"
                                         "GRID,3,,0.,2.,0.\nGRID,4,,0.,0.,1.\n"
                                         "CTETRA,1,1,1,2,3,4\nPSOLID,1,1\n"
                                         "MAT1,1,7.+10,,") +
                                 ratio + ",2700.\n");
    expect_refusal("half.bdf", "MAT1 1: Poisson's ratio");
  }
}

TEST_F(SolidDecks, RefuseWhatASolidBodyLacksByItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"CQUAD4,9,2,1,2,3,4\nPSHELL,2,1,1.\n", "one.bdf:10: PSHELL 2: MID1"},
      {"CBAR,9,2,1,2,0.,1.,0.\nPBARL,2,1,,ROD\n,2.\n",
       "the softest row is node 1, rotation about x"},
      {"CELAS2,9,1.+3,1,1,2,1\n", "one.bdf:9: CELAS2 is not a"},
      {"CONM2,9,2,,1.-5,1.,0.,0.\n", "one.bdf:9: CONM2 9: it has an offset"},
      {"MAT1,1,70000.,,.3,2.7-9\n", "one.bdf:9: material 1 is there twice"}};
  for (const auto& [card, what] : cases) {
    write_tetrahedron(card);
    expect_refusal("one.bdf --unit mm", what);
  }
  write_tetrahedron("CELAS2,9,1.+3,1,1,2,1\n");
  const CommandResult result =
      place_.limber("modes one.bdf --unit mm --count 1 --ignore CELAS2");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("the body lacks them: 1 CELAS2"));
}

/// A free bar of 0.5 m, 30 x 20 mm. Timoshenko's beam with E of its axis, G of
/// its plane and a shear factor of 5/6, 200 elements: 741.85, 1081.82 Hz with
/// fibres along it, 204.33 and 304.80 Hz across.
TEST_F(SolidDecks, OrthotropicBarVibratesByTheModuliOfItsAxes) {
  place_.write("bar.geo", R"(Point(1) = {0, -0.015, -0.01};
line[] = Extrude {0, 0.03, 0} { Point{1}; Layers{2}; };
root[] = Extrude {0, 0, 0.02} { Line{line[1]}; Layers{2}; Recombine; };
bar[] = Extrude {0.5, 0, 0} { Surface{root[1]}; Layers{20}; Recombine; };
Physical Volume("bar") = {bar[1]};
)");
  const std::string material =
      "bar.geo --youngs-modulus 140e9,10e9,10e9 --poisson-ratio 0.3,0.3,0.4 "
      "--shear-modulus 5e9,4e9,3.4e9 --density 1600 --count 2";
  const json along = find_modes(material);
  EXPECT_NEAR(along["frequencies_hz"][0].get<double>(), 741.85, 4.0);
  EXPECT_NEAR(along["frequencies_hz"][1].get<double>(), 1081.82, 6.0);
  const json across = find_modes(material + " --axis-1 0,1,0 --axis-2 1,0,0");
  EXPECT_NEAR(across["frequencies_hz"][0].get<double>(), 204.33, 1.1);
  EXPECT_NEAR(across["frequencies_hz"][1].get<double>(), 304.80, 1.6);
  expect_refusal(material + " --axis-1 0,1,0 --axis-2 0,2,0", "material: ");
}

}  // namespace
}  // namespace limber::test::solid_deck_test
