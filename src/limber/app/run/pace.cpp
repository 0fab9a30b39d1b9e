// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/pace.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "limber/common/duration.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/dynamics/simulation/tolerance_loop.hpp"
#include "limber/scene/probes/followed_probes.hpp"

namespace limber::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMeasured = 0.5;    // wall time of the first steps [s]
constexpr double kScouted = 1.0;     // and of the coarse pass [s]
constexpr double kCoarse = 100.0;    // its tolerance, relative to the run's [-]
constexpr double kPassesTime = 6.0;  // of three verified passes, to the first

/// A point of a pass: fraction of the motion, and wall time.
struct Progressed {
  double fraction = 0.0;
  double seconds = 0.0;  // [s]
};

/// The first pass of a run, as far as it came.
class Trial {
 public:
  Trial(const scene::BuiltScene& built,
        const dynamics::SimulationSettings& settings, double most_seconds) {
    dynamics::SystemState state = built.initial;
    dynamics::RunRecord record;
    const Clock::time_point start = Clock::now();
    bool is_first_pass = true;
    const Progress progress = [&](std::string_view, double fraction) {
      const double seconds = seconds_since(start);
      is_first_pass = is_first_pass && fraction >= points_.back().fraction;
      if (is_first_pass) points_.push_back({fraction, seconds});
      if (!is_first_pass || (seconds > most_seconds && fraction < 1.0)) {
        throw dynamics::Interrupted("measured");
      }
    };
    const dynamics::Observer observer = [&](const dynamics::SystemState& now,
                                            const dynamics::EnergyBalance&) {
      static_cast<void>(scene::evaluate_all(built.probes, built.model, now));
    };
    try {
      dynamics::simulate(built.model, state, settings, observer, progress,
                         statistics, {},
                         scene::follow(built.probes, built.model), record);
    } catch (const dynamics::Interrupted&) {  // as asked
    } catch (const NumericalError& error) {
      failure = error.what();
    } catch (const InputError& error) {
      failure = error.what();
    }
    if (!is_first_pass) points_.back().fraction = 1.0;
    reached = (is_first_pass ? state.t : settings.end_time) - built.initial.t;
  }

  [[nodiscard]] double fraction() const { return points_.back().fraction; }
  [[nodiscard]] double seconds() const { return points_.back().seconds; }
  [[nodiscard]] bool is_complete() const { return fraction() >= 1.0; }

  /// Until a fraction of the motion, linear between points [s].
  [[nodiscard]] double seconds_until(double fraction) const {
    const auto after = std::lower_bound(
        points_.begin(), points_.end(), fraction,
        [](const Progressed& p, double f) { return p.fraction < f; });
    if (after == points_.begin()) return after->seconds;
    if (after == points_.end()) return seconds();
    const Progressed& before = *(after - 1);
    const double part =
        (fraction - before.fraction) / (after->fraction - before.fraction);
    return before.seconds + part * (after->seconds - before.seconds);
  }

  /// Of the later half of its time [s per whole motion]; none of one point.
  [[nodiscard]] std::optional<double> find_pace() const {
    const Progressed& last = points_.back();
    const auto middle = std::find_if(
        points_.rbegin(), points_.rend(), [&](const Progressed& point) {
          return point.seconds <= 0.5 * last.seconds;
        });
    if (middle == points_.rend() || !(last.fraction > middle->fraction)) {
      return std::nullopt;
    }
    return (last.seconds - middle->seconds) /
           (last.fraction - middle->fraction);
  }

  /// Of a whole pass, at that pace [s].
  [[nodiscard]] std::optional<double> extrapolate() const {
    if (is_complete()) return seconds();
    const std::optional<double> pace = find_pace();
    if (!pace) return std::nullopt;
    return seconds() + (1.0 - fraction()) * *pace;
  }

  dynamics::SimulationStatistics statistics;
  std::string failure;
  double reached = 0.0;  ///< [s]

 private:
  std::vector<Progressed> points_{{}};
};

/// Of a pass of the run whose start was measured [s].
std::optional<double> scale(const Trial& run, const Trial& coarse) {
  const double f = run.fraction();
  const double half = 0.5 * f;
  const double measured = run.seconds() - run.seconds_until(half);
  const double scouted = coarse.seconds_until(f) - coarse.seconds_until(half);
  const std::optional<double> all = coarse.extrapolate();
  if (!all || coarse.fraction() < f || !(scouted > 0.0)) {
    return run.extrapolate();
  }
  const double rest = std::max(*all - coarse.seconds_until(f), 0.0);
  return run.seconds() + rest * measured / scouted;
}

}  // namespace

Pace measure_pace(const scene::BuiltScene& built) {
  dynamics::SimulationSettings settings = built.settings;
  settings.passes =
      dynamics::choose_passes(built.model, settings, built.initial.t);
  const Trial run(built, settings, kMeasured);
  Pace pace;
  pace.steps = run.statistics.steps;
  pace.time = run.reached;
  pace.seconds = run.seconds();
  pace.failure = run.failure;
  if (!run.failure.empty()) return pace;
  pace.run_seconds = run.extrapolate();
  pace.is_verified = settings.tolerance > 0.0 &&
                     settings.passes == dynamics::TolerancePasses::verified;
  if (settings.tolerance > 0.0 && !run.is_complete()) {
    settings.tolerance *= kCoarse;
    const Trial coarse(built, settings, kScouted);
    if (coarse.failure.empty()) {
      pace.run_seconds = scale(run, coarse);
      pace.scouted = coarse.fraction();
    }
  }
  if (pace.run_seconds && pace.is_verified) *pace.run_seconds *= kPassesTime;
  return pace;
}

}  // namespace limber::app
