// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <variant>

#include "limber/app/options/mode_options.hpp"
#include "limber/app/reports/contact_report.hpp"
#include "limber/app/reports/error_report.hpp"
#include "limber/app/reports/event_report.hpp"
#include "limber/app/reports/level_report.hpp"
#include "limber/app/reports/stress_report.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/dynamics/monitors/energy_verdict.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/results/energy_error.hpp"

namespace limber::app {
namespace {

Json describe_extreme(const dynamics::Extreme& extreme) {
  return Json{{"value", extreme.value}, {"time", extreme.time}};
}

Json describe_rows(const std::vector<dynamics::EnergyRow>& rows) {
  Json json = Json::array();
  for (const dynamics::EnergyRow& row : rows) {
    json.push_back({{"name", row.name},
                    {"stored", row.stored},
                    {"in", row.in},
                    {"out", row.out},
                    {"lost", row.dissipated},
                    {"error", row.error}});
  }
  return json;
}

Json summarize_energy(const results::History& history,
                      const dynamics::EnergyRecord& record) {
  Json json = Json::object();
  if (history.energies.empty()) return json;
  const results::EnergyError energy = results::find_energy_error(history);
  json["initial"] = energy.initial;
  json["final"] = energy.final;
  json["dissipated"] = energy.dissipated;
  json["work"] = energy.work;
  json["drift"] = energy.drift;
  json["throughput"] = energy.throughput;
  const std::optional<double> relative = energy.relative();
  json["relative_drift"] = relative ? Json(*relative) : Json(nullptr);
  json["largest_drift"] = describe_extreme(record.drift);
  json["open_share"] = dynamics::find_unbalanced_fraction(record.worst);
  json["place"] = record.worst.place;
  json["place_share"] = record.worst.place_error;
  json["rows"] = describe_rows(record.rows);
  json["peaks"] = {{"stored", describe_extreme(record.stored)},
                   {"kinetic", describe_extreme(record.kinetic)},
                   {"elastic", describe_extreme(record.elastic)},
                   {"coupler", describe_extreme(record.coupler)}};
  return json;
}

Json summarize_probes(const runs::Run& run) {
  const results::History& history = run.history;
  const std::vector<dynamics::Extreme>& peaks = run.record.peaks;
  const auto nodes = runs::find_peak_nodes(run.built, run.record);
  Json json = Json::object();
  if (history.probe_rows.empty()) return json;
  for (std::size_t i = 0; i < history.columns.size(); ++i) {
    Json probe = Json::object();
    probe["final"] = history.probe_rows.back()[i];
    if (!peaks.empty()) {
      probe["peak"] = peaks[i].value;
      probe["peak_time"] = peaks[i].time;
      if (nodes[i]) {
        probe["peak_node"] = nodes[i]->tag;
        if (!nodes[i]->layer.empty()) probe["peak_layer"] = nodes[i]->layer;
      }
    }
    probe["unit"] = history.columns[i].unit;
    json[history.columns[i].name] = probe;
  }
  return json;
}

// path -> value as given; null: removed.
Json describe_settings(const std::vector<scene::Setting>& settings) {
  Json json = Json::object();
  for (const scene::Setting& setting : settings) {
    json[setting.path] = setting.value ? Json(*setting.value) : Json(nullptr);
  }
  return json;
}

Json summarize_selections(const runs::Run& run) {
  Json json = Json::object();
  for (const dynamics::BodyModel& body : run.built.model.bodies) {
    if (!body.reduced || !body.reduced->selection) continue;
    json[body.name] = to_json(*body.reduced->selection);
  }
  return json;
}

// What determined the lengths of steps, and for which bodies and pairs.
Json summarize_limits(const runs::Run& run) {
  const dynamics::StepRecord& steps = run.record.steps;
  Json json{{"by", Json::array()},
            {"bodies", Json::object()},
            {"pairs", Json::object()}};
  for (std::size_t i = 0; i < steps.causes.size(); ++i) {
    const dynamics::StepRecord::Cause& cause = steps.causes[i];
    if (cause.count == 0.0) continue;
    json["by"].push_back(
        {{"limit", to_string(static_cast<dynamics::StepCause>(i))},
         {"count", cause.count},
         {"time", cause.time},
         {"shortest", cause.shortest}});
  }
  for (std::size_t b = 0; b < steps.of_body.size(); ++b) {
    if (steps.of_body[b] == 0.0) continue;
    json["bodies"][run.built.model.bodies[b].name] = steps.of_body[b];
  }
  for (std::size_t p = 0; p < steps.of_pair.size(); ++p) {
    if (steps.of_pair[p] == 0.0) continue;
    json["pairs"][run.built.model.pairs[p].name] = steps.of_pair[p];
  }
  return json;
}

// Estimates of the parts of the steps, such that their sum is what was
// measured.
Json summarize_times(const runs::Run& run) {
  const dynamics::StepTimes& times = run.record.times;
  const double steps = times.contact + times.newton + times.monitors;
  const double scale =
      steps > 0.0
          ? std::max(run.statistics.seconds - times.outputs, 0.0) / steps
          : 0.0;
  return Json{{"contact", scale * times.contact},
              {"Newton", scale * times.newton},
              {"monitors", scale * times.monitors},
              {"outputs", times.outputs}};
}

// Links that touch others by a mesh.
std::vector<std::string> find_meshed_links(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.robot.links.size(); ++i) {
    const scene::Link& link = scene.robot.links[i];
    const auto touches = [&](const scene::Toucher& body) {
      return !body.is_obstacle && body.index == i;
    };
    const bool is_meshed =
        link.flexible ||
        std::any_of(link.collisions.begin(), link.collisions.end(),
                    [](const scene::Collision& shape) {
                      return std::holds_alternative<scene::MeshGeometry>(
                          shape.geometry);
                    });
    if (is_meshed && std::any_of(scene.touching.begin(), scene.touching.end(),
                                 [&](const scene::TouchingPair& pair) {
                                   return touches(pair.A) || touches(pair.B);
                                 })) {
      names.push_back(link.name);
    }
  }
  return names;
}

// Why the run ended early.
void summarize_failure(const runs::Run& run, Json& json) {
  json["completed"] = run.failure == nullptr;
  json["interrupted"] = false;
  if (!run.failure) return;
  try {
    std::rethrow_exception(run.failure);
  } catch (const dynamics::Interrupted& end) {
    json["interrupted"] = true;
    json["failure"] = end.what();
  } catch (const std::exception& error) {
    json["failure"] = error.what();
  }
}

int count_modes(const runs::Run& run) { return run.built.model.modal_count; }

}  // namespace

Json summarize(const runs::Run& run) {
  Json json = Json::object();
  json["scenario"] = run.scene.scenario.file.string();
  const std::vector<scene::Setting>& settings = run.scene.overrides.settings;
  if (!settings.empty()) {
    json["settings"] = describe_settings(settings);
  }
  summarize_failure(run, json);
  json["reached"] = run.history.times.empty() ? 0.0 : run.history.times.back();
  json["end_time"] = run.built.settings.end_time;
  json["bodies"] = run.built.model.bodies.size();
  json["modes"] = count_modes(run);
  const Json selections = summarize_selections(run);
  if (!selections.empty()) json["automatic_modes"] = selections;
  for (const flexbody::PieceCheck& check : run.built.piece_checks) {
    json["pieces"][check.link] = to_json(check);
  }
  json["couplers"] = run.built.model.couplers.size();
  json["modes_exact"] = run.statistics.exact_modes;
  json["integrator"] = to_string(run.built.settings.integrator);
  json["step"] = run.built.settings.step;
  json["step_changes"] = run.built.settings.step_changes.size();
  json["steps"] = run.statistics.steps;
  json["newton_iterations"] = run.statistics.newton_iterations;
  json["steps_halved"] = run.statistics.halved_steps;
  json["step_limits"] = summarize_limits(run);
  if (run.built.settings.tolerance > 0.0) {
    json["steps_rejected"] = run.statistics.rejected_steps;
    json["tolerance_passes"] = to_string(run.built.settings.passes);
    json["passes"] = run.statistics.passes;
    json["tolerance"] = run.built.settings.tolerance;
    if (run.statistics.passes > 1) {
      json["estimated_error"] = run.statistics.estimated_error;
    }
  }
  // 0: not computed; infinite: nothing vibrates.
  const double stable_step = run.statistics.stable_step;
  if (stable_step > 0.0 && std::isfinite(stable_step)) {
    json["stable_step"] = stable_step;
  }
  json["seconds_offline"] = run.built.seconds_offline;
  json["seconds_online"] = run.statistics.seconds;
  json["seconds_by_part"] = summarize_times(run);
  json["bodies_reduced"] = run.built.bodies_reduced;
  json["bodies_cached"] = run.built.bodies_cached;
  json["energy"] = summarize_energy(run.history, run.record.energy);
  json["events"] = to_json(run.history.events);
  if (!run.built.model.pairs.empty()) {
    json["contacts"] = to_json(run.record.contacts);
    json["contact_meshes"] = find_meshed_links(run.scene);
  }
  json["probes"] = summarize_probes(run);
  if (run.scene.scenario.output.stress) {
    json["stress"] =
        to_json(runs::find_stress_peaks(run.built, run.history, run.record));
  }
  if (run.errors) json["errors"] = to_json(*run.errors);
  json["levels"] = Json::array();
  for (const runs::BodyLevel& level : run.levels) {
    json["levels"].push_back(to_json(level));
  }
  json["notes"] = run.built.notes;
  json["warnings"] = run.built.warnings;
  for (const auto& texts : {run.statistics.warnings, run.given_warnings}) {
    for (const std::string& text : texts) json["warnings"].push_back(text);
  }
  return json;
}

}  // namespace limber::app
