// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/coupler_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/scene/build/recipes.hpp"
#include "limber/scene/build/rotation_check.hpp"
#include "limber/scene/text/error_context.hpp"

namespace limber::scene {
namespace {

/// A joint farther from its interface than this fraction of the body's size
/// gets a warning.
constexpr double kFarFraction = 0.05;

/// Largest gap between the ends of a loop, relative to its size.
constexpr double kGapFraction = 1e-6;
/// Round-off of the ends, relative to their places.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// A gear with a larger error at the start, relative to what it adds up, gets a
/// warning [-].
constexpr double kStretched = 1e-9;

/// A link and those that carry it, up to the root, without the world.
std::vector<int> list_carriers(const Robot& robot, const std::string& name) {
  std::vector<int> links;
  if (name == "world") return links;
  links.push_back(find_link(robot, name));
  const auto find_joint = [&] {
    return std::find_if(
        robot.joints.begin(), robot.joints.end(),
        [&](const Joint& joint) { return joint.child == links.back(); });
  };
  for (auto joint = find_joint(); joint != robot.joints.end();
       joint = find_joint()) {
    if (robot.links[index(joint->parent)].name == "world") break;
    links.push_back(joint->parent);
  }
  return links;
}

/// Links that carry one of two ends, but not both, and the ends' own.
std::vector<int> list_loop(const Robot& robot, const std::string& from,
                           const std::string& to) {
  std::vector<int> a = list_carriers(robot, from);
  std::vector<int> b = list_carriers(robot, to);
  while (a.size() > 1 && b.size() > 1 && a.back() == b.back()) {
    a.pop_back();
    b.pop_back();
  }
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

CouplerAssembly::CouplerAssembly(const Scene& scene, const BodyPlans& plans,
                                 const AttachmentSites& sites,
                                 dynamics::SystemBuilder& builder,
                                 std::vector<std::string>& warnings)
    : scene_(scene),
      plans_(plans),
      sites_(sites),
      builder_(builder),
      warnings_(warnings),
      loads_(scene, plans, sites.start()),
      at_zero_(find_motions_at_zero(scene.robot, scene.scenario)),
      starts_(find_joint_starts(scene.robot, scene.scenario)) {}

void CouplerAssembly::add_all() {
  const Robot& robot = scene_.robot;
  for (const int joint : plans_.coupled_joints) add_joint(joint);
  const auto add_each = [](const char* what, const auto& all, const auto& add) {
    for (const auto& one : all) {
      with_context(fmt::format("{} '{}'", what, one.name), [&] { add(one); });
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
                                            const AttachmentSite& site) {
  const flexbody::InterfaceTable& table = *site.anchor.table;
  const double distance = (site.X_BF.p - table.p_B).norm();
  if (distance >
      kFarFraction *
          sites_.plan_of(link, site.anchor.piece).reduced->size.norm()) {
    warnings_.push_back(fmt::format(
        "joint '{}' is {:.3g} m from the middle of interface '{}' of link "
        "'{}'; check the joint's origin and the mesh's <origin> and unit",
        joint.name, distance, table.name, site.link));
  }
}

AttachmentSite CouplerAssembly::find_joint_site(const Joint& joint, int link,
                                                const Pose& X_LF) {
  const BodyPlan& plan = sites_.plan_of(link);
  if (!plan.reduced || joint.kind == joints::JointKind::floating) {
    if (plan.piece_count > 1) {
      throw InputError(fmt::format(
          "joint '{}': damping of a floating link in pieces would act on its "
          "first piece only; leave link '{}' in one piece",
          joint.name, scene_.robot.links[index(link)].name));
    }
    return sites_.find_site(link, X_LF, {});
  }
  const Link& source = scene_.robot.links[index(link)];
  const std::string interface =
      find_joint_interface(*source.flexible, joint.name);
  const Anchor anchor = with_context(
      fmt::format("joint '{}' on link '{}', to which it is attached at {}",
                  joint.name, source.name,
                  interface == joint.name
                      ? "the interface of the joint's own name"
                      : "the interface that <attach> names"),
      [&] { return find_anchor(sites_.pieces_of(link), interface); });
  AttachmentSite site = sites_.find_site(link, X_LF, anchor);
  check_joint_interface(joint, link, site);
  return site;
}

dynamics::CouplerIndex CouplerAssembly::add_coupler(
    const std::string& name, const joints::CouplerLaw& law,
    const AttachmentSite& F, const AttachmentSite& M) {
  const RequiredSides required = joints::find_required_rotations(law);
  check_rotation(F, required.F);
  check_rotation(M, required.M);
  const dynamics::AttachmentIndex frame_F = attach(name + ".F", F, builder_);
  const dynamics::AttachmentIndex frame_M = attach(name + ".M", M, builder_);
  return builder_.add_coupler(name, law, frame_F, frame_M);
}

// An explicit scheme's steps resolve the vibration of rigid sides.
double CouplerAssembly::choose_rigid_frequency(const Vector3& p_W) const {
  return dynamics::traits_of(scene_.scenario.settings.integrator).is_implicit
             ? dynamics::find_rigid_frequency(p_W.norm())
             : dynamics::kLeastRigidFrequency;
}

// Couplers of two rigid sides that hold them by a default stiffness.
void CouplerAssembly::record_default(const std::string& name,
                                     const CouplerOptions& options,
                                     const AttachmentSite& F,
                                     const AttachmentSite& M,
                                     const joints::ConstraintStiffness& held) {
  if (F.side.flexibility || M.side.flexibility) return;
  if ((!options.translational_stiffness && held.translational > 0.0) ||
      (!options.rotational_stiffness && held.rotational > 0.0)) {
    rigid_defaults_.push_back(name);
  }
}

std::optional<std::string> CouplerAssembly::describe_explicit_defaults() const {
  const dynamics::IntegratorTraits& scheme =
      dynamics::traits_of(scene_.scenario.settings.integrator);
  if (scheme.is_implicit || rigid_defaults_.empty()) return std::nullopt;
  const std::size_t count = rigid_defaults_.size();
  return fmt::format(
      "{} is explicit, and its steps resolve joints: {} of rigid links, "
      "{}'{}', {} a default stiffness on which the masses of both sides "
      "vibrate at {:g} Hz ({:g} Hz with implicit integrators); "
      "translational_stiffness and rotational_stiffness of a <coupler> set "
      "another",
      scheme.name, count == 1 ? "1 joint" : fmt::format("{} joints", count),
      count == 1 ? "" : "the first ", rigid_defaults_.front(),
      count == 1 ? "has" : "have", dynamics::kLeastRigidFrequency,
      dynamics::kRigidFrequency);
}

void CouplerAssembly::add_joint(const JointSpec& spec, const AttachmentSite& F,
                                const AttachmentSite& M) {
  const auto find_parameters = [&](const CouplerOptions& options) {
    return find_joint_parameters(options, F.side, M.side, spec.load,
                                 choose_rigid_frequency(spec.p_W));
  };
  const auto coordinates =
      joints::find_coordinates(spec.kind, spec.axis, spec.second);
  std::vector<joints::JointElement> elements = make_elements(
      spec.actions, coordinates, find_stop_stiffness(F.side, M.side));
  for (const DriveSpec& drive : scene_.scenario.drives) {
    if (drive.joint != spec.name) continue;
    with_context("drive '" + drive.name + "'", [&] {
      elements.push_back({drive.coordinate - 1,
                          make_drive(drive, spec.max_effort, spec.max_speed)});
    });
  }
  const joints::CouplerLaw law =
      joints::make_joint(spec.kind, spec.axis, spec.second,
                         find_parameters(spec.coupler), std::move(elements));
  record_default(spec.name, spec.coupler, F, M,
                 joints::find_constraint_stiffness(law).value_or(
                     joints::ConstraintStiffness{}));
  const dynamics::CouplerIndex coupler = add_coupler(spec.name, law, F, M);
  if (coordinates.size() != 1) return;
  CouplerOptions stiff = spec.coupler;  // gears are, also between ideal joints
  stiff.is_ideal.reset();
  geared_[spec.name] = {coupler,
                        find_constraint(coordinates[0], find_parameters(stiff)),
                        coordinates,
                        {F, M}};
}

void CouplerAssembly::add_joint(int i) {
  const Joint& joint = scene_.robot.joints[index(i)];
  const bool free = joint.kind == joints::JointKind::floating;
  if (free && joint.coupler.free_damping.value_or(0.0) == 0.0) return;
  const AttachmentSite F = find_joint_site(joint, joint.parent, joint.X_PJ);
  const AttachmentSite M = find_joint_site(joint, joint.child, Pose{});
  with_context("joint '" + joint.name + "'", [&] {
    add_joint({joint.name, joint.kind, joint.axis_J, joint.second_J,
               joint.coupler, joint.actions, joint.max_effort, joint.max_speed,
               loads_.of_joint(i), sites_.start()[index(joint.child)].X_WL.p},
              F, M);
  });
}

void CouplerAssembly::check_gap(const LoopEnds& ends,
                                const std::vector<LinkMotion>& motions,
                                const char* where) const {
  const Pose from = sites_.find_pose(ends.from, motions);
  const Pose to = sites_.find_pose(ends.to, motions);
  double size = 0.0;
  for (const int link :
       list_loop(scene_.robot, ends.from.where.link, ends.to.where.link)) {
    size = std::max(size, (motions[index(link)].X_WL.p - from.p).norm());
  }
  const double gap = (to.p - from.p).norm();
  const double rounding = kRounding * (from.p.norm() + to.p.norm());
  if (gap <= kGapFraction * size + rounding) return;
  throw InputError(fmt::format(
      "its ends are {:.3g} m apart {}, at ({:.6g}, {:.6g}, {:.6g}) and "
      "({:.6g}, {:.6g}, {:.6g}) m; they must meet there",
      gap, where, from.p.x(), from.p.y(), from.p.z(), to.p.x(), to.p.y(),
      to.p.z()));
}

void CouplerAssembly::add_loop(const Loop& loop) {
  const Pose X_WF = sites_.find_pose(loop.from, at_zero_);
  check_gap({loop.from, loop.to}, at_zero_, "where all joints are at zero");
  add_joint({loop.name, loop.kind, loop.axis_F, loop.second_F, loop.coupler,
             loop.actions, joints::Drive::kUnlimited, joints::Drive::kUnlimited,
             loads_.of_loop(loop), X_WF.p},
            sites_.find_site(loop.from, X_WF, at_zero_),
            sites_.find_site(loop.to, X_WF, at_zero_));
}

void CouplerAssembly::add_connector(const Connector& connector) {
  const std::vector<LinkMotion>& start = sites_.start();
  const Pose from = sites_.find_pose(connector.from, start);
  const Pose to = sites_.find_pose(connector.to, start);
  const AttachmentSite F = sites_.find_site(connector.from, from, start);
  if (const auto* spring = std::get_if<SpringOptions>(&connector.law)) {
    add_coupler(connector.name, make_spring(*spring, (to.p - from.p).norm()), F,
                sites_.find_site(connector.to, to, start));
    return;
  }
  // Unstressed at the start: both frames are that of the first end.
  if (connector.to.where.point) {
    check_gap({connector.from, connector.to}, start, "at the start");
  }
  add_coupler(
      connector.name,
      joints::Bushing(std::get<joints::Bushing::Parameters>(connector.law)), F,
      sites_.find_site(connector.to, from, start));
}

void CouplerAssembly::add_latch(const Latch& latch) {
  const std::vector<LinkMotion>& start = sites_.start();
  const Pose X_WF = sites_.find_pose(latch.from, start);
  const AttachmentSite F = sites_.find_site(latch.from, X_WF, start);
  const AttachmentSite M =
      sites_.find_site(latch.to, sites_.find_pose(latch.to, start), start);
  Latch released = latch;
  const auto time = scene_.scenario.releases.find(latch.name);
  if (time != scene_.scenario.releases.end()) {
    released.release_time = time->second;
  }
  const joints::JointParameters held = find_joint_parameters(
      latch.coupler, F.side, M.side, {}, choose_rigid_frequency(X_WF.p));
  record_default(latch.name, latch.coupler, F, M,
                 {held.translational_stiffness, held.rotational_stiffness});
  add_coupler(latch.name, make_latch(released, held), F, M);
}

void CouplerAssembly::add_tendon(const Tendon& tendon) {
  std::vector<dynamics::AttachmentIndex> points;
  std::vector<Vector3> p_W;
  double length = 0.0;
  for (const ConnectorEnd& end : tendon.via) {
    const Pose X_WF = sites_.find_pose(end, sites_.start());
    const AttachmentSite site = sites_.find_site(end, X_WF, sites_.start());
    points.push_back(attach(
        fmt::format("{}.{}", tendon.name, points.size() + 1), site, builder_));
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
    with_context("drive '" + drive.name + "'", [&] {
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
  const double sum = std::abs(place(joint->second)) +
                     std::abs(gear.ratio * place(with->second)) +
                     std::abs(gear.offset);
  if (std::abs(excess) <= kStretched * sum) return;
  warnings_.push_back(fmt::format(
      "gear '{}' starts strained by {:.3g}: joint '{}' is at {:g}, and joint "
      "'{}' requires {:g}",
      gear.name, excess, gear.joint, place(joint->second), gear.with, needed));
}

void CouplerAssembly::add_gear(const Gear& gear) {
  check_start(gear);
  const Geared& joint = geared_.at(gear.joint);
  const Geared& with = geared_.at(gear.with);
  for (const Geared* side : {&joint, &with}) {
    const RequiredSides required =
        joints::find_required_rotations(side->coordinates, 0);
    check_rotation(side->sites[0], required.F);
    check_rotation(side->sites[1], required.M);
  }
  dynamics::JointSum sum;
  sum.terms = {{joint.coupler, 0, 1.0}, {with.coupler, 0, -gear.ratio}};
  sum.offset = gear.offset;
  builder_.add_joint_sum(
      gear.name, sum,
      {make_gear_spring(gear, joint.constraint, with.constraint)});
}

}  // namespace limber::scene
