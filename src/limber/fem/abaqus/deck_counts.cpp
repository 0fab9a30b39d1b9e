// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/deck_counts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"

namespace limber::fem {

void count_in_deck(const DeckPlace& at, const std::string& what,
                   DeckCounts& counts) {
  DeckCount& entry = counts[what];
  if (entry.count++ == 0) entry.first = at.text();
}

void note_in_deck(const DeckCounts& counts, const std::string& file,
                  const char* why, std::vector<std::string>& notices) {
  if (counts.empty()) return;
  std::vector<std::string> texts;
  for (const auto& [what, entry] : counts)
    texts.push_back(
        fmt::format("{} {} ({})", entry.count, echo(what), entry.first));
  notices.push_back(
      fmt::format("{}: {}: {}.", file, why, fmt::join(texts, ", ")));
}

void refuse_in_deck(const DeckCounts& refused, const std::string& expected) {
  std::vector<std::string> problems;
  for (const auto& [what, entry] : refused)
    problems.push_back(fmt::format(
        "{}: {}{} would be lost. {}, or ignore {} to go on without.",
        entry.first, echo(what),
        entry.count == 1 ? std::string()
                         : fmt::format(" ({}, the first here)", entry.count),
        expected, echo(what.substr(what.find_first_of(" *") + 1))));
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace limber::fem
