// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/point_spring.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

// The length as a coordinate: the line rotates about its far end.
struct LineMotion {
  Vector3 e;
  ScalarMotion scalar;
};

LineMotion find_line(const RelativeMotion& motion, double shortest) {
  const double length = motion.p_FM_F.norm();
  if (!(length > shortest)) {
    throw NumericalError(fmt::format(
        "point spring: its ends coincide, so its direction is undefined; "
        "use a free length of 0 and no table, or a bushing (length {:g} m)",
        length));
  }
  const Vector3 e = motion.p_FM_F / length;
  return {e, {length, e.dot(motion.v_FM_F)}};
}

}  // namespace

PointSpring::PointSpring(const Parameters& parameters)
    : parameters_(parameters),
      line_({.curve = SpringCurve({.stiffness = parameters.stiffness,
                                   .quadratic = parameters.quadratic,
                                   .extensions = parameters.extensions,
                                   .forces = parameters.forces}),
             .damping = parameters.damping,
             .rest = parameters.free_length,
             .tension_only = parameters.tension_only}),
      has_no_length_(parameters.free_length == 0.0 &&
                     parameters.forces.empty() && !parameters.tension_only) {
  if (!(parameters.free_length >= 0.0)) {
    throw InputError(
        fmt::format("point spring: free length is {:g} m; expected >= 0",
                    parameters.free_length));
  }
}

CouplerResponse PointSpring::evaluate_without_length(
    const RelativeMotion& motion) const {
  const Parameters& p = parameters_;
  const Vector3& r = motion.p_FM_F;
  const double length = r.norm();
  const double k = p.stiffness + p.quadratic * length;
  CouplerResponse response;
  response.wrench.head<3>() = -k * r - p.damping * motion.v_FM_F;
  response.energy =
      (0.5 * p.stiffness + p.quadratic * length / 3.0) * length * length;
  response.dissipation = p.damping * motion.v_FM_F.squaredNorm();
  response.stiffness.topLeftCorner<3, 3>().diagonal().setConstant(k);
  if (p.quadratic > 0.0 && length > 0.0) {
    response.stiffness.topLeftCorner<3, 3>() +=
        p.quadratic * r * (r / length).transpose();
  }
  response.damping.topLeftCorner<3, 3>().diagonal().setConstant(p.damping);
  return response;
}

CouplerResponse PointSpring::evaluate(const RelativeMotion& motion,
                                      SwitchMode mode) const {
  if (has_no_length_) return evaluate_without_length(motion);
  if (parameters_.tension_only &&
      !is_on(mode, motion.p_FM_F.norm() > parameters_.free_length)) {
    return {};
  }
  const LineMotion line =
      find_line(motion, kMinLengthRatio * parameters_.free_length);
  const ScalarResponse scalar = line_.evaluate(line.scalar, {mode, {}});
  const double length = line.scalar.z;
  const Matrix3 along = line.e * line.e.transpose();
  const Matrix3 across = Matrix3::Identity() - along;

  CouplerResponse response;
  response.wrench.head<3>() = scalar.force * line.e;
  response.energy = scalar.energy;
  response.dissipation = scalar.dissipation;
  // d rate / d p = (across v)' / length.
  const Vector3 drift = across * motion.v_FM_F / length;
  response.stiffness.topLeftCorner<3, 3>() =
      scalar.stiffness * along - (scalar.force / length) * across +
      scalar.damping * line.e * drift.transpose();
  response.damping.topLeftCorner<3, 3>() = scalar.damping * along;
  return response;
}

CouplerResponse PointSpring::evaluate_over_step(const MotionStep& motion,
                                                const CouplerMemory& memory,
                                                const StepTimes& times) const {
  const SwitchMode mode = memory.switches[0];
  const double length0 = motion.begin.p_FM_F.norm();
  const double length1 = motion.end.p_FM_F.norm();
  const double length = 0.5 * (length0 + length1);
  const double across = motion.mean.p_FM_F.norm();
  const double fraction = across > 0.0 ? across / length : 1.0;
  RelativeMotion line = motion.mean;
  line.p_FM_F /= fraction;
  line.v_FM_F *= fraction;
  CouplerResponse response = evaluate(line, mode);
  response.wrench *= fraction;
  if (!(across > 0.0)) return response;
  const Vector3 direction = motion.mean.p_FM_F / length;
  const double rate = direction.dot(motion.mean.v_FM_F);
  // Of the length that the rate leads to: not that of rounded places.
  RelativeMotion end = motion.end;
  if (length1 > 0.0) end.p_FM_F *= (length0 + times.h * rate) / length1;
  const double lack =
      find_lack({.energy0 = evaluate(motion.begin, mode).energy,
                 .energy1 = evaluate(end, mode).energy,
                 .h = times.h,
                 .dissipation = response.dissipation,
                 .power = response.wrench.head<3>().dot(motion.mean.v_FM_F),
                 .force = response.wrench.head<3>().norm(),
                 .z0 = length0,
                 .z1 = length1});
  if (lack != 0.0 && rate != 0.0) {
    response.wrench.head<3>() += (lack / rate) * direction;
  }
  return response;
}

SwitchValue PointSpring::find_switch(int /*index*/,
                                     const RelativeMotion& motion,
                                     const CouplerMemory& /*memory*/,
                                     double /*t*/) const {
  const double length = motion.p_FM_F.norm();
  const double rate =
      length > 0.0 ? motion.p_FM_F.dot(motion.v_FM_F) / length : 0.0;
  return line_.find_switch(0, {length, rate});
}

CoordinateReading PointSpring::read(int coordinate,
                                    const RelativeMotion& motion,
                                    const CouplerMemory& memory,
                                    const EvaluationTime& now) const {
  LIMBER_EXPECT(coordinate == 0);
  const Vector3 force = evaluate(motion, memory, now).wrench.head<3>();
  const double length = motion.p_FM_F.norm();
  const ScalarMotion along =
      length == 0.0
          ? ScalarMotion{0.0, motion.v_FM_F.norm()}
          : ScalarMotion{length, motion.v_FM_F.dot(motion.p_FM_F) / length};
  const double push =
      length == 0.0 ? -force.norm() : force.dot(motion.p_FM_F) / length;
  return {along, {.force = push}, -push};
}

}  // namespace limber::joints
