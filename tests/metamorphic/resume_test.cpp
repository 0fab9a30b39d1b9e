// SPDX-License-Identifier: BSD-3-Clause
// Scenes interrupted at any output go on to the bits of the whole run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "metamorphic/draw_plan.hpp"
#include "metamorphic/scene_count.hpp"
#include "metamorphic/scene_plan.hpp"

namespace limber::metamorphic::resume_test {
namespace {

using dynamics::Checkpoint;

struct Trace {
  std::vector<std::vector<double>> outputs;
  std::vector<double> end;
  std::optional<Checkpoint> kept;
  bool is_finished = false;
};

template <typename Value>
std::vector<double> to_numbers(Value value) {
  Archive archive;
  archive(value);
  return archive.numbers();
}

// Interrupted at output `last`, if that comes.
Trace run(const ScenePlan& plan, const std::optional<Checkpoint>& from,
          std::size_t last) {
  Trace trace;
  Scene scene = build(plan);
  dynamics::Continuation continuation;
  continuation.from = from;
  continuation.keeper.interval = 1e9;
  continuation.keeper.keep = [&](const Checkpoint& c) { trace.kept = c; };
  dynamics::SimulationStatistics statistics;
  try {
    dynamics::simulate(
        scene.model, scene.state, scene.settings,
        [&](const dynamics::SystemState& state,
            const dynamics::EnergyBalance& energy) {
          trace.outputs.push_back(to_numbers(state));
          const std::vector<double> more = to_numbers(energy);
          trace.outputs.back().insert(trace.outputs.back().end(), more.begin(),
                                      more.end());
          if (trace.outputs.size() == last) {
            throw dynamics::Interrupted("asked to end");
          }
        },
        {}, statistics, continuation);
    trace.is_finished = true;
  } catch (const dynamics::Interrupted&) {
  } catch (const NumericalError&) {
  }
  trace.end = to_numbers(scene.state);
  return trace;
}

// Of some 1000 steps: a checkpoint is one of each 256.
ScenePlan lengthen(ScenePlan plan) {
  constexpr double kLonger = 10.0;
  plan.settings.end_time *= kLonger;
  for (double& t : plan.settings.output_times) t *= kLonger;
  return plan;
}

// Whether it was compared.
bool check(unsigned seed) {
  SCOPED_TRACE(fmt::format("seed {}", seed));
  const ScenePlan plan = lengthen(draw_plan(seed));
  const Trace whole = run(plan, {}, 0);
  if (!whole.is_finished) return false;
  const std::size_t last = 2 + seed % (whole.outputs.size() - 1);
  const Trace part = run(plan, {}, last);
  if (!part.kept) return false;
  const Trace rest = run(plan, part.kept, 0);
  const std::size_t before = part.kept->outputs;
  EXPECT_EQ(whole.outputs.size(), before + rest.outputs.size());
  for (std::size_t i = 0; i < rest.outputs.size(); ++i) {
    EXPECT_EQ(whole.outputs.at(before + i), rest.outputs[i]);
  }
  EXPECT_EQ(whole.end, rest.end);
  return part.kept->time > 0.0;
}

TEST(Resumed, SceneGoesOnToTheBit) {
  int compared = 0;
  const unsigned scenes = count_scenes();
  for (unsigned seed = 0; seed < scenes; ++seed) {
    if (check(seed)) ++compared;
  }
  RecordProperty("compared", compared);
  fmt::print("Resumed: {} scenes compared\n", compared);
  EXPECT_GE(4 * compared, static_cast<int>(scenes));
}

}  // namespace
}  // namespace limber::metamorphic::resume_test
