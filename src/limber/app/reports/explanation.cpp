// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/app/reports/event_report.hpp"
#include "limber/app/reports/next_steps.hpp"

namespace limber::app {
namespace {

using dynamics::EnergyRow;

constexpr std::size_t kMostCarriers = 3;
constexpr std::size_t kMostWarnings = 3;
constexpr std::size_t kMostEvents = 12;

const char* name_of(RunEnd end) {
  switch (end) {
    case RunEnd::finished:
      return "finished";
    case RunEnd::failed:
      return "failed";
    case RunEnd::stopped:
      return "stopped";
    case RunEnd::killed:
      return "killed";
  }
  return "";
}

double find_carried(const EnergyRow& row) { return std::max(row.in, row.out); }

/// Couplers and pairs, those that carried most energy first.
std::vector<EnergyRow> find_carriers(const RunSummary& run) {
  std::vector<EnergyRow> rows;
  for (const EnergyRow& row : run.rows) {
    if (!row.name.starts_with("body ")) rows.push_back(row);
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const EnergyRow& a, const EnergyRow& b) {
                     return find_carried(a) > find_carried(b);
                   });
  return rows;
}

std::string describe_limit(const std::string& by, const RunSummary& run) {
  const auto most = [](const std::map<std::string, double>& counts) {
    return counts.empty() ? "" : fmt::format(" '{}'", find_most(counts));
  };
  if (by == "given") {
    return fmt::format("as given, {:.3g} s at most", run.step);
  }
  if (by == "tolerance") {
    return fmt::format("by the tolerance of {:.3g} m, most for the motion of{}",
                       run.tolerance, most(run.by_body));
  }
  if (by == "rotation") return "by a body's rotation";
  if (by == "oscillation") return "by the period of a load or command";
  if (by == "breakpoint") return "by outputs, samples and jumps of loads";
  if (by == "impact") {
    return "to resolve impacts, most of" + most(run.by_pair);
  }
  if (by == "event") return "cut at events";
  if (by == "failure") return "halved, as longer ones failed";
  return by;
}

std::string describe_end(const RunSummary& run) {
  std::string text = fmt::format("{}: {}", run.folder, name_of(run.end));
  text += fmt::format(", {:.6g} s", run.reached);
  if (run.end != RunEnd::finished && run.end_time > 0.0) {
    text += fmt::format(" of {:.6g} s", run.end_time);
  }
  if (run.end == RunEnd::killed) return text + " at its last checkpoint\n";
  text += fmt::format(" in {} steps, {:.3g} s of time, {:.3g} s before them\n",
                      run.steps, run.seconds, run.seconds_offline);
  if (!run.failure.empty()) text += fmt::format("cause     {}\n", run.failure);
  return text;
}

std::string describe_steps(const RunSummary& run) {
  std::vector<RunSummary::Steps> limits = run.limits;
  std::stable_sort(
      limits.begin(), limits.end(),
      [](const auto& a, const auto& b) { return a.count > b.count; });
  const double all = count_parts(run);
  std::string text;
  for (const RunSummary::Steps& limit : limits) {
    text +=
        fmt::format("{:<9} {:5.1f} % {}", text.empty() ? "steps" : "",
                    100.0 * limit.count / all, describe_limit(limit.by, run));
    // An event where another step ends has a step of no length.
    if (limit.shortest > 0.0) {
      text += fmt::format(", shortest {:.3g} s", limit.shortest);
    }
    text += "\n";
  }
  if (run.halved > 0) {
    text += fmt::format("          {} times a step was halved\n", run.halved);
  }
  if (run.rejected > 0) {
    text += fmt::format("          {} steps were rejected by their error\n",
                        run.rejected);
  }
  if (run.steps > 0 && run.iterations > 0) {
    text += fmt::format(
        "          {:.2f} Newton iterations a step\n",
        static_cast<double>(run.iterations) / static_cast<double>(run.steps));
  }
  return text;
}

std::string describe_events(const RunSummary& run) {
  if (run.events.empty()) return "events    none\n";
  if (run.events.size() > kMostEvents) {
    double iterations = 0.0;
    for (const dynamics::Event& event : run.events) {
      iterations += event.iterations;
    }
    return to_text(run.events) +
           fmt::format("          {:.2f} iterations each to locate them\n",
                       iterations / static_cast<double>(run.events.size()));
  }
  std::string text;
  for (const dynamics::Event& event : run.events) {
    text += fmt::format("{:<9} {:.6g} s '{}' {}", text.empty() ? "events" : "",
                        event.time, event.source, event.what);
    if (event.iterations > 0) {
      text += fmt::format(", {} iteration{} to locate it", event.iterations,
                          event.iterations == 1 ? "" : "s");
    }
    text += "\n";
  }
  return text;
}

std::string describe_time(const RunSummary& run) {
  const auto newton = run.parts.find("Newton");
  const bool is_measured = newton != run.parts.end() && newton->second > 0.0;
  if (!(run.seconds > 0.0) || !is_measured) return "";
  std::vector<std::pair<std::string, double>> parts(run.parts.begin(),
                                                    run.parts.end());
  std::stable_sort(
      parts.begin(), parts.end(),
      [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, seconds] : parts) {
    if (!(seconds > 0.0)) continue;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name,
                        100.0 * seconds / run.seconds);
  }
  return "time      " + text + "\n";
}

std::string describe_energy(const RunSummary& run) {
  std::string text;
  const std::vector<EnergyRow> carriers = find_carriers(run);
  for (const EnergyRow& row : carriers) {
    if (!(find_carried(row) > 0.0) ||
        &row - carriers.data() == static_cast<std::ptrdiff_t>(kMostCarriers)) {
      break;
    }
    text +=
        fmt::format("{:<9} {} took {:.3g} J, gave {:.3g} J, lost {:.3g} J\n",
                    text.empty() ? "energy" : "", row.name, row.in, row.out,
                    row.dissipated);
  }
  if (run.unbalanced_fraction) {
    text += fmt::format(
        "{:<9} {}\n", text.empty() ? "energy" : "",
        *run.unbalanced_fraction > 0.0
            ? fmt::format("error {:.1e} of the throughput, most in {}",
                          *run.unbalanced_fraction, run.open_place)
            : "error within round-off");
  }
  return text;
}

std::string describe_next(const RunSummary& run) {
  std::string text;
  int i = 0;
  for (const NextStep& step : find_next_steps(run)) {
    text += fmt::format("{:<9} {}. {}\n             {}\n", i == 0 ? "try" : "",
                        i + 1, step.what, step.why);
    ++i;
  }
  return text.empty() ? "try       no suggestions from this record\n" : text;
}

std::string describe_warnings(const RunSummary& run) {
  std::string text;
  for (std::size_t i = 0; i < std::min(run.warnings.size(), kMostWarnings);
       ++i) {
    text += fmt::format("warning   {}\n", run.warnings[i]);
  }
  if (run.warnings.size() > kMostWarnings) {
    text += fmt::format("          and {} more (--json)\n",
                        run.warnings.size() - kMostWarnings);
  }
  return text;
}

}  // namespace

Json explain(const RunSummary& run) {
  Json json{
      {"folder", run.folder},
      {"scenario", run.scenario},
      {"status", name_of(run.end)},
      {"cause", run.failure.empty() ? Json(nullptr) : Json(run.failure)},
      {"reached", run.reached},
      {"steps", run.steps},
      {"newton_iterations", run.iterations},
      {"steps_halved", run.halved},
      {"steps_rejected", run.rejected},
      {"limits", Json::array()},
      {"limits_by_body", run.by_body},
      {"limits_by_pair", run.by_pair},
      {"events", to_json(run.events)},
      {"seconds", run.seconds},
      {"seconds_by_part", run.parts},
      {"energy_error", run.unbalanced_fraction ? Json(*run.unbalanced_fraction)
                                               : Json(nullptr)},
      {"carried", Json::array()},
      {"warnings", run.warnings},
      {"try", Json::array()}};
  for (const RunSummary::Steps& limit : run.limits) {
    json["limits"].push_back({{"limit", limit.by},
                              {"count", limit.count},
                              {"time", limit.time},
                              {"shortest", limit.shortest}});
  }
  for (const EnergyRow& row : find_carriers(run)) {
    json["carried"].push_back({{"name", row.name},
                               {"in", row.in},
                               {"out", row.out},
                               {"lost", row.dissipated},
                               {"stored", row.stored}});
  }
  for (const NextStep& step : find_next_steps(run)) {
    json["try"].push_back({{"what", step.what}, {"why", step.why}});
  }
  return json;
}

std::string to_text(const RunSummary& run) {
  return describe_end(run) + describe_steps(run) + describe_events(run) +
         describe_time(run) + describe_energy(run) + describe_warnings(run) +
         describe_next(run);
}

}  // namespace limber::app
