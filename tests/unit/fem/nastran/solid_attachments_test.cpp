// SPDX-License-Identifier: BSD-3-Clause
// Format: MSC Nastran Quick Reference Guide, "Bulk Data Entries".
#include "limber/fem/nastran/solid_attachments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/fem/nastran/bulk_data.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::solid_attachments_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

/// A tetrahedron of four GRIDs, and a fifth off it; `cards` begin on line 9.
std::filesystem::path write_deck(const std::string& cards) {
  return testing::write_file(
      "deck.bdf",
      "SOL 103\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"
      "GRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nGRID,9,,.5,.5,.5\n" +
          cards + "CTETRA,1,1,1,2,3,4\nENDDATA\n");
}

SolidDeck read_cards(const std::string& cards) {
  return read_bulk_data(write_deck(cards));
}

Tags nodes_of(const SolidDeck& deck, const std::string& name) {
  for (const DeckGroup& group : deck.groups)
    if (group.name == name) return group.elements.begin()->second.nodes;
  ADD_FAILURE() << "no group " << name;
  return {};
}

TEST(SolidAttachments, MassesOfANodeAddUp) {
  const SolidDeck deck = read_cards(
      "PARAM,WTMASS,.5\nCONM2,11,2,,3.\nCONM2,12,2,,1.\n"
      "CONM2*,13,4,0,7.\n*,0.,0.,0.\n");
  EXPECT_THAT(deck.masses, ElementsAre(Pair(2, 2.0), Pair(4, 3.5)));
}

TEST(SolidAttachments, SpidersAndSupportsAreSetsOfNodes) {
  const SolidDeck deck = read_cards(
      "RBE2,21,9,123456,1,THRU,3\nRBE3,22,,9,123456,1.,123,2,4\n"
      "SPC1,5,123456,4\nSPC,5,1,123,0.\nSPC1,6,12,3\nSPC1,7,123,2,9\n");
  EXPECT_THAT(nodes_of(deck, "rbe2:21"), ElementsAre(1, 2, 3));
  EXPECT_THAT(nodes_of(deck, "rbe3:22"), ElementsAre(2, 4));
  EXPECT_THAT(nodes_of(deck, "spc:5"), ElementsAre(1, 4));
  EXPECT_THAT(nodes_of(deck, "spc:7"), ElementsAre(2));
  EXPECT_EQ(deck.groups.size(), 4U);  // 3 is held in part only
  const std::string all = fmt::format("{}", fmt::join(deck.notices, "\n"));
  EXPECT_THAT(all, HasSubstr("RBE2 21 is the set rbe2:21 of 3 nodes. An "
                             "interface of it moves with their mean and does "
                             "not stiffen them."));
  EXPECT_THAT(all, HasSubstr("are the sets spc:SID"));
}

TEST(SolidAttachments, WhatANodeOfASolidCannotCarryIsAnError) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"CONM2,11,9,,3.\n", "it is at GRID 9, which belongs to no solid"},
      {"RBE3,22,,9,123456,1.,123,2,4\nCONM2,11,9,,3.\n",
       "it is at GRID 9, which is the hub of rbe3:22"},
      {"CONM2,11,2,,3.,0.,.1\n", "it has an offset or moments of inertia"},
      {"CONM2,11,2,,3.,,,,\n,1.\n", "it has an offset or moments of inertia"},
      {"CONM2,11,2,-1,3.\n", "it has an offset or moments of inertia"},
      {"CONM2,11,2,,-3.\n", "its mass is -3. Expected >= 0."},
      {"RBE2,21,1,123456,2,3\n", "its hub, GRID 1, is a node of a solid"},
      {"RBE2,21,9,12,2,3\n", "CM is '12'"},
      {"RBE2,21,9,123,2,8\n", "has GRID 8, which belongs to no solid"},
      {"RBE2,21,9,123\n", "has no nodes"},
      {"RBE3,22,,9,123456,1.,123,2,\n,2.,123,3\n", "different weights"},
      {"RBE3,22,,9,123456,1.,123,2,x\n", "has 'X' among its nodes"},
      {"SPC1,22,123,2,-4\n", "has '-4' among its nodes"},
      {"RBE3,22,,9,123456,1.,1,2\n", "a component list (C) is '1'"}};
  for (const auto& [cards, what] : cases) {
    SCOPED_TRACE(cards);
    try {
      static_cast<void>(read_cards(cards));
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("deck.bdf:"), HasSubstr(what)));
    }
  }
}

TEST(SolidAttachments, AreLeftOutByName) {
  const SolidDeck deck = read_bulk_data(
      write_deck("CONM2,11,9,,3.\nRBE2,21,1,123456,2,3\n"), {"conm2", "RBE2"});
  EXPECT_TRUE(deck.masses.empty());
  EXPECT_TRUE(deck.groups.empty());
  EXPECT_THAT(fmt::format("{}", fmt::join(deck.notices, "\n")),
              HasSubstr("the body lacks them: 1 CONM2 (line 9), 1 RBE2"));
}

}  // namespace
}  // namespace limber::fem::solid_attachments_test
