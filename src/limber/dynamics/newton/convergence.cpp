// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/convergence.hpp"

#include <algorithm>
#include <cmath>

#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

constexpr double kErrorFraction = 0.01;
constexpr double kMostFraction = 1e-9;  // of the step's motion [-]
// Contraction above which the remaining error is not estimated [-].
constexpr double kPromising = 0.5;
// Contraction above which corrections that reverse alternate [-].
constexpr double kAlternating = 0.25;
// Largest correction between two faces, of the step's motion [-].
constexpr double kBetweenFaces = 1e-3;

double find_rest(double size, double before) {
  const double c = before > 0.0 ? size / before : 1.0;
  return c < kPromising ? size * c / (1.0 - c) : size;
}

}  // namespace

CorrectionSize find_limit(const CorrectionSize& predictor_errors, double gamma,
                          double motion) {
  const auto choose = [&](double predictor_error) {
    return std::clamp(kErrorFraction * predictor_error / (12.0 * gamma),
                      kLeastFraction * motion, kMostFraction * motion);
  };
  CorrectionSize limit;
  limit.value = choose(predictor_errors.value);
  limit.rigid = choose(predictor_errors.rigid);
  limit.modal = choose(predictor_errors.modal);
  return limit;
}

bool has_converged(const CorrectionSize& correction,
                   const CorrectionSize& before, const CorrectionSize& limit,
                   const Roundoff& roundoff) {
  const auto is_done = [](double size, double last, double most, double noise) {
    return find_rest(size, last) <= most || size <= noise;
  };
  return is_done(correction.rigid, before.rigid, limit.rigid, roundoff.rigid) &&
         is_done(correction.modal, before.modal, limit.modal, roundoff.modal);
}

double GroupProgress::rest() const {
  return find_rest(now.value, before.value);
}

bool GroupProgress::alternates() const {
  return reversal.is_whole() && now.value <= kBetweenFaces * motion;
}

NewtonProgress::NewtonProgress(const SystemModel& model)
    : model_(model),
      groups_(model),
      progress_(groups_.count()),
      last_(VectorX::Zero(count_unknowns(model))),
      sizes_(groups_.count()),
      reversals_(groups_.count()),
      roundoffs_(groups_.count()),
      motions_(groups_.count()) {}

void NewtonProgress::start(const SystemState& end, const VectorX& motion) {
  is_compared_ = false;
  measure_roundoff(model_, groups_, end, motion, roundoffs_);
  for (std::size_t g = 0; g < progress_.size(); ++g) {
    progress_[g] = {};
    progress_[g].roundoff = roundoffs_[g];
  }
}

void NewtonProgress::include(const VectorX& increments, bool compares) {
  measure_correction(model_, groups_, increments, sizes_);
  if (compares && is_compared_) {
    measure_reversal(model_, groups_, increments, last_, reversals_);
  } else {
    reversals_.assign(progress_.size(), {});
  }
  is_compared_ = compares;
  if (compares) last_ = increments;
  for (std::size_t g = 0; g < progress_.size(); ++g) {
    progress_[g].contraction_before = progress_[g].contraction();
    progress_[g].before = progress_[g].now;
    progress_[g].now = sizes_[g];
    progress_[g].reversal = reversals_[g];
    progress_[g].was_done = progress_[g].is_done;
    progress_[g].is_done = false;
  }
}

void NewtonProgress::measure_motion(const SystemState& state,
                                    const SystemTerms& terms,
                                    const VectorX& motion) {
  groups_.measure_motion(model_, state, terms, motion, motions_);
  for (std::size_t g = 0; g < progress_.size(); ++g) {
    progress_[g].motion = motions_[g];
    roundoffs_[g] = progress_[g].roundoff;
  }
  raise_roundoff_in_contact(model_, groups_, terms, roundoffs_);
  for (std::size_t g = 0; g < progress_.size(); ++g) {
    progress_[g].roundoff = roundoffs_[g];
  }
}

void NewtonProgress::add_roundoff(const VectorX& increments) {
  measure_correction(model_, groups_, increments, sizes_);
  for (std::size_t g = 0; g < progress_.size(); ++g) {
    Roundoff& roundoff = progress_[g].roundoff;
    roundoff.rigid = std::max(roundoff.rigid, sizes_[g].rigid);
    roundoff.modal = std::max(roundoff.modal, sizes_[g].modal);
  }
}

void NewtonProgress::judge() {
  for (GroupProgress& g : progress_) {
    g.is_done =
        has_converged(g.now, g.before, g.limit, g.roundoff) || g.alternates();
  }
}

bool NewtonProgress::may_be_noise(double poor) const {
  return std::any_of(
      progress_.begin(), progress_.end(), [poor](const GroupProgress& g) {
        return !g.is_done &&
               (g.contraction() > poor || g.now.rigid <= g.roundoff.rigid);
      });
}

bool NewtonProgress::reverses_last() const {
  return std::any_of(
      progress_.begin(), progress_.end(), [](const GroupProgress& g) {
        return g.now.value > g.roundoff.rigid &&
               g.contraction() > kAlternating && g.reversal.is_backward();
      });
}

std::optional<double> NewtonProgress::find_contraction(double poor) const {
  std::optional<double> slowest;
  for (const GroupProgress& g : progress_) {
    const double contraction = g.contraction();
    if (g.was_done && g.is_done) continue;
    if (g.alternates() || (contraction > poor && g.is_roundoff())) continue;
    slowest = std::max(slowest.value_or(0.0), contraction);
  }
  return slowest;
}

bool NewtonProgress::is_finite() const {
  return std::all_of(
      progress_.begin(), progress_.end(),
      [](const GroupProgress& g) { return std::isfinite(g.now.value); });
}

bool NewtonProgress::is_done() const {
  return std::all_of(progress_.begin(), progress_.end(),
                     [](const GroupProgress& g) { return g.is_done; });
}

const GroupProgress& NewtonProgress::find_worst() const {
  return *std::max_element(
      progress_.begin(), progress_.end(),
      [](const GroupProgress& a, const GroupProgress& b) {
        if (std::isnan(a.now.value)) return false;
        if (std::isnan(b.now.value)) return true;
        return a.is_done != b.is_done ? a.is_done : a.now.value < b.now.value;
      });
}

}  // namespace limber::dynamics
