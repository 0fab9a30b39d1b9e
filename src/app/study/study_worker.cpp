// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/study/study_worker.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "limber/app/options/reducer.hpp"
#include "limber/app/run/library_lock.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/common/duration.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::app {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> list_warnings(const Run& run) {
  std::vector<std::string> texts = run.built.warnings;
  texts.insert(texts.end(), run.statistics.warnings.begin(),
               run.statistics.warnings.end());
  return texts;
}

}  // namespace

StudyWorker::StudyWorker(const Study& study, std::filesystem::path cache,
                         scene::KnownBodies known, Progress watch)
    : study_(study),
      cache_(std::move(cache)),
      watch_(std::move(watch)),
      judges_(needs_levels(study)),
      known_(std::move(known)),
      reducer_(make_reducer({})) {}

std::optional<StudyRow> StudyWorker::make_row(
    std::size_t run, const std::vector<std::string>& factors) {
  StudyRow row;
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

bool StudyWorker::simulate(StudyRow& row) {
  const Clock::time_point start = Clock::now();
  scene::Scene scene;
  scene::BuiltScene built;
  {
    const auto lock = lock_libraries();
    scene = scene::load_scene(study_.scenario,
                              to_overrides(study_, row.factors), &robots_);
    built = scene::build_system(scene, reducer_, cache_, make_full_maker({}),
                                known_);
    known_ = built.known;
  }
  row.seconds_ready = seconds_since(start);
  const Run run =
      simulate_built(scene, std::move(built), cache_, watch_, {}, judges_);
  row.seconds = run.statistics.seconds;
  row.warnings = fmt::format("{}", fmt::join(list_warnings(run), "\n"));
  try {
    if (run.failure) std::rethrow_exception(run.failure);
  } catch (const dynamics::Interrupted&) {
    return false;
  } catch (const NumericalError& error) {
    row.error = error.what();
    return true;
  }
  row.responses = evaluate_run(study_, run);
  return true;
}

}  // namespace limber::app
