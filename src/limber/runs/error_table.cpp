// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/error_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace limber::runs {
namespace {

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

}  // namespace limber::runs
