// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/joint_motion.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/roll_pitch_yaw.hpp"
#include "limber/common/rotation.hpp"

namespace limber::joints {
namespace {

using Kind = AxisCoordinate::Kind;

std::vector<double> pad(std::vector<double> values, std::size_t count) {
  LIMBER_EXPECT(values.empty() || values.size() == count);
  values.resize(count, 0.0);
  return values;
}

// Without stiffness it holds nothing.
bool is_free(const Joint& joint) {
  const auto held = joint.find_constraint_stiffness();
  return !held || (held->translational == 0.0 && held->rotational == 0.0);
}

}  // namespace

std::size_t coordinate_count(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return 0;
    case JointKind::universal:
      return 2;
    case JointKind::planar:
    case JointKind::ball:
      return 3;
    case JointKind::floating:
      return 6;
    default:
      return 1;
  }
}

JointShape find_shape(const Joint& joint) {
  const std::vector<AxisCoordinate>& q = joint.coordinates();
  const auto is = [&](std::size_t i, Kind kind) { return q[i].kind == kind; };
  if (q.empty()) {
    return {.kind = is_free(joint) ? JointKind::floating : JointKind::fixed};
  }
  if (q.size() == 1) {
    return {
        .kind = is(0, Kind::angle) ? JointKind::revolute : JointKind::prismatic,
        .axis_F = q[0].axis};
  }
  if (q.size() == 2 && is(0, Kind::angle) && is(1, Kind::angle)) {
    return {.kind = JointKind::universal,
            .axis_F = q[0].axis,
            .second_F = q[1].axis};
  }
  if (q.size() == 3 && is(2, Kind::angle) &&
      is(0, Kind::angle) == is(1, Kind::angle)) {
    return {.kind = is(0, Kind::angle) ? JointKind::ball : JointKind::planar,
            .axis_F = q[2].axis};
  }
  throw InputError(
      "it leaves coordinates free that are those of no kind of joint");
}

RelativeMotion find_joint_motion(const JointShape& shape,
                                 const JointCoordinates& coordinates) {
  const std::size_t count = coordinate_count(shape.kind);
  const std::vector<double> q = pad(coordinates.position, count);
  const std::vector<double> u = pad(coordinates.velocity, count);
  RelativeMotion motion;
  switch (shape.kind) {
    case JointKind::fixed:
      break;
    case JointKind::revolute:
    case JointKind::continuous:
      motion.R_FM = exp_rotation(q[0] * shape.axis_F);
      motion.w_FM_F = u[0] * shape.axis_F;
      break;
    case JointKind::prismatic:
      motion.p_FM_F = q[0] * shape.axis_F;
      motion.v_FM_F = u[0] * shape.axis_F;
      break;
    case JointKind::planar: {
      const auto [x, y] = find_plane_axes(shape.axis_F);
      motion.p_FM_F = q[0] * x + q[1] * y;
      motion.R_FM = exp_rotation(q[2] * shape.axis_F);
      motion.v_FM_F = u[0] * x + u[1] * y;
      motion.w_FM_F = u[2] * shape.axis_F;
      break;
    }
    case JointKind::floating:
      motion.p_FM_F = Vector3(q[0], q[1], q[2]);
      motion.R_FM = rotation_rpy(Vector3(q[3], q[4], q[5]));
      motion.v_FM_F = Vector3(u[0], u[1], u[2]);
      motion.w_FM_F = Vector3(u[3], u[4], u[5]);
      break;
    case JointKind::universal:
      motion.R_FM = exp_rotation(q[0] * shape.axis_F);
      motion.w_FM_F =
          u[0] * shape.axis_F + u[1] * (motion.R_FM * shape.second_F);
      motion.R_FM = motion.R_FM * exp_rotation(q[1] * shape.second_F);
      break;
    case JointKind::ball:
      motion.R_FM = rotation_rpy(Vector3(q[0], q[1], q[2]));
      motion.w_FM_F = Vector3(u[0], u[1], u[2]);
      break;
  }
  return motion;
}

}  // namespace limber::joints
