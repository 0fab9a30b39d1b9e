// SPDX-License-Identifier: BSD-3-Clause
#include "scene/coupler_assembly.hpp"

#include <fmt/format.h>

#include "scene/naming.hpp"
#include "scene/recipes.hpp"

namespace limber::scene {
namespace {

/// A joint farther from its interface than this share of the body's size gets
/// a warning.
constexpr double kFarShare = 0.05;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

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

void CouplerAssembly::add_joints() {
  for (const int joint : plans_.coupled_joints) {
    add_joint(scene_.robot.joints[index(joint)]);
  }
}

void CouplerAssembly::check_joint_interface(const Joint& joint, int link,
                                            const Mount& mount) {
  const flexbody::InterfaceTable& table = *mount.anchor.table;
  if (table.rotation_rank < 3) {
    throw InputError(fmt::format(
        "joint '{}': interface '{}' of link '{}' has too few nodes to hold a "
        "rotation; use a surface group",
        joint.name, table.name, mount.link));
  }
  const double distance = (mount.X_BF.p - table.p_B).norm();
  if (distance > kFarShare * mounts_.plan_of(link).reduced->size.norm()) {
    warnings_.push_back(fmt::format(
        "joint '{}' is {:.3g} m from the middle of interface '{}' of link "
        "'{}'; check the joint's origin and the mesh's <origin> and unit",
        joint.name, distance, table.name, mount.link));
  }
}

Mount CouplerAssembly::mount_joint(const Joint& joint, int link,
                                   const Pose& X_LF) {
  const BodyPlan& plan = mounts_.plan_of(link);
  if (!plan.reduced || joint.kind == joints::JointKind::floating) {
    return mounts_.find_mount(link, X_LF, {});
  }
  const Link& source = scene_.robot.links[index(link)];
  const Anchor anchor =
      naming("joint '" + joint.name + "' on link '" + source.name + "'", [&] {
        return find_anchor(plan,
                           find_joint_interface(*source.flexible, joint.name));
      });
  const Mount mount = mounts_.find_mount(link, X_LF, anchor);
  check_joint_interface(joint, link, mount);
  return mount;
}

void CouplerAssembly::add_coupler(const std::string& name,
                                  const joints::CouplerLaw& law, const Mount& F,
                                  const Mount& M) {
  const dynamics::AttachmentIndex frame_F = attach(name + ".F", F, builder_);
  const dynamics::AttachmentIndex frame_M = attach(name + ".M", M, builder_);
  builder_.add_coupler(name, law, frame_F, frame_M);
}

void CouplerAssembly::add_joint(const Joint& joint) {
  const bool free = joint.kind == joints::JointKind::floating;
  if (free && joint.coupler.free_damping.value_or(0.0) == 0.0) return;
  const Mount F = mount_joint(joint, joint.parent, joint.X_PJ);
  const Mount M = mount_joint(joint, joint.child, Pose{});
  const joints::JointParameters parameters =
      find_joint_parameters(joint.coupler, F.side, M.side);
  add_coupler(
      joint.name,
      joints::make_joint(joint.kind, joint.axis_J, joint.second_J, parameters),
      F, M);
}

void CouplerAssembly::add_connectors() {
  for (const Connector& connector : scene_.robot.connectors) {
    naming("connector '" + connector.name + "'",
           [&] { add_connector(connector); });
  }
}

void CouplerAssembly::add_connector(const Connector& connector) {
  const std::vector<LinkMotion>& start = mounts_.start();
  const Pose from = mounts_.find_pose(connector.from, start);
  const Pose to = mounts_.find_pose(connector.to, start);
  const Mount F = mounts_.find_mount(connector.from, from, start);
  if (const auto* spring = std::get_if<SpringOptions>(&connector.law)) {
    add_coupler(connector.name, make_spring(*spring, (to.p - from.p).norm()), F,
                mounts_.find_mount(connector.to, to, start));
    return;
  }
  // At rest at the start: both frames are the one of the first end.
  add_coupler(connector.name,
              make_bushing(std::get<BushingOptions>(connector.law)), F,
              mounts_.find_mount(connector.to, from, start));
}

}  // namespace limber::scene
