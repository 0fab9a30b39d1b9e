// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limber/fem/nastran/deck_lines.hpp"

namespace limber::fem {

/// What is wrong with a deck, each with its place.
class DeckProblems {
 public:
  explicit DeckProblems(const Deck& deck) : deck_(&deck) {}
  void add(const DeckLine& line, const std::string& what);
  /// @throws InputError with all of them, if there are any.
  void check() const;

 private:
  static constexpr std::size_t kMostListed = 20;
  const Deck* deck_;
  std::vector<std::string> listed_;
  std::size_t count_ = 0;
};

/// A card of the bulk data with its continuations. Views are into its deck.
struct BulkCard {
  std::string_view name;  ///< without the * of large fields
  const DeckLine* line = nullptr;
  std::vector<std::string_view> fields;  ///< from field 2 on, trimmed

  /// Field `index`, from 0 after the name; empty if it is blank or absent.
  [[nodiscard]] std::string_view field(std::size_t index) const {
    return index < fields.size() ? fields[index] : std::string_view();
  }
  /// The integer, `blank` where the field is blank; a problem otherwise.
  [[nodiscard]] std::optional<int> integer(std::size_t index,
                                           std::optional<int> blank,
                                           DeckProblems& problems) const;
  /// A number, also as 7.+10 and 1.D3; 0 where the field is blank.
  [[nodiscard]] std::optional<double> real(std::size_t index,
                                           DeckProblems& problems) const;
  /// Adds the problem "NAME NUMBER: what" unless it is fine.
  /// @returns whether it is
  bool require(bool fine, const std::string& what,
               DeckProblems& problems) const;
};

/// The cards of a deck one after the other: small, large and free fields, with
/// continuations that follow their card, named or not.
class CardReader {
 public:
  CardReader(const Deck& deck, DeckProblems& problems)
      : deck_(&deck), problems_(&problems) {}
  /// @returns false at the end of the deck
  bool next(BulkCard& card);

 private:
  const Deck* deck_;
  DeckProblems* problems_;
  std::size_t next_ = 0;
};

}  // namespace limber::fem
