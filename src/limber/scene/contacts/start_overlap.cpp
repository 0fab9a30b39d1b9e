// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/start_overlap.hpp"

#include <fmt/format.h>

#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/contact/patches/patch_moduli.hpp"
#include "limber/contact/shapes/shape_measures.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::scene {
namespace {

constexpr double kMostFraction = 0.03;  // of R_e [-]
// Of the smaller shape's size a, where both are flat [-]. A face of 2 a x 2 a
// pressed in by s a stores about s^2 E* a^3, with this 1e-4 E* a^3; a sphere at
// the fraction above 8 / 15 0.03^2.5 E* R^3 = 0.8e-4 E* R^3.
constexpr double kMostFlatFraction = 0.01;
// Of the above: where shapes are meant to touch exactly [-].
constexpr double kRounding = 1e-8;
constexpr std::size_t kMostReported = 10;

joints::PairTouch find_touch(const PlacedPair& placed,
                             const dynamics::SystemModel& model,
                             const joints::PairBodies& bodies) {
  const dynamics::Pair& pair = model.pairs[index(placed.pair)];
  joints::PairResponse scratch = dynamics::make_response(model, pair);
  return pair.law->touching()->find_touch(bodies, scratch);
}

std::string refuse(const PlacedPair& pair, const joints::PairTouch& overlap) {
  const Vector3& p = overlap.p_W;
  return fmt::format(
      "contact '{}': the bodies overlap by {:.3g} m at the start, at ({:.4g}, "
      "{:.4g}, {:.4g}) m in the world; up to {:.2g} m counts as touching "
      "there: move them apart, or leave this pair out",
      pair.name, overlap.depth, p.x(), p.y(), p.z(), pair.most_overlap);
}

std::string refuse_enclosed(const PlacedPair& pair) {
  return fmt::format(
      "contact '{}': one body lies within the other at the start, where no "
      "force separates them: move them apart, or leave this pair out",
      pair.name);
}

std::string report_overlap(const PlacedPair& placed, double depth,
                           const dynamics::SystemModel& model,
                           const joints::PairBodies& bodies) {
  const dynamics::Pair& pair = model.pairs[index(placed.pair)];
  const std::vector<double> memory(pair.law->memory_size(), 0.0);
  joints::PairResponse scratch = dynamics::make_response(model, pair);
  const joints::TouchReading reading =
      pair.law->touching()->read(bodies, EvaluationTime{}, memory, scratch);
  return fmt::format(
      "contact '{}': the bodies overlap by {:.3g} m at the start, which pushes "
      "them apart with {:.4g} N and stores {:.3g} J",
      placed.name, depth, reading.normal_force, reading.energy);
}

}  // namespace

double find_most_overlap(const contact::ContactSide& A,
                         const contact::ContactSide& B,
                         const std::optional<double>& radius) {
  if (radius) return kMostFraction * *radius;
  const auto is_ball = [](const contact::ContactSide& side) {
    return std::holds_alternative<contact::Sphere>(side.shape.kind);
  };
  return is_ball(A) || is_ball(B)
             ? kMostFraction * contact::find_touch_radius(A, B)
             : kMostFlatFraction * contact::find_size(A.shape, B.shape);
}

std::vector<std::string> check_overlaps(const std::vector<PlacedPair>& pairs,
                                        const dynamics::SystemModel& model,
                                        const dynamics::SystemState& state) {
  std::vector<std::string> problems;
  std::vector<std::string> notices;
  std::size_t count = 0;
  for (const PlacedPair& pair : pairs) {
    const dynamics::PairMotion motion =
        dynamics::find_pair_motion(model, model.pairs[index(pair.pair)], state);
    const joints::PairTouch overlap = find_touch(pair, model, motion.bodies());
    const bool overlaps = overlap.depth > kRounding * pair.most_overlap;
    if (!overlaps && !overlap.is_enclosed) continue;
    if (overlaps && overlap.depth <= pair.most_overlap) {
      notices.push_back(
          report_overlap(pair, overlap.depth, model, motion.bodies()));
    } else if (++count <= kMostReported) {
      problems.push_back(overlaps ? refuse(pair, overlap)
                                  : refuse_enclosed(pair));
    }
  }
  if (count > kMostReported) {
    problems.push_back(
        fmt::format("{} more contacts overlap", count - kMostReported));
  }
  if (!problems.empty()) throw InputError(problems);
  return notices;
}

}  // namespace limber::scene
