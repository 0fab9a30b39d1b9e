// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/modal_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

using Complex = std::complex<double>;

Complex find_phasor(double angle) { return {std::cos(angle), std::sin(angle)}; }

void check_coefficients(const VectorX& values, const char* name,
                        const char* unit, std::vector<std::string>& problems) {
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (!(values[k] >= 0.0) || !std::isfinite(values[k])) {
      problems.push_back(fmt::format(
          "modal response: {} of mode {} is {:g} {}; expected >= 0 (a rigid "
          "mode's round-off should be set to zero)",
          name, k, values[k], unit));
    }
  }
}

void check_state(const VectorX& values, Eigen::Index modes, const char* name,
                 std::vector<std::string>& problems) {
  if (values.size() != 0 && values.size() != modes) {
    problems.push_back(
        fmt::format("modal response: initial {} has {} entries; expected one "
                    "for each of {} modes, or none",
                    name, values.size(), modes));
  }
  if (!values.allFinite()) {
    problems.push_back(
        fmt::format("modal response: initial {} is not finite", name));
  }
}

void check_modes(const VectorX& lambda, const VectorX& damping,
                 const ModalState& initial) {
  std::vector<std::string> problems;
  if (damping.size() != lambda.size()) {
    problems.push_back(fmt::format(
        "modal response: {} eigenvalues but {} damping coefficients",
        lambda.size(), damping.size()));
  }
  check_coefficients(lambda, "lambda", "rad^2/s^2", problems);
  check_coefficients(damping, "damping", "1/s", problems);
  check_state(initial.eta, lambda.size(), "eta", problems);
  check_state(initial.etadot, lambda.size(), "etadot", problems);
  if (!std::isfinite(initial.time)) {
    problems.emplace_back("modal response: initial time is not finite");
  }
  refuse(std::move(problems));
}

void check_times(const std::vector<double>& times, double start) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || times[i] < start) {
      throw InputError(fmt::format(
          "modal response: time {} is {:g} s; expected a time from {:g} s on",
          i, times[i], start));
    }
  }
}

VectorX fill(const VectorX& values, Eigen::Index modes) {
  return values.size() == 0 ? VectorX(VectorX::Zero(modes)) : values;
}

// The free responses of all modes since one start, cached while the start does
// not change: most waves share it.
class SharedResponses {
 public:
  explicit SharedResponses(const std::vector<ModalOscillator>& modes)
      : modes_(modes), responses_(modes.size()) {}

  const std::vector<FreeResponse>& find(double cause, double t) {
    if (!known_ || cause != cause_ || t != t_) {
      for (std::size_t k = 0; k < modes_.size(); ++k) {
        responses_[k] = modes_[k].find_free_response(t - cause);
      }
      known_ = true;
      cause_ = cause;
      t_ = t;
    }
    return responses_;
  }

 private:
  const std::vector<ModalOscillator>& modes_;
  std::vector<FreeResponse> responses_;
  bool known_ = false;
  double cause_ = 0.0;
  double t_ = 0.0;
};

}  // namespace

ModalResponse::ModalResponse(const VectorX& lambda, const VectorX& damping,
                             const ModalLoads& loads,
                             const ModalState& initial) {
  check_modes(lambda, damping, initial);
  check(loads, lambda.size());
  modes_.reserve(static_cast<std::size_t>(lambda.size()));
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    modes_.emplace_back(lambda[k], damping[k]);
  }
  add_intervals(loads.steps, initial);
  for (const SinusoidalLoad& load : loads.sinusoids) add_wave(load);
}

// The first interval starts at the initial time, under the load at that time.
void ModalResponse::add_intervals(const StepLoad& steps,
                                  const ModalState& initial) {
  const auto later =
      std::upper_bound(steps.times.begin(), steps.times.end(), initial.time);
  const Eigen::Index passed = later - steps.times.begin();
  starts_.assign(1, initial.time);
  starts_.insert(starts_.end(), later, steps.times.end());
  const auto intervals = std::ssize(starts_);
  load_ = MatrixX::Zero(modes(), intervals);
  if (passed > 0) load_.col(0) = steps.values.col(passed - 1);
  for (Eigen::Index j = 1; j < intervals; ++j) {
    load_.col(j) = steps.values.col(passed + j - 1);
  }

  at_start_ = {make_zeros(starts_), make_zeros(starts_)};
  at_start_.eta.col(0) = fill(initial.eta, modes());
  at_start_.etadot.col(0) = fill(initial.etadot, modes());
  ModalHistory next{MatrixX(modes(), 1), MatrixX(modes(), 1)};
  for (Eigen::Index j = 1; j < intervals; ++j) {
    calc_steps({starts_[static_cast<std::size_t>(j)]}, {j - 1}, next);
    at_start_.eta.col(j) = next.eta;
    at_start_.etadot.col(j) = next.etadot;
  }
}

void ModalResponse::add_wave(const SinusoidalLoad& load) {
  const double start = std::max(load.from, starts_.front());
  if (load.until <= start) return;
  const Complex i(0.0, 1.0);
  waves_.push_back({.omega = load.omega,
                    .start = start,
                    .end = load.until,
                    .amplitude = (load.cosine - i * load.sine) *
                                 find_phasor(load.omega * (start - load.from)),
                    .end_eta = VectorX::Zero(modes()),
                    .end_etadot = VectorX::Zero(modes())});
  Wave& wave = waves_.back();
  if (std::isinf(wave.end)) return;
  const double duration = wave.end - start;
  const Complex phasor = find_phasor(wave.omega * duration);
  for (Eigen::Index k = 0; k < modes(); ++k) {
    const ModalOscillator& mode = modes_[static_cast<std::size_t>(k)];
    const HarmonicResponse response = mode.find_harmonic_response(
        wave.omega, phasor, mode.find_free_response(duration));
    wave.end_eta[k] = (wave.amplitude[k] * response.eta).real();
    wave.end_etadot[k] = (wave.amplitude[k] * response.etadot).real();
  }
}

ModalHistory ModalResponse::evaluate(const std::vector<double>& times) const {
  check_times(times, starts_.front());
  ModalHistory history{make_zeros(times), make_zeros(times)};
  calc_steps(times, find_intervals(times), history);
  add_waves(times, history);
  return history;
}

ModalEnergies ModalResponse::evaluate_energies(
    const std::vector<double>& times) const {
  const ModalHistory history = evaluate(times);
  const Indices intervals = find_intervals(times);
  ModalEnergies energies{0.5 * history.etadot.cwiseAbs2(),
                         0.5 * history.eta.cwiseAbs2(), make_zeros(times)};
  for (Eigen::Index k = 0; k < modes(); ++k) {
    energies.elastic.row(k) *= modes_[static_cast<std::size_t>(k)].lambda();
  }
  for (Eigen::Index j = 0; j < history.eta.cols(); ++j) {
    const Eigen::Index interval = intervals[static_cast<std::size_t>(j)];
    energies.load.col(j) =
        -load_.col(interval).cwiseProduct(history.eta.col(j));
  }
  return energies;
}

MatrixX ModalResponse::evaluate_step_work(
    const std::vector<double>& times) const {
  check_times(times, starts_.front());
  MatrixX before = make_zeros(starts_);
  const MatrixX each = calc_interval_work();
  for (Eigen::Index j = 0; j < each.cols(); ++j) {
    before.col(j + 1) = before.col(j) + each.col(j);
  }
  const MatrixX wave_at_start = find_wave_eta(starts_);
  const MatrixX wave_eta = find_wave_eta(times);
  const Indices intervals = find_intervals(times);
  MatrixX work = make_zeros(times);
  for (Eigen::Index j = 0; j < work.cols(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const Eigen::Index interval = intervals[at];
    for (Eigen::Index k = 0; k < modes(); ++k) {
      const double growth = find_step_growth(k, interval, times[at]) +
                            wave_eta(k, j) - wave_at_start(k, interval);
      work(k, j) = before(k, interval) + load_(k, interval) * growth;
    }
  }
  return work;
}

MatrixX ModalResponse::calc_interval_work() const {
  const MatrixX wave_eta = find_wave_eta(starts_);
  MatrixX work(modes(), std::ssize(starts_) - 1);
  for (Eigen::Index j = 0; j < work.cols(); ++j) {
    const double end = starts_[static_cast<std::size_t>(j + 1)];
    for (Eigen::Index k = 0; k < modes(); ++k) {
      const double growth =
          find_step_growth(k, j, end) + wave_eta(k, j + 1) - wave_eta(k, j);
      work(k, j) = load_(k, j) * growth;
    }
  }
  return work;
}

// eta(t) - eta(start) as one sum: a difference would cancel in a short
// interval.
double ModalResponse::find_step_growth(Eigen::Index mode, Eigen::Index interval,
                                       double t) const {
  const ModalOscillator& oscillator = modes_[static_cast<std::size_t>(mode)];
  const FreeResponse free = oscillator.find_free_response(
      t - starts_[static_cast<std::size_t>(interval)]);
  const double imbalance = load_(mode, interval) -
                           oscillator.lambda() * at_start_.eta(mode, interval);
  return free.impulse * at_start_.etadot(mode, interval) +
         free.step * imbalance;
}

void ModalResponse::calc_steps(const std::vector<double>& times,
                               const Indices& intervals,
                               ModalHistory& history) const {
  for (Eigen::Index j = 0; j < std::ssize(times); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const Eigen::Index interval = intervals[at];
    const double t = times[at] - starts_[static_cast<std::size_t>(interval)];
    for (Eigen::Index k = 0; k < modes(); ++k) {
      const ModalOscillator& mode = modes_[static_cast<std::size_t>(k)];
      const FreeResponse free = mode.find_free_response(t);
      const double eta = at_start_.eta(k, interval);
      const double etadot = at_start_.etadot(k, interval);
      const double load = load_(k, interval);
      history.eta(k, j) =
          free.stay * eta + free.impulse * etadot + free.step * load;
      history.etadot(k, j) =
          free.keep * etadot + free.impulse * (load - mode.lambda() * eta);
    }
  }
}

void ModalResponse::add_waves(const std::vector<double>& times,
                              ModalHistory& history) const {
  SharedResponses shared(modes_);
  for (Eigen::Index j = 0; j < std::ssize(times); ++j) {
    const double t = times[static_cast<std::size_t>(j)];
    for (const Wave& wave : waves_) {
      if (t <= wave.start) continue;
      if (t < wave.end) {
        add_driven(wave, shared.find(wave.start, t), j, history);
      } else {
        add_left(wave, shared.find(wave.end, t), j, history);
      }
    }
  }
}

void ModalResponse::add_driven(const Wave& wave,
                               const std::vector<FreeResponse>& free,
                               Eigen::Index column,
                               ModalHistory& history) const {
  for (Eigen::Index k = 0; k < modes(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const HarmonicResponse response = modes_[at].find_harmonic_response(
        wave.omega, find_phasor(wave.omega * free[at].t), free[at]);
    history.eta(k, column) += (wave.amplitude[k] * response.eta).real();
    history.etadot(k, column) += (wave.amplitude[k] * response.etadot).real();
  }
}

// After a wave ends, its motion is free.
void ModalResponse::add_left(const Wave& wave,
                             const std::vector<FreeResponse>& free,
                             Eigen::Index column, ModalHistory& history) const {
  for (Eigen::Index k = 0; k < modes(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const FreeResponse& f = free[at];
    history.eta(k, column) +=
        f.stay * wave.end_eta[k] + f.impulse * wave.end_etadot[k];
    history.etadot(k, column) +=
        f.keep * wave.end_etadot[k] -
        modes_[at].lambda() * f.impulse * wave.end_eta[k];
  }
}

MatrixX ModalResponse::find_wave_eta(const std::vector<double>& times) const {
  ModalHistory history{make_zeros(times), make_zeros(times)};
  add_waves(times, history);
  return history.eta;
}

// Continues from the previous interval while times increase, so that a sorted
// list needs no search.
ModalResponse::Indices ModalResponse::find_intervals(
    const std::vector<double>& times) const {
  Indices intervals(times.size());
  Eigen::Index current = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i == 0 || times[i] < times[i - 1]) {
      current = std::upper_bound(starts_.begin(), starts_.end(), times[i]) -
                starts_.begin() - 1;
    }
    while (current + 1 < std::ssize(starts_) &&
           starts_[static_cast<std::size_t>(current + 1)] <= times[i]) {
      ++current;
    }
    intervals[i] = current;
  }
  return intervals;
}

}  // namespace limber::flexbody
