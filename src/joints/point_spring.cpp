// SPDX-License-Identifier: BSD-3-Clause
#include "joints/point_spring.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/errors.hpp"

namespace limber::joints {
namespace {

void check_not_negative(double value, const char* what, const char* unit) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw InputError(fmt::format("point spring: {} is {:g} {}; expected >= 0",
                                 what, value, unit));
  }
}

// Spring without free length: k p' p / 2, damper on all of v.
CouplerResponse evaluate_without_length(const PointSpring::Parameters& p,
                                        const RelativeMotion& motion) {
  CouplerResponse response;
  response.wrench.head<3>() =
      -p.stiffness * motion.p_FM_F - p.damping * motion.v_FM_F;
  response.energy = 0.5 * p.stiffness * motion.p_FM_F.squaredNorm();
  response.dissipation = p.damping * motion.v_FM_F.squaredNorm();
  response.stiffness.topLeftCorner<3, 3>().diagonal().setConstant(p.stiffness);
  response.damping.topLeftCorner<3, 3>().diagonal().setConstant(p.damping);
  return response;
}

}  // namespace

PointSpring::PointSpring(const Parameters& parameters)
    : parameters_(parameters) {
  check_not_negative(parameters.stiffness, "stiffness", "N/m");
  check_not_negative(parameters.damping, "damping", "N s/m");
  check_not_negative(parameters.free_length, "free length", "m");
}

CouplerResponse PointSpring::evaluate(const RelativeMotion& motion) const {
  const Parameters& p = parameters_;
  if (p.free_length == 0.0) return evaluate_without_length(p, motion);

  const double length = motion.p_FM_F.norm();
  if (!(length > kMinLengthRatio * p.free_length)) {
    throw NumericalError(fmt::format(
        "point spring: its ends coincide, so its direction has no meaning; "
        "use a free length of 0 or a bushing (free length {:g} m)",
        p.free_length));
  }
  const Vector3 e = motion.p_FM_F / length;
  const Matrix3 along = e * e.transpose();
  const Matrix3 across = Matrix3::Identity() - along;
  const double rate = e.dot(motion.v_FM_F);
  const double stretch = length - p.free_length;
  const double tension = p.stiffness * stretch + p.damping * rate;

  CouplerResponse response;
  response.wrench.head<3>() = -tension * e;
  response.energy = 0.5 * p.stiffness * stretch * stretch;
  response.dissipation = p.damping * rate * rate;
  // d rate / d p = (across v)' / length.
  const Vector3 drift = across * motion.v_FM_F / length;
  response.stiffness.topLeftCorner<3, 3>() = p.stiffness * along +
                                             (tension / length) * across +
                                             p.damping * e * drift.transpose();
  response.damping.topLeftCorner<3, 3>() = p.damping * along;
  return response;
}

}  // namespace limber::joints
