// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"
#include "limber/flexbody/modal/modal_response_load.hpp"
#include "limber/flexbody/modal/modal_response_oscillator.hpp"

namespace limber::flexbody {

/// State of m modes. Empty vectors mean zero.
struct ModalState {
  double time = 0.0;  ///< [s]
  VectorX eta;        ///< m [kg^1/2 m]
  VectorX etadot;     ///< m [kg^1/2 m/s]
};

/// Motion of m modes at T times, a column each.
struct ModalHistory {
  MatrixX eta;     ///< m x T [kg^1/2 m]
  MatrixX etadot;  ///< m x T [kg^1/2 m/s]
};

/// Energies of m modes at T times, a column each.
struct ModalEnergies {
  MatrixX kinetic;  ///< m x T, etadot^2 / 2 [J]
  MatrixX elastic;  ///< m x T, lambda eta^2 / 2 [J]
  MatrixX load;     ///< m x T, -f eta of the current step load f [J]
  /// Constant in an undamped mode while its load is constant [J].
  [[nodiscard]] MatrixX corrected() const { return kinetic + elastic + load; }
};

/// Work of the loads on m modes and dissipated energy, from the initial time to
/// each of T times, a column each.
struct ModalLosses {
  MatrixX work;        ///< m x T [J]
  MatrixX dissipated;  ///< m x T [J]
};

/// Closed-form response of independent modes to step loads and sinusoids, at
/// any times.
///
/// Equation   eta'' + damping eta' + lambda eta = f(t), for each mode
/// Source     [@morrison2023, section 2], with damping, zero frequencies and
///            sinusoids added; docs/theory/modal_response.md
/// Limits     the load must not depend on the motion. Phases are exact up to
///            the round-off of sqrt(lambda) t.
///
/// The cost is one evaluation of ModalOscillator per mode for each load change
/// and each requested time (times the active sinusoids), independent of the
/// time between them. See ModalLoads for modal quantities.
class ModalResponse {
 public:
  /// @param lambda m, >= 0 [rad^2/s^2]
  /// @param damping m, diagonal of C, >= 0 [1/s]
  /// @param loads on m modes; ignored before initial.time
  /// @throws InputError, all problems at once, for sizes that differ, negative
  /// or non-finite lambda, damping, initial state; and as check(loads).
  ModalResponse(const VectorX& lambda, const VectorX& damping,
                const ModalLoads& loads, const ModalState& initial);

  [[nodiscard]] Eigen::Index modes() const { return std::ssize(modes_); }

  /// @param times T, in any order, not before the initial time [s]
  /// @throws InputError for a time that is earlier or not finite.
  [[nodiscard]] ModalHistory evaluate(const std::vector<double>& times) const;

  /// At a load change the new load applies.
  /// @param times as for evaluate() [s]
  /// @throws InputError as evaluate() does.
  [[nodiscard]] ModalEnergies evaluate_energies(
      const std::vector<double>& times) const;

  /// Work of the step load from the initial time to each of `times`, m x T
  /// [J]: the exact sum of f (eta(end) - eta(begin)) over its intervals, the
  /// motion due to sinusoids included. Arguments and errors as evaluate().
  [[nodiscard]] MatrixX evaluate_step_work(
      const std::vector<double>& times) const;

  /// Work of all loads and dissipation. Under step loads alone the work is
  /// evaluate_step_work(), and the dissipation follows from the energy balance.
  /// Under a sinusoid the dissipation is integrated by Gauss's rule over panels
  /// that resolve the fastest rate, at most kMostPanels between two times, and
  /// the work follows from the balance.
  /// @param times T, increasing, not before the initial time [s]
  /// @throws InputError for a time that is earlier or not finite.
  [[nodiscard]] ModalLosses evaluate_losses(
      const std::vector<double>& times) const;
  static constexpr int kMostPanels = 256;  ///< largest number of panels

  /// Starts of the intervals in which the step load is constant [s]: the
  /// initial time, then the changes after it.
  [[nodiscard]] const std::vector<double>& interval_starts() const {
    return starts_;
  }
  /// Work of the step load in each such interval except the last, which has no
  /// end; m x (intervals - 1) [J].
  [[nodiscard]] MatrixX calc_interval_work() const;

 private:
  // A sinusoid acting from rest: cosine - i sine at its start, and the state at
  // its end.
  struct Wave {
    double omega;
    double start;
    double end;
    Eigen::VectorXcd amplitude;
    VectorX end_eta;
    VectorX end_etadot;
  };
  using Indices = std::vector<Eigen::Index>;

  void add_intervals(const StepLoad& steps, const ModalState& initial);
  void add_wave(const SinusoidalLoad& load);
  void calc_steps(const std::vector<double>& times, const Indices& intervals,
                  ModalHistory& history) const;
  void add_waves(const std::vector<double>& times, ModalHistory& history) const;
  void add_driven(const Wave& wave, const std::vector<FreeResponse>& free,
                  Eigen::Index column, ModalHistory& history) const;
  void add_left(const Wave& wave, const std::vector<FreeResponse>& free,
                Eigen::Index column, ModalHistory& history) const;
  [[nodiscard]] Indices find_intervals(const std::vector<double>& times) const;
  [[nodiscard]] double find_step_growth(Eigen::Index mode,
                                        Eigen::Index interval, double t) const;
  [[nodiscard]] bool is_driven_by_wave(Eigen::Index mode) const;
  [[nodiscard]] MatrixX find_energy(const std::vector<double>& times) const;
  [[nodiscard]] MatrixX integrate_dissipation(
      const std::vector<double>& times) const;
  [[nodiscard]] std::vector<double> find_panels(
      const std::vector<double>& times) const;
  [[nodiscard]] MatrixX find_wave_eta(const std::vector<double>& times) const;
  [[nodiscard]] MatrixX make_zeros(const std::vector<double>& times) const {
    return MatrixX::Zero(modes(), std::ssize(times));
  }

  std::vector<ModalOscillator> modes_;
  std::vector<double> starts_;  // n intervals
  MatrixX load_;                // m x n
  ModalHistory at_start_;       // m x n, without the waves
  std::vector<Wave> waves_;
};

}  // namespace limber::flexbody
