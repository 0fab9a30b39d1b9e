// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/archive.hpp"
#include "dynamics/system_state.hpp"
#include "dynamics/workspace.hpp"

namespace limber::dynamics {

/// What dampers take over a step, from the path that they go: the trapezoidal
/// rule on powers does not know how far a stiff damper moves.
///
/// Equation   of a damper with the force D v: mean(D v) . dz in place of
///            h mean(v . D v), means of both ends, dz the change of the
///            coupler's relative position and angle, of a transmission's
///            coordinate, of eta. Their difference is of third order in h, and
///            nothing where v is constant. Where it is not resolved, v is wrong
///            by what the scheme leaves of velocities, O(h^2) on the group; a
///            stiff spring holds the position all the same, and D v . v may be
///            1e6 times the energy there is.
///            No link or mode gives energy back: less than nothing is nothing,
///            so that what a scheme puts into springs is not taken for losses;
///            nor does it take over 1.1 of what the trapezoidal rule has, which
///            round-off of positions may do to stiff ones.
/// Source     work as mean(f) . dz: [@belytschko2000, sec. 6.2]; by it
///            Newmark's average acceleration changes the kinetic energy exactly
/// Limits     D is the law's derivative by velocities. A link whose power is
///            not v . D v to a thousandth, of friction or a drive, goes by the
///            trapezoidal rule, and so does a coupler that turns more than a
///            right angle in a step.
class DamperWork {
 public:
  explicit DamperWork(const SystemModel& model);

  /// The step that follows begins at `terms`.
  void start(const SystemTerms& terms);
  /// A step of `h` [s] from `from` to `to`, with `terms`; the next begins
  /// there. @returns what to add to the trapezoidal rule [J]
  double advance(const SystemState& from, const SystemState& to,
                 const SystemTerms& terms, double h);
  /// Takes the last advance() back.
  void undo() { now_.swap(before_); }

  /// What it knows between steps.
  void exchange_memory(Archive& archive) { archive(now_); }

 private:
  // Of a coupler or a transmission, in its first entries.
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
