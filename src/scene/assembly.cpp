// SPDX-License-Identifier: BSD-3-Clause
#include "scene/assembly.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scene/default_stiffness.hpp"
#include "scene/interface_tables.hpp"
#include "scene/link_start.hpp"
#include "scene/nodal_forces.hpp"
#include "scene/problems.hpp"
#include "scene/recipes.hpp"

namespace limber::scene {
namespace {

using dynamics::AttachmentIndex;
using flexbody::InterfaceTable;

/// A joint farther from its interface than this share of the body's size gets
/// a warning.
constexpr double kFarShare = 0.05;
/// Mass in <inertial> may differ from the mesh's by this share.
constexpr double kMassShare = 0.01;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Runs `work`; what it refuses is told with `who` in front.
template <typename Work>
auto naming(const std::string& who, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    std::vector<std::string> texts;
    for (const std::string& text : error.problems()) {
      texts.push_back(who + ": " + text);
    }
    throw InputError(texts);
  }
}

CouplerSide make_side(const BodyPlan& plan, const Pose& X_BF,
                      const std::optional<InterfaceTable>& table) {
  CouplerSide side;
  if (!plan.is_world && !(plan.reduced && plan.reduced->clamped)) {
    side.mass = plan.mass;
    side.inertia =
        plan.inertia.trace() / 3.0 + plan.mass * X_BF.p.squaredNorm();
  }
  if (table) side.flexibility = table->flexibility;
  return side;
}

joints::PointSpring make_spring(const SpringOptions& options, double length) {
  joints::PointSpring::Parameters parameters;
  parameters.stiffness = options.stiffness;
  parameters.damping = options.damping;
  parameters.free_length = options.free_length.value_or(length);
  return joints::PointSpring(parameters);
}

joints::Bushing make_bushing(const BushingOptions& options) {
  joints::Bushing::Parameters parameters;
  parameters.translational_stiffness =
      options.translational_stiffness.asDiagonal();
  parameters.rotational_stiffness = options.rotational_stiffness.asDiagonal();
  parameters.translational_damping = options.translational_damping.asDiagonal();
  parameters.rotational_damping = options.rotational_damping.asDiagonal();
  return joints::Bushing(parameters);
}

}  // namespace

Assembly::Assembly(const Scene& scene, const BodyPlans& plans,
                   const std::vector<LinkMotion>& motions)
    : scene_(scene), plans_(plans), motions_(motions) {
  builder_.set_gravity(scene.scenario.gravity);
}

const BodyPlan& Assembly::plan_of(int link) const {
  return plans_.bodies[index(plans_.body_of_link[index(link)])];
}

void Assembly::add_bodies() {
  for (const BodyPlan& plan : plans_.bodies) add_body(plan);
}

void Assembly::add_body(const BodyPlan& plan) {
  if (plan.is_world) {
    body_index_.push_back(dynamics::kWorld);
    return;
  }
  if (!plan.reduced) {
    body_index_.push_back(
        builder_.add_rigid_body(plan.name, {plan.mass, plan.inertia}));
    return;
  }
  const Link& link = scene_.robot.links[index(plan.links.front())];
  const dynamics::ModalDamping& damping = link.flexible->damping;
  const dynamics::Fidelity level = scene_.scenario.level_of(plan.name);
  body_index_.push_back(
      plan.full
          ? builder_.add_full_body(plan.name, plan.reduced, plan.full, damping)
          : builder_.add_flexible_body(plan.name, plan.reduced, level,
                                       damping));
  if (link.inertia &&
      std::abs(link.inertia->mass - plan.mass) > kMassShare * plan.mass) {
    warnings_.push_back(fmt::format(
        "link '{}': the mesh has {:.4g} kg, <inertial> says {:.4g} kg; the "
        "mesh's is used",
        link.name, plan.mass, link.inertia->mass));
  }
  if (level == dynamics::Fidelity::rigid &&
      find_start(scene_.scenario, link.name) != nullptr) {
    warnings_.push_back(fmt::format(
        "link '{}' is rigid in this run: its initial deformation is left out",
        link.name));
  }
}

AttachmentIndex Assembly::attach(const std::string& name, int link,
                                 const Pose& X_LF, const Anchor& anchor) {
  const int plan = plans_.body_of_link[index(link)];
  const dynamics::BodyIndex body = body_index_[index(plan)];
  const Pose X_BF = plans_.X_BL[index(link)] * X_LF;
  if (body == dynamics::kWorld) {
    return builder_.attach_world(name, motions_.front().X_WL * X_BF);
  }
  if (!anchor.table) return builder_.attach_frame(name, body, X_BF);
  if (anchor.nodes) {
    return builder_.attach_nodes(name, body, *anchor.nodes, X_BF);
  }
  return builder_.attach_interface(name, body, *anchor.table, X_BF);
}

void Assembly::add_joints() {
  for (const int joint : plans_.coupled_joints) {
    add_joint(scene_.robot.joints[index(joint)]);
  }
}

void Assembly::check_joint_interface(const Joint& joint, int link,
                                     const InterfaceTable& table,
                                     const Pose& X_BF) {
  const std::string& name = scene_.robot.links[index(link)].name;
  if (table.rotation_rank < 3) {
    throw InputError(fmt::format(
        "joint '{}': interface '{}' of link '{}' has too few nodes to hold a "
        "rotation; use a surface group",
        joint.name, table.name, name));
  }
  const double distance = (X_BF.p - table.p_B).norm();
  if (distance > kFarShare * plan_of(link).reduced->size.norm()) {
    warnings_.push_back(fmt::format(
        "joint '{}' is {:.3g} m from the middle of interface '{}' of link "
        "'{}'; check the joint's origin and the mesh's <origin> and unit",
        joint.name, distance, table.name, name));
  }
}

void Assembly::add_joint(const Joint& joint) {
  const bool free = joint.kind == joints::JointKind::floating;
  if (free && joint.coupler.free_damping.value_or(0.0) == 0.0) return;
  struct End {
    int link;
    Pose X_LF;
    Anchor anchor;
    Pose X_BF;
  };
  End ends[2] = {{joint.parent, joint.X_PJ, {}, {}},
                 {joint.child, Pose{}, {}, {}}};
  for (End& end : ends) {
    const BodyPlan& plan = plan_of(end.link);
    end.X_BF = plans_.X_BL[index(end.link)] * end.X_LF;
    if (!plan.reduced || free) continue;
    const Link& link = scene_.robot.links[index(end.link)];
    end.anchor =
        naming("joint '" + joint.name + "' on link '" + link.name + "'", [&] {
          return find_anchor(plan,
                             find_joint_interface(*link.flexible, joint.name));
        });
    check_joint_interface(joint, end.link, *end.anchor.table, end.X_BF);
  }
  const auto side = [&](const End& end) {
    return make_side(plan_of(end.link), end.X_BF, end.anchor.table);
  };
  const joints::JointParameters parameters =
      find_joint_parameters(joint.coupler, side(ends[0]), side(ends[1]));
  const AttachmentIndex frame_F =
      attach(joint.name + ".F", ends[0].link, ends[0].X_LF, ends[0].anchor);
  const AttachmentIndex frame_M =
      attach(joint.name + ".M", ends[1].link, ends[1].X_LF, ends[1].anchor);
  builder_.add_coupler(
      joint.name,
      joints::make_joint(joint.kind, joint.axis_J, joint.second_J, parameters),
      frame_F, frame_M);
}

Pose Assembly::pose_of(const ConnectorEnd& end) const {
  if (end.link == "world") return {Matrix3::Identity(), end.point};
  const int link = find_link(scene_.robot, end.link);
  const BodyPlan& plan = plan_of(link);
  const Pose& X_WL = motions_[index(link)].X_WL;
  if (!plan.reduced) return X_WL * Pose{Matrix3::Identity(), end.point};
  if (end.interface.empty()) {
    throw InputError(fmt::format(
        "link '{}' is flexible; name one of its interfaces: \"{}/INTERFACE\"",
        end.link, end.link));
  }
  const InterfaceTable& table = get_table(*plan.reduced, end.interface);
  const Pose X_LB = plans_.X_BL[index(link)].inverse();
  return {X_WL.R, X_WL * (X_LB * table.p_B)};
}

AttachmentIndex Assembly::attach_end(const std::string& name,
                                     const ConnectorEnd& end,
                                     const Pose& X_WF) {
  if (end.link == "world") return builder_.attach_world(name, X_WF);
  const int link = find_link(scene_.robot, end.link);
  const BodyPlan& plan = plan_of(link);
  return attach(name, link, motions_[index(link)].X_WL.inverse() * X_WF,
                plan.reduced ? find_anchor(plan, end.interface) : Anchor{});
}

void Assembly::add_connectors() {
  for (const Connector& connector : scene_.robot.connectors) {
    naming("connector '" + connector.name + "'",
           [&] { add_connector(connector); });
  }
}

void Assembly::add_connector(const Connector& connector) {
  const Pose from = pose_of(connector.from);
  Pose to = pose_of(connector.to);
  if (const auto* spring = std::get_if<SpringOptions>(&connector.law)) {
    const AttachmentIndex frame_F =
        attach_end(connector.name + ".F", connector.from, from);
    const AttachmentIndex frame_M =
        attach_end(connector.name + ".M", connector.to, to);
    builder_.add_coupler(connector.name,
                         make_spring(*spring, (to.p - from.p).norm()), frame_F,
                         frame_M);
    return;
  }
  // At rest at the start: both frames are the one of the first end.
  const AttachmentIndex frame_F =
      attach_end(connector.name + ".F", connector.from, from);
  const AttachmentIndex frame_M =
      attach_end(connector.name + ".M", connector.to, from);
  builder_.add_coupler(connector.name,
                       make_bushing(std::get<BushingOptions>(connector.law)),
                       frame_F, frame_M);
}

void Assembly::add_loads() {
  for (const LoadSpec& load : scene_.scenario.loads) {
    naming("load '" + load.name + "'", [&] {
      load.nodal_forces.empty() ? add_load(load) : add_nodal_load(load);
    });
  }
}

void Assembly::add_nodal_load(const LoadSpec& load) {
  const int link = find_link(scene_.robot, load.where.link);
  const BodyPlan& plan = plan_of(link);
  const FlexibleLink& flexible = *scene_.robot.links[index(link)].flexible;
  const ForceFile file = read_force_file(load.nodal_forces);
  const MatrixX forces = spread_over_nodes(
      *plan.reduced, flexible.clamped_groups, file, load.nodal_forces);
  builder_.add_nodal_load(
      load.name, body_index_[index(plans_.body_of_link[index(link)])],
      flexbody::reduce_nodal_load(*plan.reduced, file.times, forces), forces);
}

void Assembly::add_load(const LoadSpec& load) {
  const int link = find_link(scene_.robot, load.where.link);
  const BodyPlan& plan = plan_of(link);
  if (plan.is_world) throw InputError("it acts on the world, which is fixed");
  Pose X_LF{Matrix3::Identity(), load.where.point.value_or(Vector3::Zero())};
  Anchor anchor;
  if (plan.reduced) {
    anchor = find_anchor(plan, load.where);
    X_LF.p = plans_.X_BL[index(link)].inverse() * anchor.table->p_B;
    if (anchor.table->rotation_rank < 3 && !load.moment.isZero()) {
      throw InputError(
          "its nodes are too few to take a moment; use a surface group");
    }
  }
  const AttachmentIndex where = attach(load.name, link, X_LF, anchor);
  const bool in_body = load.frame == dynamics::LoadFrame::body;
  const Matrix3 R =
      in_body ? plans_.X_BL[index(link)].R : Matrix3(Matrix3::Identity());
  builder_.add_load(load.name, where, R * load.force, R * load.moment,
                    load.frame, load.time);
}

std::vector<Probe> Assembly::make_probes() const {
  std::vector<Probe> probes;
  for (const ProbeSpec& spec : scene_.scenario.probes) {
    probes.push_back(
        naming("probe '" + spec.name + "' on link '" + spec.where.link + "'",
               [&] { return make_probe(spec); }));
  }
  return probes;
}

Probe Assembly::make_probe(const ProbeSpec& spec) const {
  const int link = find_link(scene_.robot, spec.where.link);
  const BodyPlan& plan = plan_of(link);
  if (plan.is_world) throw InputError("it is on the world, which is fixed");
  const Pose& X_BL = plans_.X_BL[index(link)];
  Probe probe;
  probe.name = spec.name;
  probe.quantity = spec.quantity;
  probe.body = body_index_[index(plans_.body_of_link[index(link)])];
  probe.R_BL = X_BL.R;
  probe.p_B = X_BL * spec.where.point.value_or(Vector3::Zero());
  if (!plan.reduced) return probe;
  const Anchor anchor = find_anchor(plan, spec.where);
  probe.p_B = anchor.table->p_B;
  probe.Phi_B = anchor.table->Phi_B;
  probe.Psi_B = anchor.table->Psi_B;
  if (anchor.nodes) {
    probe.nodal = std::make_shared<const dynamics::NodalFrame>(
        dynamics::make_nodal_frame(*plan.full, *anchor.nodes, probe.p_B));
  }
  return probe;
}

dynamics::SystemModel Assembly::build() const { return builder_.build(); }

void Assembly::deform(const dynamics::SystemModel& model,
                      const dynamics::BodyModel& body, VectorX& u_B,
                      VectorX& udot_B, dynamics::SystemState& state) const {
  const LinkStart* start = find_start(scene_.scenario, body.name);
  if (start == nullptr || body.fidelity == dynamics::Fidelity::rigid) return;
  naming("[initial.links." + body.name + "]", [&] {
    const ModalStart modal = find_modal_start(*start, *body.reduced);
    if (body.full >= 0) {
      const auto& full = model.full_bodies[index(body.full)];
      const MatrixX& Phi = body.reduced->rows.Phi_B;
      u_B.segment(full.first, full.dofs()) = Phi * modal.eta;
      udot_B.segment(full.first, full.dofs()) = Phi * modal.etadot;
      return;
    }
    state.eta.segment(body.offset, body.modes) = modal.eta;
    state.etadot.segment(body.offset, body.modes) = modal.etadot;
  });
}

// Joints that start beyond half a turn count on from there.
void Assembly::remember_turns(const dynamics::SystemModel& model,
                              dynamics::SystemState& state) const {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const auto start = scene_.scenario.joints.find(model.couplers[c].name);
    if (start == scene_.scenario.joints.end()) continue;
    const std::vector<double>& q = start->second.position;
    const auto& coordinates = joints::coordinates_of(model.couplers[c].law);
    for (std::size_t i = 0; i < coordinates.size() && i < q.size(); ++i) {
      state.memory[c].near[i] = q[i];
    }
  }
}

dynamics::SystemState Assembly::make_initial_state(
    const dynamics::SystemModel& model) const {
  dynamics::SystemState state = dynamics::make_state(model);
  VectorX u_B = state.u_H;
  VectorX udot_B = state.udot_H;
  for (std::size_t i = 0; i < plans_.bodies.size(); ++i) {
    if (body_index_[i] == dynamics::kWorld) continue;
    const int link = plans_.bodies[i].links.front();
    const LinkMotion& motion = motions_[index(link)];
    const Pose X_WB = motion.X_WL * plans_.X_BL[index(link)].inverse();
    dynamics::BodyState& body = state.bodies[index(body_index_[i])];
    body.p_WB = X_WB.p;
    body.quat_WB = Quaternion(X_WB.R).normalized();
    body.v_WB_W = motion.v_WL_W + motion.w_WL_W.cross(X_WB.p - motion.X_WL.p);
    body.w_WB_B = X_WB.R.transpose() * motion.w_WL_W;
    deform(model, model.bodies[index(body_index_[i])], u_B, udot_B, state);
  }
  place_nodes(model, u_B, udot_B, state);
  remember_turns(model, state);
  return state;
}

}  // namespace limber::scene
