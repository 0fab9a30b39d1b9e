// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/time_settings_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"

namespace limber::scene {
namespace {

/// Largest number of output times, which are kept in memory.
constexpr double kMostOutputs = 1e7;
/// Default number of outputs of a run to a tolerance, whose steps are unknown.
constexpr double kOutputsOfTolerance = 200.0;

std::vector<double> even_times(double end, double interval) {
  std::vector<double> times;
  // A last interval shorter than a millionth of the others is round-off.
  const auto count = static_cast<long>(std::floor(end / interval + 1e-6));
  for (long i = 0; i <= count; ++i) {
    times.push_back(std::min(static_cast<double>(i) * interval, end));
  }
  if (end - times.back() > 1e-6 * interval) times.push_back(end);
  times.back() = end;
  return times;
}

/// The end of every step.
std::vector<double> step_times(const dynamics::SimulationSettings& settings) {
  std::vector<double> times = {0.0};
  double step = settings.step;
  const auto fill = [&](double until) {
    const double from = times.back();
    for (const double t : even_times(until - from, step)) {
      if (t > 0.0) times.push_back(from + t);
    }
    times.back() = until;
  };
  for (const dynamics::StepChange& change : settings.step_changes) {
    if (change.from < settings.end_time) fill(change.from);
    step = change.step;
  }
  fill(settings.end_time);
  return times;
}

double count_steps(const dynamics::SimulationSettings& settings) {
  double count = 0.0;
  double from = 0.0;
  double step = settings.step;
  for (const dynamics::StepChange& change : settings.step_changes) {
    count += (change.from - from) / step;
    from = change.from;
    step = change.step;
  }
  return count + (settings.end_time - from) / step;
}

// A step ends at every output.
void check_steps(double interval, const dynamics::SimulationSettings& settings,
                 std::vector<std::string>& warnings) {
  constexpr double kSame = 1e-9;
  if (settings.tolerance > 0.0) return;
  const double longest = dynamics::find_longest_step(settings);
  if (!(longest > interval * (1.0 + kSame))) return;
  warnings.push_back(fmt::format(
      "[time] a step of {:g} s is longer than output_interval, {:g} s: steps "
      "end at every output, and are no longer than that",
      longest, interval));
}

void check_interval(double interval, double duration,
                    std::vector<std::string>& warnings) {
  if (interval <= duration) return;
  warnings.push_back(fmt::format(
      "[time] output_interval, {:g} s, is longer than the run of {:g} s: its "
      "start and end are the only outputs; is it in seconds?",
      interval, duration));
}

std::vector<double> read_output_times(
    TomlTable& table, const dynamics::SimulationSettings& settings,
    std::vector<std::string>& warnings) {
  const double end = settings.end_time;
  const auto times = table.numbers("output_times", {0.0, end, false, false});
  const auto interval = table.number("output_interval", kPositive);
  if (times && interval) {
    table.fail("has both 'output_times' and 'output_interval'; keep one");
  }
  if (interval) {
    check_steps(*interval, settings, warnings);
    check_interval(*interval, end, warnings);
  }
  if (!times && !interval && settings.tolerance > 0.0) {
    return even_times(end, end / kOutputsOfTolerance);
  }
  if (!times) {
    const double count = interval ? end / *interval : count_steps(settings);
    if (count > kMostOutputs) {
      table.fail(
          fmt::format("requests {:.3g} output times, more than {:g}; use a "
                      "longer output_interval",
                      count, kMostOutputs));
      return {0.0, end};
    }
    return interval ? even_times(end, *interval) : step_times(settings);
  }
  for (std::size_t i = 1; i < times->size(); ++i) {
    if ((*times)[i] <= (*times)[i - 1]) {
      table.fail("output_times", "must increase");
      break;
    }
  }
  if (times->empty()) table.fail("output_times", "is empty");
  return *times;
}

dynamics::TolerancePasses parse_passes(std::string_view name) {
  static const std::vector<std::string> names = {
      dynamics::kTolerancePasses.begin(), dynamics::kTolerancePasses.end()};
  return static_cast<dynamics::TolerancePasses>(
      find_name("tolerance_passes", name, names));
}

/// Nothing, for a tolerance to be chosen; a `tolerance`, with the longest step
/// if there is one; one `step`; or `steps
/// = { from = [...], size = [...] }`: from each time on the step of that size,
/// the first from the start.
void read_step_settings(TomlTable& table,
                        dynamics::SimulationSettings& settings) {
  const toml::table* steps = table.table("steps");
  settings.tolerance = table.number("tolerance", kPositive).value_or(0.0);
  settings.passes =
      read_name(table, "tolerance_passes", settings.passes, &parse_passes);
  if (steps == nullptr && table.has("tolerance")) {
    settings.step = table.number("step", kPositive).value_or(settings.end_time);
    return;
  }
  if (steps == nullptr && table.has("step")) {
    settings.step = table.required_number("step", kPositive);
    return;
  }
  if (steps == nullptr) {
    settings.step = settings.end_time;
    settings.tolerance = kToleranceToChoose;
    return;
  }
  if (table.number("step", kPositive)) {
    table.fail("has both 'step' and 'steps'; keep one");
  }
  TomlTable changes(*steps, "time.steps", table.problems());
  const auto from =
      changes.numbers("from", {0.0, settings.end_time, false, false});
  const auto size = changes.numbers("size", kPositive);
  changes.finish();
  settings.step = settings.end_time;
  if (!from || !size || from->empty() || from->size() != size->size() ||
      from->front() != 0.0) {
    changes.fail(
        "needs 'from', times that begin with 0, and 'size', a step for each");
    return;
  }
  settings.step = size->front();
  for (std::size_t i = 1; i < from->size(); ++i) {
    if ((*from)[i] <= (*from)[i - 1]) {
      changes.fail("from", "must increase");
      return;
    }
    settings.step_changes.push_back({(*from)[i], (*size)[i]});
  }
}

}  // namespace

dynamics::SimulationSettings read_time_settings(
    TomlTable& table, std::vector<std::string>& warnings) {
  dynamics::SimulationSettings settings;
  settings.end_time = table.required_number("duration", kPositive);
  read_step_settings(table, settings);
  settings.integrator = read_name(table, "integrator", settings.integrator,
                                  &dynamics::parse_integrator);
  if (settings.tolerance == kToleranceToChoose &&
      !dynamics::traits_of(settings.integrator).is_adaptive) {
    settings.tolerance = 0.0;
    settings.step = table.required_number("step", kPositive);
  }
  settings.rho_inf = table.number("rho_inf", {0.0, 1.0, false, false})
                         .value_or(settings.rho_inf);
  settings.newton_tolerance =
      table.number("newton_tolerance", {0.0, 1.0, true, true})
          .value_or(settings.newton_tolerance);
  settings.newton_iterations = table.integer("newton_iterations", 1, 10000)
                                   .value_or(settings.newton_iterations);
  settings.impact_steps =
      table.number("impact_steps", {4.0, 1000.0, false, false})
          .value_or(settings.impact_steps);
  settings.most_steps = table.integer("most_steps", 1, 1'000'000'000)
                            .value_or(settings.most_steps);
  settings.exact_modes =
      table.boolean("exact_modes").value_or(settings.exact_modes);
  settings.output_times = read_output_times(table, settings, warnings);
  return settings;
}

}  // namespace limber::scene
