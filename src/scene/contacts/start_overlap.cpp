// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/start_overlap.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/contact/meetings.hpp"
#include "limber/contact/shape_measures.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::scene {
namespace {

constexpr double kMostShare = 0.03;  // of R_e [-]
// Of the smaller shape's size a, where both are flat [-]. A face of 2 a x 2 a
// pressed in by s a stores about s^2 E* a^3, with this 1e-4 E* a^3; a sphere at
// the share above 8 / 15 0.03^2.5 E* R^3 = 0.8e-4 E* R^3.
constexpr double kMostFlatShare = 0.01;
constexpr std::size_t kMostTold = 10;

double find_limit(const PlacedPair& pair, const contact::Meeting& meeting) {
  if (pair.radius) return kMostShare * *pair.radius;
  if (meeting.curvature > 0.0) return kMostShare / meeting.curvature;
  return kMostFlatShare * contact::find_size(pair.shapes.A(), pair.shapes.B());
}

/// The deepest overlap of two shapes; none if they do not overlap.
std::optional<contact::Meeting> find_overlap(const PlacedPair& pair,
                                             const joints::PairBodies& bodies) {
  contact::Meetings meetings(pair.shapes.most_points());
  pair.shapes.find(bodies, 0.0, meetings.all());
  const contact::Meeting& deepest = meetings[meetings.find_deepest()];
  const contact::Meeting enclosed = pair.shapes.find_enclosed(bodies);
  const bool is_found = deepest.depth > 0.0;
  // Corners of a shallow overlap are found as well, less exactly.
  const double limit = is_found ? find_limit(pair, deepest) : 0.0;
  if (enclosed.depth > limit) return enclosed;
  if (!is_found) return std::nullopt;
  return deepest;
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

std::string tell(const PlacedPair& placed, double depth,
                 const dynamics::SystemModel& model,
                 const joints::PairBodies& bodies) {
  const dynamics::Pair& pair = model.pairs[index(placed.pair)];
  const std::vector<double> memory(pair.law->memory_size(), 0.0);
  joints::PairResponse scratch = dynamics::make_response(model, pair);
  const joints::TouchReading reading =
      pair.law->touching()->read(bodies, Instant{}, memory, scratch);
  return fmt::format(
      "contact '{}': both overlap by {:.3g} m at the start, which presses them "
      "apart with {:.4g} N and stores {:.3g} J",
      placed.name, depth, reading.normal_force, reading.energy);
}

}  // namespace

std::vector<std::string> check_overlaps(const std::vector<PlacedPair>& pairs,
                                        const dynamics::SystemModel& model,
                                        const dynamics::SystemState& state) {
  std::vector<std::string> problems;
  std::vector<std::string> notices;
  std::size_t count = 0;
  for (const PlacedPair& pair : pairs) {
    const dynamics::PairMotion motion =
        dynamics::find_pair_motion(model, model.pairs[index(pair.pair)], state);
    const auto deepest = find_overlap(pair, motion.bodies());
    if (!deepest) continue;
    const double limit = find_limit(pair, *deepest);
    if (deepest->depth <= limit) {
      notices.push_back(tell(pair, deepest->depth, model, motion.bodies()));
    } else if (++count <= kMostTold) {
      problems.push_back(refuse(pair, *deepest, limit));
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
