// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace limber::fem {

/// A line of a deck and where it stands.
struct DeckLine {
  std::string text;  ///< upper case, without comment, tabs expanded
  std::size_t file = 0;
  std::size_t number = 0;  ///< from 1
};

/// The bulk data section of a Nastran deck, INCLUDE files inserted, without
/// blank lines.
struct Deck {
  std::vector<std::filesystem::path> files;
  std::vector<DeckLine> lines;
  bool has_end = false;  ///< ends in ENDDATA

  /// "file:line", for messages.
  [[nodiscard]] std::string place_of(const DeckLine& line) const;
};

/// What a deck is read for.
enum class DeckUse {
  mesh,
  /// As `mesh` without DMIG cards, which may be millions; the section may be
  /// that of a superelement (BEGIN SUPER), and need no ENDDATA then.
  points
};

/// What follows BEGIN BULK, or the whole file if it has no such line.
/// @throws InputError for a file that is not text or cannot be read, for more
/// than one section, and for a section without ENDDATA, which is truncated.
[[nodiscard]] Deck read_deck(const std::filesystem::path& file,
                             DeckUse use = DeckUse::mesh);

}  // namespace limber::fem
