// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/text/text_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

constexpr std::size_t kLargestBlock = std::size_t{1} << 20;
constexpr std::size_t kLongestLine = std::size_t{1} << 20;

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

constexpr bool ends_word(char c) { return c == ',' || is_blank(c); }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_same_letter(char c, char upper) { return to_upper(c) == upper; }

/// from_chars on the whole text; below the range of a double is zero.
bool parse_plain(std::string_view text, double& value) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (rest != end || text.empty()) return false;
  if (error == std::errc::result_out_of_range) {
    value = 0.0;
    return text.find("e-") != std::string_view::npos ||
           text.find("E-") != std::string_view::npos;
  }
  return error == std::errc() && std::isfinite(value);
}

/// 1.5D3 and 1.5+3 as 1.5e3; empty if it is longer than any number.
std::string_view to_plain_exponent(std::string_view text,
                                   std::array<char, 64>& buffer) {
  std::size_t size = 0;
  bool has_exponent = false;
  for (const char c : text) {
    if (size + 2 > buffer.size()) return {};
    const char upper = to_upper(c);
    const bool is_letter = upper == 'D' || upper == 'E';
    const bool is_sign = c == '+' || c == '-';
    if (is_letter || (is_sign && size > 0 && buffer[size - 1] != 'e')) {
      if (has_exponent) return {};
      has_exponent = true;
      buffer[size++] = 'e';
    }
    if (!is_letter && !(c == '+' && size == 0)) buffer[size++] = c;
  }
  return {buffer.data(), size};
}

}  // namespace

TextScanner::TextScanner(std::filesystem::path file)
    : file_(std::move(file)), input_(file_, kMatrixInput) {}

bool TextScanner::fill() {
  if (ended_) return false;
  buffer_.erase(0, start_);
  start_ = 0;
  const std::size_t size = buffer_.size();
  buffer_.resize(size + block_);
  const std::size_t count = input_.read(buffer_.data() + size, block_);
  buffer_.resize(size + count);
  ended_ = count < block_;
  block_ = std::min(2 * block_, kLargestBlock);
  return true;
}

bool TextScanner::next() {
  if (stays_) {
    stays_ = false;
    return true;
  }
  std::size_t end = buffer_.find('\n', start_);
  while (end == std::string::npos) {
    if (buffer_.size() - start_ > kLongestLine) {
      ++number_;
      fail(fmt::format("a line of more than {} bytes. Expected text.",
                       kLongestLine));
    }
    if (!fill()) break;
    end = buffer_.find('\n', start_);
  }
  if (end == std::string::npos) end = buffer_.size();
  if (start_ >= buffer_.size()) return false;
  ++number_;
  line_ = std::string_view(buffer_).substr(start_, end - start_);
  start_ = std::min(end + 1, buffer_.size());
  if (number_ == 1 && line_.starts_with("\xef\xbb\xbf")) line_.remove_prefix(3);
  while (!line_.empty() && is_blank(line_.back())) line_.remove_suffix(1);
  if (line_.find('\0') != std::string_view::npos)
    fail("a zero byte. Expected text.");
  return true;
}

bool TextScanner::next_text() {
  while (next())
    if (!line_.empty()) return true;
  return false;
}

void TextScanner::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", file_.string(), number_, what));
}

void TextScanner::fail_at_end(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: the file ends here. Expected {}.",
                               file_.string(), number_, what));
}

std::string_view take_word(std::string_view& rest) {
  std::size_t start = 0;
  while (start < rest.size() && ends_word(rest[start])) ++start;
  std::size_t end = start;
  while (end < rest.size() && !ends_word(rest[end])) ++end;
  const std::string_view word = rest.substr(start, end - start);
  rest.remove_prefix(end);
  return word;
}

std::string_view trim_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split_commas(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    fields.push_back(trim_blanks(line.substr(start, end - start)));
    start = end + 1;
  }
  return fields;
}

bool contains_word(std::string_view text, std::string_view upper_word) {
  return std::search(text.begin(), text.end(), upper_word.begin(),
                     upper_word.end(), is_same_letter) != text.end();
}

bool begins_with_word(std::string_view text, std::string_view upper_word) {
  return text.size() >= upper_word.size() &&
         std::equal(upper_word.begin(), upper_word.end(), text.begin(),
                    [](char u, char c) { return to_upper(c) == u; });
}

bool parse_whole(std::string_view text, long& value) {
  if (text.starts_with('+') && text.size() > 1 && is_digit(text[1]))
    text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end && !text.empty();
}

bool parse_real(std::string_view text, double& value) {
  if (parse_plain(text, value)) return true;
  std::array<char, 64> buffer{};
  return parse_plain(to_plain_exponent(text, buffer), value);
}

int count_digits(std::string_view number) {
  int count = 0;
  bool is_whole = true;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const char c = number[i];
    if (is_digit(c)) {
      if (count > 0 || c != '0') ++count;
    } else if (c == '.') {
      is_whole = false;
    } else if (i > 0) {
      return count;  // an exponent
    }
  }
  return is_whole ? 0 : count;
}

FieldFormat parse_format(std::string_view text, std::string_view letters) {
  FieldFormat format;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (letters.find(to_upper(text[i])) == std::string_view::npos ||
        !is_digit(text[i + 1]))
      continue;
    std::size_t first = i;
    while (first > 0 && is_digit(text[first - 1])) --first;
    std::size_t last = i + 1;
    while (last < text.size() && is_digit(text[last])) ++last;
    long count = 1;
    long width = 0;
    if (first < i && !parse_whole(text.substr(first, i - first), count)) break;
    if (!parse_whole(text.substr(i + 1, last - i - 1), width)) break;
    constexpr long kMost = 1000;
    if (count < 1 || width < 1 || count > kMost || width > kMost) break;
    format.count = static_cast<std::size_t>(count);
    format.width = static_cast<std::size_t>(width);
    break;
  }
  return format;
}

std::string_view FieldReader::take() {
  if (next_ == format_.count) {
    if (!scanner_->next_text())
      scanner_->fail_at_end("more values, as many as the file's head says");
    next_ = 0;
  }
  const std::size_t start = next_++ * format_.width;
  const std::string_view line = scanner_->line();
  if (start >= line.size()) {
    scanner_->fail(fmt::format(
        "field {} of this line is missing. Expected {} fields of {} columns "
        "a line, as many values as the file's head says.",
        next_, format_.count, format_.width));
  }
  return trim_blanks(line.substr(start, format_.width));
}

void FieldReader::end() const {
  const std::size_t start = next_ * format_.width;
  if (next_ == format_.count || start >= scanner_->line().size()) return;
  if (!trim_blanks(scanner_->line().substr(start)).empty())
    scanner_->fail(
        "more values than the file's head says. Expected a new line.");
}

}  // namespace limber::fem
