// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/joint_response.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "limber/common/index.hpp"
#include "limber/dynamics/monitors/shortest_impact.hpp"

namespace limber::dynamics {
namespace {

std::array<BodyIndex, 2> find_bodies(const SystemModel& model,
                                     const Coupler& coupler) {
  return {model.attachments[index(coupler.frame_F)].body,
          model.attachments[index(coupler.frame_M)].body};
}

/// 1 / mu of the joint's bodies [1/kg]; none if one of them deforms.
std::optional<double> find_mobility(const SystemModel& model,
                                    const std::array<BodyIndex, 2>& bodies) {
  double mobility = 0.0;
  for (const BodyIndex b : bodies) {
    if (b == kWorld) continue;
    const BodyModel& body = model.bodies[index(b)];
    if (body.reduced) return std::nullopt;
    mobility += 1.0 / body.mass;
  }
  return mobility;
}

/// Natural frequency of a joint of rigid bodies [Hz].
std::optional<double> find_hold_frequency(const SystemModel& model,
                                          const Coupler& coupler) {
  const auto stiffness = joints::find_constraint_stiffness(coupler.law);
  if (!stiffness || !(stiffness->translational > 0.0)) return std::nullopt;
  const auto mobility = find_mobility(model, find_bodies(model, coupler));
  if (!mobility) return std::nullopt;
  return std::sqrt(stiffness->translational * *mobility) /
         (2.0 * std::numbers::pi);
}

bool is_held(const Pair& pair, const std::array<BodyIndex, 2>& bodies) {
  for (const BodyIndex b : bodies) {
    if (b != kWorld && (b == pair.body_A || b == pair.body_B)) return true;
  }
  return false;
}

}  // namespace

std::vector<JointResponse> find_joint_responses(
    const SystemModel& model, const std::vector<ContactRecord>& records) {
  const auto shortest = find_shortest_impacts(records);
  std::vector<JointResponse> responses;
  for (const Pair& pair : model.pairs) {
    const auto found = shortest.find(pair.name);
    if (found == shortest.end()) continue;
    for (const Coupler& coupler : model.couplers) {
      if (!is_held(pair, find_bodies(model, coupler))) continue;
      const auto frequency = find_hold_frequency(model, coupler);
      if (!frequency) continue;
      responses.push_back({pair.name, coupler.name, found->second, *frequency});
    }
  }
  return responses;
}

std::string describe(const JointResponse& response) {
  const double ratio = JointResponse::kEnough / response.fraction();
  return fmt::format(
      "joint '{}' is slow relative to the impact of contact '{}': it vibrates "
      "at {:.4g} Hz and the impact lasts about {:.3g} s, so it does not "
      "constrain its bodies during the impact, and the rebound is wrong; "
      "{:.2g} times its stiffness would suffice",
      response.joint, response.pair, response.frequency, response.duration,
      ratio * ratio);
}

}  // namespace limber::dynamics
