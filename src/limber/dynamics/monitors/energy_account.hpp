// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/archive.hpp"
#include "limber/common/types.hpp"

namespace limber::dynamics {

/// Energy of one row of EnergyRows in the world frame, and what passed through
/// it since the start; of a body also its momentum, by which the frame can be
/// changed.
struct EnergyAccount {
  double initial = 0.0;     ///< stored at the start [J]
  double stored = 0.0;      ///< [J]
  double kinetic = 0.0;     ///< [J]
  double power = 0.0;       ///< received from other rows [W]
  double received = 0.0;    ///< from them since the start [J]
  double supplied = 0.0;    ///< by loads, gravity and drives since then [J]
  double dissipated = 0.0;  ///< since then [J]
  double in = 0.0;          ///< over steps with more in than out [J]
  double out = 0.0;         ///< over the others [J]
  double passed = 0.0;      ///< magnitudes of what went in and out [J]
  double noise = 0.0;       ///< of a coupler or pair at a state, at most [J]

  /// Of a body whose places end at their last digits every step, at most [J].
  double jitter = 0.0;
  double mass = 0.0;                         ///< of a body that is free [kg]
  Vector3 first_momentum = Vector3::Zero();  ///< at the start [kg m/s]
  Vector3 momentum = Vector3::Zero();        ///< [kg m/s]
  Vector3 force = Vector3::Zero();           ///< of all that acts on it [N]
  Vector3 impulse = Vector3::Zero();         ///< of it since the start [N s]

  /// Energies in a frame that moves with the constant velocity `v` [m/s].
  [[nodiscard]] double stored_in(const Vector3& v) const {
    return stored + shift(v);
  }
  [[nodiscard]] double kinetic_in(const Vector3& v) const {
    return kinetic + shift(v);
  }
  [[nodiscard]] double initial_in(const Vector3& v) const {
    return initial - first_momentum.dot(v) + 0.5 * mass * v.squaredNorm();
  }
  /// Work of loads, gravity and drives there, if forces of other rows cancel
  /// within a group.
  [[nodiscard]] double work_in(const Vector3& v) const {
    return supplied - impulse.dot(v);
  }
  /// Energy that a change to that frame subtracts from.
  [[nodiscard]] double rounded_in(const Vector3& v) const {
    return kinetic + 0.5 * mass * v.squaredNorm();
  }
  /// Of its energies there, and the tolerance of Newton's method, at most.
  [[nodiscard]] double roundoff_in(const Vector3& v) const {
    constexpr double kPassedError = 1e-11;  // [-]
    return kPassedError * (passed + rounded_in(v));
  }
  /// What nothing accounts for.
  [[nodiscard]] double error_in(const Vector3& v) const {
    return stored - initial - received - supplied + dissipated -
           (momentum - first_momentum - impulse).dot(v);
  }

 private:
  [[nodiscard]] double shift(const Vector3& v) const {
    return -momentum.dot(v) + 0.5 * mass * v.squaredNorm();
  }
};

inline void exchange(Archive& archive, EnergyAccount& account) {
  archive(account.initial, account.stored, account.kinetic, account.power,
          account.received, account.supplied, account.dissipated, account.in,
          account.out, account.passed, account.noise, account.jitter,
          account.first_momentum, account.momentum, account.force,
          account.impulse);
}

}  // namespace limber::dynamics
