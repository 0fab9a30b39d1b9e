// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Energy dissipated by dampers over a step, from their displacement: the
/// trapezoidal rule applied to powers ignores how far a stiff damper moves.
///
/// Equation   of a damper with the force D v: mean(D v) . dz in place of
///            h mean(v . D v), means of both ends, dz the change of the
///            coupler's relative position and angle, of a transmission's
///            coordinate, of eta. The two differ at third order in h, and not
///            at all where v is constant. Where the step does not resolve the
///            motion, v has the scheme's error, O(h^2) on the group, while a
///            stiff spring keeps the position; D v . v may then be 1e6 times
///            the energy of the system.
///            The dissipation of each link and mode is limited to between 0, so
///            that energy which a scheme adds to springs does not count as a
///            negative loss, and 1.1 times that of the trapezoidal rule, which
///            round-off of positions may exceed for stiff dampers.
/// Source     work as mean(f) . dz: [@belytschko2000, sec. 6.2]; by it
///            Newmark's average acceleration changes the kinetic energy exactly
/// Limits     D is the law's derivative with respect to velocity. Links whose
///            power differs from v . D v by more than a thousandth (friction,
///            drives) use the trapezoidal rule, as do couplers that rotate more
///            than a right angle in a step.
class DamperWork {
 public:
  explicit DamperWork(const SystemModel& model);

  /// Sets the terms at the beginning of the next step.
  void start(const SystemTerms& terms);
  /// Accounts for a step of `h` [s] from `from` to `to`, where `terms` apply;
  /// the next step begins there.
  /// @param losses by the trapezoidal rule, in the rows of EnergyRows, to which
  /// corrections are added [J]
  void advance(const SystemState& from, const SystemState& to,
               const SystemTerms& terms, double h, VectorX& losses);
  /// Reverts the last advance().
  void undo() { now_.swap(before_); }

  /// Saves or restores the history.
  void exchange_memory(Archive& archive) { archive(now_); }

 private:
  // Motion and force of a coupler; of a transmission, in the first entries.
  struct Link {
    Matrix3 R = Matrix3::Identity();
    Vector3 p = Vector3::Zero();
    Vector6 velocity = Vector6::Zero();
    Vector6 force = Vector6::Zero();
    double power = 0.0;  // of all its dampers and friction [W]
    [[nodiscard]] bool is_linear() const;  // its power is force . velocity
  };
  friend void exchange(Archive& archive, Link& link) {
    archive(link.R, link.p, link.velocity, link.force, link.power);
  }
  static Link read(const CouplerTerms& coupler);
  static Link read(const TransmissionTerms& transmission);
  static double find_correction(const Link& first, const Link& last, double h);

  const SystemModel& model_;
  std::vector<Link> now_;  // couplers, then transmissions
  std::vector<Link> before_;
};

}  // namespace limber::dynamics
