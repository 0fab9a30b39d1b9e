// SPDX-License-Identifier: BSD-3-Clause
#include "results/probes_csv.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>

#include "common/errors.hpp"

namespace limber::results {

void write_probes_csv(const std::filesystem::path& file,
                      const History& history) {
  std::ofstream out(file);
  fmt::print(out, "time [s]");
  for (const ProbeColumn& column : history.columns) {
    fmt::print(out, ",{} [{}]", column.name, column.unit);
  }
  out << '\n';
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    fmt::print(out, "{:.17g}", history.times[i]);
    for (const double value : history.probe_rows[i]) {
      fmt::print(out, ",{:.17g}", value);
    }
    out << '\n';
  }
  out.flush();
  if (!out) {
    throw InputError(fmt::format(
        "'{}' cannot be written; does its folder exist, and is there room?",
        file.string()));
  }
}

}  // namespace limber::results
