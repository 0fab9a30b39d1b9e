// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "limber/fem/text/deck_place.hpp"

namespace limber::fem {

/// Keywords or elements of one kind.
struct DeckCount {
  int count = 0;
  std::string first = {};  ///< "file:line"
};
using DeckCounts = std::map<std::string, DeckCount>;

/// @param what "*TIE" or "elements T3D2"
void count_in_deck(const DeckPlace& at, const std::string& what,
                   DeckCounts& counts);

/// Adds "file: why: 2 *TIE (file:7), ..."; nothing without any.
void note_in_deck(const DeckCounts& counts, const std::string& file,
                  const char* why, std::vector<std::string>& notices);

/// @param expected "Expected ...", without a full stop
/// @throws InputError that they would be lost, if there are any
void refuse_in_deck(const DeckCounts& refused, const std::string& expected);

}  // namespace limber::fem
