// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/start_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/joints/pairs/touching.hpp"

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

/// A pair that overlaps at the start.
struct Overlap {
  joints::PairBodies bodies;
  contact::Meeting deepest;
};

std::optional<Overlap> find_overlap(const PlacedPair& pair,
                                    const dynamics::SystemModel& model,
                                    const dynamics::SystemState& state) {
  const joints::PairBody A = find_motion(model, state, pair.body_A);
  const joints::PairBody B = find_motion(model, state, pair.body_B);
  std::vector<contact::Meeting> meetings(pair.shapes.most_points());
  pair.shapes.find({A, B}, 0.0, meetings);
  const auto deepest = std::max_element(
      meetings.begin(), meetings.end(),
      [](const auto& a, const auto& b) { return a.depth < b.depth; });
  if (deepest == meetings.end() || !(deepest->depth > 0.0)) return {};
  return Overlap{{A, B}, *deepest};
}

std::string refuse(const PlacedPair& pair, const contact::Meeting& deepest,
                   double limit) {
  const Vector3& p = deepest.p_W;
  return fmt::format(
      "contact '{}': both overlap by {:.3g} m at the start, at ({:.4g}, "
      "{:.4g}, {:.4g}) m in the world; up to {:.2g} m is taken as touching "
      "there: move them apart, or leave this pair out",
      pair.name, deepest.depth, p.x(), p.y(), p.z(), limit);
}

std::string tell(const PlacedPair& pair, const Overlap& overlap,
                 const joints::PairInteraction& law) {
  const std::vector<double> memory(law.memory_size(), 0.0);
  joints::PairResponse scratch(law.most_points(), overlap.bodies.A.modes,
                               overlap.bodies.B.modes);
  const joints::TouchReading reading =
      law.touching()->read(overlap.bodies, Instant{}, memory, scratch);
  return fmt::format(
      "contact '{}': both overlap by {:.3g} m at the start, which presses them "
      "apart with {:.4g} N and stores {:.3g} J",
      pair.name, overlap.deepest.depth, reading.normal_force, reading.energy);
}

}  // namespace

std::vector<std::string> check_overlaps(const std::vector<PlacedPair>& pairs,
                                        const dynamics::SystemModel& model,
                                        const dynamics::SystemState& state) {
  std::vector<std::string> problems;
  std::vector<std::string> notices;
  std::size_t count = 0;
  for (const PlacedPair& pair : pairs) {
    const std::optional<Overlap> overlap = find_overlap(pair, model, state);
    if (!overlap) continue;
    const double limit = find_limit(pair, overlap->deepest);
    if (overlap->deepest.depth <= limit) {
      notices.push_back(
          tell(pair, *overlap, *model.pairs[index(pair.pair)].law));
    } else if (++count <= kMostTold) {
      problems.push_back(refuse(pair, overlap->deepest, limit));
    }
  }
  if (count > kMostTold) {
    problems.push_back(
        fmt::format("{} more contacts overlap", count - kMostTold));
  }
  if (!problems.empty()) throw InputError(problems);
  return notices;
}

}  // namespace limber::scene
