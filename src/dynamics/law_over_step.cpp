// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/law_over_step.hpp"

#include <cmath>
#include <limits>

namespace limber::dynamics {
namespace {

using joints::CouplerMemory;
using joints::CouplerResponse;
using joints::RelativeMotion;
using joints::ScalarResponse;

// A balance is closed when what is left of it is round-off of its terms.
constexpr double kRoundoff = 4.0 * std::numeric_limits<double>::epsilon();
// Below this turn [rad] a gradient at the middle is exact to round-off.
constexpr double kSmallTurn = 1e-5;

// Power that the force lacks to balance the energies; 0 if it is round-off.
double find_lack(double energy0, double energy1, double h, double dissipation,
                 double supplied, double power) {
  const double lack = supplied - dissipation - power - (energy1 - energy0) / h;
  const double noise =
      kRoundoff *
      ((std::abs(energy0) + std::abs(energy1)) / h + std::abs(dissipation) +
       std::abs(supplied) + std::abs(power));
  return std::abs(lack) <= noise ? 0.0 : lack;
}

// The rotation halfway between those of both ends.
Matrix3 find_middle_rotation(const Matrix3& R0, const Matrix3& R1) {
  const Quaternion q0(R0);
  const Quaternion q1(R1);
  const double sign = q0.dot(q1) < 0.0 ? -1.0 : 1.0;
  return Quaternion(q0.coeffs() + sign * q1.coeffs())
      .normalized()
      .toRotationMatrix();
}

// A line's length over the step: its law sees the mean of both lengths and
// their difference, and acts along the sum of both lines over that of their
// lengths, whose product with the velocity is the length's rate.
CouplerResponse evaluate_line(const joints::PointSpring& spring,
                              const MotionStep& motion,
                              const CouplerMemory& memory, double h) {
  const joints::SwitchMode mode = memory.switches[0];
  const double length =
      0.5 * (motion.begin.p_FM_F.norm() + motion.end.p_FM_F.norm());
  const double across = motion.mean.p_FM_F.norm();
  const double share = across > 0.0 ? across / length : 1.0;
  RelativeMotion line = motion.mean;
  line.p_FM_F /= share;
  line.v_FM_F *= share;
  CouplerResponse response = spring.evaluate(line, mode);
  response.wrench *= share;
  if (!(across > 0.0)) return response;
  const Vector3 direction = motion.mean.p_FM_F / length;
  const double rate = direction.dot(motion.mean.v_FM_F);
  const double power = response.wrench.head<3>().dot(motion.mean.v_FM_F);
  const double lack = find_lack(spring.evaluate(motion.begin, mode).energy,
                                spring.evaluate(motion.end, mode).energy, h,
                                response.dissipation, 0.0, power);
  if (lack != 0.0 && rate != 0.0) {
    response.wrench.head<3>() += (lack / rate) * direction;
  }
  return response;
}

CouplerResponse evaluate_joint(const joints::Joint& joint,
                               const MotionStep& motion,
                               const CouplerMemory& memory,
                               const StepTimes& times) {
  CouplerResponse response =
      std::visit([&](const auto& hold) { return hold.evaluate(motion.mean); },
                 joint.hold());
  std::size_t first = 0;  // of an element's switches
  for (const joints::JointElement& element : joint.elements()) {
    const auto i = static_cast<std::size_t>(element.coordinate);
    const CoordinateStep step = find_coordinate_step(
        joint.coordinates()[i], motion, memory.near[i], times.h);
    const ScalarResponse scalar = evaluate_over_step(
        element.law, step, times,
        {memory.switches[first], memory.switches[first + 1]});
    joints::CoordinateValue value;
    value.gradient = step.gradient;
    value.hessian = step.hessian;
    joints::add_along(value, motion.mean, scalar, response);
    first += static_cast<std::size_t>(joints::switch_count(element.law));
  }
  return response;
}

}  // namespace

CoordinateStep find_coordinate_step(const joints::AxisCoordinate& coordinate,
                                    const MotionStep& motion, double near,
                                    double h) {
  CoordinateStep step;
  step.z0 = joints::evaluate(coordinate, motion.begin, near).z;
  step.z1 = joints::evaluate(coordinate, motion.end, near).z;
  RelativeMotion middle = motion.mean;
  middle.R_FM = find_middle_rotation(motion.begin.R_FM, motion.end.R_FM);
  const joints::CoordinateValue value =
      joints::evaluate(coordinate, middle, near);
  step.rate = value.rate;
  step.gradient = value.gradient;
  step.hessian = value.hessian;
  const Vector3& w = motion.mean.w_FM_F;
  const double speed = w.norm();
  if (coordinate.kind == joints::AxisCoordinate::Kind::angle &&
      h * speed > kSmallTurn) {
    step.rate = (step.z1 - step.z0) / h;
    step.gradient.tail<3>() += ((step.rate - value.rate) / (speed * speed)) * w;
  }
  return step;
}

ScalarResponse evaluate_over_step(const joints::ScalarLaw& law,
                                  const CoordinateStep& coordinate,
                                  const StepTimes& times,
                                  const joints::SwitchModes& modes) {
  const auto at = [&](double z, double t, Side side) {
    return joints::evaluate(law, {z, coordinate.rate}, {t, side}, modes);
  };
  const double energy0 = at(coordinate.z0, times.begin, Side::right).energy;
  const double energy1 = at(coordinate.z1, times.end, Side::left).energy;
  const double z = 0.5 * (coordinate.z0 + coordinate.z1);
  ScalarResponse response = at(z, times.middle(), Side::right);
  const double power = response.force * coordinate.rate;
  if (std::holds_alternative<joints::Drive>(law)) {
    response.supplied =
        (energy1 - energy0) / times.h + response.dissipation + power;
    return response;
  }
  const double lack = find_lack(energy0, energy1, times.h, response.dissipation,
                                response.supplied, power);
  if (lack != 0.0 && coordinate.rate != 0.0) {
    response.force += lack / coordinate.rate;
  }
  return response;
}

CouplerResponse evaluate_over_step(const joints::CouplerLaw& law,
                                   const MotionStep& motion,
                                   const joints::CouplerMemory& memory,
                                   const StepTimes& times) {
  if (const auto* joint = std::get_if<joints::Joint>(&law)) {
    return evaluate_joint(*joint, motion, memory, times);
  }
  if (const auto* spring = std::get_if<joints::PointSpring>(&law)) {
    return evaluate_line(*spring, motion, memory, times.h);
  }
  return joints::evaluate(law, motion.mean, memory,
                          {times.middle(), Side::right});
}

}  // namespace limber::dynamics
