// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/silent_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "limber/common/evaluation_time.hpp"
#include "limber/common/index.hpp"

namespace limber::app {
namespace {

// Of the bounds of a link's travel, as links bend and joints yield [-].
constexpr double kTravelMargin = 1.05;
constexpr int kTimesOfLoad = 256;

bool is_fixed(const scene::BuiltScene& built, dynamics::BodyIndex body) {
  if (body == dynamics::kWorld) return true;
  const dynamics::BodyModel& model = built.model.bodies[index(body)];
  return model.clamped && model.modes == 0;
}

void add_probes(const scene::Scene& scene, const scene::BuiltScene& built,
                std::vector<std::string>& silent) {
  for (const scene::ProbeSpec& probe : scene.scenario.probes) {
    const auto* point = std::get_if<scene::PointProbeSpec>(&probe.of);
    if (point == nullptr || point->relative_to) continue;
    const std::string& link = point->where.link;
    const bool stays =
        link == "world" ||
        is_fixed(built,
                 built.links[index(scene::find_link(scene.robot, link))].body);
    if (!stays) continue;
    silent.push_back(fmt::format(
        "probe '{}' stays constant: link '{}' is fixed in the world",
        probe.name, link));
  }
}

bool is_zero(const dynamics::TimeFunction& function, double start, double end) {
  if (std::holds_alternative<dynamics::InputFunction>(function)) return false;
  std::vector<double> times = dynamics::break_times(function);
  for (int i = 0; i <= kTimesOfLoad; ++i) {
    times.push_back(start + (end - start) * i / kTimesOfLoad);
  }
  return std::all_of(times.begin(), times.end(), [&](double t) {
    const auto value = [&](Side side) {
      return dynamics::evaluate(function, t, side);
    };
    return t < start || t > end ||
           (value(Side::right) == 0.0 &&
            (t == start || value(Side::left) == 0.0));
  });
}

void add_loads(const scene::BuiltScene& built,
               std::vector<std::string>& silent) {
  const double end = built.settings.end_time;
  for (const dynamics::Load& load : built.model.loads) {
    const dynamics::BodyIndex body =
        built.model.attachments[index(load.where)].body;
    if (is_fixed(built, body)) {
      silent.push_back(
          fmt::format("load '{}' has no effect: it acts on a body that is "
                      "fixed in the world",
                      load.name));
    } else if ((load.force.isZero(0.0) && load.moment.isZero(0.0)) ||
               is_zero(load.function, built.initial.t, end)) {
      silent.push_back(fmt::format(
          "load '{}' is zero from the start to the end", load.name));
    }
  }
}

/// Balls that links stay in, see the header.
class LinkReach {
 public:
  LinkReach(const scene::Scene& scene, const scene::BuiltScene& built)
      : robot_(scene.robot), built_(built) {}

  /// Links from a body's own to the root that carries it; empty: fixed in the
  /// world. Nothing if it is not a link of the tree, or is free.
  [[nodiscard]] std::optional<std::vector<int>> find_chain(
      dynamics::BodyIndex body) const {
    if (body == dynamics::kWorld) return std::vector<int>{};
    const auto link = std::find_if(
        built_.links.begin(), built_.links.end(),
        [&](const scene::PlacedLink& placed) { return placed.body == body; });
    const auto first = link - built_.links.begin();
    if (first >= std::ssize(robot_.joints) + 1) return std::nullopt;
    std::vector<int> chain;
    for (int i = static_cast<int>(first); i > 0; i = joint_of(i).parent) {
      chain.push_back(i);
    }
    chain.push_back(0);
    return chain;
  }

  /// Whether the root is fixed in the world.
  [[nodiscard]] bool has_fixed_root() const {
    const dynamics::BodyIndex root = built_.links.front().body;
    return root == dynamics::kWorld || built_.model.bodies[index(root)].clamped;
  }

  /// Largest distance that any point of a chain's first link can travel from
  /// `p_W`, relative to the last link, which carries the chain [m].
  [[nodiscard]] std::optional<double> find_travel(const std::vector<int>& chain,
                                                  double extent,
                                                  const Vector3& p_W) const {
    if (chain.size() < 2) return 0.0;
    double radius = extent + built_.links[index(chain.front())].X_BL.p.norm();
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const scene::Joint& joint = joint_of(chain[i]);
      const std::optional<double> slide = find_slide(joint);
      if (!slide) return std::nullopt;
      radius += *slide;
      if (i + 2 < chain.size()) radius += joint.X_PJ.p.norm();
    }
    const scene::Joint& carrier = joint_of(chain[chain.size() - 2]);
    const Vector3 centre = find_pose(carrier.parent) * carrier.X_PJ.p;
    return radius + (p_W - centre).norm();
  }

 private:
  [[nodiscard]] const scene::Joint& joint_of(int link) const {
    return robot_.joints[index(link - 1)];
  }

  [[nodiscard]] Pose find_pose(int link) const {
    const scene::PlacedLink& placed = built_.links[index(link)];
    if (placed.body == dynamics::kWorld) return placed.X_BL;
    const dynamics::BodyState& body = built_.initial.bodies[index(placed.body)];
    return Pose{body.quat_WB.toRotationMatrix(), body.p_WB} * placed.X_BL;
  }

  // Travel of a joint's origin; nothing if it is not bounded [m].
  [[nodiscard]] static std::optional<double> find_slide(
      const scene::Joint& joint) {
    using joints::JointKind;
    if (joint.kind == JointKind::planar || joint.kind == JointKind::floating) {
      return std::nullopt;
    }
    if (joint.kind != JointKind::prismatic) return 0.0;
    for (const scene::JointAction& action : joint.actions) {
      const auto* stop = std::get_if<scene::StopOptions>(&action.law);
      if (stop == nullptr || !stop->lower || !stop->upper) continue;
      return std::max(std::abs(*stop->lower), std::abs(*stop->upper));
    }
    return std::nullopt;
  }

  const scene::Robot& robot_;
  const scene::BuiltScene& built_;
};

/// Removes the links above the lowest that carries both.
/// @returns false if nothing carries both
bool cut_to_common(std::vector<int>& a, std::vector<int>& b) {
  std::optional<int> common;
  while (!a.empty() && !b.empty() && a.back() == b.back()) {
    common = a.back();
    a.pop_back();
    b.pop_back();
  }
  if (!common) return false;
  a.push_back(*common);
  b.push_back(*common);
  return true;
}

void add_contacts(const scene::Scene& scene, const scene::BuiltScene& built,
                  const std::vector<StartTouch>& touches,
                  std::vector<std::string>& silent) {
  const LinkReach reach(scene, built);
  for (const StartTouch& start : touches) {
    if (!start.has_place()) continue;
    auto A = reach.find_chain(start.pair->body_A);
    auto B = reach.find_chain(start.pair->body_B);
    if (!A || !B) continue;
    if (A->empty() && reach.has_fixed_root()) A = std::vector<int>{0};
    if (B->empty() && reach.has_fixed_root()) B = std::vector<int>{0};
    if (!cut_to_common(*A, *B)) continue;
    const Vector3 half = 0.5 * start.gap * start.touch.normal_W;
    const auto travel_A = reach.find_travel(
        *A, start.law->find_reach_A().extent, start.touch.p_W - half);
    const auto travel_B = reach.find_travel(
        *B, start.law->find_reach_B().extent, start.touch.p_W + half);
    if (!travel_A || !travel_B) continue;
    const double travel = kTravelMargin * (*travel_A + *travel_B);
    if (!(start.gap > travel)) continue;
    silent.push_back(fmt::format(
        "contact '{}' cannot occur: the bodies are {:.3g} m apart, and their "
        "joints let them approach each other by at most {:.3g} m",
        start.pair->name, start.gap, travel));
  }
}

void add_shapes(const scene::Scene& scene, std::vector<std::string>& silent) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.robot.links.size(); ++i) {
    const scene::Link& link = scene.robot.links[i];
    const scene::Toucher body = {false, i};
    const bool touches =
        std::any_of(scene.touching.begin(), scene.touching.end(),
                    [&](const scene::TouchingPair& pair) {
                      return pair.A == body || pair.B == body;
                    });
    if (!link.collisions.empty() && !touches) names.push_back(link.name);
  }
  if (names.empty()) return;
  silent.push_back(fmt::format(
      "the shape of '{}'{} has no effect: no [[contact]] names it",
      names.front(),
      names.size() == 1 ? ""
                        : fmt::format(" (and of {} more)", names.size() - 1)));
}

}  // namespace

std::vector<std::string> find_silent_parts(
    const scene::Scene& scene, const scene::BuiltScene& built,
    const std::vector<StartTouch>& touches) {
  std::vector<std::string> silent;
  add_probes(scene, built, silent);
  add_loads(built, silent);
  add_contacts(scene, built, touches, silent);
  add_shapes(scene, silent);
  return silent;
}

}  // namespace limber::app
