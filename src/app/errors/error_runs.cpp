// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/errors/error_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "limber/app/errors/error_causes.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::app {
namespace {

std::vector<ColumnValues> take_columns(const Run& run) {
  std::vector<ColumnValues> columns(run.history.columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c < run.record.peaks.size())
      columns[c].peak = run.record.peaks[c].value;
    for (const std::vector<double>& row : run.history.probe_rows) {
      columns[c].curve.push_back(row[c]);
    }
  }
  return columns;
}

/// Threads that stop when one throws, or the caller does.
void run_all(std::size_t count,
             const std::function<void(std::size_t)>& simulate) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) simulate(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      next = count;
    }
  };
  const std::size_t threads = std::min<std::size_t>(
      count, std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::thread> pool;
  for (std::size_t i = 0; i < threads; ++i) pool.emplace_back(work);
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

/// A scene that is ready to run, or why not.
struct Made {
  ErrorRun run;
  scene::Scene scene;
  std::optional<scene::BuiltScene> built;
};

class Estimator {
 public:
  Estimator(const Run& own, const std::filesystem::path& cache,
            const Progress& progress)
      : own_(own), cache_(cache), progress_(progress) {}

  ErrorTable estimate() {
    ErrorCauses found = find_error_causes(own_.scene, own_.built, own_.record);
    const std::size_t count = found.causes.size();
    std::vector<Made> all;
    for (const ErrorCause& cause : found.causes) all.push_back(make(cause));
    if (count > 1) {
      all.push_back(make({"all", "", join_overrides(found.causes), 1.0}));
    }
    done_.assign(all.size(), 0.0);
    run_all(all.size(), [&](std::size_t i) { simulate(i, all[i]); });
    std::optional<ErrorRun> together;
    if (count > 1) together = std::move(all.back().run);
    std::vector<ErrorRun> runs;
    for (std::size_t i = 0; i < count; ++i) {
      runs.push_back(std::move(all[i].run));
    }
    return finish(std::move(runs), together, std::move(found.unknown));
  }

 private:
  /// Reduces its bodies, one scene after the other.
  Made make(const ErrorCause& cause) {
    Made made{{cause.name, cause.finer, cause.factor, 0.0, "", {}}, {}, {}};
    try {
      made.scene = scene::load_scene(
          own_.scene.scenario.file,
          scene::merge(own_.scene.overrides, cause.overrides));
      made.scene.scenario.settings.output_times =
          own_.scene.scenario.settings.output_times;
      made.built = scene::build_system(made.scene, make_reducer(progress_),
                                       cache_, make_full_maker(progress_));
    } catch (const InputError& error) {
      made.run.failure = error.problems().front();
    } catch (const NumericalError& error) {
      made.run.failure = error.what();
    }
    return made;
  }

  void simulate(std::size_t index, Made& made) {
    if (!made.built) return;
    const Run run = simulate_built(made.scene, std::move(*made.built), cache_,
                                   [&](std::string_view what, double fraction) {
                                     if (what == "simulating")
                                       note(index, fraction);
                                   });
    made.run.seconds = run.statistics.seconds;
    if (run.failure) {
      try {
        std::rethrow_exception(run.failure);
      } catch (const NumericalError& error) {
        made.run.failure = error.what();
      }
      return;
    }
    if (run.history.columns.size() != own_.history.columns.size() ||
        run.history.times.size() != own_.history.times.size()) {
      made.run.failure = "it has other probes or outputs";
      return;
    }
    made.run.columns = take_columns(run);
  }

  void note(std::size_t index, double fraction) {
    const std::lock_guard lock(mutex_);
    done_[index] = fraction;
    double sum = 0.0;
    for (const double one : done_) sum += one;
    report(progress_, fmt::format("{} runs for errors", done_.size()),
           sum / static_cast<double>(done_.size()));
  }

  ErrorTable finish(std::vector<ErrorRun> runs,
                    const std::optional<ErrorRun>& together,
                    std::vector<std::string> unknown) {
    std::vector<std::string> names;
    std::vector<std::string> units;
    for (const results::ProbeColumn& column : own_.history.columns) {
      names.push_back(column.name);
      units.push_back(column.unit);
    }
    ErrorTable table = compare_causes(names, units, take_columns(own_),
                                      std::move(runs), together);
    table.unknown = std::move(unknown);
    return table;
  }

  const Run& own_;
  const std::filesystem::path& cache_;
  const Progress& progress_;
  std::mutex mutex_;  // of the next
  std::vector<double> done_;
};

}  // namespace

ErrorTable estimate_errors(const Run& run, const std::filesystem::path& cache,
                           const Progress& progress) {
  return Estimator(run, cache, progress).estimate();
}

}  // namespace limber::app
