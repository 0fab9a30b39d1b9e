// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::contact {

/// Centre and second moments of the pressure of several patches, from the place
/// of the first, so that a distant origin costs no digits.
class PressureSum {
 public:
  /// @param force normal, > 0 [N] @param spread_W about p_W [m^2]
  void add(double force, const Vector3& p_W, const Matrix3& spread_W) {
    if (force_ == 0.0) first_W_ = p_W;
    const Vector3 place = p_W - first_W_;
    force_ += force;
    first_moment_ += force * place;
    second_moment_ += force * (spread_W + place * place.transpose());
  }
  /// Of nothing: 0 [m].
  [[nodiscard]] Vector3 centre_W() const {
    return first_W_ + first_moment_ / divisor();
  }
  /// About the centre [m^2].
  [[nodiscard]] Matrix3 spread_W() const {
    const Vector3 centre = first_moment_ / divisor();
    return second_moment_ / divisor() - centre * centre.transpose();
  }

 private:
  [[nodiscard]] double divisor() const { return force_ > 0.0 ? force_ : 1.0; }

  double force_ = 0.0;
  Vector3 first_W_ = Vector3::Zero();
  Vector3 first_moment_ = Vector3::Zero();
  Matrix3 second_moment_ = Matrix3::Zero();
};

}  // namespace limber::contact
