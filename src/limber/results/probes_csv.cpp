// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/probes_csv.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
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

void write_peaks(std::ostream& out, const History& history,
                 const std::vector<dynamics::Extreme>& peaks) {
  out << "name,unit,peak,time [s]\n";
  for (std::size_t c = 0; c < peaks.size(); ++c) {
    const ProbeColumn& column = history.columns[c];
    fmt::print(out, "{},{},{:.17g},{:.17g}\n", make_field(column.name),
               make_field(column.unit), peaks[c].value, peaks[c].time);
  }
}

void write_envelopes(std::ostream& out, const History& history,
                     const Envelopes& envelopes) {
  out << "from [s],to [s]";
  for (const ProbeColumn& column : history.columns) {
    for (const char* side : {"least", "most"}) {
      out << ','
          << make_field(
                 fmt::format("{} {} [{}]", column.name, side, column.unit));
    }
  }
  out << '\n';
  const auto add = [&](double value) {
    out << ',';
    if (!std::isnan(value)) fmt::print(out, "{:.17g}", value);
  };
  for (Eigen::Index i = 0; i < envelopes.least.rows(); ++i) {
    const auto edge = static_cast<std::size_t>(i);
    fmt::print(out, "{:.17g},{:.17g}", envelopes.edges[edge],
               envelopes.edges[edge + 1]);
    for (Eigen::Index c = 0; c < envelopes.least.cols(); ++c) {
      add(envelopes.least(i, c));
      add(envelopes.most(i, c));
    }
    out << '\n';
  }
}

// @param write_content to a stream
template <typename WriteContent>
void write_text_file(const std::filesystem::path& file,
                     const WriteContent& write_content) {
  write_whole(file, [&](const std::filesystem::path& part) {
    std::ofstream out(part);
    write_content(out);
    out.flush();
    if (out) return;
    throw InputError(
        fmt::format("'{}' cannot be written; does its folder exist, and is "
                    "there free space?",
                    file.string()));
  });
}

}  // namespace

void write_probes_csv(const std::filesystem::path& file,
                      const History& history) {
  write_text_file(file, [&](std::ostream& out) { write_table(out, history); });
}

void write_peaks_csv(const std::filesystem::path& file, const History& history,
                     const std::vector<dynamics::Extreme>& peaks) {
  write_text_file(file,
                  [&](std::ostream& out) { write_peaks(out, history, peaks); });
}

void write_envelopes_csv(const std::filesystem::path& file,
                         const History& history, const Envelopes& envelopes) {
  write_text_file(file, [&](std::ostream& out) {
    write_envelopes(out, history, envelopes);
  });
}

}  // namespace limber::results
