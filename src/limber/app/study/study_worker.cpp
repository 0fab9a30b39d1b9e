// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/study/study_worker.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "limber/app/options/reducer.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/common/duration.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/library_lock.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::app {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> list_warnings(const runs::Run& run) {
  std::vector<std::string> texts = run.built.warnings;
  texts.insert(texts.end(), run.statistics.warnings.begin(),
               run.statistics.warnings.end());
  return texts;
}

}  // namespace

StudyWorker::StudyWorker(const study::Study& study, std::filesystem::path cache,
                         scene::KnownParts known, Progress watch)
    : study_(study),
      cache_(std::move(cache)),
      watch_(std::move(watch)),
      judges_(needs_levels(study)),
      known_(std::move(known)),
      reducer_(make_reducer({})) {}

std::optional<study::StudyRow> StudyWorker::make_row(
    std::size_t run, const std::vector<std::string>& factors) {
  study::StudyRow row;
  row.run = run;
  row.factors = factors;
  row.responses.resize(study_.responses.size());
  try {
    if (!simulate(row)) return std::nullopt;
  } catch (const dynamics::Interrupted&) {
    return std::nullopt;
  } catch (const InputError& error) {
    row.error = error.what();
  } catch (const NumericalError& error) {
    row.error = error.what();
  } catch (const std::bad_alloc&) {
    row.error = "out of memory";
  }
  return row;
}

/// Adds to the row's times and warnings.
runs::Run StudyWorker::make_run(
    study::StudyRow& row, const std::optional<dynamics::Fidelity>& level) {
  const Clock::time_point start = Clock::now();
  scene::Scene scene;
  scene::BuiltScene built;
  {
    const auto lock = runs::lock_libraries();
    scene::Overrides overrides = to_overrides(study_, row.factors);
    if (level) overrides.fidelity = level;
    scene = scene::load_scene(study_.scenario, overrides, &robots_);
    built = scene::build_system(scene, reducer_, cache_, make_full_maker({}),
                                known_);
    known_ = built.known;
  }
  row.seconds_ready += seconds_since(start);
  runs::RunOptions options;
  options.reductions = {reducer_, cache_};
  options.progress = watch_;
  options.judges_levels = judges_;
  runs::Run run = runs::simulate_built(scene, std::move(built), options);
  row.seconds += run.statistics.seconds;
  if (!level) {
    row.warnings = fmt::format("{}", fmt::join(list_warnings(run), "\n"));
  }
  return run;
}

bool StudyWorker::simulate(study::StudyRow& row) {
  const runs::Run run = make_run(row, {});
  std::vector<runs::Run> at_levels;
  std::string place;
  try {
    if (run.failure) std::rethrow_exception(run.failure);
    for (const dynamics::Fidelity level : list_levels(study_)) {
      place = fmt::format("at level {}: ", dynamics::to_string(level));
      const runs::Run& other = at_levels.emplace_back(make_run(row, level));
      if (other.failure) std::rethrow_exception(other.failure);
    }
  } catch (const dynamics::Interrupted&) {
    return false;
  } catch (const InputError& error) {
    row.error = place + error.what();
    return true;
  } catch (const NumericalError& error) {
    row.error = place + error.what();
    return true;
  }
  row.responses =
      evaluate_run(study_, run, at_levels,
                   [](const runs::Run& made) { return summarize(made); });
  return true;
}

}  // namespace limber::app
