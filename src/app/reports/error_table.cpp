// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/error_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace limber::app {
namespace {

bool is_known(const ErrorRun& run) { return run.failure.empty(); }

ColumnError find_difference(const ColumnValues& fine, const ColumnValues& own,
                            double factor) {
  ColumnError error;
  error.peak = factor * std::abs(std::abs(fine.peak) - std::abs(own.peak));
  for (std::size_t i = 0; i < own.curve.size(); ++i) {
    if (std::isnan(fine.curve[i]) && std::isnan(own.curve[i])) continue;
    const double d = factor * std::abs(fine.curve[i] - own.curve[i]);
    if (!(d <= error.curve)) error.curve = d;  // also NaN, which stays
    if (std::isnan(d)) break;
  }
  return error;
}

/// The cheapest run that alone leaves half of the total.
std::optional<std::size_t> find_remedy(const ProbeErrors& probe,
                                       const std::vector<ErrorRun>& runs) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!(probe.by_cause[i].curve >= 0.5 * probe.total.curve)) continue;
    if (!(probe.by_cause[i].curve > 0.0)) continue;
    if (!best || runs[i].seconds < runs[*best].seconds) best = i;
  }
  return best;
}

void add_total(const ColumnValues& own, const ErrorRun* together,
               std::size_t column, ProbeErrors& probe) {
  for (const ColumnError& error : probe.by_cause) {
    probe.total.peak += error.peak;
    probe.total.curve += error.curve;
  }
  if (together == nullptr) return;
  constexpr double kMuch = 2.0;
  const ColumnError all =
      find_difference(together->columns[column], own, together->factor);
  probe.adds_up = all.curve <= kMuch * probe.total.curve;
  probe.total.peak = std::max(probe.total.peak, all.peak);
  probe.total.curve = std::max(probe.total.curve, all.curve);
}

std::string probe_of(const ProbeErrors& probe) {
  return probe.column.substr(0, probe.column.rfind('.'));
}

void mark_noise(std::vector<ProbeErrors>& probes) {
  constexpr double kNoise = 1e-9;
  std::map<std::pair<std::string, std::string>, double> largest;
  for (const ProbeErrors& probe : probes) {
    double& peak = largest[{probe_of(probe), probe.unit}];
    peak = std::max(peak, std::abs(probe.peak));
  }
  for (ProbeErrors& probe : probes) {
    const double least = kNoise * largest[{probe_of(probe), probe.unit}];
    probe.is_noise =
        std::abs(probe.peak) <= least && probe.total.curve <= least;
  }
}

std::string describe_noise(const ErrorTable& table) {
  std::vector<std::string> names;
  for (const ProbeErrors& probe : table.probes) {
    if (probe.is_noise) names.push_back("'" + probe.column + "'");
  }
  if (names.empty()) return "";
  constexpr std::size_t kMostNoise = 4;
  const std::size_t count = names.size();
  names.resize(std::min(count, kMostNoise));
  return fmt::format(
      "  {} left out, zero or round-off: {}{}\n", count, fmt::join(names, ", "),
      count > kMostNoise ? fmt::format(" and {} more", count - kMostNoise)
                         : "");
}

Json to_json(const ColumnError& error) {
  return Json{{"peak", error.peak}, {"curve", error.curve}};
}

std::string describe_run(const ErrorRun& run) {
  if (!is_known(run)) {
    return fmt::format("  {:<8} unknown: {}\n", run.name, run.failure);
  }
  return fmt::format("  {:<8} {}, {:.3g} s\n", run.name, run.finer,
                     run.seconds);
}

}  // namespace

ErrorTable compare_causes(const std::vector<std::string>& names,
                          const std::vector<std::string>& units,
                          const std::vector<ColumnValues>& own,
                          std::vector<ErrorRun> runs,
                          const std::optional<ErrorRun>& together) {
  ErrorTable table;
  const ErrorRun* all = together && is_known(*together) ? &*together : nullptr;
  for (std::size_t c = 0; c < names.size(); ++c) {
    ProbeErrors probe{names[c], units[c], own[c].peak, {}, {}, {}, {}, false};
    for (const ErrorRun& run : runs) {
      probe.by_cause.push_back(
          is_known(run) ? find_difference(run.columns[c], own[c], run.factor)
                        : ColumnError{});
    }
    add_total(own[c], all, c, probe);
    probe.remedy = find_remedy(probe, runs);
    table.probes.push_back(std::move(probe));
  }
  mark_noise(table.probes);
  if (together && !is_known(*together)) {
    table.unknown.push_back("whether causes add up: " + together->failure);
  }
  for (ErrorRun& run : runs) run.columns.clear();
  table.runs = std::move(runs);
  return table;
}

Json to_json(const ErrorTable& table) {
  Json causes = Json::array();
  for (const ErrorRun& run : table.runs) {
    Json cause{{"name", run.name},
               {"finer", run.finer},
               {"factor", run.factor},
               {"seconds", run.seconds}};
    if (!is_known(run)) cause["failure"] = run.failure;
    causes.push_back(std::move(cause));
  }
  Json probes = Json::object();
  for (const ProbeErrors& probe : table.probes) {
    Json by_cause = Json::object();
    for (std::size_t i = 0; i < table.runs.size(); ++i) {
      by_cause[table.runs[i].name] =
          is_known(table.runs[i]) ? to_json(probe.by_cause[i]) : Json(nullptr);
    }
    probes[probe.column] =
        Json{{"unit", probe.unit},
             {"total", to_json(probe.total)},
             {"by_cause", by_cause},
             {"is_noise", probe.is_noise},
             {"adds_up", probe.adds_up ? Json(*probe.adds_up) : Json(nullptr)},
             {"remedy", probe.remedy ? Json(table.runs[*probe.remedy].name)
                                     : Json(nullptr)}};
  }
  return Json{
      {"causes", causes}, {"probes", probes}, {"unknown", table.unknown}};
}

std::string to_text(const ErrorTable& table) {
  if (table.probes.empty()) return "";
  std::string text =
      fmt::format("errors of curves, largest, by cause\n{:<28} {:>10} {:>10}",
                  "probe", "peak", "total");
  for (const ErrorRun& run : table.runs) {
    text += fmt::format(" {:>9}", run.name);
  }
  text += "  halved by\n";
  for (const ProbeErrors& probe : table.probes) {
    if (probe.is_noise) continue;
    text += fmt::format("{:<28} {:>10.4g} {:>10.2g}", probe.column, probe.peak,
                        probe.total.curve);
    for (std::size_t i = 0; i < table.runs.size(); ++i) {
      text += is_known(table.runs[i])
                  ? fmt::format(" {:>9.2g}", probe.by_cause[i].curve)
                  : fmt::format(" {:>9}", "?");
    }
    text += fmt::format(
        "  {} {}\n",
        probe.remedy ? table.runs[*probe.remedy].name : "no single cause",
        probe.adds_up == false ? "(causes do not add up)" : "");
  }
  text += describe_noise(table);
  for (const ErrorRun& run : table.runs) text += describe_run(run);
  for (const std::string& why : table.unknown) {
    text += fmt::format("  not known: {}\n", why);
  }
  return text;
}

}  // namespace limber::app
