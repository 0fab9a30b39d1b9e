// SPDX-License-Identifier: BSD-3-Clause
#include "metamorphic/draw_law.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "limber/joints/joint_kind.hpp"

namespace limber::metamorphic {
namespace {

using joints::JointKind;

/// A scalar law, drawn for a coordinate, in other units of length.
struct ScalarUnits {
  double z = 1.0;       ///< of the coordinate
  double energy = 1.0;  ///< of energy
  double delay = 0.0;   ///< [s]

  [[nodiscard]] double force() const { return energy / z; }
  [[nodiscard]] double stiffness() const { return energy / (z * z); }
};
using MakeScalar = std::function<joints::ScalarLaw(const ScalarUnits&)>;

ScalarUnits find_units(const Manner& manner, bool is_angle) {
  return {is_angle ? 1.0 : manner.length, manner.length * manner.length,
          manner.delay};
}

/// What is usual of a coordinate: its size, stiffness, rate.
struct Usual {
  double z = 1.0;
  double k = 1.0;
  double frequency = 1.0;

  [[nodiscard]] double c() const { return k / frequency; }
};

Usual find_usual(const LawScale& scale, bool is_angle) {
  const double k = scale.mass * scale.frequency * scale.frequency;
  const double arm = is_angle ? 0.1 * scale.length : 1.0;
  return {is_angle ? 1.0 : scale.length, k * arm * arm, scale.frequency};
}

MakeScalar draw_spring(RandomDraw& draw, const Usual& usual, bool is_line) {
  const double k = usual.k * draw.log_uniform(0.01, 1.0);
  const double quadratic =
      draw.chance(0.3) ? k / usual.z * draw.uniform(0.0, 1.0) : 0.0;
  const double c =
      draw.chance(0.5) ? 0.0 : usual.c() * draw.log_uniform(1e-3, 0.1);
  const double rest = usual.z * draw.uniform(-0.1, is_line ? 2.0 : 0.1);
  return [=](const ScalarUnits& u) {
    return joints::ScalarSpring(
        {.curve = joints::SpringCurve(
             {.stiffness = k * u.stiffness(),
              .quadratic = quadratic * u.stiffness() / u.z}),
         .damping = c * u.stiffness(),
         .rest = rest * u.z,
         .tension_only = is_line});
  };
}

MakeScalar draw_friction(RandomDraw& draw, const Usual& usual) {
  const double coulomb = usual.k * usual.z * draw.log_uniform(1e-3, 0.1);
  const double viscous = usual.c() * draw.log_uniform(1e-3, 0.1);
  const double speed = usual.z * usual.frequency * draw.log_uniform(0.1, 1.0);
  return [=](const ScalarUnits& u) {
    return joints::Friction({.coulomb = coulomb * u.force(),
                             .viscous = viscous * u.stiffness(),
                             .speed = speed * u.z});
  };
}

MakeScalar draw_stop(RandomDraw& draw, const Usual& usual) {
  const double lower = -usual.z * draw.log_uniform(0.01, 1.0);
  const double upper = usual.z * draw.log_uniform(0.01, 1.0);
  const double k = usual.k * draw.log_uniform(1.0, 10.0);
  const double b = draw.uniform(0.0, 1.0) / (usual.z * usual.frequency);
  return [=](const ScalarUnits& u) {
    return joints::EndStop({.lower = lower * u.z,
                            .upper = upper * u.z,
                            .stiffness = k * u.stiffness(),
                            .damping = b / u.z});
  };
}

MakeScalar draw_drive(RandomDraw& draw, const Usual& usual) {
  using joints::DriveMode;
  const auto mode = static_cast<DriveMode>(draw.integer(0, 2));
  const double hertz = 0.05 * usual.frequency;
  double amplitude = 0.2 * usual.z;
  if (mode == DriveMode::velocity) amplitude *= usual.frequency;
  if (mode == DriveMode::effort) amplitude *= usual.k;
  const double k =
      mode == DriveMode::position ? usual.k * draw.log_uniform(0.1, 1.0) : 0.0;
  const double c =
      mode == DriveMode::effort ? 0.0 : usual.c() * draw.log_uniform(0.01, 0.3);
  const bool is_limited = mode != DriveMode::effort && draw.chance(0.5);
  const double most = usual.k * usual.z * draw.log_uniform(0.03, 0.3);
  return [=](const ScalarUnits& u) {
    joints::SineSignal sine;
    sine.amplitude = amplitude * (mode == DriveMode::effort ? u.force() : u.z);
    sine.frequency = hertz;
    sine.start = u.delay;
    joints::Drive::Parameters drive{.mode = mode,
                                    .stiffness = k * u.stiffness(),
                                    .damping = c * u.stiffness()};
    drive.signal.base = sine;
    if (is_limited) drive.max_effort = most * u.force();
    return joints::Drive(drive);
  };
}

MakeScalar draw_law(RandomDraw& draw, const Usual& usual) {
  switch (draw.integer(0, 3)) {
    case 0:
      return draw_spring(draw, usual, false);
    case 1:
      return draw_friction(draw, usual);
    case 2:
      return draw_stop(draw, usual);
    default:
      return draw_drive(draw, usual);
  }
}

MakeLaw<joints::ScalarLaw> along(bool is_angle, const MakeScalar& make) {
  return
      [=](const Manner& manner) { return make(find_units(manner, is_angle)); };
}

// An axis of rotation is an axial vector.
Vector3 reflect_axis(const Manner& manner, const Vector3& axis, bool is_axial) {
  const Matrix3 M = find_reflection(manner);
  return (is_axial ? M.determinant() : 1.0) * M * axis;
}

CouplerPlan draw_joint(RandomDraw& draw, const LawScale& scale) {
  const auto kind = static_cast<JointKind>(draw.integer(0, 7));
  const Vector3 axis = draw.direction();
  const Vector3 second = axis.unitOrthogonal();
  const double omega = scale.frequency * draw.log_uniform(1.0, 10.0);
  const double k = scale.mass * omega * omega;
  const double c = draw.chance(0.4) ? 0.0 : 0.1 * k / omega;
  const double arm = 0.1 * scale.length;
  std::vector<std::pair<int, MakeLaw<joints::ScalarLaw>>> laws;
  const auto coordinates = joints::find_coordinates(kind, axis, second);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (!draw.chance(0.5)) continue;
    const bool is_angle =
        coordinates[i].kind == joints::AxisCoordinate::Kind::angle;
    laws.emplace_back(
        static_cast<int>(i),
        along(is_angle, draw_law(draw, find_usual(scale, is_angle))));
  }
  CouplerPlan plan;
  plan.is_hinge = kind == JointKind::revolute || kind == JointKind::continuous;
  // Their coordinates are about axes that have no mirror image of their own.
  plan.has_mirror_image =
      laws.empty() || (kind != JointKind::planar && kind != JointKind::ball);
  plan.law = [=](const Manner& manner) -> joints::CouplerLaw {
    const double L = manner.length;
    const joints::JointParameters parameters{
        .translational_stiffness = k,
        .rotational_stiffness = k * arm * arm * L * L,
        .translational_damping = c,
        .rotational_damping = c * arm * arm * L * L};
    std::vector<joints::JointElement> elements;
    for (const auto& [i, law] : laws) elements.push_back({i, law(manner)});
    const bool is_axial = kind != JointKind::prismatic;
    return joints::make_joint(kind, reflect_axis(manner, axis, is_axial),
                              reflect_axis(manner, second, true), parameters,
                              elements);
  };
  return plan;
}

joints::Bushing::Parameters make_bushing(const Manner& manner, double k,
                                         double c, double arm,
                                         const Vector3& along) {
  const Matrix3 M = find_reflection(manner);
  const double l = arm * manner.length;
  const Matrix3 shape = Matrix3::Identity() + M * along * along.transpose() * M;
  return {.translational_stiffness = k * shape,
          .rotational_stiffness = k * l * l * shape,
          .translational_damping = c * shape,
          .rotational_damping = c * l * l * shape};
}

CouplerPlan draw_bushing(RandomDraw& draw, const LawScale& scale) {
  const double omega = scale.frequency * draw.log_uniform(0.3, 3.0);
  const double k = scale.mass * omega * omega;
  const double c = draw.chance(0.5) ? 0.0 : 0.1 * k / omega;
  const double arm = 0.3 * scale.length;
  const Vector3 axis = draw.direction();
  const bool is_latch = draw.chance(0.3);
  const double most = k * scale.length * draw.log_uniform(0.01, 1.0);
  CouplerPlan plan;
  plan.law = [=](const Manner& manner) -> joints::CouplerLaw {
    const auto bushing = make_bushing(manner, k, c, arm, axis);
    if (!is_latch) return joints::Bushing(bushing);
    return joints::Latch({.reach = 0.01 * scale.length * manner.length,
                          .bushing = bushing,
                          .release_force = most * manner.length});
  };
  return plan;
}

}  // namespace

CouplerPlan draw_coupler(RandomDraw& draw, const LawScale& scale) {
  return draw.chance(0.75) ? draw_joint(draw, scale)
                           : draw_bushing(draw, scale);
}

CouplerPlan draw_point_spring(RandomDraw& draw, const LawScale& scale) {
  const double k = scale.mass * scale.frequency * scale.frequency *
                   draw.log_uniform(0.01, 1.0);
  const double c = draw.chance(0.5)
                       ? 0.0
                       : k / scale.frequency * draw.log_uniform(1e-3, 0.1);
  const double rest = scale.length * draw.uniform(0.0, 2.0);
  const bool is_cable = draw.chance(0.4);
  CouplerPlan plan;
  plan.is_symmetric = true;
  plan.law = [=](const Manner& manner) -> joints::CouplerLaw {
    return joints::PointSpring({.stiffness = k,
                                .damping = c,
                                .free_length = rest * manner.length,
                                .tension_only = is_cable});
  };
  return plan;
}

MakeLaw<joints::ScalarLaw> draw_tendon_law(RandomDraw& draw,
                                           const LawScale& scale) {
  return along(false, draw_spring(draw, find_usual(scale, false), true));
}

MakeLaw<joints::ScalarLaw> draw_gear_law(RandomDraw& draw,
                                         const LawScale& scale) {
  return along(true, draw_law(draw, find_usual(scale, true)));
}

}  // namespace limber::metamorphic
