// SPDX-License-Identifier: BSD-3-Clause
// Scenes without events converge with the order of their scheme.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "metamorphic/draw_plan.hpp"
#include "metamorphic/scene_count.hpp"
#include "metamorphic/scene_motion.hpp"

namespace limber::metamorphic::order_test {
namespace {

/// Runs with steps that halve: coarse ones do not resolve all motion yet.
constexpr int kRuns = 6;
/// Between the last two orders measured, if they are those of the limit [-].
constexpr double kSteady = 0.2;
/// Differences below this fraction of a scene's size and speed are round-off.
constexpr double kRoundoff = 1e-10;
/// A scene that moves less, of its size, has nothing but round-off [-].
constexpr double kRest = 1e-6;

using Differences = std::array<double, kRuns - 1>;

// Between runs of steps h and h / 2, as fractions of the scene's size and
// speed.
std::optional<Differences> find_differences(ScenePlan plan) {
  Differences differences{};
  Motion last = run(plan);
  const Magnitude size = measure(plan, last);
  const bool rests = size.speed * plan.settings.end_time < kRest * size.length;
  if (rests) return {};
  for (double& difference : differences) {
    plan.settings.step *= 0.5;
    const Motion next = run(plan);
    const bool is_smooth = last.refusal.empty() && next.refusal.empty() &&
                           !next.has_halved_steps && !next.has_events &&
                           !next.has_jumps;
    if (!is_smooth) return {};
    const Difference d = compare(plan, last, next);
    difference = std::max(d.position / size.length, d.velocity / size.speed);
    last = next;
  }
  return differences;
}

// The last two orders that round-off leaves, if they are steady.
std::optional<double> find_order(const Differences& d) {
  std::size_t last = d.size();
  while (last > 0 && d[last - 1] < kRoundoff) --last;
  if (last < 3) return {};
  const double before = std::log2(d[last - 3] / d[last - 2]);
  const double order = std::log2(d[last - 2] / d[last - 1]);
  if (std::abs(order - before) > kSteady) return {};
  return order;
}

// Nothing if steps do not show one. A low one counts if far shorter steps show
// it, too.
std::optional<double> find_order(ScenePlan plan, double expected) {
  std::optional<double> order;
  for (int i = 0; i < 2; ++i) {
    const std::optional<Differences> d = find_differences(plan);
    order = d ? find_order(*d) : std::nullopt;
    if (!order || *order > expected) return order;
    plan.settings.step /= 16.0;
  }
  return order;
}

TEST(HalvedSteps, ConvergeWithTheSchemesOrder) {
  int compared = 0;
  const unsigned scenes = count_scenes();
  for (unsigned seed = 0; seed < scenes; ++seed) {
    const ScenePlan plan = draw_plan(seed);
    if (plan.settings.tolerance > 0.0) continue;
    const auto& traits = dynamics::traits_of(plan.settings.integrator);
    const double expected = traits.order - 0.3;
    const std::optional<double> order = find_order(plan, expected);
    if (!order) continue;
    ++compared;
    EXPECT_GT(*order, expected) << traits.name << ", seed " << seed;
  }
  RecordProperty("compared", compared);
  fmt::print("HalvedSteps: {} scenes compared\n", compared);
  EXPECT_GE(10 * compared, static_cast<int>(scenes));
}

}  // namespace
}  // namespace limber::metamorphic::order_test
