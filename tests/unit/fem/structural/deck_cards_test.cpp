// SPDX-License-Identifier: BSD-3-Clause
// What decks say in several ways is one body; what is lost is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/fem/structural/assemble_structure.hpp"
#include "limber/fem/structural/read_structure.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::deck_cards_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::write_file;

AssembledStructure assemble(const std::string& name, const std::string& text,
                            const std::vector<std::string>& ignored = {}) {
  return assemble_structure(read_structure(write_file(name, text), ignored),
                            {});
}

std::string find_error(const std::string& name, const std::string& text) {
  try {
    static_cast<void>(assemble(name, text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

/// Of the largest entry.
double difference(const AssembledStructure& a, const AssembledStructure& b) {
  const auto ratio = [](const auto& x, const auto& y) {
    return (x - y).norm() / y.norm();
  };
  return std::max(ratio(a.model.stiffness.entries, b.model.stiffness.entries),
                  ratio(a.model.mass.entries, b.model.mass.entries));
}

const std::string kGrids =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,.2\nGRID,3,,1.1,.9,.1\nGRID,4,,0.,1.,0.\n";
const std::string kBar =
    "CBAR,1,1,1,2,.3,1.,.2,,\n,,,.01,.02,.03,-.01,.0,.02\n"
    "PBAR,1,1,1.-3,1.-7,2.-7,3.-7\nMAT1,1,7.+10,,.3,2700.\n";
const std::string kMass =
    "CONM2,3,2,,2.,.1,.2,.3,,\n,.05,.01,.06,-.01,.005,.04\n";
const std::string kPlate = "CQUAD4,2,2,1,2,3,4\nPSHELL,2,1,.01,1,,1\n";
/// x along -y, y along x.
const std::string kTurned = "CORD2R,5,,7.,8.,9.,7.,8.,10.\n,7.,7.,9.\n";

TEST(DeckCards, VectorsAreInTheAxesOfDisplacements) {
  const auto basic = assemble("a.bdf", kGrids + kBar + kMass + kPlate);
  // v = (x, y, z) is (-y, x, z) in the turned axes.
  const std::string bar =
      "CBAR,1,1,1,2,-1.,.3,.2,,\n,,,-.02,.01,.03,-.0,-.01,.02\n" +
      kBar.substr(kBar.find("PBAR"));
  std::string grids = kGrids;
  for (const char* end : {",0.,0.,0.\n", ",1.,0.,.2\n"})
    grids.insert(grids.find(end) + std::string(end).size() - 1, ",5");
  EXPECT_LT(
      difference(assemble("b.bdf", grids + kTurned + bar + kMass + kPlate),
                 basic),
      1e-14);
  EXPECT_LT(difference(assemble("c.bdf", "GRDSET,,,,,,5\n" + kGrids + kTurned +
                                             bar + kMass + kPlate),
                       basic),
            1e-14);
}

/// Of a cylinder about z: radial and tangential at (3, 4, .); of a sphere also
/// along rising angles from z.
TEST(DeckCards, CurvilinearAxesOfDisplacementsAreThoseOfThePlace) {
  const auto deck = [](const std::string& kind, const std::string& motions,
                       const std::string& up) {
    return "CORD2" + kind + ",5,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n" +
           "GRID,1,,3.,4.,0.," + motions + "\nGRID,2,,3.,4.,2.\n" +
           "CBAR,1,1,1,2," + up + kBar.substr(kBar.find("PBAR") - 1);
  };
  const auto basic = assemble("a.bdf", deck("C", "", ".6,.8,0."));
  EXPECT_LT(difference(assemble("b.bdf", deck("C", "5", "1.,0.,0.")), basic),
            1e-14);
  EXPECT_LT(difference(assemble("c.bdf", deck("S", "5", "1.,0.,0.")), basic),
            1e-14);
  const auto across = assemble("a.bdf", deck("C", "", "-.8,.6,0."));
  EXPECT_LT(difference(assemble("b.bdf", deck("C", "5", "0.,1.,0.")), across),
            1e-14);
  EXPECT_LT(difference(assemble("c.bdf", deck("S", "5", "0.,0.,1.")), across),
            1e-14);
}

TEST(DeckCards, MassesAreInTheAxesOfTheirSystem) {
  const auto basic = assemble("a.bdf", kGrids + kBar + kMass);
  // I11 and I22 change places, I31 = -I32, I32 = I31, I21 its sign.
  EXPECT_LT(difference(assemble("b.bdf",
                                kGrids + kBar + kTurned +
                                    "CONM2,3,2,5,2.,-.2,.1,.3,,\n,.06,-.01,.05,"
                                    "-.005,-.01,.04\n"),
                       basic),
            1e-14);
  EXPECT_LT(
      difference(assemble("c.bdf", kGrids + kBar +
                                       "CONM2,3,2,-1,2.,1.1,.2,.5,,\n,.05,.01,"
                                       ".06,-.01,.005,.04\n"),
                 basic),
      1e-14);
}

TEST(DeckCards, BlankFieldsOfBarsAreThoseOfBaror) {
  const auto basic = assemble("a.bdf", kGrids + kBar + kPlate);
  std::string bar = kBar;
  bar.replace(0, bar.find(",,\n"), "BAROR,,1,,,.3,1.,.2\nCBAR,1,,1,2,,,");
  EXPECT_EQ(difference(assemble("b.bdf", kGrids + bar + kPlate), basic), 0.0);
  EXPECT_THAT(find_error("c.bdf", kGrids + bar + kPlate + "BAROR,,1\n"),
              HasSubstr("a second BAROR"));
}

/// The same plate in plane stress by its constants, and MAT8 turned by 30
/// degrees as six constants and two of transverse shear.
TEST(DeckCards, PlatesByTheirStiffnessAreThoseByTheirConstants) {
  const auto plate = [](const std::string& element, const std::string& more) {
    return kGrids + "CQUAD4,2,2,1,2,3,4" + element + more;
  };
  const double q = 7e10 / (1.0 - 0.09);
  const double G = 7e10 / 2.6;
  EXPECT_LT(
      difference(
          assemble("b.bdf",
                   plate("\n", "PSHELL,2,8,.01,8,,9\n" +
                                   fmt::format(
                                       "MAT2,8,{:e},{:e},0.,{:e},0.,{:e},"
                                       "2700.\nMAT2,9,{:e},0.,0.,{:e},0.,1.\n",
                                       q, 0.3 * q, q, G, G, G))),
          assemble("a.bdf", plate("\n",
                                  "PSHELL,2,1,.01,1,,1\nMAT1,1,7.+10,,"
                                  ".3,2700.\n"))),
      1e-6);
  const double d = 1.0 - 0.09 * 9.0 / 140.0;
  Matrix3 Q;
  Q << 1.4e11 / d, 2.7e9 / d, 0, 2.7e9 / d, 9e9 / d, 0, 0, 0, 5e9;
  const double c = std::cos(M_PI / 6.0);
  const double s = std::sin(M_PI / 6.0);
  Matrix3 T;
  T << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s,
      c * c - s * s;
  Q = (T.transpose() * Q * T).eval();
  const auto find_laminate = [&](const std::string& more) {
    return read_structure(write_file("b.bdf", plate("\n", more)))
        .laminates.at(0);
  };
  const Laminate turned =
      find_laminate("PSHELL,2,8,.01,8,,9\n" +
                    fmt::format("MAT2,8,{:e},{:e},{:e},{:e},{:e},{:e},1600.\n"
                                "MAT2,9,{:e},{:e},0.,{:e},0.,1.\n",
                                Q(0, 0), Q(0, 1), Q(0, 2), Q(1, 1), Q(1, 2),
                                Q(2, 2), c * c * 5e9 + s * s * 3e9, c * s * 2e9,
                                s * s * 5e9 + c * c * 3e9));
  const Laminate ply = find_laminate(
      "MAT8,7,1.4+11,9.+9,.3,5.+9,5.+9,3.+9,1600.\n"
      "PCOMP,2,,,,,,,,\n,7,.01,30.\n");
  EXPECT_LT((turned.A - ply.A).norm(), 1e-6 * ply.A.norm());
  EXPECT_LT((turned.D - ply.D).norm(), 1e-6 * ply.D.norm());
  EXPECT_EQ(turned.mass, ply.mass);
  // Of a ply at an angle equilibrium gives another S than 5/6 G t.
  Matrix2 shear;
  shear << c * c * 5e9 + s * s * 3e9, c * s * 2e9, c * s * 2e9,
      s * s * 5e9 + c * c * 3e9;
  EXPECT_LT((turned.S - 5.0 / 6.0 * 0.01 * shear).norm(),
            1e-6 * shear.norm() * 0.01);
  EXPECT_THAT(find_error("c.bdf", plate("\n",
                                        "PSHELL,2,8,.01,8,,8\nMAT2,8,"
                                        "1.,2.,0.,1.,0.,1.,1.\n")),
              HasSubstr("c.bdf:7: MAT2 8: G11, ..., G33 are not positive"));
}

TEST(DeckCards, OfOtherKindsAreRefusedUnlessIgnored) {
  const std::string deck = kGrids + kBar + kPlate +
                           "CELAS2,8,1.,1,1,2,1\nCELAS2,9,1.,1,1\nNSM,9,PBAR,1,"
                           "5.\nWHAT,1\n";
  EXPECT_THAT(find_error("a.bdf", deck),
              AllOf(HasSubstr("a.bdf:11: CELAS2 (2 cards, the first here)"),
                    HasSubstr("a.bdf:13: NSM is not read"),
                    HasSubstr("a.bdf:14: WHAT is not known"),
                    HasSubstr("or ignore WHAT to go on without")));
  const auto body = assemble("a.bdf", deck, {"celas2", "NSM", "WHAT"});
  EXPECT_EQ(difference(body, assemble("b.bdf", kGrids + kBar + kPlate)), 0.0);
  EXPECT_THAT(body.model.notices,
              Contains(AllOf(HasSubstr("left out as you ask"),
                             HasSubstr("2 CELAS2 (line 11)"))));
  // Elements, too: the bar alone.
  const auto bar = assemble("a.bdf", kGrids + kBar + kPlate, {"CQUAD4"});
  EXPECT_EQ(difference(bar, assemble("b.bdf", kGrids + kBar)), 0.0);
}

TEST(DeckCards, AWrongMaterialIsToldOnce) {
  std::string bar = kBar;
  bar.replace(bar.find("7.+10"), 5, "-7.+1");
  const std::string error = find_error("a.bdf", kGrids + bar + kPlate);
  EXPECT_THAT(error, HasSubstr("MAT1 1: E, G, NU or RHO is out of range"));
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

TEST(DeckCards, AMissingPointOrPropertyIsToldOnceAtItsFirstUse) {
  const std::string more =
      "CBAR,5,8,1,77,0.,1.,0.\nCBAR,6,8,2,77,0.,1.,0.\n"
      "CBAR,7,8,2,3,0.,1.,1.\nCBAR,9,8,3,4,0.,1.,1.\n";
  const std::string error = find_error("a.bdf", kGrids + kBar + more);
  EXPECT_THAT(error, HasSubstr("a.bdf:9: CBAR 5 has node 77"));
  EXPECT_THAT(error, HasSubstr("a.bdf:11: its property 8 is missing"));
  EXPECT_EQ(std::ranges::count(error, '\n'), 1) << error;
  const std::string wrong = find_error(
      "b.bdf", "GRID,3,,x,0.,0.\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n" + kBar +
                   "CBAR,5,1,1,3,0.,1.,0.\n");
  EXPECT_THAT(wrong, HasSubstr("b.bdf:1: GRID has 'X' in field 4"));
  EXPECT_EQ(wrong.find('\n'), std::string::npos) << wrong;
}

TEST(DeckCards, TellsWhatHasNoDensityAndSupportsOfGrids) {
  std::string bar = kBar;
  bar.replace(bar.find(",2700."), 6, "");
  const auto body =
      assemble("a.bdf", "GRID,9,,5.,5.,5.,,123\n" + kGrids + bar + kMass);
  EXPECT_THAT(body.model.notices,
              Contains(HasSubstr("material 1 has no density (RHO)")));
  EXPECT_THAT(body.model.notices,
              Contains(HasSubstr("1 GRID with supports (PS) (line 1)")));
}

TEST(DeckCards, RigidElementsThatLeadThemselvesOrAllAreRefused) {
  const std::string deck = kGrids + kBar + kPlate;
  EXPECT_THAT(find_error("a.bdf", deck + "RBE2,9,1,123456,1,2\n"),
              HasSubstr("a.bdf:11: RBE2 9: its node GN leads itself"));
  EXPECT_THAT(find_error("a.bdf", deck + "RBAR,9,1,1,123456\n"),
              HasSubstr("a.bdf:11: RBAR 9: it has one node twice"));
  EXPECT_THAT(find_error("a.bdf", deck + "RBE2,9,1,123456,2,3,4\n"),
              HasSubstr("nothing can deform"));
}

/// In pounds: K of 1 lbf/m, masses of 1 lbf s^2/m.
TEST(DeckCards, ForcesHaveTheirUnit) {
  const auto newtons = assemble("a.bdf", kGrids + kBar + kMass + kPlate);
  Structure structure =
      read_structure(write_file("a.bdf", kGrids + kBar + kMass + kPlate));
  convert_forces(structure, 4.5);
  const auto pounds = assemble_structure(structure, {});
  EXPECT_LT(
      (pounds.model.stiffness.entries - 4.5 * newtons.model.stiffness.entries)
          .norm(),
      1e-14 * pounds.model.stiffness.entries.norm());
  EXPECT_LT(
      (pounds.model.mass.entries - 4.5 * newtons.model.mass.entries).norm(),
      1e-14 * pounds.model.mass.entries.norm());
  EXPECT_NEAR(pounds.mass, 4.5 * newtons.mass, 1e-12 * pounds.mass);
  const Laminate& plate = structure.laminates.at(0);
  EXPECT_NEAR(plate.points.at(0).membrane(2, 2), 4.5 * 7e10 / 2.6, 1.0);
  EXPECT_NEAR(plate.outer.E_2, 4.5 * 7e10, 1.0);
}

/// A plate and a beam on its edge, with a mass.
const std::string kInput =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n"
    "*ELEMENT, TYPE=B31, ELSET=B\n1, 1, 2\n*ELEMENT, TYPE=S4, ELSET=S\n"
    "2, 1, 2, 3, 4\n*ELEMENT, TYPE=MASS, ELSET=P\n3, 1\n*MATERIAL, NAME=M\n"
    "*ELASTIC\n7e10, .3\n*DENSITY\n2700.\n*BEAM SECTION, ELSET=B, MATERIAL=M, "
    "SECTION=RECT\n.1, .2\n0, 0, 1\n*SHELL SECTION, ELSET=S, MATERIAL=M\n.01\n"
    "*MASS, ELSET=P\n1.\n";  // to line 23

TEST(DeckCards, KeywordsThatWouldBeLostAreRefusedWithTheirLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"*NONSTRUCTURAL MASS, ELSET=S\n1.\n", "*NONSTRUCTURAL MASS would be"},
      {"*BEAM ADDED INERTIA\n1.\n", "*BEAM ADDED INERTIA would be"},
      {"*TRANSVERSE SHEAR STIFFNESS\n1.\n", "*TRANSVERSE SHEAR STIFFNESS"},
      {"*WHAT\n1\n", "*WHAT would be lost"},
      {"*ELEMENT, TYPE=T3D2\n9, 1, 3\n", "elements T3D2 would be lost"},
      {"*SHELL SECTION, ELSET=S, MATERIAL=M, COMPOSITE, SYMMETRIC\n.1,,M\n",
       "*SHELL SECTION has SYMMETRIC"},
      {"*BEAM SECTION, ELSET=B, DENSITY=1.\n", "*BEAM SECTION has DENSITY"},
      {"*SOLID SECTION, ELSET=S, MATERIAL=M\n",
       "element 2 is a S4. Expected a section of its own kind"},
      {"*MEMBRANE SECTION, ELSET=S, MATERIAL=M\n.1\n", "element 2 is a S4"},
      {"*MASS, ELSET=P\n2.\n", "element 3 of *MASS is a MASS that has a mass"},
      {"*MASS, ELSET=S\n2.\n", "element 2 of *MASS is a S4"},
      {"*MASS, ELSET=No\n2.\n", "its set of elements NO is missing"},
      {"*MASS, ELSET=P\n", "*MASS has no mass"},
      {"*MASS, ELSET=P, TYPE=ANISOTROPIC\n1., 2., 3.\n", "another TYPE"},
      {"*NSET\n1\n", "*NSET has no name"},
      {"*NSET, NSET=N\n1, 99\n", "node 99 is missing"},
      {"*INCLUDE\n", "*INCLUDE without a file"},
      {"*INCLUDE, INPUT=no.inp\n", "the file 'no.inp' is missing"}};
  for (const auto& [more, what] : cases)
    EXPECT_THAT(find_error("bad.inp", kInput + more),
                AllOf(HasSubstr("bad.inp:24: "), HasSubstr(what)))
        << more;
  EXPECT_EQ(find_error("good.inp", kInput + "*STEP\n*WHAT\n1\n*END STEP\n"),
            "none");
}

TEST(DeckCards, KeywordsAndElementsAreLeftOutOnRequest) {
  const auto all = assemble("a.inp", kInput);
  const auto body = assemble(
      "b.inp", kInput + "*TIE, NAME=T\nA, B\n*ELEMENT, TYPE=T3D2\n9, 1, 3\n",
      {"TIE", "t3d2"});
  EXPECT_EQ(difference(body, all), 0.0);
  EXPECT_THAT(body.model.notices,
              Contains(AllOf(HasSubstr("left out as you ask"),
                             HasSubstr("1 *TIE"), HasSubstr("T3D2"))));
  EXPECT_NEAR(assemble("c.inp", kInput, {"MASS"}).mass, all.mass - 1.0, 1e-12);
}

TEST(DeckCards, MaterialsOfInputFilesAreAdmissible) {
  std::string poisson = kInput;
  poisson.replace(poisson.find("7e10, .3"), 8, "7e10, .6");
  EXPECT_THAT(find_error("bad.inp", poisson),
              HasSubstr("bad.inp:12: its Poisson's ratio is 0.6"));
  std::string beam = kInput;
  beam.replace(beam.find("*ELASTIC\n7e10, .3"), 17,
               "*ELASTIC, TYPE=LAMINA\n7e10, 7e10, .3, 1e9, 1e9, 1e9");
  EXPECT_THAT(find_error("bad.inp", beam), HasSubstr("is not isotropic"));
}

}  // namespace
}  // namespace limber::fem::deck_cards_test
