// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/error_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace limber::app {
namespace {

std::string describe_noise(const runs::ErrorTable& table) {
  std::vector<std::string> names;
  for (const runs::ProbeErrors& probe : table.probes) {
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

Json describe_column(const runs::ColumnError& error) {
  return Json{{"peak", error.peak}, {"curve", error.curve}};
}

std::string describe_run(const runs::ErrorRun& run) {
  if (!is_known(run)) {
    return fmt::format("  {:<8} unknown: {}\n", run.name, run.failure);
  }
  return fmt::format("  {:<8} {}, {:.3g} s\n", run.name, run.finer,
                     run.seconds);
}

}  // namespace

Json to_json(const runs::ErrorTable& table) {
  Json causes = Json::array();
  for (const runs::ErrorRun& run : table.runs) {
    Json cause{{"name", run.name},
               {"finer", run.finer},
               {"factor", run.factor},
               {"seconds", run.seconds}};
    if (!is_known(run)) cause["failure"] = run.failure;
    causes.push_back(std::move(cause));
  }
  Json probes = Json::object();
  for (const runs::ProbeErrors& probe : table.probes) {
    Json by_cause = Json::object();
    for (std::size_t i = 0; i < table.runs.size(); ++i) {
      by_cause[table.runs[i].name] = is_known(table.runs[i])
                                         ? describe_column(probe.by_cause[i])
                                         : Json(nullptr);
    }
    probes[probe.column] =
        Json{{"unit", probe.unit},
             {"total", describe_column(probe.total)},
             {"by_cause", by_cause},
             {"is_noise", probe.is_noise},
             {"adds_up", probe.adds_up ? Json(*probe.adds_up) : Json(nullptr)},
             {"remedy", probe.remedy ? Json(table.runs[*probe.remedy].name)
                                     : Json(nullptr)}};
  }
  return Json{
      {"causes", causes}, {"probes", probes}, {"unknown", table.unknown}};
}

std::string to_text(const runs::ErrorTable& table) {
  if (table.probes.empty()) return "";
  std::string text =
      fmt::format("errors of curves, largest, by cause\n{:<28} {:>10} {:>10}",
                  "probe", "peak", "total");
  for (const runs::ErrorRun& run : table.runs) {
    text += fmt::format(" {:>9}", run.name);
  }
  text += "  halved by\n";
  for (const runs::ProbeErrors& probe : table.probes) {
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
  for (const runs::ErrorRun& run : table.runs) text += describe_run(run);
  for (const std::string& why : table.unknown) {
    text += fmt::format("  not known: {}\n", why);
  }
  return text;
}

}  // namespace limber::app
