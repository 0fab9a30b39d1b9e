// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/compare/comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/app/compare/contact_comparison.hpp"
#include "limber/app/console/json.hpp"
#include "limber/common/percent.hpp"
#include "limber/runs/compare/comparison_selection.hpp"

namespace limber::app {
namespace {

/// Null: the scenario's.
Json to_json(const std::optional<dynamics::IntegratorKind>& kind) {
  if (!kind) return nullptr;
  return dynamics::to_string(*kind);
}

Json to_json(const results::FieldError& error) {
  return Json{{"relative", or_null(error.relative())},
              {"relative_max", or_null(error.relative_max())},
              {"rms", error.rms},
              {"max", error.max},
              {"reference", error.reference}};
}

Json to_json(const results::MotionError& error, bool has_nodes) {
  Json json = Json::object();
  if (has_nodes) json["displacement"] = to_json(error.displacement);
  json["rigid"] = to_json(error.rigid);
  if (has_nodes) json["deformation"] = to_json(error.deformation);
  return json;
}

Json to_json(const scene::BasisChoice& basis) {
  Json json = Json::object();
  if (basis.eigenmodes) json["eigenmodes"] = *basis.eigenmodes;
  const std::string sources = runs::find_source_name(basis);
  if (!sources.empty()) json["sources"] = sources;
  return json;
}

/// The body whose error is the largest, with that error.
std::string find_worst(const results::SystemMotionError& error) {
  const results::BodyMotionError* worst = nullptr;
  double most = -1.0;
  for (const results::BodyMotionError& body : error.bodies) {
    const auto own = find_error(body.error, runs::ErrorMeasure::both);
    if (!own || *own <= most) continue;
    worst = &body;
    most = *own;
  }
  if (worst == nullptr) return "none";
  return fmt::format("{} {}", to_percent(most), worst->name);
}

std::string to_percent_pair(const results::FieldError& error) {
  if (!error.relative()) return "none";
  return fmt::format("{} ({})", to_percent(error.relative()),
                     to_percent(error.relative_max()));
}

using Cells = std::vector<std::string>;

const Cells kHeader = {"run",         "modes",      "displacement", "rigid",
                       "deformation", "worst body", "drift",        "online",
                       "cheaper",     "offline"};

Cells make_cells(const runs::ComparedRun& run, double reference_cost) {
  Cells cells = {describe(run.choice), fmt::format("{}", run.cost.modes)};
  if (run.error) {
    const results::MotionError& error = run.error->error;
    cells.push_back(to_percent_pair(error.displacement));
    cells.push_back(to_percent_pair(error.rigid));
    cells.push_back(to_percent_pair(error.deformation));
    cells.push_back(find_worst(*run.error));
  } else {
    cells.insert(cells.end(), {"stopped", "", "", ""});
  }
  cells.push_back(run.energy_drift ? fmt::format("{:.1e}", *run.energy_drift)
                                   : "none");
  cells.push_back(fmt::format("{:.3g}", run.cost.online));
  cells.push_back(run.cost.online > 0.0 && run.error
                      ? fmt::format("{:.3g}", reference_cost / run.cost.online)
                      : "");
  cells.push_back(run.cost.offline ? fmt::format("{:.2g} s", *run.cost.offline)
                                   : "cached");
  return cells;
}

std::string align(const std::vector<Cells>& rows) {
  std::vector<std::size_t> widths(kHeader.size(), 0);
  for (const Cells& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], row[c].size());
    }
  }
  std::string text;
  for (const Cells& row : rows) {
    std::string line = fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t c = 1; c < row.size(); ++c) {
      line += fmt::format("  {:>{}}", row[c], widths[c]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string list_contacts(const runs::Comparison& comparison) {
  std::vector<NamedContacts> runs;
  for (const runs::ComparedRun& run : comparison.runs) {
    runs.push_back({describe(run.choice), run.contacts});
  }
  const std::string text =
      to_text(runs, {"reference: " + describe(comparison.reference.choice),
                     comparison.reference.contacts});
  return text.empty() ? "" : "\n" + text + "\n";
}

}  // namespace

Json to_json(const runs::ComparedRun& run, const runs::ComparedRun* reference) {
  Json json{{"name", describe(run.choice)},
            {"fidelity", std::string(to_string(run.choice.level))},
            {"basis", to_json(run.choice.basis)},
            {"step", or_null(run.choice.step)},
            {"tolerance_share", run.choice.tolerance_fraction},
            {"integrator", to_json(run.choice.integrator)},
            {"completed", run.stopped.empty()}};
  if (!run.stopped.empty()) json["stopped"] = run.stopped;
  json["modes"] = run.cost.modes;
  json["steps"] = run.cost.steps;
  json["newton_iterations"] = run.cost.newton_iterations;
  json["online"] = run.cost.online;
  json["repeats"] = run.cost.repeats;
  json["seconds_offline"] = or_null(run.cost.offline);
  json["energy_drift"] = or_null(run.energy_drift);
  if (run.error) {
    json["error"] = to_json(run.error->error, true);
    json["bodies"] = Json::object();
    for (const results::BodyMotionError& body : run.error->bodies) {
      json["bodies"][body.name] = to_json(body.error, body.has_nodes);
    }
  }
  json["contacts"] = to_json(
      run.contacts, reference == nullptr ? nullptr : &reference->contacts);
  json["difference"] = Json::object();
  for (const auto& [name, d] : run.probes) {
    json["difference"][name] =
        Json{{"rms", d.rms}, {"max", d.max}, {"unit", d.unit}};
  }
  return json;
}

Json to_json(const runs::Comparison& comparison) {
  Json runs = Json::array();
  for (const runs::ComparedRun& run : comparison.runs) {
    runs.push_back(to_json(run, &comparison.reference));
    const double cost = run.cost.online;
    runs.back()["times_cheaper"] =
        cost > 0.0 ? Json(comparison.reference.cost.online / cost)
                   : Json(nullptr);
  }
  Json json{{"scenario", comparison.scenario.string()},
            {"reference", to_json(comparison.reference, nullptr)},
            {"runs", runs}};
  if (!comparison.reference_note.empty()) {
    json["reference"]["note"] = comparison.reference_note;
  }
  return json;
}

std::string to_text(const runs::Comparison& comparison) {
  std::vector<Cells> rows = {kHeader};
  const double cost = comparison.reference.cost.online;
  for (const runs::ComparedRun& run : comparison.runs) {
    rows.push_back(make_cells(run, cost));
  }
  rows.push_back(make_cells(comparison.reference, cost));
  for (std::size_t c = 2; c <= 5; ++c) rows.back()[c] = "";
  rows.back()[2] = "reference";
  std::string text = align(rows);
  for (const runs::ComparedRun& run : comparison.runs) {
    if (run.stopped.empty()) continue;
    text += fmt::format("'{}' {}\n", describe(run.choice), run.stopped);
  }
  text += list_contacts(comparison);
  if (!comparison.reference_note.empty()) {
    text += comparison.reference_note + "\n";
  }
  return text +
         "Errors: RMS over nodes and times (largest over times), relative to "
         "the reference's.\nOnline: wall time per simulated time. Drift: "
         "energy error relative to the throughput.\n";
}

}  // namespace limber::app
