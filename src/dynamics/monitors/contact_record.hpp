// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/common/records/fields.hpp"

namespace limber::dynamics {

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
  double parting_speed = 0.0;    ///< at the last leave [m/s]
  bool has_parted = false;       ///< false: they touch at the end
  double impact_duration = 0.0;  ///< T_c of a free impact, expected [s]

  /// Of both bodies' rigid motions, along the normals of the first touch and
  /// the last leave, without vibration [-]. None if they touch at the end, or
  /// did not approach each other.
  [[nodiscard]] std::optional<double> restitution() const {
    if (!has_parted || !(touch_speed > 0.0)) return std::nullopt;
    return parting_speed / touch_speed;
  }
};

constexpr auto fields_of(const ContactRecord*) {
  return list_fields("contact", "pair", "time [s]", "touches", "impulse [N s]",
                     "peak force [N]", "peak time [s]", "peak depth [m]",
                     "peak depth over radius", "duration [s]",
                     "touch speed [m/s]", "parting speed [m/s]", "has parted",
                     "impact duration [s]");
}

}  // namespace limber::dynamics
