// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/control/coupler_rows.hpp"

#include <utility>
#include <variant>

#include "limber/common/dense/qr.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/coupler_motion.hpp"
#include "limber/scene/control/vector_rows.hpp"

namespace limber::scene {
namespace {

using Index = Eigen::Index;
using Row = Eigen::RowVectorXd;

/// Rows of one coupler or transmission.
struct LinkRows {
  MatrixX motion;
  MatrixX velocity;
  MatrixX wrench;
  MatrixX wrench_by_input;
};

LinkRows find_link(const dynamics::LinearSystem& system, std::size_t link) {
  const Index row = 6 * static_cast<Index>(link);
  return {system.links.middleRows<6>(row),
          system.link_velocities.middleRows<6>(row),
          system.wrenches.middleRows<6>(row),
          system.wrenches_by_input.middleRows<6>(row)};
}

/// A coordinate's derivatives by the states.
struct CoordinateRows {
  Row z;
  Row rate;
};

CouplerRows only(MatrixX by_state, Index inputs) {
  const Index rows = by_state.rows();
  return {std::move(by_state), MatrixX::Zero(rows, inputs), ""};
}

CouplerRows find_transmission_rows(const CouplerProbe& probe,
                                   const dynamics::SystemModel& model,
                                   const dynamics::LinearSystem& system) {
  const auto i = index(probe.transmission);
  const LinkRows link = find_link(system, model.couplers.size() + i);
  const Index inputs = system.B.cols();
  if (probe.spec.quantity == CouplerQuantity::coordinate) {
    return only(link.motion.row(0), inputs);
  }
  if (probe.spec.quantity == CouplerQuantity::coordinate_rate) {
    return only(link.velocity.row(0), inputs);
  }
  const bool pulls = std::holds_alternative<dynamics::PathCoordinate>(
      model.transmissions[i].coordinate);
  const double sign = pulls ? -1.0 : 1.0;
  return {sign * link.wrench.row(0), sign * link.wrench_by_input.row(0), ""};
}

/// A spring between two points: its length, and its tension.
CouplerRows find_length_rows(CouplerQuantity quantity, const LinkRows& link,
                             const dynamics::CouplerReading& reading) {
  const Vector3& p = reading.motion.p_FM_F;
  const double length = p.norm();
  if (length == 0.0) {
    return {{}, {}, "its length is zero, where it has no derivative"};
  }
  const Vector3 e = p / length;
  const Matrix3 across = (Matrix3::Identity() - e * e.transpose()) / length;
  const MatrixX moved = link.motion.topRows<3>();
  const Vector3 force = reading.response.wrench.head<3>();
  switch (quantity) {
    case CouplerQuantity::coordinate:
      return only(e.transpose() * moved, link.wrench_by_input.cols());
    case CouplerQuantity::coordinate_rate:
      return only(e.transpose() * link.velocity.topRows<3>() +
                      (across * reading.motion.v_FM_F).transpose() * moved,
                  link.wrench_by_input.cols());
    default:
      return {-(e.transpose() * link.wrench.topRows<3>() +
                (across * force).transpose() * moved),
              -(e.transpose() * link.wrench_by_input.topRows<3>()), ""};
  }
}

/// Along all coordinates of a joint.
CouplerRows find_joint_rows(const CouplerProbe& probe,
                            const dynamics::SystemModel& model,
                            const dynamics::SystemState& state,
                            const joints::RelativeMotion& motion,
                            const LinkRows& link) {
  const auto c = index(probe.coupler);
  const auto& coordinates = joints::coordinates_of(model.couplers[c].law);
  const Index count = std::ssize(coordinates);
  const CouplerQuantity quantity = probe.spec.quantity;
  const bool is_effort = quantity == CouplerQuantity::effort;
  CouplerRows out{MatrixX(count, link.motion.cols()),
                  MatrixX::Zero(count, link.wrench_by_input.cols()), ""};
  MatrixX gradients(6, count);
  for (Index i = 0; i < count; ++i) {
    const joints::CoordinateValue value =
        joints::evaluate(coordinates[static_cast<std::size_t>(i)], motion,
                         state.memory[c].near[static_cast<std::size_t>(i)]);
    gradients.col(i) = value.gradient;
    const Row z = value.gradient.transpose() * link.motion;
    const Row rate =
        value.gradient.transpose() * link.velocity +
        motion.w_FM_F.transpose() * value.hessian * link.motion.bottomRows<3>();
    if (is_effort) {
      const joints::ScalarResponse response =
          dynamics::evaluate_coordinate(model, state, probe.coupler,
                                        static_cast<int>(i))
              .response;
      out.by_state.row(i) = -response.stiffness * z - response.damping * rate;
    } else {
      out.by_state.row(i) = quantity == CouplerQuantity::coordinate ? z : rate;
    }
  }
  if (is_effort && out.by_input.cols() > 0) {
    // Drives' wrenches are sums along the gradients.
    out.by_input = dense::solve_least_squares(gradients, link.wrench_by_input);
  }
  return out;
}

/// A vector of a coupler in F, and its derivatives.
struct VectorRows {
  Vector3 value = Vector3::Zero();
  Matrix3X by_state;
  Matrix3X by_input;
};

VectorRows find_wrench_rows(const CouplerProbeSpec& spec,
                            const dynamics::CouplerReading& reading,
                            const LinkRows& link) {
  const Vector3 f = reading.response.wrench.head<3>();
  const Vector3 t = reading.response.wrench.tail<3>();
  const VectorRows force{f, link.wrench.topRows<3>(),
                         link.wrench_by_input.topRows<3>()};
  const bool on_M = spec.side == ProbeSide::M;
  if (spec.quantity == CouplerQuantity::force) {
    if (on_M) return force;
    return {-f, -force.by_state, -force.by_input};
  }
  const VectorRows moment{t, link.wrench.bottomRows<3>(),
                          link.wrench_by_input.bottomRows<3>()};
  if (on_M) return moment;
  const Vector3& p = reading.motion.p_FM_F;
  return {-t - p.cross(f),
          -moment.by_state - skew(p) * force.by_state +
              skew(f) * link.motion.topRows<3>(),
          -moment.by_input - skew(p) * force.by_input};
}

VectorRows find_vector_rows(const CouplerProbeSpec& spec,
                            const dynamics::CouplerReading& reading,
                            const LinkRows& link) {
  const joints::RelativeMotion& motion = reading.motion;
  const Matrix3X none = Matrix3X::Zero(3, link.wrench_by_input.cols());
  switch (spec.quantity) {
    case CouplerQuantity::relative_position:
      return {motion.p_FM_F, link.motion.topRows<3>(), none};
    case CouplerQuantity::relative_rotation:
      return {log_rotation(motion.R_FM),
              log_rows(motion.R_FM, link.motion.bottomRows<3>()), none};
    case CouplerQuantity::relative_velocity:
      return {motion.v_FM_F, link.velocity.topRows<3>(), none};
    case CouplerQuantity::relative_angular_velocity:
      return {motion.w_FM_F, link.velocity.bottomRows<3>(), none};
    default:
      return find_wrench_rows(spec, reading, link);
  }
}

/// Rotated from F to the probe's axes, which rotate with the motion.
CouplerRows rotate(ProbeAxes axes, const dynamics::CouplerReading& reading,
                   const VectorRows& in_F, const LinkRows& link,
                   const Matrix3X& turn_F) {
  if (axes == ProbeAxes::M) {
    const Matrix3 R = reading.motion.R_FM.transpose();
    return {
        R * (in_F.by_state + skew(in_F.value) * link.motion.bottomRows<3>()),
        R * in_F.by_input, ""};
  }
  if (axes == ProbeAxes::world) {
    return {
        reading.R_WF * in_F.by_state - skew(reading.R_WF * in_F.value) * turn_F,
        reading.R_WF * in_F.by_input, ""};
  }
  return {in_F.by_state, in_F.by_input, ""};
}

}  // namespace

CouplerRows find_coupler_rows(const CouplerProbe& probe,
                              const dynamics::SystemModel& model,
                              const dynamics::SystemState& state,
                              const dynamics::LinearSystem& system,
                              const Matrix3X& turn_F) {
  if (probe.transmission >= 0) {
    return find_transmission_rows(probe, model, system);
  }
  const LinkRows link = find_link(system, index(probe.coupler));
  const dynamics::CouplerReading reading =
      dynamics::evaluate_coupler(model, state, probe.coupler);
  if (is_vector(probe.spec.quantity)) {
    return rotate(probe.spec.axes, reading,
                  find_vector_rows(probe.spec, reading, link), link, turn_F);
  }
  const auto& law = model.couplers[index(probe.coupler)].law;
  if (std::holds_alternative<joints::PointSpring>(law)) {
    return find_length_rows(probe.spec.quantity, link, reading);
  }
  return find_joint_rows(probe, model, state, reading.motion, link);
}

}  // namespace limber::scene
