// SPDX-License-Identifier: BSD-3-Clause
// Format: MSC Nastran Quick Reference Guide, "Bulk Data Entries".
#include "limber/fem/nastran/bulk_data.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::bulk_data_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::write_file;

std::string deck(const std::string& cards) {
  return "SOL 103\nCEND\nBEGIN BULK\n" + cards + "ENDDATA\n";
}

SolidDeck read_cards(const std::string& cards) {
  return read_bulk_data(write_file("deck.bdf", deck(cards)));
}

std::string find_error(const std::string& text) {
  try {
    static_cast<void>(read_bulk_data(write_file("deck.bdf", text)));
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted:\n" << text;
  return {};
}

/// Corners 0, x, y, z of a tetrahedron, from line 4 of the deck on.
const std::string kGrids =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
const std::string kMiddles =
    "GRID,5,,.5,0.,0.\nGRID,6,,.5,.5,0.\nGRID,7,,0.,.5,0.\n"
    "GRID,8,,0.,0.,.5\nGRID,9,,.5,0.,.5\nGRID,10,,0.,.5,.5\n";
const std::string kTetra = kGrids + "CTETRA,1,1,1,2,3,4\n";

/// Ten nodes in each form of a card; Gmsh swaps Nastran's last two.
class ElementForm : public ::testing::TestWithParam<const char*> {};

TEST_P(ElementForm, IsReadWithAllItsNodes) {
  const SolidDeck data = read_cards(kGrids + kMiddles + GetParam());
  ASSERT_EQ(data.solids.size(), 1U);
  EXPECT_EQ(data.solids.at(11).type, 11);
  EXPECT_THAT(data.solids.at(11).elements, ElementsAre(77));
  EXPECT_THAT(data.region_groups, ElementsAre(ElementsAre("3")));
  EXPECT_THAT(data.solids.at(11).nodes,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 10, 9));
  EXPECT_THAT(data.notices, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Forms, ElementForm,
    ::testing::Values(
        "CTETRA,77,3,1,2,3,4,5,6\n,7,8,9,10\n",
        "CTETRA,77,3,1,2,3,4,5,6,+A\n+A,7,8,9,10\n",
        "ctetra, 77, 3, 1, 2, 3, 4, 5, 6, +\n+, 7, 8, 9, 10\n",
        "CTETRA,77,3,1,2,3,4,5,6\r\n$ a comment\r\n\r\n,7,8,9,10 $ here\r\n",
        "CTETRA  77      3       1       2       3       4       5       6\n"
        "        7       8       9       10\n",
        "CTETRA        77       3       1       2       3       4       5"
        "       6+E77\n+E77           7       8       9      10\n",
        "CTETRA\t77\t3\t1\t2\t3\t4\t5\t6\n\t7\t8\t9\t10\n",
        "CTETRA* 77              3               1               2\n"
        "*       3               4               5               6\n"
        "*       7               8               9               10\n",
        "CTETRA* 77              3               1               2\n"
        "*       3               4               5               6\n"
        "        7       8       9       10\n",
        "CTETRA*,77,3,1,2\n*,3,4,5,6\n*,7,8,9,10\n",
        "Ctetra  77      3       1       2       3       4       5       6"
        "       ABC\n+BC     7       8       9       10\n"));

TEST(BulkData, NumbersHaveNastransForms) {
  const SolidDeck data = read_cards(
      "GRID,1,,7.+1,-1.5-3,1.D2\nGRID           2        2.5E+1     .25  -4.e-1"
      "\nGRID*                  3                              0."
      "   1.23456789012\n*                -1.5D-1\nGRID,4,,+1.,0,\n"
      "CTETRA,1,,1,2,3,4\n");
  EXPECT_EQ(data.x.col(0), Vector3(70.0, -0.0015, 100.0));
  EXPECT_EQ(data.x.col(1), Vector3(25.0, 0.25, -0.4));
  EXPECT_EQ(data.x.col(2), Vector3(0.0, 1.23456789012, -0.15));
  EXPECT_EQ(data.x.col(3), Vector3(1.0, 0.0, 0.0));
  EXPECT_THAT(data.region_groups, ElementsAre(ElementsAre("1")));  // its EID
}

TEST(BulkData, CoordinateSystemsLeadToTheBasicOne) {
  // 7: cylindrical about y through (1, 0, 0), angles from z on. 8: rectangular,
  // given in 7's coordinates. 9: spherical by the grids 1, 2, 3: basic axes.
  const SolidDeck data = read_cards(
      "GRDSET,,7\n"
      "CORD2C,7,0,1.,0.,0.,1.,1.,0.\n,1.,0.,1.\n"
      "CORD2R,8,7,2.,90.,0.,2.,90.,1.\n,3.,90.,0.\n"
      "CORD1S,9,1,2,3\n"
      "GRID,1,0,0.,0.,0.\nGRID,2,0,0.,0.,3.\nGRID,3,0,2.,0.,0.\n"
      "GRID,4,,2.,90.,5.\nGRID,5,8,.5,.25,.125\nGRID,6,9,2.,90.,90.\n"
      "GRID,7,9,2.,60.,0.\nGRID,8,7,2.,0.,5.\n"
      "CHEXA,1,1,1,2,3,4,5,6\n,7,8\n");
  const auto expect_at = [&](Eigen::Index grid, const Vector3& x) {
    EXPECT_LT((data.x.col(grid - 1) - x).norm(), 1e-14) << "grid " << grid;
  };
  expect_at(4, {3.0, 5.0, 0.0});      // e_r at 90 degrees is y x z = x
  expect_at(8, {1.0, 5.0, 2.0});      // at 0 it is z
  expect_at(5, {3.5, 0.125, -0.25});  // origin (3, 0, 0), z = y, x = x
  expect_at(6, {0.0, 2.0, 0.0});      // y
  expect_at(7, {std::sqrt(3.0), 0.0, 1.0});
}

TEST(BulkData, IncludedFilesStandInTheirPlace) {
  const auto folder = testing::make_test_folder();
  std::filesystem::create_directories(folder / "part");
  write_file("part/grids.inc", "include 'more.inc'\nGRID,1,,0.,0.,0.\n");
  write_file("part/more.inc",
             "GRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n");
  const SolidDeck data =
      read_cards("Include \"part/grids.inc\"\nCTETRA,1,1,1,2,3,4\n");
  EXPECT_THAT(data.nodes, ElementsAre(1, 2, 3, 4));
  write_file("part/more.inc", "include 'grids.inc'\n");
  EXPECT_THAT(find_error(deck("INCLUDE part/grids.inc\n")),
              AllOf(HasSubstr("nested"), HasSubstr(".inc:1:")));
  EXPECT_THAT(find_error(deck("INCLUDE 'absent.inc'\n")),
              AllOf(HasSubstr("deck.bdf:4: "), HasSubstr("'absent.inc'")));
  EXPECT_THAT(find_error(deck("INCLUDE 'part/\ngrids.inc'\n")),
              AllOf(HasSubstr("deck.bdf:4: "), HasSubstr("on one line")));
}

/// Line 9 of a deck that is right without it, and what is said of it.
struct BadCard {
  const char* text;
  const char* message;
};
class BadCardOf : public ::testing::TestWithParam<BadCard> {};

TEST_P(BadCardOf, IsRefusedByItsLine) {
  const auto& [text, message] = GetParam();
  EXPECT_THAT(find_error(deck(kTetra + text + "\nPSOLID,1,1\n")),
              AllOf(HasSubstr("deck.bdf:9: "), HasSubstr(message)));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BadCardOf,
    ::testing::Values(
        BadCard{"CQUAD4,9,3,1,2,3,4", "CQUAD4 is not a solid"},
        BadCard{"ctria3,9,3,1,2,3", "CTRIA3 is not a solid"},
        BadCard{"CBAR,9,4,1,3,0.,0.,1.", "CBAR is not a solid"},
        BadCard{"RBAR,9,1,3,123456", "RBAR is not a solid"},
        BadCard{"CONM1,9,1,,5.", "CONM1 is not a solid"},
        BadCard{"CELAS2,9,1.+3,1,1,2,1", "CELAS2 is not a solid"},
        BadCard{"CHEXA27,9,1,1", "is not a solid"},
        BadCard{"NSM1,9,PSOLID,1.,1", "NSM1 is not a solid"},
        BadCard{"WHAT,9,1", "WHAT is not known"},
        BadCard{"CONM2,1,2,,1.", "element 1 is there twice"},
        BadCard{"RBE2,1,5,123,2,3", "element 1 is there twice"},
        BadCard{"MPC,9,1,1,1.,2,1,-1.", "MPC constrains nodes"},
        BadCard{"CORD3G,9,1,1,1,1", "CORD3G is not"},
        BadCard{"CTETRA,9,1,1,2,3,4,5,6", "has node 5, which is missing"},
        BadCard{"CTETRA,9,1,1,2,3,4,5,\n,7,8,9,10",
                "has node 5, which is missing"},
        BadCard{"CTETRA,9,1,1,2,3", "has 3 nodes"},
        BadCard{"CTETRA,9,1,1,,3,4", "G2 is blank"},
        BadCard{"CTETRA,9,1,1,2,3,3", "a node twice"},
        BadCard{"CTETRA,9,1,1,2,3,99", "node 99, which is missing"},
        BadCard{"CTETRA,1,1,1,2,3,4", "element 1 is there twice"},
        BadCard{"CTETRA,9,1,1,2,3,4,,,,,1", "more than 8"},
        BadCard{"CTETRA,9,1,1,2,3,x", "'X' in field 7"},
        BadCard{"CTETRA,9,1.5,1,2,3,4", "'1.5' in field 3"},
        BadCard{"GRID,4,,0.,0.,0.", "GRID 4 is there twice"},
        BadCard{"GRID,9,,1,5x,0.", "'5X' in field 5"},
        BadCard{"GRID,9,8,1.,0.,0.", "coordinate system 8 is missing"},
        BadCard{"GRID 9 0 1.0 0.0 0.0", "not the name of a card"},
        BadCard{"GRID           9        0,00000 1,00000", "name of a card"},
        BadCard{"=,*(1),=,=", "not the name of a card"},
        BadCard{"GRDSET,,5x", "'5X'"},
        BadCard{"CORD2R,7,0,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\nGRID,9,7", "line"},
        BadCard{"CORD2R,7,7,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRID,9,7",
                "depends on itself"},
        BadCard{"CORD1R,7,1,2,88\nGRID,9,7", "GRID 88 is missing"},
        BadCard{"PSOLID,9,1,,,,,PFLUID", "a fluid"}));

TEST(BulkData, SolidsAndUnknownCardsAreLeftOutOnRequest) {
  const SolidDeck data = read_bulk_data(
      write_file("deck.bdf", deck(kTetra + "WHAT,1\nGRID,5,,1.,"
                                           "1.,1.\nCTETRA,2,2,"
                                           "5,2,3,4\nCPENTA,3\n")),
      {"what", "CPENTA"});
  EXPECT_EQ(data.solids.begin()->second.elements.size(), 2U);
  EXPECT_THAT(data.notices,
              Contains(AllOf(HasSubstr("as you ask"), HasSubstr("1 WHAT"),
                             HasSubstr("1 CPENTA"))));
}

TEST(BulkData, ContinuationsMustFollowTheirCard) {
  EXPECT_THAT(find_error(deck("+A,7,8,9,10\n" + kTetra)),
              HasSubstr("deck.bdf:4: continuation '+A' does not follow"));
  EXPECT_THAT(find_error(deck(kGrids + "CTETRA,1,1,1,2,3,4,,,+A\n")),
              AllOf(HasSubstr("deck.bdf:8: "), HasSubstr("is missing")));
  EXPECT_THAT(find_error(deck(kGrids + kMiddles +
                              "CTETRA,1,1,1,2,3,4,5,6,+A\n"
                              "+B,7,8,9,10\n")),
              HasSubstr("deck.bdf:15: continuation '+B' does not follow"));
}

TEST(BulkData, ProblemsComeTogether) {
  const std::string error = find_error(
      deck(kTetra + "CBAR,9,4,1,3\nCBAR,10,4,1,3\nGRID,4\nPSOLID,1,1\n"));
  EXPECT_THAT(error, HasSubstr("CBAR (2 cards, the first here)"));
  EXPECT_THAT(error, HasSubstr("deck.bdf:11: "));
}

TEST(BulkData, ATruncatedDeckIsRefused) {
  const std::string whole = deck(kTetra);
  for (std::size_t size = whole.find("BULK") + 5; size + 2 < whole.size();
       size += 7)
    EXPECT_THAT(find_error(whole.substr(0, size)), HasSubstr("truncated"));
}

TEST(BulkData, WithoutBeginBulkAllIsBulkData) {
  const auto file = write_file("punch.bdf", kTetra);
  const SolidDeck data = read_bulk_data(file);
  EXPECT_EQ(data.nodes.size(), 4U);
  EXPECT_THAT(data.notices, ElementsAre(HasSubstr("no ENDDATA")));
}

TEST(BulkData, OtherTextAndBinariesAreRefused) {
  EXPECT_THAT(find_error("$ GRID\n*NODE\n1, 0., 0., 0.\n"),
              HasSubstr("deck.bdf:2: "));
  EXPECT_THAT(find_error(std::string("GRID\0\x01\x02", 7)),
              HasSubstr("not text"));
  EXPECT_THAT(find_error("GRID \x01\x1b[2J \xff\xfe\n"),
              AllOf(HasSubstr("\\x1b"), ::testing::Not(HasSubstr("\xff"))));
  EXPECT_THAT(find_error("BEGIN SUPER=1\n" + kTetra + "ENDDATA\n"),
              HasSubstr("superelement"));
}

TEST(BulkData, CardsAndGridsWithoutEffectAreReported) {
  const SolidDeck data = read_cards(
      kTetra +
      "GRID,21,,9.,9.,9.\nGRID,22,,9.,9.,9.,,123\nSPC1,1,123,1\nSPC1,1,123,2\n"
      "FORCE,1,4,0,1.,0.,0.,1.\nMAT1,1,7.+10,,.3,2700.\nPARAM,POST,-1\n"
      "PSOLID,1,1\nEIGRL,1,,,10\n");
  ASSERT_EQ(data.notices.size(), 2U);
  EXPECT_THAT(data.notices[0],
              AllOf(HasSubstr("2 of 6 GRIDs"), HasSubstr("21, 22")));
  EXPECT_THAT(data.notices[1],
              AllOf(HasSubstr("2 SPC1 (line 11)"), HasSubstr("1 FORCE"),
                    HasSubstr("1 GRID with supports"),
                    ::testing::Not(HasSubstr("MAT1"))));
}

/// Mesh generators write faces and edges of the solid as shells and bars, for
/// want of names. With properties they are parts of the structure.
TEST(BulkData, ShellsAreMarksOfTheSurfaceInADeckWithoutAnyProperties) {
  const std::string marks = "CTRIA3,9,2,1,2,3\nCBAR,10,2,1,2\n";
  const SolidDeck data = read_cards(kTetra + marks);
  EXPECT_EQ(data.solids.size(), 1U);
  EXPECT_THAT(data.notices, ElementsAre(AllOf(HasSubstr("1 CBAR (line 10)"),
                                              HasSubstr("1 CTRIA3"),
                                              HasSubstr("no properties"))));
  EXPECT_THAT(find_error(deck(kTetra + marks + "PSOLID,1,1\n")),
              AllOf(HasSubstr("CTRIA3 is not"), HasSubstr("CBAR is not")));
  EXPECT_THAT(find_error(deck(kTetra + marks + "CONM1,9,1,,5.\n")),
              HasSubstr("CONM1 is not"));
}

TEST(BulkData, HasTheMaterialsOfItsProperties) {
  const SolidDeck data = read_cards(
      kTetra +
      "GRID,5,,1.,1.,1.\nCTETRA,2,7,2,3,4,5\nPSOLID,1,1\nPSOLID,7,2,3\n"
      "MAT1,1,2.1+11,,.3,7850.\n"
      "MAT9,2,4.,1.,1.,,,,3.,\n,1.,,,,3.,,,,\n,1.,,,1.5,,2.,10.\n"
      "CORD2C,3,,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\nPARAM,WTMASS,.5\n");
  ASSERT_EQ(data.materials.size(), 2U);
  EXPECT_EQ(data.materials[0].name, "MAT1 1");
  EXPECT_EQ(data.materials[0].material.youngs_modulus, 2.1e11);
  EXPECT_EQ(data.materials[0].material.poisson_ratio, 0.3);
  EXPECT_EQ(data.materials[0].material.density, 3925.0);
  const SolidMaterial& other = data.materials[1].material;
  EXPECT_EQ(data.materials[1].problem, "");
  ASSERT_TRUE(other.anisotropy);
  EXPECT_EQ(other.anisotropy->C.diagonal(),
            (Vector6{{4.0, 3.0, 3.0, 1.0, 1.5, 2.0}}));
  EXPECT_EQ(other.density, 5.0);
  EXPECT_TRUE(other.anisotropy->axes.is_cylindrical);
  EXPECT_EQ(other.anisotropy->axes.point, Vector3::UnitX());
}

TEST(BulkData, FindsTheThirdOfEGAndNu) {
  const auto find = [](const std::string& card) {
    return read_cards(kTetra + "PSOLID,1,1\n" + card).materials.at(0);
  };
  EXPECT_NEAR(find("MAT1,1,,80.,.25,1.\n").material.youngs_modulus, 200.0,
              1e-12);
  EXPECT_NEAR(find("MAT1,1,200.,80.,,1.\n").material.poisson_ratio, 0.25,
              1e-15);
  EXPECT_THAT(find("MAT1,1,200.,,,1.\n").problem,
              HasSubstr("two of E, G and NU"));
  EXPECT_THAT(find("MAT1,1,200.,,.3\n").problem, HasSubstr("no density RHO"));
  EXPECT_THAT(find("MATT1,1,2\nMAT1,1,200.,,.3,1.\n").problem,
              HasSubstr("temperature"));
  EXPECT_THAT(find("MAT9,1,-1.\n").problem, HasSubstr("C11 is -1 Pa"));
  EXPECT_THAT(
      find("MAT10,1,1.\n").problem,
      AllOf(HasSubstr("no MAT1, MAT9 or MAT11"), HasSubstr("deck.bdf")));
  EXPECT_EQ(read_cards(kTetra).materials.at(0).name, "");
}

TEST(BulkData, WrongMaterialCardsAreErrorsWithTheirLine) {
  const std::string start = kTetra + "PSOLID,1,1\n";
  EXPECT_THAT(find_error(deck(start + "MAT1,1,x,,.3,1.\n")),
              HasSubstr("deck.bdf:"));
  EXPECT_THAT(find_error(deck(start + "MAT1,1,1.,,.3\nMAT9,1,1.\n")),
              HasSubstr("material 1 is there twice"));
  EXPECT_THAT(find_error(deck(start + "PSOLID,1,2\n")),
              HasSubstr("PSOLID 1 is there twice"));
}

TEST(BulkData, LeavesOutTheCardsThatItIsAskedTo) {
  const std::string text = deck(kTetra + "PSOLID,1,1\nCONM1,9,1,,5.\n");
  EXPECT_THAT(find_error(text), HasSubstr("ignore CONM1 to go on without"));
  EXPECT_THAT(
      read_bulk_data(write_file("deck.bdf", text), {"conm1"}).notices,
      ElementsAre(HasSubstr("left out as you ask, so that the body lacks them: "
                            "1 CONM1")));
}

}  // namespace
}  // namespace limber::fem::bulk_data_test
