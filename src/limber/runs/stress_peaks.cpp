// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/stress_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/flexbody/model/stress_modes.hpp"
#include "limber/scene/probes/followed_probes.hpp"

namespace limber::runs {
namespace {

/// A stress probe's column in a run.
struct Column {
  std::size_t index = 0;
  const scene::StressProbe* stress = nullptr;
};

std::vector<Column> list_columns(const scene::BuiltScene& built) {
  std::vector<Column> columns;
  std::size_t next = 0;
  for (const scene::Probe& probe : built.probes) {
    const auto* stress = std::get_if<scene::StressProbe>(&probe.of);
    const std::size_t count = column_names(probe).size();
    for (std::size_t i = 0; stress != nullptr && i < count; ++i) {
      columns.push_back({next + i, stress});
    }
    next += count;
  }
  return columns;
}

/// State of the output nearest to `time`.
dynamics::SystemState find_nearest(const results::History& history,
                                   double time) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < history.times.size(); ++i) {
    if (std::abs(history.times[i] - time) <
        std::abs(history.times[nearest] - time)) {
      nearest = i;
    }
  }
  return history.states[nearest];
}

std::optional<double> find_error(const scene::BuiltScene& built,
                                 dynamics::BodyIndex b,
                                 const dynamics::SystemState& state) {
  const dynamics::BodyModel& body = built.model.bodies[index(b)];
  if (body.full >= 0 || body.reduced->stress->averaging.size() == 0) {
    return std::nullopt;
  }
  return flexbody::find_averaging_error(
      *body.reduced->stress, body.reduced->lambda,
      state.eta.segment(body.offset, body.modes));
}

// @param place index of a point of the probe
std::optional<double> find_correction(const scene::BuiltScene& built,
                                      const scene::StressProbe& probe,
                                      int place,
                                      const dynamics::SystemState& state) {
  if (probe.eigenmodes < 0) return std::nullopt;
  const dynamics::BodyModel& body = built.model.bodies[index(probe.body)];
  const auto modes = probe.Sigma_L.middleRows<6>(6 * Eigen::Index{place});
  const auto eta = state.eta.segment(body.offset, body.modes);
  const Eigen::Index corrections =
      std::max<Eigen::Index>(0, body.modes - probe.eigenmodes);
  VectorX all;
  calc_stress_coordinates(body, state, all);
  const double whole = flexbody::calc_von_mises(modes * all);
  if (!(whole > 0.0)) return std::nullopt;
  return flexbody::calc_von_mises(
             modes.middleCols(body.modes - corrections, corrections) *
             eta.tail(corrections)) /
         whole;
}

}  // namespace

std::vector<StressPeak> find_stress_peaks(const scene::BuiltScene& built,
                                          const results::History& history,
                                          const dynamics::RunRecord& record) {
  std::vector<StressPeak> peaks;
  if (history.states.empty() || record.peaks.empty()) return peaks;
  for (const Column& column : list_columns(built)) {
    const int place = record.places[column.index];
    if (!column.stress->is_of_link || place < 0) continue;
    const dynamics::Extreme& peak = record.peaks[column.index];
    const dynamics::SystemState near = find_nearest(history, peak.time);
    peaks.push_back({built.model.bodies[index(column.stress->body)].name,
                     peak.value, peak.time, column.stress->tags[index(place)],
                     column.stress->layer_of(index(place)),
                     column.stress->p_L.col(place),
                     find_error(built, column.stress->body, near),
                     find_correction(built, *column.stress, place, near)});
  }
  return peaks;
}

dynamics::RunRecord record_state(const scene::BuiltScene& built,
                                 const dynamics::SystemState& state) {
  const dynamics::Followed followed = scene::follow(built.probes, built.model);
  std::vector<double> values;
  followed.evaluate(state, values);
  dynamics::RunRecord record;
  for (std::size_t i = 0; i < values.size(); ++i) {
    record.peaks.push_back({values[i], state.t});
    record.places.push_back(followed.find_place(i));
  }
  return record;
}

std::vector<std::optional<PeakNode>> find_peak_nodes(
    const scene::BuiltScene& built, const dynamics::RunRecord& record) {
  std::vector<std::optional<PeakNode>> nodes(record.peaks.size());
  for (const Column& column : list_columns(built)) {
    if (column.index >= nodes.size()) continue;
    const int place = record.places[column.index];
    const std::vector<std::size_t>& tags = column.stress->tags;
    if (place >= 0 && tags.size() > 1) {
      nodes[column.index] = {tags[index(place)],
                             column.stress->layer_of(index(place))};
    }
  }
  return nodes;
}

}  // namespace limber::runs
