// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/tolerance_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/files/spilled_list.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/equations/motion_scale.hpp"
#include "limber/dynamics/simulation/settings_check.hpp"
#include "limber/dynamics/simulation/single_run.hpp"
#include "limber/dynamics/system/oscillation.hpp"

namespace limber::dynamics {
namespace {

constexpr int kMostPasses = 8;
// Error of a step in the first pass, relative to the tolerance [-].
constexpr double kFirst = 1.0 / 3.0;
// In the second, with steps of half the length.
constexpr double kSecond = kFirst / 8.0;
constexpr double kToleranceSafety =
    0.5;  // target of later passes, of the tolerance [-]

// Ratio of the errors of passes from that of the errors of their steps, and
// back, for a second-order scheme.
double to_error(double allowed) { return std::cbrt(allowed * allowed); }
double to_allowed(double error) { return error * std::sqrt(error); }
double to_length(double allowed) { return std::cbrt(allowed); }  // of steps

// Outputs of a pass, and the logs of its checkpoints.
struct Record {
  int pass = 0;
  SpilledList<SystemState> states;
  SpilledList<EnergyBalance> balances;
  std::vector<double> log = {};
};

constexpr auto fields_of(const Record*) {
  return list_fields("record", "pass", "states", "balances", "log");
}

// Contents of a record from an output on, until another.
Record cut(const Record& record, std::size_t from, std::size_t to) {
  return {record.pass, record.states.read(from, to - from),
          record.balances.read(from, to - from)};
}

void append(const Record& part, Record& record) {
  for (const SystemState& state : part.states) record.states.push_back(state);
  for (const EnergyBalance& balance : part.balances) {
    record.balances.push_back(balance);
  }
  record.log.insert(record.log.end(), part.log.begin(), part.log.end());
}

// State between two passes, saved in checkpoints.
struct Course {
  int pass = 0;
  double allowed = 0.0;         // error of a step of this pass [m]
  double allowed_before = 0.0;  // of the previous pass [m]
  double estimate = 0.0;        // error of the last complete pass [m]
};

constexpr auto fields_of(const Course*) {
  return list_fields("course", "pass", "allowed [m]", "allowed before [m]",
                     "estimate [m]");
}

double measure_distance(const MotionScale& scale, const Record& a,
                        const Record& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.states.size(), b.states.size()); ++i) {
    largest = std::max(
        largest, scale.measure_distance(a.states[i], b.states[i]).displacement);
  }
  return largest;
}

void add_costs(const SimulationStatistics& pass,
               SimulationStatistics& statistics) {
  statistics.steps += pass.steps;
  statistics.rejected_steps += pass.rejected_steps;
  statistics.halved_steps += pass.halved_steps;
  statistics.newton_iterations += pass.newton_iterations;
  statistics.factorizations += pass.factorizations;
  statistics.linear_solves += pass.linear_solves;
}

class ToleranceLoop {
 public:
  ToleranceLoop(const SystemModel& model, const SystemState& start,
                const SimulationSettings& settings, const Progress& progress,
                SimulationStatistics& statistics,
                const Continuation& continuation, const Followed& followed,
                RunRecord& record)
      : model_(model),
        start_(start),
        settings_(settings),
        progress_(progress),
        statistics_(statistics),
        followed_(followed),
        run_record_(record),
        scale_(model) {
    keeper_.interval = continuation.keeper.interval;
    if (continuation.keeper.keep) {
      keeper_.keep = [this, keep = continuation.keeper.keep](
                         const Checkpoint& inner) { keep(wrap(inner)); };
    }
    course_.allowed = kFirst * settings.tolerance;
    if (continuation.from) unwrap(*continuation.from);
  }

  // Sets `state` to the end of the last pass.
  void run(SystemState& state) {
    while (true) {
      run_pass(state);
      if (is_good_enough()) return;
      plan_next();
    }
  }

  [[nodiscard]] const Record& record() const { return now_; }

 private:
  void run_pass(SystemState& state) {
    SimulationSettings settings = settings_;
    settings.tolerance = course_.allowed;
    settings.most_steps = std::max(
        settings_.most_steps - statistics_.steps - statistics_.rejected_steps,
        1L);
    const Observer observer = [this](const SystemState& at,
                                     const EnergyBalance& balance) {
      now_.states.push_back(at);
      now_.balances.push_back(balance);
    };
    Continuation continuation{keeper_, std::move(inner_)};
    inner_.reset();
    SimulationStatistics pass;
    state = start_;
    const auto finish = [&] {
      add_costs(pass, statistics_);
      statistics_.exact_modes = pass.exact_modes;
      statistics_.events = std::move(pass.events);
      statistics_.warnings = std::move(pass.warnings);
      statistics_.passes = ++course_.pass;
    };
    try {
      run_once(model_, state, settings, observer, progress_, pass, continuation,
               followed_, run_record_,
               to_length(course_.allowed / (kFirst * settings_.tolerance)));
    } catch (const NumericalError&) {
      finish();
      throw;
    }
    finish();
  }

  // Estimates the error of the last complete pass.
  bool is_good_enough() {
    if (course_.pass < 2) return false;
    const double distance = measure_distance(scale_, before_, now_);
    const double shrinkage = to_error(course_.allowed_before / course_.allowed);
    course_.estimate = distance / (shrinkage - 1.0);
    statistics_.estimated_error = course_.estimate;
    if (course_.estimate <= settings_.tolerance) return true;
    if (course_.pass < kMostPasses) return false;
    statistics_.warnings.push_back(fmt::format(
        "after {} passes positions are still uncertain by {:.3g} m, more than "
        "the tolerance of {:.3g} m: the motion amplifies small errors; use a "
        "shorter time or a larger tolerance",
        kMostPasses, course_.estimate, settings_.tolerance));
    return true;
  }

  void plan_next() {
    double next = kSecond * settings_.tolerance;
    if (course_.pass >= 2) {
      const double wanted =
          kToleranceSafety * settings_.tolerance / course_.estimate;
      next = course_.allowed * to_allowed(std::clamp(wanted, 1e-4, 0.5));
    }
    course_.allowed_before = course_.allowed;
    course_.allowed = next;
    before_ = std::move(now_);
    before_logged_ = now_logged_;
    now_ = {course_.pass, {}, {}};
    now_logged_ = 0;
  }

  Checkpoint wrap(const Checkpoint& inner) {
    Archive archive;
    std::vector<double> numbers = inner.numbers;
    archive(numbers, course_);
    exchange_costs(archive, statistics_);
    return {inner.time, archive.take_numbers(), take_log(inner)};
  }

  // The contents of the two current records that are in no log yet, of the
  // current pass until its checkpoint.
  std::vector<double> take_log(const Checkpoint& inner) {
    Archive log;
    Record before = cut(before_, before_logged_, before_.states.size());
    Record now = cut(now_, now_logged_, inner.outputs);
    now.log = inner.log;
    log(before, now);
    before_logged_ = before_.states.size();
    now_logged_ = inner.outputs;
    return log.take_numbers();
  }

  void unwrap(const Checkpoint& checkpoint) {
    Archive archive(checkpoint.numbers);
    inner_.emplace();
    inner_->time = checkpoint.time;
    archive(inner_->numbers, course_);
    exchange_costs(archive, statistics_);
    before_.pass = course_.pass - 1;
    now_.pass = course_.pass;
    Archive log(checkpoint.log);
    while (log.has_more()) {
      Record part;
      log(part);
      if (part.pass == before_.pass) append(part, before_);
      if (part.pass == now_.pass) append(part, now_);
    }
    inner_->log = std::move(now_.log);
    before_logged_ = before_.states.size();
    now_logged_ = now_.states.size();
  }

  const SystemModel& model_;
  const SystemState start_;
  const SimulationSettings& settings_;
  const Progress& progress_;
  SimulationStatistics& statistics_;
  const Followed& followed_;
  RunRecord& run_record_;  // of the last pass
  MotionScale scale_;
  CheckpointKeeper keeper_;
  std::optional<Checkpoint> inner_;  // of the current pass
  Course course_;
  Record before_;  // of the previous pass
  Record now_;
  std::size_t before_logged_ = 0;  // number of outputs in a log
  std::size_t now_logged_ = 0;
};

// Whether a load or a command oscillates between two times [s].
bool has_oscillation(const SystemModel& model, double start, double end) {
  const std::vector<Oscillation> all = find_oscillations(model);
  return std::any_of(all.begin(), all.end(), [&](const Oscillation& one) {
    return one.from < end && one.until > start;
  });
}

}  // namespace

TolerancePasses choose_passes(const SystemModel& model,
                              const SimulationSettings& settings,
                              double start) {
  if (settings.passes != TolerancePasses::automatic) return settings.passes;
  const bool is_verified = settings.tolerance > 0.0 &&
                           find_hidden_memory(model) == nullptr &&
                           has_oscillation(model, start, settings.end_time);
  return is_verified ? TolerancePasses::verified : TolerancePasses::one;
}

void run_to_tolerance(const SystemModel& model, SystemState& state,
                      const SimulationSettings& settings,
                      const Observer& observer, const Progress& progress,
                      SimulationStatistics& statistics,
                      const Continuation& continuation,
                      const Followed& followed, RunRecord& record) {
  ToleranceLoop passes(model, state, settings, progress, statistics,
                       continuation, followed, record);
  const auto store = [&] {
    if (!observer) return;
    for (std::size_t i = 0; i < passes.record().states.size(); ++i) {
      observer(passes.record().states[i], passes.record().balances[i]);
    }
  };
  try {
    passes.run(state);
  } catch (const NumericalError&) {
    store();
    throw;
  }
  store();
}

}  // namespace limber::dynamics
