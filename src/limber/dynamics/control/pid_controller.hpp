// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "limber/common/records/fields.hpp"
#include "limber/dynamics/control/linear_law.hpp"
#include "limber/dynamics/system/controller.hpp"
#include "limber/joints/scalar/signal.hpp"

namespace limber::dynamics {

/// Gains and limits of a PidController. u: unit of its output, y: of its
/// measurement.
struct PidParameters {
  joints::Signal reference = {joints::ConstantSignal{}};  ///< r [y]
  double proportional = 0.0;                              ///< kp [u/y]
  double integral = 0.0;                                  ///< ki [u/(y s)]
  double derivative = 0.0;                                ///< kd [u s/y]
  double filter_time = 0.0;  ///< tau of the low-pass filter, >= 0 [s]
  /// Number of samples from a measurement to the output for it.
  std::size_t delay = 0;
  /// Bounds of the output [u]
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double initial = 0.0;   ///< written while a delay has nothing yet [u]
  bool has_rate = false;  ///< the rate is measured, too: the second measurement
  double period = 0.0;    ///< of its controller, T > 0 [s]
};

/// A sampled proportional, integral and derivative law of one measurement.
///
/// Equation   yf_k = yf_(k-1) + (1 - exp(-T/tau)) (y_k - yf_(k-1)), yf_0 = y_0
///            e_k  = r(t_k) - yf_k,    I_k = I_(k-1) + ki T e_k
///            u_k  = kp e_k + I_k + kd (r'(t_k) - (yf_k - yf_(k-1)) / T)
///            within [lower, upper]; I keeps its value in a sample in which u
///            is beyond a bound and ki e_k would move it further. A
///            measured rate replaces the difference, with the same
///            filter
/// Source     [@astrom1995], ch. 3 (conditional integration)
/// Limits     the first sample has no difference: the rate of the measurement
///            is taken as 0 there
class PidController : public Controller {
 public:
  /// @throws InputError for a number that is not finite, a negative filter
  /// time, an empty range of bounds, an initial value outside them, or no gain.
  explicit PidController(PidParameters parameters);

  /// The required ControllerModel::memory.
  [[nodiscard]] std::vector<double> make_memory() const;

  [[nodiscard]] const PidParameters& parameters() const { return parameters_; }

  /// The law within its limits, after its first sample.
  [[nodiscard]] LinearLaw linearise() const;

  void sample(const ControllerView& view, std::span<double> memory,
              std::span<double> written) const override;
  void describe(Manifest& out) const override;

 private:
  PidParameters parameters_;
  double fraction_ = 1.0;  ///< of a new measurement in the filtered one
};

constexpr auto fields_of(const PidParameters*) {
  return list_fields("pid", "reference", "proportional", "integral",
                     "derivative", "filter time [s]", "delay in samples",
                     "lower bound", "upper bound", "initial",
                     "measures the rate", "period [s]");
}

}  // namespace limber::dynamics
