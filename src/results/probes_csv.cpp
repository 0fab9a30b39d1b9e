// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/probes_csv.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/common/files/whole_file.hpp"

namespace limber::results {
namespace {

// Quoted if necessary, as in RFC 4180.
std::string make_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

void write_table(std::ostream& out, const History& history) {
  fmt::print(out, "time [s]");
  for (const ProbeColumn& column : history.columns) {
    out << ',' << make_field(fmt::format("{} [{}]", column.name, column.unit));
  }
  out << '\n';
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    fmt::print(out, "{:.17g}", history.times[i]);
    for (const double value : history.probe_rows[i]) {
      fmt::print(out, ",{:.17g}", value);
    }
    out << '\n';
  }
}

}  // namespace

void write_probes_csv(const std::filesystem::path& file,
                      const History& history) {
  write_whole(file, [&](const std::filesystem::path& part) {
    std::ofstream out(part);
    write_table(out, history);
    out.flush();
    if (out) return;
    throw InputError(fmt::format(
        "'{}' cannot be written; does its folder exist, and is there room?",
        file.string()));
  });
}

}  // namespace limber::results
