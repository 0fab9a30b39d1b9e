// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reference/scene_mechanism.hpp"

#include <fmt/format.h>

#include <map>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/scene/build/body_plan.hpp"

namespace limber::reference {
namespace {

using joints::JointKind;

Pose turn_z_to(const Vector3& axis) {
  return {Quaternion::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix(),
          Vector3::Zero()};
}

/// Mobilizer frame in the joint's frame: z along the axis or, for a universal
/// joint, x along the first and y along the second.
Pose find_axes(const scene::Joint& joint) {
  if (!joints::needs_axis(joint.kind)) return {};
  if (joint.kind != JointKind::universal) return turn_z_to(joint.axis_J);
  Pose axes;
  axes.R << joint.axis_J, joint.second_J, joint.axis_J.cross(joint.second_J);
  return axes;
}

Mobilizer find_mobilizer(JointKind kind) {
  switch (kind) {
    case JointKind::revolute:
    case JointKind::continuous:
      return Mobilizer::pin;
    case JointKind::prismatic:
      return Mobilizer::slider;
    case JointKind::planar:
      return Mobilizer::planar;
    case JointKind::floating:
      return Mobilizer::free;
    case JointKind::fixed:
      break;
    case JointKind::ball:
      return Mobilizer::ball;
    case JointKind::universal:
      return Mobilizer::universal;
  }
  return Mobilizer::weld;
}

[[noreturn]] void refuse(const std::string& who, const char* why) {
  throw InputError(
      fmt::format("{} {}; verify supports only joints, linear springs and "
                  "viscous friction in them, bushings without coupling of "
                  "translation and rotation, and linear springs between points",
                  who, why));
}

bool is_linear(const joints::SpringCurve::Parameters& curve) {
  return curve.quadratic == 0.0 && curve.forces.empty();
}

/// The linear spring and damper of a law along a joint's coordinate.
/// @throws InputError if the law has other parts.
CoordinateElement find_linear(const joints::ScalarLaw& law,
                              const std::string& joint) {
  CoordinateElement element;
  element.name = joint;
  if (const auto* spring = std::get_if<joints::ScalarSpring>(&law)) {
    const joints::ScalarSpring::Parameters& p = spring->parameters();
    if (!is_linear(p.curve.parameters()) || p.tension_only) {
      refuse("joint '" + joint + "'", "has a spring that is not linear");
    }
    element.stiffness = p.curve.parameters().stiffness;
    element.rest = p.rest;
    element.damping = p.damping;
    return element;
  }
  const auto* friction = std::get_if<joints::Friction>(&law);
  if (friction == nullptr) {
    refuse("joint '" + joint + "'", "has stops or drives");
  }
  if (friction->parameters().coulomb != 0.0) {
    refuse("joint '" + joint + "'", "has Coulomb friction");
  }
  element.damping = friction->parameters().viscous;
  return element;
}

/// Rejects laws that only Limber implements. @throws InputError naming one.
void check_laws(const dynamics::SystemModel& model) {
  for (const dynamics::Coupler& coupler : model.couplers) {
    const std::string who = "'" + coupler.name + "'";
    if (const auto* law = std::get_if<joints::Bushing>(&coupler.law)) {
      const joints::Bushing::Parameters& p = law->parameters();
      if (!p.coupling_stiffness.isZero(0.0) ||
          !p.coupling_damping.isZero(0.0)) {
        refuse(who, "couples translation and rotation");
      }
    }
    if (const auto* law = std::get_if<joints::PointSpring>(&coupler.law)) {
      const joints::PointSpring::Parameters& p = law->parameters();
      if (p.quadratic != 0.0 || !p.forces.empty() || p.tension_only) {
        refuse(who, "is not a linear spring");
      }
    }
  }
}

std::vector<double> join(const Vector3& a, const Vector3& b) {
  return {a[0], a[1], a[2], b[0], b[1], b[2]};
}

void check_levels(const dynamics::SystemModel& model) {
  for (const dynamics::BodyModel& body : model.bodies) {
    if (body.fidelity == dynamics::Fidelity::rigid) continue;
    throw InputError(fmt::format(
        "link '{}' is at level '{}'; rigid bodies are compared at 'rigid'",
        body.name, dynamics::to_string(body.fidelity)));
  }
}

void check_couplers(const scene::Scene& scene,
                    const dynamics::SystemModel& model) {
  const scene::Robot& robot = scene.robot;
  const auto refuse = [](const char* what, const auto& all) {
    if (all.empty()) return;
    throw InputError(
        fmt::format("{} '{}' is not compared", what, all.front().name));
  };
  refuse("loop", robot.loops);
  refuse("latch", robot.latches);
  refuse("tendon", robot.tendons);
  refuse("gear", robot.gears);
  refuse("projectile", scene.scenario.projectiles);
  refuse("contact", model.pairs);
}

class Translator {
 public:
  Translator(const scene::Scene& scene, const scene::BuiltScene& built)
      : scene_(scene),
        robot_(scene.robot),
        model_(built.model),
        plans_(
            scene::plan_bodies(robot_, scene::find_reduced(robot_, model_))) {}

  Mechanism run() {
    mechanism_.gravity_W = scene_.scenario.gravity;
    for (int link = 0; link < std::ssize(robot_.links); ++link) add_link(link);
    add_joints();
    add_connectors();
    add_loads();
    for (const scene::BodyPlan& plan : plans_.bodies) {
      if (plan.is_world) continue;
      const int link = plan.links.front();
      mechanism_.observed.push_back({link, X_LB(link)});
    }
    return mechanism_;
  }

 private:
  [[nodiscard]] Pose X_LB(int link) const {
    return plans_.X_BL[index(link)].inverse();
  }

  void set_mass(int link, MechanismBody& body) const {
    const scene::BodyPlan& plan =
        plans_.bodies[index(plans_.body_of_link[index(link)])];
    const auto& inertia = robot_.links[index(link)].inertia;
    if (plan.reduced) {
      const Pose X = X_LB(link);
      body.mass = plan.reduced->mass;
      body.p_LBcm = X.p;
      body.inertia = X.R * plan.reduced->inertia() * X.R.transpose();
    } else if (inertia) {
      body.mass = inertia->mass;
      body.p_LBcm = inertia->p_LBcm;
      body.inertia = inertia->inertia;
    }
  }

  void set_root(MechanismBody& body) const {
    const scene::BodyStart& base = scene_.scenario.base;
    const auto& flexible = plans_.bodies.front().reduced;
    body.mobilizer = robot_.has_world_root() || (flexible && flexible->clamped)
                         ? Mobilizer::weld
                         : Mobilizer::free;
    if (body.mobilizer == Mobilizer::weld) {
      const Vector3& rpy = base.orientation_rpy;
      body.X_PF.R = (Eigen::AngleAxisd(rpy[2], Vector3::UnitZ()) *
                     Eigen::AngleAxisd(rpy[1], Vector3::UnitY()) *
                     Eigen::AngleAxisd(rpy[0], Vector3::UnitX()))
                        .toRotationMatrix();
      body.X_PF.p = base.position;
      return;
    }
    body.position = join(base.position, base.orientation_rpy);
    body.velocity = join(base.velocity, base.angular_velocity);
  }

  void set_joint(const scene::Joint& joint, MechanismBody& body) const {
    const Pose axes = find_axes(joint);
    body.parent = joint.parent;
    body.mobilizer = find_mobilizer(joint.kind);
    body.X_PF = joint.X_PJ * axes;
    body.X_LM = axes;
    const auto start = scene_.scenario.joints.find(joint.name);
    if (start == scene_.scenario.joints.end()) return;
    body.position = start->second.position;
    body.velocity = start->second.velocity;
  }

  void add_link(int link) {
    MechanismBody body;
    body.name = robot_.links[index(link)].name;
    set_mass(link, body);
    if (link == 0) {
      set_root(body);
    } else {
      set_joint(robot_.joints[index(link - 1)], body);
    }
    mechanism_.bodies.push_back(body);
  }

  /// An attachment of the built model, on the first link of its body.
  [[nodiscard]] MechanismFrame find_frame(
      dynamics::AttachmentIndex attachment) const {
    const dynamics::Attachment& a = model_.attachments[index(attachment)];
    const Pose X_BF{a.R_BF, a.p_BF};
    if (a.body == dynamics::kWorld) return {kGround, X_BF};
    return on_body(a.body, X_BF);
  }

  [[nodiscard]] MechanismFrame on_body(dynamics::BodyIndex body,
                                       const Pose& X_BF) const {
    int count = 0;
    for (const scene::BodyPlan& plan : plans_.bodies) {
      if (plan.is_world || count++ != body) continue;
      const int link = plan.links.front();
      return {link, X_LB(link) * X_BF};
    }
    LIMBER_EXPECT(false && "a body without a plan");
    return {};
  }

  /// Couplers are in the order in which a scene adds them: joints first.
  void add_joints() {
    std::size_t coupler = 0;
    for (const int i : plans_.coupled_joints) {
      const scene::Joint& joint = robot_.joints[index(i)];
      const bool exists = coupler < model_.couplers.size() &&
                          model_.couplers[coupler].name == joint.name;
      if (!exists) continue;  // floating, without damping
      const dynamics::Coupler& source = model_.couplers[coupler++];
      add_joint(joint, std::get<joints::Joint>(source.law));
    }
    LIMBER_EXPECT(coupler + robot_.connectors.size() == model_.couplers.size());
  }

  void add_joint(const scene::Joint& joint, const joints::Joint& law) {
    const MechanismFrame F{joint.parent, joint.X_PJ};
    const MechanismFrame M{joint.child, Pose{}};
    const int joint_of =
        joint.kind == JointKind::floating ? kGround : joint.child;
    if (const auto* bushing = std::get_if<joints::Bushing>(&law.constraint())) {
      mechanism_.bushings.push_back(
          {F, M, bushing->parameters(), turn_z_to(joint.axis_J).R, joint_of});
    } else {
      mechanism_.universals.push_back(
          {joint.name, F, M,
           std::get<joints::UniversalConstraint>(law.constraint()).parameters(),
           joint_of});
    }
    for (const joints::JointElement& acting : law.elements()) {
      CoordinateElement element = find_linear(acting.law, joint.name);
      element.F = F;
      element.M = M;
      element.coordinate = law.coordinates()[index(acting.coordinate)];
      mechanism_.coordinates.push_back(element);
    }
  }

  void add_connectors() {
    const std::size_t first = model_.couplers.size() - robot_.connectors.size();
    for (std::size_t i = first; i < model_.couplers.size(); ++i) {
      add_connector(model_.couplers[i]);
    }
  }

  void add_connector(const dynamics::Coupler& coupler) {
    const MechanismFrame F = find_frame(coupler.frame_F);
    const MechanismFrame M = find_frame(coupler.frame_M);
    if (const auto* law = std::get_if<joints::Bushing>(&coupler.law)) {
      BushingElement element;
      element.F = F;
      element.M = M;
      element.law = law->parameters();
      mechanism_.bushings.push_back(element);
      return;
    }
    mechanism_.springs.push_back(
        {F, M, std::get<joints::PointSpring>(coupler.law).parameters()});
  }

  void add_loads() {
    std::size_t next = 0;
    for (const scene::LoadSpec& spec : scene_.scenario.loads) {
      if (spec.nodal_forces.empty()) add_load(spec, model_.loads.at(next++));
    }
    for (const dynamics::BodyLoad& load : model_.body_loads) {
      mechanism_.histories.push_back(
          {on_body(load.body, Pose{}), load.history});
    }
  }

  void add_load(const scene::LoadSpec& spec, const dynamics::Load& load) {
    LoadElement element;
    element.body = scene::find_link(robot_, spec.where.link);
    element.point = robot_.links[index(element.body)].flexible
                        ? find_frame(load.where).X_LF.p
                        : Vector3(spec.where.point.value_or(Vector3::Zero()));
    element.force = spec.force;
    element.moment = spec.moment;
    element.in_world = spec.frame == dynamics::LoadFrame::world;
    element.function = spec.time;
    mechanism_.loads.push_back(element);
  }

  const scene::Scene& scene_;
  const scene::Robot& robot_;
  const dynamics::SystemModel& model_;
  scene::BodyPlans plans_;
  Mechanism mechanism_;
};

}  // namespace

Mechanism make_mechanism(const scene::Scene& scene,
                         const scene::BuiltScene& built) {
  check_levels(built.model);
  check_couplers(scene, built.model);
  check_laws(built.model);
  return Translator(scene, built).run();
}

}  // namespace limber::reference
