// SPDX-License-Identifier: BSD-3-Clause
// Format: Abaqus Keywords Reference Guide; CalculiX CrunchiX User's Manual.
#include "limber/fem/abaqus/deck_attachments.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/fem/abaqus/solid_deck_reader.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::deck_attachments_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

const std::string kSolid =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n9,2,2,2\n"
    "*ELEMENT, TYPE=C3D4, ELSET=E\n1,1,2,3,4\n*NSET, NSET=Base\n1,2\n";

SolidDeck read(const std::string& text) {
  return read_solid_deck(testing::write_file("deck.inp", text));
}

TEST(DeckAttachments, MassOfASetIsAtEachOfItsElements) {
  const SolidDeck deck =
      read(kSolid +
           "*ELEMENT, TYPE=MASS, ELSET=M\n11, 2\n12, 4\n*MASS, ELSET=M\n0.5\n"
           "*ELEMENT, TYPE=MASS, ELSET=N\n13, 4\n*MASS, ELSET=N\n2.\n");
  EXPECT_THAT(deck.masses, ElementsAre(Pair(2, 0.5), Pair(4, 2.5)));
}

std::string find_error_of(const std::string& more) {
  try {
    static_cast<void>(read(kSolid + more));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(DeckAttachments, MassesWithoutTheirElementsAreRefused) {
  EXPECT_THAT(find_error_of("*MASS, ELSET=E\n1.\n"),
              HasSubstr("deck.inp:12: *MASS has element 1, which is no MASS"));
  EXPECT_THAT(
      find_error_of("*MASS, ELSET=None\n1.\n"),
      HasSubstr("deck.inp:12: *MASS has the set NONE, which is missing"));
}

TEST(DeckAttachments, MassesAreOneForEachElementAndAlikeAlongAllAxes) {
  const std::string point = "*ELEMENT, TYPE=MASS, ELSET=M\n11, 2\n";
  EXPECT_THAT(find_error_of(point + "*MASS, ELSET=M\n1.\n1.\n"),
              HasSubstr("deck.inp:15: element 11 has a *MASS already"));
  EXPECT_THAT(
      find_error_of(point + "*MASS, ELSET=M, TYPE=ANISOTROPIC\n1., 2., 3.\n"),
      HasSubstr("deck.inp:14: *MASS has another TYPE"));
}

TEST(DeckAttachments, SetsHaveNamesAndMembersThatAreThere) {
  EXPECT_THAT(find_error_of("*NSET, NSET=X\n1, 99\n"),
              HasSubstr("deck.inp:11: the set X has node 99"));
  EXPECT_THAT(find_error_of("*ELSET, ELSET=Y\n1, 98\n"),
              HasSubstr("deck.inp:11: the set Y has element 98"));
  for (const char* text :
       {"*NSET\n1\n", "*ELSET\n1\n", "*SURFACE\nE, S1\n", "*MATERIAL\n"})
    EXPECT_THAT(find_error_of(text), HasSubstr("deck.inp:11: *")) << text;
}

TEST(DeckAttachments, KeywordsThatAreNotKnownAreRefusedOutsideOfSteps) {
  EXPECT_THAT(find_error_of("*WHAT\n1.\n"),
              HasSubstr("deck.inp:11: *WHAT would be lost"));
  EXPECT_THAT(find_error_of("*NONSTRUCTURAL MASS, ELSET=E\n1.\n"),
              HasSubstr("deck.inp:11: *NONSTRUCTURAL MASS would be lost"));
  EXPECT_EQ(find_error_of("*STEP\n*WHAT\n*END STEP\n"), "none");
  const auto file = testing::write_file("deck.inp", kSolid + "*WHAT\n1.\n");
  EXPECT_THAT(read_solid_deck(file, {"what"}).notices,
              ::testing::Contains(HasSubstr("as you ask")));
}

TEST(DeckAttachments, NodesHeldInAllDirectionsAreTheSetBoundary) {
  const SolidDeck deck =
      read(kSolid +
           "*BOUNDARY\nbase, 1, 2\n2, 3\n3, ENCASTRE\n4, 2, 6\n9, 1, "
           "3\n");
  ASSERT_EQ(deck.groups.size(), 2U);
  EXPECT_EQ(deck.groups[1].name, "boundary");
  EXPECT_THAT(deck.groups[1].elements.begin()->second.nodes, ElementsAre(2, 3));
}

TEST(DeckAttachments, OfAPartBelongToItsInstance) {
  const SolidDeck deck = read(
      "*PART, NAME=P\n" + kSolid +
      "*ELEMENT, TYPE=MASS, ELSET=M\n11, 2\n*MASS, ELSET=M\n0.5\n*END PART\n"
      "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n"
      "*END ASSEMBLY\n*BOUNDARY\nI.Base, PINNED\n");
  EXPECT_THAT(deck.masses, ElementsAre(Pair(2, 0.5)));
  EXPECT_THAT(deck.groups.back().elements.begin()->second.nodes,
              ElementsAre(1, 2));
}

TEST(DeckAttachments, WhatIsNoMassOfASolidIsAnError) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"*ELEMENT, TYPE=MASS, ELSET=M\n11, 9\n*MASS, ELSET=M\n0.5\n",
       "deck.inp:12: the mass 11 is not at one node of a solid"},
      {"*ELEMENT, TYPE=MASS, ELSET=M\n11, 2\n*MASS, ELSET=M\n-1\n",
       "deck.inp:14: *MASS is '-1'"},
      {"*ELEMENT, TYPE=MASS, ELSET=M\n11, 2\n", "deck.inp:12: elements MASS"},
      {"*BOUNDARY\nBase, 1, x\n", "deck.inp:12: *BOUNDARY has the last"}};
  for (const auto& [text, what] : cases) {
    SCOPED_TRACE(text);
    try {
      static_cast<void>(read(kSolid + text));
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(what));
    }
  }
}

}  // namespace
}  // namespace limber::fem::deck_attachments_test
