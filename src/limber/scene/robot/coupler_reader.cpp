// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/coupler_reader.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/scene/robot/action_reader.hpp"
#include "limber/scene/robot/end_reader.hpp"

namespace limber::scene {
namespace {

using joints::JointKind;

CouplerOptions read_options(XmlElement& element) {
  CouplerOptions options;
  options.translational_stiffness =
      element.number("translational_stiffness", kPositive);
  options.rotational_stiffness =
      element.number("rotational_stiffness", kPositive);
  options.translational_damping =
      element.number("translational_damping", kNonNegative);
  options.rotational_damping =
      element.number("rotational_damping", kNonNegative);
  return options;
}

std::optional<JointKind> read_kind(XmlElement& element, const std::string& name,
                                   const std::vector<JointKind>& kinds) {
  std::vector<std::string> known;
  for (const JointKind kind : kinds) {
    known.emplace_back(joints::to_string(kind));
    if (known.back() == name) return kind;
  }
  element.fail(describe_unknown("kind", name, known));
  return std::nullopt;
}

Vector3 read_direction(XmlElement& element, const std::string& name,
                       const Vector3& usual) {
  const Vector3 axis = element.vector(name).value_or(usual);
  if (!axis.isZero(0.0)) return axis.stableNormalized();
  element.fail(fmt::format("{}: it has no length, so no direction", name));
  return usual;
}

/// Axes of the kind. Two axes must be normal to each other.
void read_axes(XmlElement& element, JointKind kind, Vector3& first,
               Vector3& second) {
  constexpr double kNormal = 1e-6;  // rounding in files
  if (!joints::needs_axis(kind)) return;
  first = read_direction(element, "axis", Vector3::UnitX());
  if (kind != JointKind::universal) return;
  second = read_direction(element, "second_axis", Vector3::UnitY());
  const double along = first.dot(second);
  if (std::abs(along) > kNormal) {
    element.fail("its axis and second_axis are not normal to each other");
    second = first.unitOrthogonal();
    return;
  }
  second = (second - along * first).normalized();
}

/// The kinds without a URDF joint type, given on a floating joint.
void read_joint_kind(XmlElement& element, Joint& joint) {
  const std::optional<std::string> name = element.text("kind");
  if (!name) return;
  const auto kind =
      read_kind(element, *name, {JointKind::universal, JointKind::ball});
  if (!kind) return;
  if (joint.kind != JointKind::floating) {
    element.fail(fmt::format(
        "kind=\"{}\" goes with a joint of type floating; joint '{}' is {}",
        *name, joint.name, joints::to_string(joint.kind)));
    return;
  }
  joint.kind = *kind;
  read_axes(element, joint.kind, joint.axis_J, joint.second_J);
}

/// One number for all three directions, or three.
Vector3 read_triple(XmlElement& element, const std::string& name) {
  const auto values = element.numbers(name, kNonNegative);
  if (!values) return Vector3::Zero();
  if (values->size() == 1) return Vector3::Constant(values->front());
  return element.vector(name, kNonNegative).value_or(Vector3::Zero());
}

void read_diagonal_bushing(XmlElement& element,
                           joints::Bushing::Parameters& bushing) {
  const auto read = [&](const char* name) {
    return Matrix3(read_triple(element, name).asDiagonal());
  };
  bushing.translational_stiffness = read("translational_stiffness");
  bushing.rotational_stiffness = read("rotational_stiffness");
  bushing.translational_damping = read("translational_damping");
  bushing.rotational_damping = read("rotational_damping");
}

/// 36 numbers row by row, x y z rx ry rz; zero by default.
Matrix6 read_matrix(XmlElement& element, const std::string& name) {
  constexpr double kSymmetric = 1e-6;  // rounding in files
  const auto numbers = element.numbers(name);
  if (!numbers) return Matrix6::Zero();
  if (numbers->size() != 36) {
    element.fail(
        fmt::format("{}: expected 36 numbers, got {}", name, numbers->size()));
    return Matrix6::Zero();
  }
  const Matrix6 m = Eigen::Map<const Matrix6>(numbers->data());
  Matrix6 symmetric = 0.5 * (m + m.transpose());
  if ((m - symmetric).cwiseAbs().maxCoeff() >
      kSymmetric * m.cwiseAbs().maxCoeff()) {
    element.fail(fmt::format("{}: expected a symmetric matrix", name));
  }
  return symmetric;
}

void read_full_bushing(XmlElement& element,
                       joints::Bushing::Parameters& bushing) {
  const Matrix6 K = read_matrix(element, "stiffness");
  const Matrix6 C = read_matrix(element, "damping");
  bushing.translational_stiffness = K.topLeftCorner<3, 3>();
  bushing.coupling_stiffness = K.topRightCorner<3, 3>();
  bushing.rotational_stiffness = K.bottomRightCorner<3, 3>();
  bushing.translational_damping = C.topLeftCorner<3, 3>();
  bushing.coupling_damping = C.topRightCorner<3, 3>();
  bushing.rotational_damping = C.bottomRightCorner<3, 3>();
}

}  // namespace

void read_coupler(XmlElement& element, Joint& joint) {
  const std::optional<double> damping = joint.coupler.free_damping;
  read_joint_kind(element, joint);
  joint.coupler = read_options(element);
  joint.coupler.free_damping = element.number("free_damping", kNonNegative);
  if (!joint.coupler.free_damping) joint.coupler.free_damping = damping;
  joint.coupler.is_ideal = element.boolean("ideal");
  if (joint.coupler.is_ideal == true && joint.coupler.is_elastic()) {
    element.fail(
        "an ideal joint does not deflect, so it has no stiffness and no "
        "damping but free_damping; remove them, or ideal");
  }
  ActionReader actions(joint.kind, joint.actions);
  element.read_children(actions.readers());
}

Loop read_loop(XmlElement& element) {
  Loop loop;
  loop.name = element.required_text("name");
  const auto kind =
      read_kind(element, element.required_text("kind"),
                {JointKind::fixed, JointKind::revolute, JointKind::prismatic,
                 JointKind::planar, JointKind::universal, JointKind::ball});
  loop.kind = kind.value_or(loop.kind);
  read_axes(element, loop.kind, loop.axis_F, loop.second_F);
  loop.coupler = read_options(element);
  loop.coupler.free_damping = element.number("free_damping", kNonNegative);
  ActionReader actions(loop.kind, loop.actions);
  read_ends(element, TurnedEnds::from, loop.from, loop.to, actions.readers());
  return loop;
}

Connector read_spring(XmlElement& element) {
  Connector connector;
  connector.name = element.required_text("name");
  SpringOptions spring;
  const joints::SpringCurve::Parameters curve = read_curve(element);
  spring.law.stiffness = curve.stiffness;
  spring.law.quadratic = curve.quadratic;
  spring.law.extensions = curve.extensions;
  spring.law.forces = curve.forces;
  spring.law.damping = element.number("damping", kNonNegative).value_or(0.0);
  spring.law.tension_only = element.boolean("tension_only").value_or(false);
  spring.free_length = element.number("free_length", kNonNegative);
  try {
    (void)joints::PointSpring(spring.law);
  } catch (const InputError& error) {
    element.fail(error.what());
  }
  connector.law = spring;
  read_ends(element, TurnedEnds::none, connector.from, connector.to);
  return connector;
}

Connector read_bushing(XmlElement& element) {
  Connector connector;
  connector.name = element.required_text("name");
  joints::Bushing::Parameters bushing;
  if (element.has("stiffness") || element.has("damping")) {
    read_full_bushing(element, bushing);
  } else {
    read_diagonal_bushing(element, bushing);
  }
  try {
    (void)joints::Bushing(bushing);
  } catch (const InputError& error) {
    element.fail(error.what());
  }
  connector.law = bushing;
  read_ends(element, TurnedEnds::from, connector.from, connector.to);
  return connector;
}

Latch read_latch(XmlElement& element) {
  Latch latch;
  latch.name = element.required_text("name");
  latch.reach = element.required_number("reach", kPositive);
  latch.coupler = read_options(element);
  latch.release_force =
      element.number("release_force", kPositive).value_or(latch.release_force);
  latch.release_time =
      element.number("release_time").value_or(latch.release_time);
  read_ends(element, TurnedEnds::both, latch.from, latch.to);
  return latch;
}

Tendon read_tendon(XmlElement& element) {
  Tendon tendon;
  tendon.name = element.required_text("name");
  tendon.stiffness = element.number("stiffness", kNonNegative).value_or(0.0);
  tendon.damping = element.number("damping", kNonNegative).value_or(0.0);
  tendon.free_length = element.number("free_length", kNonNegative);
  tendon.pretension = element.number("pretension", kNonNegative);
  tendon.tension = element.number("tension", kNonNegative).value_or(0.0);
  if (tendon.free_length && tendon.pretension) {
    element.fail("has both 'free_length' and 'pretension'; keep one");
  }
  if (tendon.pretension && tendon.stiffness == 0.0) {
    element.fail("'pretension' needs 'stiffness'; give 'tension' instead");
  }
  element.read_children(
      {{"via", [&](XmlElement& e) { tendon.via.push_back(read_end(e)); }}});
  if (tendon.via.size() < 2) {
    element.fail(
        fmt::format("needs two or more <via>; it has {}", tendon.via.size()));
  }
  return tendon;
}

Gear read_gear(XmlElement& element) {
  Gear gear;
  gear.name = element.required_text("name");
  gear.joint = element.required_text("joint");
  gear.with = element.required_text("with");
  gear.ratio = element.required_number("ratio");
  gear.offset = element.number("offset").value_or(0.0);
  gear.stiffness = element.number("stiffness", kPositive);
  gear.damping = element.number("damping", kNonNegative);
  if (gear.ratio == 0.0) element.fail("ratio=0: expected another number");
  element.read_children({});
  return gear;
}

}  // namespace limber::scene
