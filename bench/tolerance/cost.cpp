// SPDX-License-Identifier: BSD-3-Clause
#include "cost.hpp"

#include <algorithm>
#include <cmath>

namespace limber::bench::tolerance {
namespace {

constexpr int kSearches = 4;
constexpr double kEqual = 0.05;  // of an error: is met
constexpr int kRepeats = 3;
constexpr double kLongRun = 0.4;  // fewer repeats of it [s]

class Search {
 public:
  Search(const SceneRuns& runs, const Reference& reference, bool in_own_steps)
      : runs_(runs), reference_(reference), in_own_steps_(in_own_steps) {}

  [[nodiscard]] Run run(double step) const {
    return in_own_steps_ ? runs_.run_own_steps(step) : runs_.run_fixed(step);
  }
  [[nodiscard]] Rung take(double step) const {
    Rung rung{step, run(step), INFINITY};
    rung.error = runs_.measure_distance(rung.run, reference_.run);
    return rung;
  }
  [[nodiscard]] std::vector<Rung> climb(double error) const {
    if (!in_own_steps_) return reference_.ladder;
    std::vector<Rung> ladder;
    for (const Rung& uniform : reference_.ladder) {
      ladder.push_back(take(uniform.step));
      if (ladder.back().error <= error) break;
    }
    return ladder;
  }

 private:
  const SceneRuns& runs_;
  const Reference& reference_;
  bool in_own_steps_;
};

// Between a step that errs too much and one that does not, errors growing as a
// power of it.
Rung meet(const Search& search, Rung coarse, Rung fine, double error) {
  for (int i = 0; i < kSearches && fine.error < (1.0 - kEqual) * error; ++i) {
    double fraction = 0.5;
    if (std::isfinite(coarse.error) && fine.error > 0.0) {
      fraction =
          std::log(error / fine.error) / std::log(coarse.error / fine.error);
    }
    fraction = std::clamp(fraction, 0.05, 0.95);
    Rung next =
        search.take(fine.step * std::pow(coarse.step / fine.step, fraction));
    (next.error <= error ? fine : coarse) = std::move(next);
  }
  return fine;
}

double find_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::optional<Rival> find_rival(const SceneRuns& runs,
                                const Reference& reference, double tolerance,
                                double error, bool in_own_steps) {
  const Search search(runs, reference, in_own_steps);
  const std::vector<Rung> ladder = search.climb(error);
  const auto fine =
      std::find_if(ladder.begin(), ladder.end(),
                   [&](const Rung& rung) { return rung.error <= error; });
  if (fine == ladder.end()) return {};
  Rival rival;
  rival.is_coarsest = fine == ladder.begin();
  rival.rung =
      rival.is_coarsest ? *fine : meet(search, *std::prev(fine), *fine, error);
  const int repeats = rival.rung.run.seconds > kLongRun ? 1 : kRepeats;
  std::vector<double> ratios;
  for (int i = 0; i < repeats; ++i) {
    const double fixed = search.run(rival.rung.step).seconds;
    ratios.push_back(
        fixed / runs.run_to(tolerance, dynamics::TolerancePasses::one).seconds);
  }
  rival.times_dearer = find_median(ratios);
  return rival;
}

}  // namespace limber::bench::tolerance
