// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/card_counts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "limber/fem/nastran/card_effect.hpp"

namespace limber::fem {
namespace {

std::string_view describe_loss(std::string_view name, std::string_view what) {
  if (name == "MPC") return "constrains nodes";
  return find_card_effect(name) == CardEffect::unknown ? "is not known" : what;
}

}  // namespace

void count_card(const BulkCard& card, CardCounts& counts,
                std::string_view with) {
  CardCount& entry = counts[std::string(card.name) + std::string(with)];
  if (entry.count++ == 0) entry.first = card.line;
}

void count_supports(const BulkCard& card, CardCounts& counts) {
  constexpr std::size_t kPermanent = 6;
  const std::string_view fixed = card.field(kPermanent);
  if (!fixed.empty() && fixed != "0")
    count_card(card, counts, " with supports (PS)");
}

std::string list_counts(const Deck& deck, const CardCounts& counts) {
  std::vector<std::string> texts;
  for (const auto& [name, cards] : counts)
    texts.push_back(fmt::format(
        "{} {} (line {}{})", cards.count, name, cards.first->number,
        cards.first->file == 0
            ? std::string()
            : " of " + deck.files[cards.first->file].filename().string()));
  return fmt::format("{}", fmt::join(texts, ", "));
}

CardCounts extract_ignored(const std::set<std::string>& ignored,
                           CardCounts& refused) {
  CardCounts left_out;
  for (const std::string& name : ignored)
    if (auto entry = refused.extract(name)) left_out.insert(std::move(entry));
  return left_out;
}

void note_left_out(const Deck& deck, const CardCounts& left_out,
                   std::vector<std::string>& notices) {
  if (left_out.empty()) return;
  notices.push_back(
      fmt::format("{}: left out as you ask, so that the body lacks them: {}.",
                  deck.files[0].string(), list_counts(deck, left_out)));
}

void refuse_cards(const CardCounts& refused, std::string_view what,
                  std::string_view expected, DeckProblems& problems) {
  for (const auto& [name, cards] : refused)
    problems.add(
        *cards.first,
        fmt::format(
            "{}{} {} and would be lost. {}; or ignore {} to go on "
            "without.",
            name,
            cards.count == 1
                ? std::string()
                : fmt::format(" ({} cards, the first here)", cards.count),
            describe_loss(name, what), expected, name));
}

}  // namespace limber::fem
