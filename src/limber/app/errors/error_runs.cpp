// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/errors/error_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "limber/app/errors/error_causes.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/monitors/energy_verdict.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/library_lock.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::app {
namespace {

/// Columns of these names; none if one is missing.
std::vector<runs::ColumnValues> take_columns(
    const runs::Run& run, const std::vector<std::string>& names) {
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find_if(
        run.history.columns.begin(), run.history.columns.end(),
        [&](const results::ProbeColumn& one) { return one.name == name; });
    if (found == run.history.columns.end()) return {};
    places.push_back(
        static_cast<std::size_t>(found - run.history.columns.begin()));
  }
  std::vector<runs::ColumnValues> columns(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] >= run.record.peaks.size()) continue;
    columns[k].peak = run.record.peaks[places[k]].value;
  }
  for (const std::vector<double>& row : run.history.probe_rows) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      columns[k].curve.push_back(row[places[k]]);
    }
  }
  return columns;
}

/// What work throws; empty where it does not. @throws Interrupted
std::string try_to(const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const dynamics::Interrupted&) {
    throw;
  } catch (const InputError& error) {
    return error.problems().front();
  } catch (const std::exception& error) {
    return error.what();
  }
}

/// A scene that is ready to run, or why not.
struct Made {
  runs::ErrorRun run;
  scene::Scene scene;
  std::optional<scene::BuiltScene> built;
};

class Estimator {
 public:
  Estimator(const runs::Run& own, const std::filesystem::path& cache,
            const Progress& progress)
      : own_(own), cache_(cache), progress_(progress) {
    for (const results::ProbeColumn& column : own_.history.columns) {
      names_.push_back(column.name);
      units_.push_back(column.unit);
    }
  }

  runs::ErrorTable estimate() {
    ErrorCauses found = find_error_causes(own_);
    const std::size_t count = found.causes.size();
    std::vector<Made> all;
    {
      const auto lock = runs::lock_libraries();
      for (const ErrorCause& cause : found.causes) all.push_back(make(cause));
      if (const auto joined = join_causes(found.causes)) {
        all.push_back(make(*joined));
      }
    }
    run_all(all);
    std::optional<runs::ErrorRun> together;
    if (all.size() > count) together = std::move(all.back().run);
    std::vector<runs::ErrorRun> runs;
    for (std::size_t i = 0; i < count; ++i) {
      runs.push_back(std::move(all[i].run));
    }
    runs::ErrorTable table = runs::compare_causes(
        names_, units_, take_columns(own_, names_), std::move(runs), together);
    table.unknown.insert(table.unknown.end(), found.unknown.begin(),
                         found.unknown.end());
    return table;
  }

 private:
  /// Reduces its bodies, one scene after the other.
  Made make(const ErrorCause& cause) {
    Made made{{cause.name, cause.finer, cause.factor, 0.0, "", {}}, {}, {}};
    made.run.failure = try_to([&] {
      made.scene = scene::load_scene(
          own_.scene.scenario.file,
          scene::merge(own_.scene.overrides, cause.overrides));
      made.scene.scenario.settings.output_times =
          own_.scene.scenario.settings.output_times;
      made.built = scene::build_system(made.scene, make_reducer(progress_),
                                       cache_, make_full_maker(progress_));
    });
    return made;
  }

  /// In threads, while this one shows the progress and may end them.
  void run_all(std::vector<Made>& all) {
    done_.assign(all.size(), 0.0);
    std::atomic<std::size_t> next = 0;
    std::atomic<std::size_t> ended = 0;
    const auto work = [&] {
      for (std::size_t i = next++; i < all.size(); i = next++) {
        try {
          simulate(i, all[i]);
        } catch (const dynamics::Interrupted&) {
          break;
        }
        ++ended;
      }
    };
    std::vector<std::thread> pool;
    const std::size_t threads = std::min<std::size_t>(
        all.size(), std::max(1U, std::thread::hardware_concurrency()));
    for (std::size_t i = 0; i < threads; ++i) pool.emplace_back(work);
    const auto join = [&] {
      for (std::thread& thread : pool) thread.join();
    };
    try {
      constexpr auto kRefresh = std::chrono::milliseconds(50);
      while (ended < all.size()) {
        std::this_thread::sleep_for(kRefresh);
        show();
      }
    } catch (...) {
      stops_ = true;
      join();
      throw;
    }
    join();
  }

  void simulate(std::size_t index, Made& made) {
    if (!made.built) return;
    made.run.failure = try_to([&] {
      runs::RunOptions options;
      options.progress = [&](std::string_view what, double fraction) {
        if (stops_) throw dynamics::Interrupted("interrupted");
        if (what == "simulating") note(index, fraction);
      };
      const runs::Run run =
          runs::simulate_built(made.scene, std::move(*made.built), options);
      made.run.seconds = run.statistics.seconds;
      if (run.failure) std::rethrow_exception(run.failure);
      if (auto open = find_imbalance(run.record.energy.worst,
                                     own_.record.energy.worst)) {
        throw NumericalError(*open);
      }
      if (run.history.times.size() != own_.history.times.size()) {
        throw InputError("it has other outputs");
      }
      if (made.run.name == "step" &&
          run.statistics.steps <= own_.statistics.steps) {
        throw InputError("it takes no more steps");
      }
      made.run.columns = take_columns(run, names_);
      if (made.run.columns.empty()) throw InputError("it has other probes");
    });
  }

  void note(std::size_t index, double fraction) {
    const std::lock_guard lock(mutex_);
    done_[index] = fraction;
  }

  void show() {
    double sum = 0.0;
    {
      const std::lock_guard lock(mutex_);
      for (const double one : done_) sum += one;
    }
    report(progress_, fmt::format("{} runs for errors", done_.size()),
           sum / static_cast<double>(done_.size()));
  }

  const runs::Run& own_;
  const std::filesystem::path& cache_;
  const Progress& progress_;
  std::vector<std::string> names_;
  std::vector<std::string> units_;
  std::atomic<bool> stops_ = false;
  std::mutex mutex_;  // of the next
  std::vector<double> done_;
};

}  // namespace

std::optional<std::string> find_imbalance(const dynamics::EnergyDrift& finer,
                                          const dynamics::EnergyDrift& own) {
  constexpr double kMuchMore = 2.0;
  const double open = dynamics::find_unbalanced_fraction(finer);
  const double most =
      std::max(dynamics::kReportedDrift,
               kMuchMore * dynamics::find_unbalanced_fraction(own));
  if (!(open > most)) return std::nullopt;
  return fmt::format(
      "energy error: {:.2g} % of its energy is {} by t = {:.4g} s",
      100.0 * open, finer.drift.value < 0.0 ? "lost" : "gained",
      finer.drift.time);
}

runs::ErrorTable estimate_errors(const runs::Run& run,
                                 const std::filesystem::path& cache,
                                 const Progress& progress) {
  return Estimator(run, cache, progress).estimate();
}

void add_errors(runs::Run& run, runs::ErrorTable errors) {
  for (const runs::ProbeErrors& probe : errors.probes) {
    for (results::ProbeColumn& column : run.history.columns) {
      if (column.name != probe.column) continue;
      if (std::isfinite(probe.total.curve)) column.error = probe.total.curve;
    }
  }
  run.errors = std::move(errors);
}

}  // namespace limber::app
