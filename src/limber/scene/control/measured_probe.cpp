// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/control/measured_probe.hpp"

#include <fmt/format.h>

#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/scene/probes/probe_fields.hpp"

namespace limber::scene {
namespace {

std::size_t find_column(const Probe& probe, const std::string& column) {
  std::string known;
  const std::vector<ProbeColumnName> columns = column_names(probe);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == column) return i;
    known += (i == 0 ? "" : ", ") + columns[i].name;
  }
  throw InputError(
      fmt::format("probe '{}' has no column '{}'; expected one of "
                  "{}",
                  probe.name, column, known));
}

}  // namespace

dynamics::Measurement measure_probe(const Probe& probe,
                                    const std::string& column) {
  const std::size_t i = find_column(probe, column);
  Manifest manifest;
  describe(manifest, column, probe);
  return {column, manifest.text(),
          [probes = std::vector<Probe>{probe}, i](
              const dynamics::SystemModel& model,
              const dynamics::SystemState& state) {
            return evaluate_all(probes, model, state)[i];
          }};
}

}  // namespace limber::scene
