// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/text/keyword_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "limber/common/echo.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

constexpr int kMostNestedInputs = 20;
constexpr int kMostInputs = 10'000;

Keyword parse_keyword(std::string_view line) {
  Keyword keyword;
  const std::vector<std::string_view> fields = split_commas(line);
  keyword.name = to_upper(std::string(trim_blanks(fields[0].substr(1))));
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::size_t equals = std::min(fields[i].find('='), fields[i].size());
    const std::string key =
        to_upper(std::string(trim_blanks(fields[i].substr(0, equals))));
    const std::string_view value =
        equals < fields[i].size() ? trim_blanks(fields[i].substr(equals + 1))
                                  : std::string_view();
    keyword.spelled[key] = std::string(value);
    keyword.parameters[key] =
        key == "INPUT" ? std::string(value) : to_upper(std::string(value));
  }
  return keyword;
}

std::string unquoted(std::string text) {
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
    return text.substr(1, text.size() - 2);
  return text;
}

void read_file(const std::filesystem::path& file, const DeckReading& reading,
               int depth, int& files) {
  TextScanner scanner(file);
  while (scanner.next_text()) {
    const std::string_view line = trim_blanks(scanner.line());
    if (line.starts_with("**")) continue;
    if (!line.starts_with('*')) {
      reading.add_data(scanner, line);
      continue;
    }
    std::string whole(line);
    while (whole.ends_with(',') && scanner.next_text())
      whole += trim_blanks(scanner.line());
    const Keyword keyword = parse_keyword(whole);
    if (keyword.name == "INCLUDE" && keyword.get("INPUT").empty())
      scanner.fail("*INCLUDE without a file. Expected INPUT=file.");
    if (!reading.begin(scanner, keyword) || !keyword.has("INPUT")) continue;
    if (depth == kMostNestedInputs || ++files > kMostInputs)
      scanner.fail(
          "files include too many others. Expected none that includes itself.");
    const std::filesystem::path other =
        file.parent_path() / unquoted(keyword.get("INPUT"));
    if (!std::filesystem::exists(other))
      scanner.fail(fmt::format(
          "the file '{}' is missing. Expected it at a path relative to this "
          "file.",
          echo(keyword.get("INPUT"))));
    read_file(other, reading, depth + 1, files);
  }
}

}  // namespace

std::string Keyword::get(const std::string& key) const {
  const auto found = parameters.find(key);
  return found == parameters.end() ? std::string() : found->second;
}

void read_keyword_deck(const std::filesystem::path& file,
                       const DeckReading& reading) {
  int files = 0;
  read_file(file, reading, 0, files);
}

}  // namespace limber::fem
