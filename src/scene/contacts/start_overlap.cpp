// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/start_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::scene {
namespace {

constexpr double kMostShare = 0.03;  // of R_e [-]
constexpr double kMostDepth = 1e-4;  // of flat surfaces [m]
constexpr std::size_t kMostTold = 10;

joints::PairBody find_motion(const dynamics::SystemModel& model,
                             const dynamics::SystemState& state,
                             dynamics::BodyIndex body) {
  joints::PairBody motion;
  if (body == dynamics::kWorld) return motion;
  const dynamics::BodyState& at = state.bodies[index(body)];
  const dynamics::BodyModel& of = model.bodies[index(body)];
  motion.R_WB = at.quat_WB.toRotationMatrix();
  motion.p_WB = at.p_WB;
  motion.v_WB_W = at.v_WB_W;
  motion.w_WB_B = at.w_WB_B;
  motion.modes = of.modes;
  motion.eta = state.eta.data() + of.offset;
  motion.etadot = state.etadot.data() + of.offset;
  return motion;
}

double find_limit(const PlacedPair& pair, const contact::Meeting& meeting) {
  if (pair.radius) return kMostShare * *pair.radius;
  return meeting.curvature > 0.0 ? kMostShare / meeting.curvature : kMostDepth;
}

/// Where a pair overlaps beyond its limit, empty if it does not.
std::string describe_overlap(const PlacedPair& pair,
                             const dynamics::SystemModel& model,
                             const dynamics::SystemState& state) {
  const joints::PairBody A = find_motion(model, state, pair.body_A);
  const joints::PairBody B = find_motion(model, state, pair.body_B);
  std::vector<contact::Meeting> meetings(pair.shapes.most_points());
  pair.shapes.find({A, B}, 0.0, meetings);
  const auto deepest = std::max_element(
      meetings.begin(), meetings.end(),
      [](const auto& a, const auto& b) { return a.depth < b.depth; });
  if (deepest == meetings.end() || !(deepest->depth > 0.0)) return "";
  const double limit = find_limit(pair, *deepest);
  if (deepest->depth <= limit) return "";
  const Vector3& p = deepest->p_W;
  return fmt::format(
      "contact '{}': both overlap by {:.3g} m at the start, at ({:.4g}, "
      "{:.4g}, {:.4g}) m in the world; up to {:.2g} m is taken as touching "
      "there: move them apart, or leave this pair out",
      pair.name, deepest->depth, p.x(), p.y(), p.z(), limit);
}

}  // namespace

void check_overlaps(const std::vector<PlacedPair>& pairs,
                    const dynamics::SystemModel& model,
                    const dynamics::SystemState& state) {
  std::vector<std::string> problems;
  std::size_t count = 0;
  for (const PlacedPair& pair : pairs) {
    std::string problem = describe_overlap(pair, model, state);
    if (problem.empty() || ++count > kMostTold) continue;
    problems.push_back(std::move(problem));
  }
  if (count > kMostTold) {
    problems.push_back(
        fmt::format("{} more contacts overlap", count - kMostTold));
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace limber::scene
