// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "limber/common/records/fields.hpp"

namespace limber::dynamics {

/// Energy balance of an impact, or of a resting contact, from its beginning to
/// its end: of both bodies' motion, and of their deformation without that at
/// the contact. Neither what else moves nor a common velocity matters.
///
/// Equation   in = stored + returned + damped + rubbed - error
/// Limits     `returned` is that of the powers at the ends of steps. Where
///            other forces act on the bodies (joints), `error` is the
///            lesser of that of the bodies with the contact and that of all
///            connected bodies.
struct ImpactEnergy {
  double in = 0.0;        ///< from both bodies [J]
  double returned = 0.0;  ///< to them [J]
  double stored = 0.0;    ///< change, 0 if they part [J]
  double damped = 0.0;    ///< lost by the normal damping [J]
  double rubbed = 0.0;    ///< lost by friction [J]
  double error = 0.0;     ///< gained by the steps, or lost if < 0 [J]
  double roundoff = 0.0;  ///< of the error, at most [J]

  /// Error over the energy of the impact [-]; 0 if it may be round-off.
  [[nodiscard]] double unbalanced_fraction() const {
    const double all = std::max(std::abs(in), std::abs(returned));
    return std::abs(error) > roundoff && all > 0.0 ? std::abs(error) / all
                                                   : 0.0;
  }
};

constexpr auto fields_of(const ImpactEnergy*) {
  return list_fields("impact energy", "in [J]", "returned [J]", "stored [J]",
                     "damped [J]", "rubbed [J]", "error [J]", "round-off [J]");
}

/// An impact of two bodies, or one body resting on another: all touches of a
/// pair with gaps shorter than the contact has lasted so far.
struct ContactRecord {
  std::string pair;         ///< name
  double time = 0.0;        ///< of the first touch [s]
  int touches = 0;          ///< count
  double impulse = 0.0;     ///< of the normal force [N s]
  double peak_force = 0.0;  ///< normal [N]
  double peak_time = 0.0;   ///< [s]
  double peak_depth = 0.0;  ///< [m]
  /// Largest pi depth^2 / area: of Hertz's contact, whose area is pi R_e depth,
  /// the depth over the radius R_e [-].
  double peak_depth_over_radius = 0.0;
  double duration = 0.0;     ///< from the first touch to the last leave, or to
                             ///< the end of the run [s]
  double touch_speed = 0.0;  ///< approach at the first touch [m/s]
  double approach_speed = 0.0;   ///< then, along the whole impulse [m/s]
  double parting_speed = 0.0;    ///< likewise, at the last leave [m/s]
  bool has_parted = false;       ///< false: they touch at the end
  double impact_duration = 0.0;  ///< T_c of a free impact, expected [s]
  double rest_speed = 0.0;       ///< approach up to which it is no impact [m/s]
  ImpactEnergy energy = {};

  /// Whether both approached each other faster than a contact at rest does.
  [[nodiscard]] bool is_impact() const { return touch_speed > rest_speed; }

  /// Of both bodies' rigid motions along the line of the whole impulse of the
  /// normal force, without vibration [-]. None if they touch at the end, no
  /// impact brought them together, or other motion did more than that: beyond 0
  /// to 1.5, for example where a vibrating finger strikes a body that it hardly
  /// approaches.
  [[nodiscard]] std::optional<double> restitution() const {
    constexpr double kMost = 1.5;
    if (!has_parted || !is_impact()) return std::nullopt;
    const double e = parting_speed / approach_speed;
    if (!(e >= 0.0 && e <= kMost)) return std::nullopt;
    return e;
  }
};

constexpr auto fields_of(const ContactRecord*) {
  return list_fields("contact", "pair", "time [s]", "touches", "impulse [N s]",
                     "peak force [N]", "peak time [s]", "peak depth [m]",
                     "peak depth over radius", "duration [s]",
                     "touch speed [m/s]", "approach speed [m/s]",
                     "parting speed [m/s]", "has parted", "impact duration [s]",
                     "rest speed [m/s]", "energy");
}

}  // namespace limber::dynamics
