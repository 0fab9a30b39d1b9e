// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/carried_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "limber/common/index.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::scene {
namespace {

// Frames nearer than this fraction of a body's farthest distance coincide.
constexpr double kSamePlace = 1e-6;

double find_largest(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

// Bound on a controller's output; 0 without limits, since it is then
// unknown.
double find_bound(const Scenario& scenario, int input) {
  const dynamics::PidParameters& pid = scenario.controllers[index(input)].pid;
  const double bound = std::max(std::abs(pid.lower), std::abs(pid.upper));
  return std::isfinite(bound) ? bound : 0.0;
}

// Bound on a load's factor.
double find_peak(const dynamics::TimeFunction& function,
                 const Scenario& scenario) {
  return std::visit(
      Overloaded{
          [](const dynamics::StepSequence& s) {
            return find_largest(s.values);
          },
          [](const dynamics::Table& t) { return find_largest(t.values); },
          [](const dynamics::HarmonicSum& sum) {
            double peak = std::abs(sum.mean);
            for (const dynamics::Harmonic& h : sum.terms) {
              peak += std::hypot(h.cosine, h.sine);
            }
            return peak;
          },
          [&](const dynamics::InputFunction& f) {
            return std::abs(f.factor) * find_bound(scenario, f.input);
          },
          [](const auto&) { return 1.0; }},
      function);
}

// Bounds on a drive's command and its rate.
joints::SignalValue find_most(const joints::Signal& signal,
                              const Scenario& scenario) {
  if (const auto* input = std::get_if<joints::InputSignal>(&signal.base)) {
    return {std::abs(input->factor) * find_bound(scenario, input->input), 0.0};
  }
  return joints::find_largest(signal);
}

// Largest angular speed that a drive commands; 0 for a translation.
double find_angular_speed(const DriveSpec& drive, joints::JointKind kind,
                          const Scenario& scenario) {
  const auto coordinates =
      joints::find_coordinates(kind, Vector3::UnitZ(), Vector3::UnitX());
  const auto i = index(drive.coordinate - 1);
  if (i >= coordinates.size() ||
      coordinates[i].kind != joints::AxisCoordinate::Kind::angle) {
    return 0.0;
  }
  const joints::SignalValue most = find_most(drive.drive.signal, scenario);
  switch (drive.drive.mode) {
    case joints::DriveMode::position:
      return most.rate;
    case joints::DriveMode::velocity:
      return most.value;
    case joints::DriveMode::effort:
      break;
  }
  return 0.0;
}

// For each link one that joints and loops hold it together with, the same for
// all of these; floating joints hold nothing.
std::vector<int> find_trees(const Robot& robot) {
  std::vector<int> trees(robot.links.size());
  std::iota(trees.begin(), trees.end(), 0);
  for (const Joint& joint : robot.joints) {
    if (joint.kind == joints::JointKind::floating) continue;
    trees[index(joint.child)] = trees[index(joint.parent)];
  }
  for (const Loop& loop : robot.loops) {
    if (loop.from.where.link == "world" || loop.to.where.link == "world") {
      continue;
    }
    const int kept = trees[index(find_link(robot, loop.from.where.link))];
    const int joined = trees[index(find_link(robot, loop.to.where.link))];
    std::replace(trees.begin(), trees.end(), joined, kept);
  }
  return trees;
}

}  // namespace

CarriedLoads::CarriedLoads(const Scene& scene, const BodyPlans& plans,
                           const std::vector<LinkMotion>& start)
    : scene_(scene),
      plans_(plans),
      start_(start),
      frames_(plans.bodies.size()),
      trees_(find_trees(scene.robot)) {
  find_frames();
  find_parts();
}

// joints[i] leads to links[i + 1], whose frame it is.
void CarriedLoads::find_frames() {
  const auto add_frame = [&](int link, const Vector3& at) {
    frames_[index(plans_.body_of_link[index(link)])].push_back(at);
  };
  for (const int j : plans_.coupled_joints) {
    const Joint& joint = scene_.robot.joints[index(j)];
    if (joint.kind == joints::JointKind::floating) continue;
    const Vector3& at = start_[index(joint.child)].X_WL.p;
    add_frame(joint.parent, at);
    add_frame(joint.child, at);
  }
  for (const Loop& loop : scene_.robot.loops) {
    for (const ConnectorEnd* end : {&loop.from, &loop.to}) {
      if (end->where.link == "world") continue;
      add_frame(find_link(scene_.robot, end->where.link), place(end->where));
    }
  }
}

void CarriedLoads::find_parts() {
  const double g = scene_.scenario.gravity.norm();
  for (const BodyPlan& plan : plans_.bodies) {
    if (plan.is_world) continue;
    const int link = plan.links.front();
    if (!is_of_tree(link)) continue;
    const Vector3 centre = find_centre(plan);
    const double w = find_speed(trees_[index(link)]);
    const double a = w * w * find_radius(link, centre) + g;
    parts_.push_back({link, plan.mass * a, 0.0, centre});
  }
  for (const LoadSpec& load : scene_.scenario.loads) {
    const int link = find_link(scene_.robot, load.where.link);
    if (!is_of_tree(link)) continue;
    const double peak = find_peak(load.time, scene_.scenario);
    parts_.push_back({link, peak * load.force.norm(), peak * load.moment.norm(),
                      place(load.where)});
  }
}

double CarriedLoads::find_speed(int tree) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < scene_.robot.tree_size(); ++i) {
    if (trees_[i] != tree) continue;
    largest = std::max(largest, start_[i].w_WL_W.norm());
  }
  std::vector<double> driven(scene_.robot.links.size(), 0.0);
  for (std::size_t j = 0; j < scene_.robot.joints.size(); ++j) {
    const Joint& joint = scene_.robot.joints[j];
    if (trees_[index(joint.child)] != tree) continue;
    double& speed = driven[index(joint.child)];
    speed = driven[index(joint.parent)];
    for (const DriveSpec& drive : scene_.scenario.drives) {
      if (drive.joint == joint.name)
        speed += find_angular_speed(drive, joint.kind, scene_.scenario);
    }
    largest = std::max(largest, speed);
  }
  for (const Loop& loop : scene_.robot.loops) {
    if (!is_in(loop, tree)) continue;
    for (const DriveSpec& drive : scene_.scenario.drives) {
      if (drive.joint != loop.name) continue;
      largest = std::max(largest,
                         find_angular_speed(drive, loop.kind, scene_.scenario));
    }
  }
  return largest;
}

// Interfaces of flexible links are placed at the link's origin.
Vector3 CarriedLoads::place(const Place& where) const {
  const int link = find_link(scene_.robot, where.link);
  return start_[index(link)].X_WL * where.point.value_or(Vector3::Zero());
}

// Projectiles hang on no joint.
bool CarriedLoads::is_of_tree(int link) const {
  return index(link) < scene_.robot.tree_size();
}

bool CarriedLoads::is_in(const Loop& loop, int tree) const {
  for (const ConnectorEnd* end : {&loop.from, &loop.to}) {
    if (end->where.link == "world") continue;
    return trees_[index(find_link(scene_.robot, end->where.link))] == tree;
  }
  return false;
}

bool CarriedLoads::is_beyond(int link, int joint) const {
  for (int l = link; l > 0; l = scene_.robot.joints[index(l - 1)].parent) {
    if (l - 1 == joint) return true;
  }
  return false;
}

Vector3 CarriedLoads::find_centre(const BodyPlan& plan) const {
  const int link = plan.links.front();
  const Pose X_BL = find_X_BL(plans_, link, plan.piece);
  return start_[index(link)].X_WL * X_BL.inverse().p;
}

double CarriedLoads::find_radius(int link, const Vector3& centre) const {
  double radius = 0.0;
  for (int l = link; l > 0; l = scene_.robot.joints[index(l - 1)].parent) {
    if (scene_.robot.joints[index(l - 1)].kind == joints::JointKind::floating) {
      break;  // a root
    }
    radius = std::max(radius, (centre - start_[index(l)].X_WL.p).norm());
  }
  return radius;
}

// Least distance of two couplers on a link's body, else by its inertia.
double CarriedLoads::find_size(int link) const {
  const auto b = index(plans_.body_of_link[index(link)]);
  const BodyPlan& plan = plans_.bodies[b];
  if (plan.is_world) return std::numeric_limits<double>::infinity();
  const std::vector<Vector3>& at = frames_[b];
  double farthest = 0.0;
  for (const Vector3& p : at) {
    for (const Vector3& q : at) farthest = std::max(farthest, (p - q).norm());
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3& p : at) {
    for (const Vector3& q : at) {
      const double distance = (p - q).norm();
      if (distance > kSamePlace * farthest) least = std::min(least, distance);
    }
  }
  if (std::isfinite(least)) return least;
  const double offset =
      at.empty() ? 0.0 : (at.front() - find_centre(plan)).norm();
  const double size =
      std::max(offset, std::sqrt(0.5 * plan.inertia.trace() / plan.mass));
  return size > 0.0 ? size : std::numeric_limits<double>::infinity();
}

void CarriedLoads::add(const Part& part, const Vector3& at,
                       CarriedLoad& sum) const {
  sum.force += part.force;
  sum.moment += part.moment + part.force * (part.at - at).norm();
}

bool CarriedLoads::is_carried(const Part& part, int joint) const {
  const int tree = trees_[index(scene_.robot.joints[index(joint)].child)];
  if (trees_[index(part.link)] != tree) return false;
  for (const Loop& loop : scene_.robot.loops) {
    if (is_in(loop, tree)) return true;
  }
  return is_beyond(part.link, joint);
}

CarriedLoad CarriedLoads::of_joint(int joint) const {
  const Joint& j = scene_.robot.joints[index(joint)];
  CarriedLoad sum{.size = std::min(find_size(j.parent), find_size(j.child))};
  for (const Part& part : parts_) {
    if (!is_carried(part, joint)) continue;
    add(part, start_[index(j.child)].X_WL.p, sum);
  }
  return sum;
}

CarriedLoad CarriedLoads::of_loop(const Loop& loop) const {
  CarriedLoad sum{.size = std::numeric_limits<double>::infinity()};
  Vector3 at = loop.from.where.point.value_or(Vector3::Zero());
  for (const ConnectorEnd* end : {&loop.to, &loop.from}) {
    if (end->where.link == "world") continue;
    at = place(end->where);
    sum.size =
        std::min(sum.size, find_size(find_link(scene_.robot, end->where.link)));
  }
  for (const Part& part : parts_) {
    if (is_in(loop, trees_[index(part.link)])) add(part, at, sum);
  }
  return sum;
}

}  // namespace limber::scene
