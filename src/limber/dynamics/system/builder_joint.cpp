// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/system/builder_checks.hpp"
#include "limber/dynamics/system/interface_rotation.hpp"
#include "limber/dynamics/system/system_builder.hpp"

namespace limber::dynamics {
namespace {

// Calls `work`; its InputErrors begin with `what`.
template <typename Work>
auto name_errors(const std::string& what, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", what, error.what()));
  }
}

// Whether it has neither a moving mass nor a flexible interface.
bool is_fixed(const CouplerSide& side) {
  return std::isinf(side.mass) && !side.flexibility;
}

}  // namespace

// Place of a joint on a body, and the interface that carries it.
struct SystemBuilder::Mount {
  Pose X_BF;
  std::optional<flexbody::InterfaceTable> table;
  const flexbody::NodeSet* nodes = nullptr;  // of an unreduced body
  CouplerSide side;
};

SystemBuilder::Mount SystemBuilder::find_mount(const std::string& what,
                                               const JointSide& side) const {
  const bool has_interface =
      !std::holds_alternative<std::monostate>(side.interface);
  Mount mount;
  if (side.X_BF) {
    check_pose(what, *side.X_BF);
    mount.X_BF = *side.X_BF;
  }
  if (side.body == kWorld) {
    if (has_interface) {
      throw InputError(what + ": the world has no interface; give a pose");
    }
    return mount;
  }
  const BodyModel& body = find_body(what, side.body);
  if (has_interface != (body.reduced != nullptr)) {
    throw InputError(fmt::format(
        "{}: body '{}' is {}", what, body.name,
        has_interface ? "rigid and has no interface; give a pose"
                      : "flexible; give the interface that carries the joint"));
  }
  if (const auto* table =
          std::get_if<flexbody::InterfaceTable>(&side.interface)) {
    mount.table = *table;
  } else if (const auto* name = std::get_if<std::string>(&side.interface)) {
    const std::string where = fmt::format("{}, body '{}'", what, body.name);
    mount.table = name_errors(where, [&] {
      return body.reduced->interfaces[find_interface(*body.reduced, *name)];
    });
    if (body.full >= 0) {
      const FullModel& full = model_.full_bodies[index(body.full)];
      mount.nodes =
          name_errors(where, [&] { return &find_node_set(*full.mesh, *name); });
    }
  }
  if (mount.table && !side.X_BF) mount.X_BF.p = mount.table->p_B;
  if (!body.clamped) {
    mount.side = make_side(body.mass, body.J0, mount.X_BF.p);
  }
  if (mount.table) mount.side.flexibility = mount.table->flexibility;
  return mount;
}

AttachmentIndex SystemBuilder::attach(const std::string& name, BodyIndex body,
                                      const Mount& mount) {
  if (body == kWorld) return attach_world(name, mount.X_BF);
  if (mount.nodes != nullptr) {
    return attach_nodes(name, body, *mount.nodes, mount.X_BF);
  }
  if (mount.table)
    return attach_interface(name, body, *mount.table, mount.X_BF);
  return attach_frame(name, body, mount.X_BF);
}

CouplerIndex SystemBuilder::add_joint(const std::string& name,
                                      joints::JointKind kind,
                                      const JointSide& parent,
                                      const JointSide& child,
                                      const Vector3& axis_F,
                                      const JointOptions& options) {
  static_cast<void>(names_.check("coupler", name));
  const std::string what = fmt::format("joint '{}'", name);
  LIMBER_EXPECT(kind >= joints::JointKind::fixed &&
                kind <= joints::JointKind::ball);
  const Mount F = find_mount(what, parent);
  const Mount M = find_mount(what, child);
  if (parent.body == child.body) {
    throw InputError(what + ": both of its sides are on the same body");
  }
  if (is_fixed(F.side) && is_fixed(M.side)) {
    throw InputError(what + ": neither of its sides can move");
  }
  const joints::Joint law = name_errors(what, [&] {
    joints::Joint joint = joints::make_joint(
        kind, axis_F, options.second_F,
        find_joint_parameters(options.held, F.side, M.side), options.elements);
    const joints::RequiredSides required = joint.find_required_rotations();
    for (const auto& [mount, rotations] :
         {std::pair{&F, required.F}, std::pair{&M, required.M}}) {
      const Matrix3& R = mount->X_BF.R;
      if (mount->table) {
        check_rotation(*mount->table, R * rotations * R.transpose());
      }
    }
    return joint;
  });
  const auto before = static_cast<std::ptrdiff_t>(model_.attachments.size());
  try {
    const AttachmentIndex frame_F = attach(name + ".F", parent.body, F);
    const AttachmentIndex frame_M = attach(name + ".M", child.body, M);
    return add_coupler(name, law, frame_F, frame_M);
  } catch (...) {
    model_.attachments.erase(model_.attachments.begin() + before,
                             model_.attachments.end());
    throw;
  }
}

}  // namespace limber::dynamics
