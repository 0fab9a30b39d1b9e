// SPDX-License-Identifier: BSD-3-Clause
// Parts and instances of input files of Abaqus, made flat.
#include "limber/fem/text/flat_deck.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::flat_deck_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::write_file;

struct Read {
  std::vector<std::string> lines;  // "number: text"; keywords by their names
  std::vector<std::string> notices;
  std::vector<Pose> poses;
};

Read read(const std::string& text) {
  Read result;
  result.notices = read_flat_deck(
      write_file("deck.inp", text),
      {[&](const DeckPlace& at, const Keyword& keyword, const Pose& pose) {
         std::string line = fmt::format("{}: *{}", at.number(), keyword.name);
         for (const char* key :
              {"NSET", "ELSET", "NAME", "SURFACE", "REF NODE", "ORIENTATION"})
           if (keyword.has(key))
             line += fmt::format(" {}={}|{}", key, keyword.get(key),
                                 keyword.spelled.at(key));
         result.lines.push_back(line);
         result.poses.push_back(pose);
         return false;
       },
       [&](const DeckPlace& at, std::string_view line) {
         result.lines.push_back(fmt::format("{}: {}", at.number(), line));
       }});
  return result;
}

std::string find_error(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

const std::string kPart =
    "*PART, NAME=Rod\n"                            // 1
    "*NODE, NSET=All\n1, 0, 0, 0\n20, 1, 0, 0\n"   // 2
    "*ELEMENT, TYPE=B31, ELSET=Bars\n5, 1,\n20\n"  // 5
    "*NSET, NSET=Ends, GENERATE\n1, 20, 19\n"      // 8
    "*SURFACE, NAME=Skin\nBars, S1\n"              // 10
    "*END PART\n";                                 // 12

TEST(FlatDeck, WithoutPartsStaysAsItIs) {
  const Read flat =
      read("*NODE, NSET=a.b\n1, 0, 0, 0\n*NSET, NSET=c, INSTANCE=d\na.b, 7\n");
  EXPECT_THAT(flat.lines, ElementsAre("1: *NODE NSET=A.B|a.b", "2: 1, 0, 0, 0",
                                      "3: *NSET NSET=C|c", "4: a.b, 7"));
  EXPECT_THAT(flat.notices, IsEmpty());
}

TEST(FlatDeck, OneInstanceKeepsItsNumbersAndNames) {
  const Read flat =
      read(kPart +
           "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Rod-1, PART=Rod\n*END INSTANCE\n"
           "*NSET, NSET=Mine\nrod-1.Ends, Rod-1.1, 20\n*END ASSEMBLY\n");
  EXPECT_THAT(
      flat.lines,
      ElementsAre("13: *ASSEMBLY NAME=A|A", "2: *NODE NSET=ALL|All",
                  "3: 1,0,0,0", "4: 20,1,0,0", "5: *ELEMENT ELSET=BARS|Bars",
                  "6: 5,1,", "7: 20", "8: *NSET NSET=ENDS|Ends", "9: 1,20,19",
                  "10: *SURFACE NAME=SKIN|Skin", "11: Bars,S1",
                  "16: *NSET NSET=MINE|Mine", "17: Ends,1,20",
                  "18: *END ASSEMBLY"));
  EXPECT_THAT(flat.notices, IsEmpty());
}

TEST(FlatDeck, ASecondInstanceHasNumbersAndNamesOfItsOwnAndIsMoved) {
  const Read flat =
      read(kPart +
           "*INSTANCE, NAME=A, PART=Rod\n*END INSTANCE\n"      // 13
           "*INSTANCE, NAME=B, PART=Rod\n0, 2, 0\n"            // 15
           "0, 0, 0, 0, 0, 1, 180\n*END INSTANCE\n"            // 17
           "*NODE, NSET=Hub\n7, 0, 0, 3\n"                     // 19
           "*NSET, NSET=Root, INSTANCE=B\n1\n"                 // 21
           "*RIGID BODY, NSET=B.Ends, REF NODE=7\n"            // 23
           "*COUPLING, SURFACE=a.Skin, REF NODE=A.20\n"        // 24
           "*MPC\nBEAM, B.20, A.20\n*BOUNDARY\nA.1, 1, 6\n");  // 25
  for (const char* line :
       {"3: 1,0,0,0", "2: *NODE NSET=A.ALL|A.All",
        "5: *ELEMENT ELSET=B.BARS|B.Bars", "6: 105,101,", "7: 120",
        "9: 101,120,19", "11: B.Bars,S1", "11: A.Bars,S1",
        "10: *SURFACE NAME=B.SKIN|B.Skin", "19: *NODE NSET=HUB|Hub",
        "20: 207,0,0,3", "22: 101",
        "23: *RIGID BODY NSET=B.ENDS|B.Ends REF NODE=207|207",
        "24: *COUPLING SURFACE=A.SKIN|A.Skin REF NODE=20|20", "26: BEAM,120,20",
        "28: 1,1,6"})
    EXPECT_THAT(flat.lines, Contains(line));
  // (1, 0, 0) + (0, 2, 0), turned about z by half a turn.
  EXPECT_THAT(flat.lines, Contains(HasSubstr("4: 120,-1")));
  EXPECT_LT((flat.poses.at(5) * Vector3(1, 0, 0) - Vector3(-1, -2, 0)).norm(),
            1e-15);
  EXPECT_THAT(flat.notices,
              ElementsAre(HasSubstr("100 is added to the numbers of nodes and "
                                    "elements of instance B"),
                          HasSubstr("200 is added to the numbers of nodes and "
                                    "elements of the assembly")));
}

/// Abaqus/CAE numbers reference points of the assembly from 1.
TEST(FlatDeck, NodesOfAnAssemblyDoNotHideThoseOfItsInstance) {
  const Read flat =
      read(kPart +
           "*INSTANCE, NAME=A, PART=Rod\n*END INSTANCE\n*NODE\n1, 9, 9, 9\n"
           "*NSET, NSET=Ref\n1\n*NSET, NSET=Far, INSTANCE=A\n1\n"
           "*NSET, NSET=Other\n20\n");
  for (const char* line :
       {"3: 1,0,0,0", "16: 101,9,9,9", "18: 101", "20: 1", "22: 20"})
    EXPECT_THAT(flat.lines, Contains(line));
}

TEST(FlatDeck, RefusesWhatIsNoAssembly) {
  const std::string place = "deck.inp:14: ";
  EXPECT_THAT(find_error(kPart + "*INSTANCE, NAME=A, PART=Rod\n1, x\n"),
              HasSubstr(place + "'x' is no finite number"));
  EXPECT_THAT(find_error(kPart + "*INSTANCE, NAME=A, PART=Rod\n" +
                         "*INSTANCE, NAME=B, PART=Rod\n"),
              HasSubstr(place + "*INSTANCE within another"));
  EXPECT_THAT(
      find_error(kPart + "*INSTANCE, NAME=A, PART=Rod\n*END INSTANCE\n" +
                 "*INSTANCE, NAME=a, PART=Rod\n*END INSTANCE\n"),
      HasSubstr("deck.inp:15: *INSTANCE has no name of its own"));
  EXPECT_THAT(find_error(kPart + "*INSTANCE, PART=Rod\n*END INSTANCE\n"),
              HasSubstr("deck.inp:13: *INSTANCE has no name of its own"));
  EXPECT_THAT(find_error(kPart + "*INSTANCE, NAME=A, PART=Rod\n0, 0, 0\n"
                                 "1, 1, 1, 1, 1, 1, 90\n*END INSTANCE\n"),
              HasSubstr("deck.inp:16: *INSTANCE turns about an axis"));
  EXPECT_THAT(find_error("*PART, NAME=P\n*NODE\n999999999, 0, 0, 0\n*END PART\n"
                         "*INSTANCE, NAME=A, PART=P\n*END INSTANCE\n"
                         "*INSTANCE, NAME=B, PART=P\n*END INSTANCE\n"),
              HasSubstr("deck.inp:5: 2 instances with numbers up to"));
}

}  // namespace
}  // namespace limber::fem::flat_deck_test
