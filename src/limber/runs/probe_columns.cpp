// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/probe_columns.hpp"

namespace limber::runs {

std::vector<results::ProbeColumn> list_columns(
    const std::vector<scene::Probe>& probes) {
  std::vector<results::ProbeColumn> columns;
  for (const scene::Probe& probe : probes) {
    for (const auto& column : scene::column_names(probe)) {
      columns.push_back({column.name, column.unit});
    }
  }
  return columns;
}

}  // namespace limber::runs
