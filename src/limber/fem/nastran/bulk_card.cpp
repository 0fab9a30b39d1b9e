// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/bulk_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/parse_number.hpp"

namespace limber::fem {
namespace {

constexpr std::size_t kSmall = 8;   // data fields of a line, and columns of one
constexpr std::size_t kLarge = 16;  // columns of a large field

std::string_view trim(std::string_view text) {
  const std::size_t start = text.find_first_not_of(' ');
  if (start == std::string_view::npos) return {};
  return text.substr(start, text.find_last_not_of(' ') + 1 - start);
}

std::string_view columns(std::string_view text, std::size_t start,
                         std::size_t count) {
  return start < text.size() ? trim(text.substr(start, count))
                             : std::string_view();
}

/// A line's fields: name or mark of continuation, data, mark of the
/// continuation to come.
struct SplitLine {
  std::string_view head;
  std::vector<std::string_view> data;
  std::string_view tail;
  std::size_t capacity = kSmall;  ///< 8 data fields, 4 large ones
  bool is_too_long = false;
};

bool is_number_like(std::string_view text) {
  return !text.empty() && (std::isdigit(text[0] & 0xff) != 0 ||
                           text[0] == '-' || text[0] == '.');
}

SplitLine split_free(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    parts.push_back(trim(text.substr(start, end - start)));
    start = end + 1;
  }
  SplitLine line;
  line.head = parts[0];
  if (line.head.find('*') != std::string_view::npos) line.capacity = kSmall / 2;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (i <= line.capacity) {
      line.data.push_back(parts[i]);
    } else if (i == line.capacity + 1 && !is_number_like(parts[i])) {
      line.tail = parts[i];
    } else if (!parts[i].empty()) {
      line.is_too_long = true;
    }
  }
  return line;
}

SplitLine split_fixed(std::string_view text) {
  constexpr std::size_t kTail = 72;
  SplitLine line;
  line.head = columns(text, 0, kSmall);
  const bool is_large = line.head.find('*') != std::string_view::npos;
  const std::size_t width = is_large ? kLarge : kSmall;
  if (is_large) line.capacity = kSmall / 2;
  for (std::size_t i = 0; i < line.capacity; ++i)
    line.data.push_back(columns(text, kSmall + i * width, width));
  line.tail = columns(text, kTail, kSmall);
  return line;
}

SplitLine split_line(std::string_view text) {
  return text.find(',') == std::string_view::npos ? split_fixed(text)
                                                  : split_free(text);
}

bool is_continuation(std::string_view head) {
  return head.empty() || head[0] == '+' || head[0] == '*';
}

/// The name in a mark of continuation: X of +X, *X and X.
std::string_view mark_name(std::string_view mark) {
  if (!mark.empty() && (mark[0] == '+' || mark[0] == '*'))
    mark.remove_prefix(1);
  return trim(mark);
}

bool is_card_name(std::string_view name) {
  return !name.empty() && name.size() <= kSmall &&
         std::isalpha(name[0] & 0xff) != 0 &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return std::isalnum(c & 0xff) != 0; });
}

/// Adds a line's data: where the lines before it end, blanks fill up.
void append_data(const SplitLine& line, BulkCard& card) {
  const std::size_t size = card.fields.size();
  const std::size_t start =
      (size + line.capacity - 1) / line.capacity * line.capacity;
  card.fields.resize(start);
  card.fields.insert(card.fields.end(), line.data.begin(), line.data.end());
  card.fields.resize(start + line.capacity);
}

void drop_trailing_blanks(BulkCard& card) {
  while (!card.fields.empty() && card.fields.back().empty())
    card.fields.pop_back();
}

/// 7.+10 as 7.e+10, 1.D3 as 1.e3.
std::string to_exponent(std::string_view field) {
  std::string text;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const char c = field[i];
    if (c == 'D' || c == 'E') {
      text += 'e';
    } else if ((c == '+' || c == '-') && i > 0 && text.back() != 'e') {
      text += 'e';
      text += c;
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

void DeckProblems::add(const DeckLine& line, const std::string& what) {
  ++count_;
  if (listed_.size() < kMostListed)
    listed_.push_back(fmt::format("{}: {}", deck_->place_of(line), what));
}

void DeckProblems::check() const {
  if (count_ == 0) return;
  std::vector<std::string> all = listed_;
  if (count_ > all.size())
    all.push_back(fmt::format("{}: {} more problems", deck_->files[0].string(),
                              count_ - all.size()));
  throw InputError(all);
}

std::optional<int> BulkCard::integer(std::size_t index,
                                     std::optional<int> blank,
                                     DeckProblems& problems) const {
  std::string_view text = field(index);
  if (text.empty() && blank) return blank;
  if (text.starts_with('+')) text.remove_prefix(1);
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && rest == end && !text.empty()) return value;
  problems.add(*line, fmt::format("{} has '{}' in field {}. Expected an "
                                  "integer.",
                                  name, echo(field(index)), index + 2));
  return std::nullopt;
}

std::optional<double> BulkCard::real(std::size_t index,
                                     DeckProblems& problems) const {
  if (field(index).empty()) return 0.0;
  const std::optional<double> value = parse_number(to_exponent(field(index)));
  if (!value)
    problems.add(
        *line, fmt::format("{} has '{}' in field {}. Expected a number.", name,
                           echo(field(index)), index + 2));
  return value;
}

bool BulkCard::require(bool fine, const std::string& what,
                       DeckProblems& problems) const {
  if (!fine)
    problems.add(*line, fmt::format("{} {}: {}", name, echo(field(0)), what));
  return fine;
}

bool CardReader::next(BulkCard& card) {
  card = {};
  std::string_view promised;
  for (; next_ < deck_->lines.size(); ++next_) {
    const DeckLine& line = deck_->lines[next_];
    const SplitLine split = split_line(line.text);
    const bool continues = is_continuation(split.head);
    if (card.line != nullptr && !continues) break;
    if (split.is_too_long)
      problems_->add(line, fmt::format("more than {} data fields on one line. "
                                       "Expected a continuation line.",
                                       split.capacity));
    const std::string_view mark = mark_name(split.head);
    if (continues &&
        (card.line == nullptr ||
         (!mark.empty() && !promised.empty() && mark != promised))) {
      problems_->add(line, fmt::format("continuation '{}' does not follow the "
                                       "line that it continues. Expected it "
                                       "next after that line.",
                                       echo(split.head)));
      continue;
    }
    if (!continues) {
      card.line = &line;
      card.name = trim(split.head.substr(0, split.head.find('*')));
      if (!is_card_name(card.name))
        problems_->add(line, fmt::format("'{}' is not the name of a card. "
                                         "Expected one, in the first 8 columns "
                                         "or before a comma.",
                                         echo(card.name)));
    }
    append_data(split, card);
    promised = split.tail.starts_with('+') || split.tail.starts_with('*')
                   ? mark_name(split.tail)
                   : std::string_view();
  }
  if (card.line != nullptr && !promised.empty())
    problems_->add(*card.line, fmt::format("{}'s continuation '{}' is missing. "
                                           "Expected it on the next line.",
                                           card.name, echo(promised)));
  drop_trailing_blanks(card);
  return card.line != nullptr;
}

}  // namespace limber::fem
