// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/single_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/monitors/linear_limit.hpp"
#include "limber/dynamics/monitors/rounding_limit.hpp"
#include "limber/dynamics/simulation/exact_modes.hpp"
#include "limber/dynamics/simulation/explicit_limit.hpp"
#include "limber/dynamics/simulation/modal_loads.hpp"
#include "limber/dynamics/simulation/start_warnings.hpp"
#include "limber/dynamics/simulation/time_loop.hpp"

namespace limber::dynamics {
namespace {

// Arguments of one run.
struct Job {
  const SimulationSettings& settings;
  const Progress& progress;
  SimulationStatistics& statistics;
  const Continuation& continuation;
  const Followed& followed;
  RunRecord& record;
  const TimeLoop::Check& check;
  double refinement;  // see StepControl [-]
};

void integrate(const SystemModel& model, SystemState& state, const Job& job,
               const TimeLoop::Visit& visit) {
  const SimulationSettings settings =
      limit_step(model, state, job.settings, job.statistics);
  add_period_warning(model, settings, state.t, job.statistics);
  TimeLoop loop(model, settings, state, job.statistics, job.refinement,
                job.followed, job.check);
  if (const auto& from = job.continuation.from) {
    Archive archive(from->numbers);
    job.continuation.keeper.exchange_outer(archive);
    loop.resume(archive, from->log, state);
  }
  try {
    loop.run(state, visit, job.progress, job.continuation.keeper);
  } catch (const NumericalError&) {
    loop.store(job.record);
    throw;
  }
  loop.store(job.record);
}

// A run without steps: all motion is known in closed form.
void pass_time(const SystemModel& model, SystemState& state,
               const std::vector<double>& times, const Job& job,
               const TimeLoop::Visit& visit) {
  PeakObserver peaks(model, job.followed,
                     choose_envelope_edges(state.t, job.settings.output_times,
                                           job.settings.end_time));
  SystemState now = state;
  peaks.start(now);
  for (const Breakpoint& mark :
       find_breakpoints(model, state.t, job.settings)) {
    now.t = mark.time;
    peaks.include(now);
    if (mark.is_jump) peaks.cross_jump(now);
  }
  peaks.store(job.record.peaks, job.record.places, job.record.envelopes);
  for (const double t : times) {
    state.t = t;
    job.check(state);
    visit(state, {});
  }
  state.t = job.settings.end_time;
}

bool has_exact_modes(const SystemModel& model,
                     const SimulationSettings& settings) {
  if (!settings.exact_modes ||
      !traits_of(settings.integrator).takes_exact_modes ||
      !model.controllers.empty()) {  // which see the whole state at each sample
    return false;
  }
  for (BodyIndex b(0); b < std::ssize(model.bodies); ++b) {
    if (has_closed_modal_loads(model, b)) return true;
  }
  return false;
}

// Sampling interval of modes in closed form [s].
double choose_longest_look(const ExactModes& exact, double start, double end,
                           std::vector<std::string>& warnings) {
  constexpr double kMostLooks = 1e6;
  const double wanted = exact.find_longest_look(end);
  const double least = (end - start) / kMostLooks;
  if (wanted >= least) return wanted;
  warnings.push_back(fmt::format(
      "peaks of modes in closed form are sampled every {:.2g} s, {:g} times in "
      "all; the fastest mode that moves needs {:.2g} s: peaks of probes may be "
      "too low; a shorter run or fewer modes would resolve them",
      least, kMostLooks, wanted));
  return least;
}

// Modes in closed form, and steps for the rest.
void integrate_with_exact_modes(ExactModes& exact, SystemState& state,
                                const std::vector<double>& times,
                                const Job& job, const TimeLoop::Visit& visit) {
  job.statistics.exact_modes = exact.count();
  // Modes at some of the times at once, to bound the memory for them.
  constexpr std::size_t kPrepared = 4096;
  std::size_t first = times.size();
  const auto prepare = [&](std::size_t i) {
    const std::size_t wanted = i - i % kPrepared;
    if (wanted == first) return;
    first = wanted;
    const auto begin = times.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count =
        static_cast<std::ptrdiff_t>(std::min(kPrepared, times.size() - first));
    exact.prepare({begin, begin + count});
  };
  SystemState rest = exact.take_rest(state);
  SystemState whole = state;
  const TimeLoop::Visit visit_whole = [&](const SystemState& now,
                                          const Losses& losses) {
    const auto i = static_cast<std::size_t>(
        std::lower_bound(times.begin(), times.end(), now.t) - times.begin());
    prepare(i);
    exact.join(now, i - first, whole);
    const ExactModes::Losses own = exact.losses(i - first);
    visit(whole, {losses.work + own.work, losses.dissipated + own.dissipated});
  };
  const auto leave = [&] {
    exact.prepare({rest.t});
    exact.join(rest, 0, state);
  };
  Followed followed = job.followed;
  if (!followed.is_empty()) {
    followed.longest = choose_longest_look(exact, rest.t, job.settings.end_time,
                                           job.statistics.warnings);
  }
  // A time is evaluated twice in a row, as the end of a step and before its
  // events: the modes are the same.
  SystemState seen = state;
  double joined = -std::numeric_limits<double>::infinity();
  const auto join = [&](const SystemState& now) {
    if (now.t <= joined && std::nextafter(now.t, joined) >= joined) {
      exact.join_rest(now, seen);
      return;
    }
    exact.join(now, seen);
    joined = now.t;
  };
  followed.evaluate = [&](const SystemState& now, std::vector<double>& values) {
    join(now);
    job.followed.evaluate(seen, values);
  };
  if (followed.motion_observer) {
    followed.motion_observer->include = [&](const SystemState& now) {
      join(now);
      job.followed.motion_observer->include(seen);
    };
  }
  const TimeLoop::Check check = [&](const SystemState& now) {
    join(now);
    job.check(seen);
  };
  const Job rest_job{
      job.settings, job.progress, job.statistics, job.continuation,
      followed,     job.record,   check,          job.refinement};
  try {
    if (exact.has_motion_left()) {
      integrate(exact.rest(), rest, rest_job, visit_whole);
    } else {
      pass_time(exact.rest(), rest, times, rest_job, visit_whole);
    }
  } catch (const NumericalError&) {
    leave();
    throw;
  }
  leave();
}

}  // namespace

void run_once(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation, const Followed& followed,
              RunRecord& record, double refinement) {
  SystemTerms terms = make_terms(model);
  SystemState framed;
  LinearLimit limit(model);
  RoundingLimit rounding(model);
  const TimeLoop::Visit visit = [&](const SystemState& at,
                                    const Losses& losses) {
    if (model.nodal_count > 0) {
      framed = at;
      update_mean_frames(model, framed);
    }
    const SystemState& now = model.nodal_count == 0 ? at : framed;
    rounding.check(now, statistics.warnings);
    if (!observer) return;
    EnergyBalance balance = calc_energy(model, now, terms);
    balance.dissipated = losses.dissipated;
    balance.work = losses.work;
    observer(now, balance);
  };
  const TimeLoop::Check check = [&](const SystemState& at) {
    limit.check(at, statistics.warnings);
  };
  LIMBER_EXPECT(!continuation.keeper.exchange_outer);
  Continuation whole = continuation;
  whole.keeper.exchange_outer = [&](Archive& archive) {
    limit.exchange_memory(archive);
    rounding.exchange_memory(archive);
  };
  const Job job{settings, progress, statistics, whole,
                followed, record,   check,      refinement};
  rounding.check(state, statistics.warnings);
  add_start_warnings(model, state, statistics);
  const double start = state.t;
  const auto finish = [&] {
    update_mean_frames(model, state);
    rounding.check(state, statistics.warnings);
    add_load_edges(model, start, state.t, statistics.events);
  };
  try {
    if (has_exact_modes(model, settings)) {
      ExactModes exact(model, state);
      integrate_with_exact_modes(exact, state,
                                 find_visited_times(model, state.t, settings),
                                 job, visit);
    } else {
      integrate(model, state, job, visit);
    }
  } catch (const NumericalError&) {
    finish();
    throw;
  }
  finish();
}

}  // namespace limber::dynamics
