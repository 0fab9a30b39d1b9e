// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "limber/common/errors.hpp"
#include "limber/results/energy_error.hpp"
#include "limber/runs/timed_reducer.hpp"
#include "limber/runs/unused_cache.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/probes/stress_points.hpp"

namespace limber::runs {
namespace {

constexpr int kMostRepeats = 1000;

std::string text_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const NumericalError& error) {
    return error.what();
  }
}

std::map<std::string, ProbeDifference> find_probe_differences(
    const results::History& history, const results::History& reference) {
  std::vector<ProbeDifference> found(reference.columns.size());
  const std::size_t count =
      std::min(history.probe_rows.size(), reference.probe_rows.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double> row = history.probe_rows[i];
    const std::vector<double> reference_row = reference.probe_rows[i];
    for (std::size_t c = 0; c < found.size(); ++c) {
      const double d = row[c] - reference_row[c];
      found[c].rms += d * d / static_cast<double>(count);
      found[c].max = std::max(found[c].max, std::abs(d));
    }
  }
  std::map<std::string, ProbeDifference> differences;
  for (std::size_t c = 0; c < found.size(); ++c) {
    found[c].unit = reference.columns[c].unit;
    found[c].rms = std::sqrt(found[c].rms);
    differences[reference.columns[c].name] = found[c];
  }
  return differences;
}

/// Runs scenes one after another, on one set of output times.
class Runner {
 public:
  Runner(const ComparisonPlan& plan, const ComparisonSettings& settings)
      : plan_(plan), settings_(settings) {
    double longest = 0.0;
    for (const Choice& choice : plan.runs) {
      longest = std::max(longest, choice.step.value_or(0.0));
      total_ += estimate_cost(choice, plan.reference);
    }
    times_ = thin_times(
        scene::load_scene(settings.scenario, {.settings = settings.settings})
            .scenario.settings.output_times,
        longest);
  }

  Comparison run() {
    Comparison comparison;
    comparison.scenario = settings_.scenario;
    comparison.reference_note = describe_default_reference(plan_);
    const Run reference = simulate(plan_.reference);
    keep(plan_.reference, reference);
    if (reference.failure) std::rethrow_exception(reference.failure);
    comparison.reference = assess(plan_.reference, reference, reference);
    for (const Choice& choice : plan_.runs) {
      comparison.runs.push_back(compare(choice, reference));
    }
    return comparison;
  }

 private:
  ComparedRun compare(const Choice& choice, const Run& reference) {
    try {
      const Run run = simulate(choice);
      keep(choice, run);
      return assess(choice, run, reference);
    } catch (const NumericalError& error) {
      // Failed before the start: its reduction, or its initial state.
      ComparedRun none;
      none.choice = choice;
      none.stopped = fmt::format("stopped before the start: {}", error.what());
      return none;
    }
  }

  Run simulate(const Choice& choice) {
    scene::Overrides overrides = to_overrides(choice, settings_.settings);
    overrides.rows = flexbody::KeptRows{flexbody::KeptRows::Extent::all, {}};
    scene::Scene scene = scene::load_scene(settings_.scenario, overrides);
    scene.scenario.settings.output_times = times_;
    if (!have_all_stress() && leave_out_stress(scene.scenario)) {
      warn({"stress is not compared: not every one of these levels has it"});
    }
    ++started_;
    const double cost = estimate_cost(choice, plan_.reference);
    const Progress progress = [this, cost](std::string_view what,
                                           double fraction) {
      report(settings_.watch, what, fraction);
      report_run(what, cost, fraction);
    };
    RunOptions options;
    options.reductions = make_reductions(progress);
    options.progress = progress;
    options.judges_levels = settings_.judges_levels;
    PicturedScene made = build_pictured(scene, options.reductions);
    warn_of_unused_cache(options.reductions.cache, made.built);
    made.built.settings.tolerance *= choice.tolerance_fraction;
    Run run = simulate_pictured(scene, std::move(made), options);
    done_ += cost;
    note(scene, run.built.notes);
    warn(run.built.warnings);
    return run;
  }

  /// All runs have the same probes.
  [[nodiscard]] bool have_all_stress() const {
    return scene::has_stress(plan_.reference.level) &&
           std::all_of(plan_.runs.begin(), plan_.runs.end(),
                       [](const Choice& choice) {
                         return scene::has_stress(choice.level);
                       });
  }

  /// Progress over all simulations of the plan together; other work unchanged.
  void report_run(std::string_view what, double cost, double fraction) const {
    const std::size_t count = plan_.runs.size() + 1;
    if (what == "simulating") {
      report(settings_.progress, fmt::format("all {} runs", count),
             (done_ + cost * fraction) / total_);
      return;
    }
    report(settings_.progress,
           fmt::format("run {} of {}, {}", started_, count, what), fraction);
  }

  void report_repeat(int again, double fraction) const {
    if (settings_.repeats < 2) return;  // short: until they take kEnough
    report(settings_.progress,
           fmt::format("run {} of {}, timed again", started_,
                       plan_.runs.size() + 1),
           (again - 1 + fraction) / (settings_.repeats - 1));
  }

  /// Records how long each reduction takes.
  Reductions make_reductions(const Progress& progress) {
    if (!settings_.make_reductions) return {};
    Reductions reductions = settings_.make_reductions(progress);
    reductions.reducer = time_reductions(
        reductions.reducer, [this](const std::string& key, double seconds) {
          reduction_seconds_[key] = seconds;
        });
    return reductions;
  }

  void note(const scene::Scene& scene, const std::vector<std::string>& notes) {
    for (const std::string& text : notes) {
      if (noted_.insert(text).second && settings_.note) {
        settings_.note(scene, text);
      }
    }
  }

  void warn(const std::vector<std::string>& warnings) {
    for (const std::string& text : warnings) {
      if (warned_.insert(text).second && settings_.warn) settings_.warn(text);
    }
  }

  void keep(const Choice& choice, const Run& run) const {
    if (settings_.keep) settings_.keep(choice, run);
  }

  ComparedRun assess(const Choice& choice, const Run& run,
                     const Run& reference) const {
    ComparedRun result;
    result.choice = choice;
    result.cost = find_cost(run);
    result.energy_drift =
        results::find_energy_error(run.history).relative_largest();
    result.contacts = sum_up(run.record.contacts);
    result.history.columns = run.history.columns;
    result.history.times = run.history.times;
    result.history.probe_rows = run.history.probe_rows;
    if (run.failure) {
      result.stopped = fmt::format("stopped: {}", text_of(run.failure));
      return result;
    }
    result.probes = find_probe_differences(run.history, reference.history);
    result.error = results::calc_motion_error(
        {run.built.model, run.history.states},
        {reference.built.model, reference.history.states});
    return result;
  }

  Cost find_cost(const Run& run) const {
    Cost cost;
    cost.steps = run.statistics.steps;
    cost.newton_iterations = run.statistics.newton_iterations;
    cost.modes = run.built.model.modal_count;
    cost.offline = find_offline(run);
    double least = run.statistics.seconds;
    double total = least;
    cost.repeats = 1;
    const auto is_enough = [&] {
      if (settings_.repeats > 0) return cost.repeats >= settings_.repeats;
      return total >= kEnough || cost.repeats >= kMostRepeats;
    };
    while (!run.failure && !is_enough()) {
      const int again = cost.repeats;
      const double seconds =
          repeat_timing(run, [&](std::string_view what, double fraction) {
            report(settings_.watch, what, fraction);
            report_repeat(again, fraction);
          });
      least = std::min(least, seconds);
      total += seconds;
      ++cost.repeats;
    }
    cost.online = least / run.scene.scenario.settings.end_time;
    return cost;
  }

  /// Counts each distinct body once.
  std::optional<double> find_offline(const Run& run) const {
    std::set<std::string> keys;
    for (const dynamics::BodyModel& body : run.built.model.bodies) {
      if (body.reduced) keys.insert(body.reduced->content_key);
    }
    double seconds = 0.0;
    for (const std::string& key : keys) {
      const auto found = reduction_seconds_.find(key);
      if (found == reduction_seconds_.end()) return std::nullopt;
      seconds += found->second;
    }
    return seconds;
  }

  const ComparisonPlan& plan_;
  const ComparisonSettings& settings_;
  std::vector<double> times_;
  std::size_t started_ = 0;
  double done_ = 0.0;   ///< costs of runs, the reference's is 1
  double total_ = 1.0;  ///< of all runs
  std::map<std::string, double> reduction_seconds_;  ///< by content key
  std::set<std::string> warned_;
  std::set<std::string> noted_;
};

}  // namespace

Comparison compare_runs(const ComparisonPlan& plan,
                        const ComparisonSettings& settings) {
  return Runner(plan, settings).run();
}

std::vector<double> thin_times(const std::vector<double>& times,
                               double longest) {
  if (times.empty()) return times;
  constexpr double kRoundoff = 1e-9;
  std::vector<double> thinned = {times.front()};
  for (const double t : times) {
    if (t - thinned.back() >= longest * (1.0 - kRoundoff) &&
        t > thinned.back()) {
      thinned.push_back(t);
    }
  }
  if (thinned.back() < times.back()) thinned.push_back(times.back());
  return thinned;
}

}  // namespace limber::runs
