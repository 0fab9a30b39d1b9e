// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/deck_lines.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

constexpr int kMostNestedIncludes = 20;

/// Without comment and trailing blanks, tabs expanded to columns of eight.
std::string clean_line(std::string_view raw) {
  std::string text;
  for (const char c : raw.substr(0, raw.find('$'))) {
    if (c == '\t') {
      text.append(8 - text.size() % 8, ' ');
    } else {
      text += c;
    }
  }
  text.erase(text.find_last_not_of(" \r\f\v") + 1);
  return text;
}

/// The letters that the line begins with.
std::string_view first_word(std::string_view upper) {
  const std::size_t start = upper.find_first_not_of(' ');
  if (start == std::string_view::npos) return {};
  std::size_t end = start;
  while (end < upper.size() && upper[end] >= 'A' && upper[end] <= 'Z') ++end;
  return upper.substr(start, end - start);
}

bool has_word(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

/// The path of an INCLUDE line as it is written, with or without quotes; none
/// if it is not whole.
std::optional<std::string> find_included_name(std::string_view line) {
  constexpr std::size_t kKeyword = 7;  // INCLUDE
  std::string_view rest = line.substr(line.find_first_not_of(' ') + kKeyword);
  const std::size_t start = rest.find_first_not_of(" =");
  if (start == std::string_view::npos) return std::nullopt;
  rest.remove_prefix(start);
  const char quote = rest[0];
  if (quote != '\'' && quote != '"') return std::string(rest);
  const std::size_t end = rest.find(quote, 1);
  if (end == std::string_view::npos || end == 1) return std::nullopt;
  return std::string(rest.substr(1, end - 1));
}

bool is_dmig(std::string_view raw) {
  return to_upper(std::string(raw.substr(0, 4))) == "DMIG";
}

class DeckReader {
 public:
  explicit DeckReader(DeckUse use) : use_(use) {}

  Deck read(const std::filesystem::path& file) {
    append(file, 0);
    if (begin_ && !deck_.has_end && !is_superelement_)
      throw InputError(fmt::format(
          "{}: the bulk data has a BEGIN BULK and no ENDDATA, so the file is "
          "truncated. Expected ENDDATA after the last card.",
          file.string()));
    return std::move(deck_);
  }

 private:
  void append(const std::filesystem::path& file, int depth) {
    const std::string text = read_input(file, kMeshInput);
    if (text.find('\0') != std::string::npos)
      throw InputError(fmt::format(
          "{}: is not text (it contains zero bytes). Expected a Nastran deck.",
          file.string()));
    const std::size_t index = deck_.files.size();
    deck_.files.push_back(file);
    std::size_t number = 0;
    for (std::size_t start = 0; start < text.size() && !deck_.has_end;) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      const auto raw = std::string_view(text).substr(start, end - start);
      ++number;
      if (use_ == DeckUse::mesh || !passes_over(raw))
        add_line(clean_line(raw), index, number, depth);
      start = end + 1;
    }
  }

  /// DMIG cards and their continuations.
  bool passes_over(std::string_view raw) {
    const bool continues =
        raw.empty() ||
        std::string_view(" +*,$\t\r").find(raw[0]) != std::string_view::npos;
    if (!continues) is_in_dmig_ = is_dmig(raw);
    return is_in_dmig_;
  }

  void add_line(const std::string& text, std::size_t file, std::size_t number,
                int depth) {
    if (text.empty()) return;
    DeckLine line{to_upper(text), file, number};
    const std::string_view word = first_word(line.text);
    if (word == "INCLUDE") {
      include(text, line, depth);
    } else if (word == "BEGIN") {
      begin(line);
    } else if (word == "ENDDATA") {
      deck_.has_end = true;
    } else {
      deck_.lines.push_back(std::move(line));
    }
  }

  /// Drops the sections before the bulk data.
  void begin(const DeckLine& line) {
    is_superelement_ =
        use_ == DeckUse::points && !begin_ && has_word(line.text, "SUPER");
    if (begin_ || (!is_superelement_ && has_word(line.text, "SUPER")) ||
        has_word(line.text, "AUX") || has_word(line.text, "MODULE") ||
        has_word(line.text, "ARBMODEL"))
      throw InputError(fmt::format(
          "{}: '{}' begins a second bulk data section or that of a "
          "superelement. Expected one section; write each part to a file of "
          "its own.",
          deck_.place_of(line), echo(line.text)));
    begin_ = true;
    deck_.lines.clear();
  }

  void include(const std::string& text, const DeckLine& line, int depth) {
    const std::optional<std::string> name = find_included_name(text);
    if (!name)
      throw InputError(
          fmt::format("{}: INCLUDE without a whole file name. Expected "
                      "INCLUDE 'file' on one line.",
                      deck_.place_of(line)));
    if (depth == kMostNestedIncludes)
      throw InputError(fmt::format(
          "{}: INCLUDE files are nested more than {} deep. Expected no file "
          "that includes itself.",
          deck_.place_of(line), kMostNestedIncludes));
    append(find_included(*name, line), depth + 1);
  }

  /// Beside the file that includes it, else beside the main file.
  std::filesystem::path find_included(const std::string& name,
                                      const DeckLine& line) const {
    for (const std::size_t from : {line.file, std::size_t{0}}) {
      const std::filesystem::path file = deck_.files[from].parent_path() / name;
      if (std::filesystem::exists(file)) return file;
    }
    throw InputError(fmt::format(
        "{}: the INCLUDE file '{}' is missing. Expected it at a path relative "
        "to this file or to {}.",
        deck_.place_of(line), echo(name), deck_.files[0].string()));
  }

  DeckUse use_;
  Deck deck_;
  bool begin_ = false;
  bool is_superelement_ = false;
  bool is_in_dmig_ = false;
};

}  // namespace

std::string Deck::place_of(const DeckLine& line) const {
  return fmt::format("{}:{}", files[line.file].string(), line.number);
}

Deck read_deck(const std::filesystem::path& file, DeckUse use) {
  return DeckReader(use).read(file);
}

}  // namespace limber::fem
