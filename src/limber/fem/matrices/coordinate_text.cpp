// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/coordinate_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/echo.hpp"
#include "limber/fem/matrices/matrix_entries.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {

SourceMatrix read_coordinate_text(const std::filesystem::path& file) {
  TextScanner scanner(file);
  MatrixEntries entries;
  long size = 0;
  while (scanner.next_text()) {
    std::string_view rest = scanner.line();
    if (rest.starts_with('*')) continue;
    const std::string_view first = take_word(rest);
    const std::string_view second = take_word(rest);
    long row = 0;
    long column = 0;
    if (!parse_whole(first, row) || !parse_whole(second, column) || row < 1 ||
        column < 1 || std::max(row, column) > kMostMatrixRows) {
      scanner.fail(
          fmt::format("'{} {}' are not a row and a column. Expected integers "
                      "from 1, and a value.",
                      echo(first), echo(second)));
    }
    const double value = entries.read(scanner, take_word(rest));
    if (!trim_blanks(rest).empty())
      scanner.fail(
          "more than one entry on this line. Expected row, column, value.");
    entries.add(row - 1, column - 1, value, scanner.number());
    size = std::max({size, row, column});
  }
  if (entries.empty()) scanner.fail_at_end("lines of row, column and value");
  SourceMatrix source;
  source.matrix.file = file.string();
  source.format = "coordinates";
  std::move(entries).make_symmetric(static_cast<std::size_t>(size), source);
  return source;
}

}  // namespace limber::fem
