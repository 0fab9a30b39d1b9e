// SPDX-License-Identifier: BSD-3-Clause
#include "scene/coupler_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/naming.hpp"
#include "scene/recipes.hpp"
#include "scene/rotation_check.hpp"

namespace limber::scene {
namespace {

/// A joint farther from its interface than this share of the body's size gets
/// a warning.
constexpr double kFarShare = 0.05;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Two ends of a loop meet within this share of the robot's size.
constexpr double kGapShare = 1e-6;

/// A gear that is farther from its place at the start gets a warning [rad, m].
constexpr double kStretched = 1e-9;

}  // namespace

CouplerAssembly::CouplerAssembly(const Scene& scene, const BodyPlans& plans,
                                 const Mounts& mounts,
                                 dynamics::SystemBuilder& builder,
                                 std::vector<std::string>& warnings)
    : scene_(scene),
      plans_(plans),
      mounts_(mounts),
      builder_(builder),
      warnings_(warnings),
      loads_(scene, plans, mounts.start()),
      at_zero_(find_motions_at_zero(scene.robot, scene.scenario)),
      starts_(find_joint_starts(scene.robot, scene.scenario)) {}

void CouplerAssembly::add_all() {
  const Robot& robot = scene_.robot;
  for (const int joint : plans_.coupled_joints) add_joint(joint);
  const auto add_each = [](const char* what, const auto& all, const auto& add) {
    for (const auto& one : all) {
      naming(fmt::format("{} '{}'", what, one.name), [&] { add(one); });
    }
  };
  add_each("loop", robot.loops, [this](const Loop& l) { add_loop(l); });
  add_each("connector", robot.connectors,
           [this](const Connector& c) { add_connector(c); });
  add_each("latch", robot.latches, [this](const Latch& l) { add_latch(l); });
  add_each("tendon", robot.tendons, [this](const Tendon& t) { add_tendon(t); });
  add_each("gear", robot.gears, [this](const Gear& g) { add_gear(g); });
}

void CouplerAssembly::check_joint_interface(const Joint& joint, int link,
                                            const Mount& mount) {
  const flexbody::InterfaceTable& table = *mount.anchor.table;
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
  Mount mount = mounts_.find_mount(link, X_LF, anchor);
  check_joint_interface(joint, link, mount);
  return mount;
}

dynamics::CouplerIndex CouplerAssembly::add_coupler(
    const std::string& name, const joints::CouplerLaw& law, const Mount& F,
    const Mount& M) {
  const AskedSides asked = find_asked_rotations(law);
  check_rotation(F, asked.F);
  check_rotation(M, asked.M);
  const dynamics::AttachmentIndex frame_F = attach(name + ".F", F, builder_);
  const dynamics::AttachmentIndex frame_M = attach(name + ".M", M, builder_);
  return builder_.add_coupler(name, law, frame_F, frame_M);
}

void CouplerAssembly::add_joint(const JointSpec& spec, const Mount& F,
                                const Mount& M) {
  const joints::JointParameters held =
      find_joint_parameters(spec.coupler, F.side, M.side, spec.load);
  const auto coordinates =
      joints::find_coordinates(spec.kind, spec.axis, spec.second);
  std::vector<joints::JointElement> elements = make_elements(
      spec.actions, coordinates, find_stop_stiffness(F.side, M.side));
  for (const DriveSpec& drive : scene_.scenario.drives) {
    if (drive.joint != spec.name) continue;
    naming("drive '" + drive.name + "'", [&] {
      elements.push_back({drive.coordinate - 1,
                          make_drive(drive, spec.max_effort, spec.max_speed)});
    });
  }
  const dynamics::CouplerIndex coupler =
      add_coupler(spec.name,
                  joints::make_joint(spec.kind, spec.axis, spec.second, held,
                                     std::move(elements)),
                  F, M);
  if (coordinates.size() == 1) {
    geared_[spec.name] = {
        coupler, find_hold(coordinates[0], held), coordinates, {F, M}};
  }
}

void CouplerAssembly::add_joint(int i) {
  const Joint& joint = scene_.robot.joints[index(i)];
  const bool free = joint.kind == joints::JointKind::floating;
  if (free && joint.coupler.free_damping.value_or(0.0) == 0.0) return;
  const Mount F = mount_joint(joint, joint.parent, joint.X_PJ);
  const Mount M = mount_joint(joint, joint.child, Pose{});
  naming("joint '" + joint.name + "'", [&] {
    add_joint(
        {joint.name, joint.kind, joint.axis_J, joint.second_J, joint.coupler,
         joint.actions, joint.max_effort, joint.max_speed, loads_.of_joint(i)},
        F, M);
  });
}

void CouplerAssembly::check_gap(const Pose& from, const Pose& to,
                                const char* where) const {
  double size = std::max(from.p.norm(), to.p.norm());
  for (const LinkMotion& link : at_zero_) {
    size = std::max(size, (link.X_WL.p - from.p).norm());
  }
  const double gap = (to.p - from.p).norm();
  if (gap <= kGapShare * size) return;
  throw InputError(fmt::format(
      "its ends are {:.3g} m apart {}, at ({:.6g}, {:.6g}, {:.6g}) and "
      "({:.6g}, {:.6g}, {:.6g}) m; they must meet there",
      gap, where, from.p.x(), from.p.y(), from.p.z(), to.p.x(), to.p.y(),
      to.p.z()));
}

void CouplerAssembly::add_loop(const Loop& loop) {
  const Pose X_WF = mounts_.find_pose(loop.from, at_zero_);
  check_gap(X_WF, mounts_.find_pose(loop.to, at_zero_),
            "where all joints are at zero");
  add_joint({loop.name, loop.kind, loop.axis_F, loop.second_F, loop.coupler,
             loop.actions, joints::Drive::kUnlimited, joints::Drive::kUnlimited,
             loads_.of_loop(loop)},
            mounts_.find_mount(loop.from, X_WF, at_zero_),
            mounts_.find_mount(loop.to, X_WF, at_zero_));
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
  if (connector.to.where.point) check_gap(from, to, "at the start");
  add_coupler(
      connector.name,
      joints::Bushing(std::get<joints::Bushing::Parameters>(connector.law)), F,
      mounts_.find_mount(connector.to, from, start));
}

void CouplerAssembly::add_latch(const Latch& latch) {
  const auto mount = [&](const ConnectorEnd& end) {
    return mounts_.find_mount(end, mounts_.find_pose(end, mounts_.start()),
                              mounts_.start());
  };
  const Mount F = mount(latch.from);
  const Mount M = mount(latch.to);
  Latch released = latch;
  const auto time = scene_.scenario.releases.find(latch.name);
  if (time != scene_.scenario.releases.end()) {
    released.release_time = time->second;
  }
  add_coupler(latch.name,
              make_latch(released,
                         find_joint_parameters(latch.coupler, F.side, M.side)),
              F, M);
}

void CouplerAssembly::add_tendon(const Tendon& tendon) {
  std::vector<dynamics::AttachmentIndex> points;
  std::vector<Vector3> p_W;
  double length = 0.0;
  for (const ConnectorEnd& end : tendon.via) {
    const Pose X_WF = mounts_.find_pose(end, mounts_.start());
    const Mount mount = mounts_.find_mount(end, X_WF, mounts_.start());
    points.push_back(attach(
        fmt::format("{}.{}", tendon.name, points.size() + 1), mount, builder_));
    if (!p_W.empty()) {
      const double stretch = (X_WF.p - p_W.back()).norm();
      if (!(stretch > 0.0)) {
        throw InputError(fmt::format(
            "its points {} and {} meet at the start; the line between them has "
            "no direction",
            p_W.size(), p_W.size() + 1));
      }
      length += stretch;
    }
    p_W.push_back(X_WF.p);
  }
  std::vector<joints::ScalarLaw> laws = make_tendon_laws(tendon, length);
  for (const DriveSpec& drive : scene_.scenario.drives) {
    if (drive.tendon != tendon.name) continue;
    naming("drive '" + drive.name + "'", [&] {
      laws.emplace_back(make_drive(drive, joints::Drive::kUnlimited,
                                   joints::Drive::kUnlimited));
    });
  }
  builder_.add_path(tendon.name, points, laws);
}

void CouplerAssembly::check_start(const Gear& gear) {
  const auto joint = starts_.find(gear.joint);
  const auto with = starts_.find(gear.with);
  if (joint == starts_.end() || with == starts_.end()) return;  // of a loop
  const auto place = [](const JointStart& start) {
    return start.position.empty() ? 0.0 : start.position.front();
  };
  const double needed = gear.ratio * place(with->second) + gear.offset;
  const double excess = place(joint->second) - needed;
  if (std::abs(excess) <= kStretched * (1.0 + std::abs(needed))) return;
  warnings_.push_back(fmt::format(
      "gear '{}' starts strained by {:.3g}: joint '{}' is at {:g}, "
      "and joint '{}' asks for {:g}",
      gear.name, excess, gear.joint, place(joint->second), gear.with, needed));
}

void CouplerAssembly::add_gear(const Gear& gear) {
  check_start(gear);
  const Geared& joint = geared_.at(gear.joint);
  const Geared& with = geared_.at(gear.with);
  for (const Geared* side : {&joint, &with}) {
    const AskedSides asked = find_asked_rotations(side->coordinates, 0);
    check_rotation(side->mounts[0], asked.F);
    check_rotation(side->mounts[1], asked.M);
  }
  dynamics::JointSum sum;
  sum.terms = {{joint.coupler, 0, 1.0}, {with.coupler, 0, -gear.ratio}};
  sum.offset = gear.offset;
  builder_.add_joint_sum(gear.name, sum,
                         {make_gear_spring(gear, joint.hold, with.hold)});
}

}  // namespace limber::scene
