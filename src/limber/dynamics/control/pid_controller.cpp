// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/control/pid_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {
namespace {

/// Places in the memory; what is delayed follows, the oldest first.
enum Place : std::size_t { kStarted, kFiltered, kRate, kIntegral, kDelayed };

void check(const PidParameters& p) {
  for (const auto& [name, value] :
       {std::pair<const char*, double>("proportional", p.proportional),
        std::pair<const char*, double>("integral", p.integral),
        std::pair<const char*, double>("derivative", p.derivative),
        std::pair<const char*, double>("filter", p.filter_time),
        std::pair<const char*, double>("initial", p.initial)}) {
    if (std::isfinite(value)) continue;
    throw InputError(
        fmt::format("'{}' is {}; expected a finite number", name, value));
  }
  if (p.filter_time < 0.0) {
    throw InputError(fmt::format("its filter's time is {:g} s; expected >= 0",
                                 p.filter_time));
  }
  if (!(p.period > 0.0)) {
    throw InputError(
        fmt::format("its period is {:g} s; expected > 0", p.period));
  }
  if (!(p.lower < p.upper)) {
    throw InputError(fmt::format(
        "its limits are {:g} and {:g}; expected the lower one first", p.lower,
        p.upper));
  }
  if (p.initial < p.lower || p.initial > p.upper) {
    throw InputError(
        fmt::format("its initial value {:g} is beyond its limits {:g} and {:g}",
                    p.initial, p.lower, p.upper));
  }
  if (p.proportional == 0.0 && p.integral == 0.0 && p.derivative == 0.0) {
    throw InputError(
        "has no gain; give 'proportional', 'integral' or 'derivative'");
  }
  joints::check(p.reference);
}

}  // namespace

PidController::PidController(PidParameters parameters)
    : parameters_(std::move(parameters)) {
  check(parameters_);
  if (parameters_.filter_time > 0.0) {
    fraction_ = -std::expm1(-parameters_.period / parameters_.filter_time);
  }
}

std::vector<double> PidController::make_memory() const {
  std::vector<double> memory(kDelayed + parameters_.delay, parameters_.initial);
  std::fill_n(memory.begin(), kDelayed, 0.0);
  return memory;
}

// States: the filtered measurement, the filtered rate, the integral, and what
// is delayed, the oldest first.
LinearLaw PidController::linearise() const {
  const PidParameters& p = parameters_;
  const Eigen::Index delay = static_cast<Eigen::Index>(p.delay);
  const Eigen::Index n = 3 + delay;
  const Eigen::Index reference = p.has_rate ? 2 : 1;
  // Rows over the states, the measurements, the reference and its rate.
  using Row = Eigen::RowVectorXd;
  const auto unit = [&](Eigen::Index i) {
    return Row(Row::Unit(n + reference + 2, i));
  };
  const Row filtered = (1.0 - fraction_) * unit(0) + fraction_ * unit(n);
  const Row rate =
      p.has_rate ? Row((1.0 - fraction_) * unit(1) + fraction_ * unit(n + 1))
                 : Row((filtered - unit(0)) / p.period);
  const Row error = unit(n + reference) - filtered;
  const Row integral = unit(2) + p.integral * p.period * error;
  const Row u = p.proportional * error + integral +
                p.derivative * (unit(n + reference + 1) - rate);
  MatrixX next(n, u.size());
  next.topRows<3>() << filtered, rate, integral;
  for (Eigen::Index i = 0; i < delay; ++i) {
    next.row(3 + i) = i + 1 < delay ? unit(4 + i) : u;
  }
  const Row written = delay > 0 ? unit(3) : u;
  return {next.leftCols(n), next.rightCols(reference + 2), written.head(n),
          written.tail(reference + 2)};
}

void PidController::sample(const ControllerView& view, std::span<double> memory,
                           std::span<double> written) const {
  const PidParameters& p = parameters_;
  const bool is_first = memory[kStarted] == 0.0;
  const double before = memory[kFiltered];
  const auto filter = [&](double old, double value) {
    return is_first ? value : old + fraction_ * (value - old);
  };
  memory[kStarted] = 1.0;
  memory[kFiltered] = filter(before, view.measured[0]);
  if (p.has_rate) {
    memory[kRate] = filter(memory[kRate], view.measured[1]);
  } else if (!is_first) {
    memory[kRate] = (memory[kFiltered] - before) / p.period;
  }
  const joints::SignalValue reference =
      joints::evaluate(p.reference, now_of(view.state));
  const double error = reference.value - memory[kFiltered];
  const double growth = p.integral * p.period * error;
  const double u = p.proportional * error + memory[kIntegral] + growth +
                   p.derivative * (reference.rate - memory[kRate]);
  const bool saturates =
      (u > p.upper && growth > 0.0) || (u < p.lower && growth < 0.0);
  if (!saturates) memory[kIntegral] += growth;
  const double bounded = std::clamp(u, p.lower, p.upper);
  const std::span<double> delayed = memory.subspan(kDelayed);
  if (delayed.empty()) {
    written[0] = bounded;
    return;
  }
  written[0] = delayed.front();
  std::shift_left(delayed.begin(), delayed.end(), 1);
  delayed.back() = bounded;
}

void PidController::describe(Manifest& out) const {
  limber::describe(out, "pid", parameters_);
}

}  // namespace limber::dynamics
