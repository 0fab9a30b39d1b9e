// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "limber/fem/nastran/bulk_card.hpp"

namespace limber::fem {

/// Cards of one name.
struct CardCount {
  const DeckLine* first = nullptr;
  int count = 0;
};
using CardCounts = std::map<std::string, CardCount, std::less<>>;

/// @param with what else their name has in messages
void count_card(const BulkCard& card, CardCounts& counts,
                std::string_view with = "");
/// Counts a GRID or GRDSET with permanent supports (PS).
void count_supports(const BulkCard& card, CardCounts& counts);

/// "2 SPC1 (line 7), 1 FORCE (line 9 of loads.inc)"
[[nodiscard]] std::string list_counts(const Deck& deck,
                                      const CardCounts& counts);

/// Takes the cards that the user leaves out from those that are refused.
[[nodiscard]] CardCounts extract_ignored(const std::set<std::string>& ignored,
                                         CardCounts& refused);

/// Adds "left out as you ask, so that the body lacks them: ..."; nothing
/// without any.
void note_left_out(const Deck& deck, const CardCounts& left_out,
                   std::vector<std::string>& notices);

/// A problem for each name of card.
/// @param what such a card is: "is not a solid"
/// @param expected "Expected ...", without a full stop
void refuse_cards(const CardCounts& refused, std::string_view what,
                  std::string_view expected, DeckProblems& problems);

}  // namespace limber::fem
