// SPDX-License-Identifier: BSD-3-Clause
// Runs resumed from a checkpoint are bitwise equal to uninterrupted ones.
#include "limber/dynamics/simulation/checkpoint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "limber/common/errors.hpp"
#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/displacement_measure.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "support/chain.hpp"
#include "support/elastic_kinds.hpp"
#include "support/lattice_chain.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::checkpoint_test {
namespace {

struct Scene {
  SystemModel model;
  SystemState state;
};

struct Trace {
  std::vector<SystemState> states;
  std::vector<EnergyBalance> energies;
  SystemState end;
  SimulationStatistics statistics;
  RunRecord record;
};

std::vector<double> to_numbers(SystemState state) {
  Archive archive;
  archive(state);
  return archive.numbers();
}

std::vector<double> to_numbers(EnergyBalance energy) {
  Archive archive;
  archive(energy);
  return archive.numbers();
}

/// Where the first body is and how fast it turns.
Followed follow_first(const SystemModel& model) {
  Followed followed;
  followed.courses = {Course::motion, Course::values};
  followed.evaluate = [&model](const SystemState& state,
                               std::vector<double>& values) {
    if (!model.full_bodies.empty()) {
      values = {state.u_H[0], state.udot_H[1]};
      return;
    }
    const BodyState& body = state.bodies[0];
    values = {body.p_WB.x() + body.p_WB.y(), body.w_WB_B.norm()};
  };
  return followed;
}

/// Checkpoint with how many outputs there were before it.
struct Kept {
  Checkpoint checkpoint;
  std::size_t outputs = 0;
};

Trace run(const Scene& scene, const SimulationSettings& settings,
          std::vector<Kept>* kept, const Checkpoint* from) {
  Trace trace;
  trace.end = scene.state;
  Continuation continuation;
  continuation.keeper.interval = 0.0;
  std::vector<double> log;
  if (kept != nullptr) {
    continuation.keeper.keep = [&](const Checkpoint& c) {
      log.insert(log.end(), c.log.begin(), c.log.end());
      kept->push_back(
          {{c.time, c.numbers, log, c.outputs}, trace.states.size()});
    };
  }
  if (from != nullptr) continuation.from = *from;
  simulate(
      scene.model, trace.end, settings,
      [&](const SystemState& state, const EnergyBalance& energy) {
        trace.states.push_back(state);
        trace.energies.push_back(energy);
      },
      {}, trace.statistics, continuation, follow_first(scene.model),
      trace.record);
  return trace;
}

/// Where there is no value, NaN.
void expect_same(const Envelopes& whole, const Envelopes& rest) {
  ASSERT_FALSE(whole.is_empty());
  ASSERT_EQ(whole.edges, rest.edges);
  for (Eigen::Index i = 0; i < whole.least.size(); ++i) {
    ASSERT_FALSE(std::isnan(whole.least.data()[i]) !=
                 std::isnan(rest.least.data()[i]));
    if (std::isnan(whole.least.data()[i])) continue;
    ASSERT_EQ(whole.least.data()[i], rest.least.data()[i]);
    ASSERT_EQ(whole.most.data()[i], rest.most.data()[i]);
  }
}

void expect_same(const Trace& whole, const Trace& rest, std::size_t outputs) {
  ASSERT_EQ(whole.states.size(), rest.states.size() + outputs);
  for (std::size_t i = 0; i < rest.states.size(); ++i) {
    ASSERT_EQ(to_numbers(whole.states[outputs + i]), to_numbers(rest.states[i]))
        << "at t = " << rest.states[i].t;
    ASSERT_EQ(to_numbers(whole.energies[outputs + i]),
              to_numbers(rest.energies[i]));
  }
  EXPECT_EQ(to_numbers(whole.end), to_numbers(rest.end));
  EXPECT_EQ(whole.statistics.steps, rest.statistics.steps);
  EXPECT_EQ(whole.statistics.newton_iterations,
            rest.statistics.newton_iterations);
  EXPECT_EQ(whole.statistics.factorizations, rest.statistics.factorizations);
  EXPECT_EQ(whole.statistics.events, rest.statistics.events);
  EXPECT_EQ(whole.record.peaks, rest.record.peaks);
  expect_same(whole.record.envelopes, rest.record.envelopes);
  EXPECT_EQ(whole.statistics.warnings, rest.statistics.warnings);
  const EnergyRecord& a = whole.record.energy;
  const EnergyRecord& b = rest.record.energy;
  EXPECT_EQ(a.drift, b.drift);
  EXPECT_EQ(a.kinetic, b.kinetic);
  EXPECT_EQ(a.throughput, b.throughput);
  EXPECT_EQ(a.roundoff, b.roundoff);
  EXPECT_EQ(a.worst.place, b.worst.place);
  EXPECT_EQ(a.worst.place_error, b.worst.place_error);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.rows[i].name, b.rows[i].name);
    EXPECT_EQ(a.rows[i].in, b.rows[i].in);
    EXPECT_EQ(a.rows[i].out, b.rows[i].out);
    EXPECT_EQ(a.rows[i].error, b.rows[i].error);
  }
}

/// The checkpoint of a run that ends at its n-th output, or with several passes
/// the n-th time that it reports its progress.
std::optional<Checkpoint> interrupt(const Scene& scene,
                                    const SimulationSettings& settings, int n) {
  std::optional<Checkpoint> kept;
  Continuation continuation;
  continuation.keeper.interval = 1e9;
  continuation.keeper.keep = [&](const Checkpoint& c) { kept = c; };
  int calls = 0;
  const auto end = [&] {
    if (calls++ == n) throw Interrupted("asked to end");
  };
  const bool has_passes =
      settings.passes == TolerancePasses::verified && settings.tolerance > 0.0;
  SystemState state = scene.state;
  SimulationStatistics statistics;
  RunRecord record;
  try {
    simulate(
        scene.model, state, settings,
        [&](const SystemState&, const EnergyBalance&) {
          if (!has_passes) end();
        },
        [&](std::string_view, double) {
          if (has_passes) end();
        },
        statistics, continuation, follow_first(scene.model), record);
  } catch (const Interrupted&) {
    EXPECT_TRUE(kept.has_value());
  }
  return kept;
}

/// Outputs are at any steps, not at those that checkpoints are of.
void expect_interrupted_runs_go_on(const Scene& scene,
                                   const SimulationSettings& settings,
                                   const Trace& whole) {
  int interrupted = 0;
  for (const int n : {0, 1, 2, 3, 4, 5, 6, 7}) {
    const std::optional<Checkpoint> kept = interrupt(scene, settings, n);
    if (!kept) continue;
    ++interrupted;
    expect_same(whole, run(scene, settings, nullptr, &*kept), kept->outputs);
  }
  EXPECT_GE(interrupted, 2);
}

void expect_runs_go_on(const Scene& scene, const SimulationSettings& settings) {
  std::vector<Kept> kept;
  const Trace whole = run(scene, settings, &kept, nullptr);
  ASSERT_GE(kept.size(), 2U);
  for (const Kept& k : kept) {
    EXPECT_LE(k.checkpoint.outputs, k.outputs);
    const Trace rest = run(scene, settings, nullptr, &k.checkpoint);
    expect_same(whole, rest, k.checkpoint.outputs);
  }
  expect_interrupted_runs_go_on(scene, settings, whole);
}

std::vector<double> sample(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

SimulationSettings make_settings(IntegratorKind kind, double end, double step) {
  SimulationSettings settings;
  settings.integrator = kind;
  settings.end_time = end;
  settings.step = step;
  settings.output_times = sample(end, 7);
  return settings;
}

Scene make_spinning_chain() {
  testing::Chain chain =
      testing::make_chain({.bodies = 3,
                           .modes = 4,
                           .stiffness = 1e5,
                           .damping = 10.0,
                           .joint = joints::JointKind::revolute});
  chain.builder.set_gravity({0.0, 0.0, -9.81});
  Scene scene{chain.builder.build(), chain.state};
  for (BodyState& body : scene.state.bodies) body.w_WB_B.x() = 2.0;
  return scene;
}

class EveryScheme : public ::testing::TestWithParam<int> {};

TEST_P(EveryScheme, GoesOnFromACheckpointToTheBit) {
  expect_runs_go_on(
      make_spinning_chain(),
      make_settings(static_cast<IntegratorKind>(GetParam()), 0.12, 1e-4));
}

TEST_P(EveryScheme, GoesOnWithStiffeningBodiesToTheBit) {
  Scene scene = make_spinning_chain();
  testing::stiffen(scene.model, 0.05);
  expect_runs_go_on(
      scene,
      make_settings(static_cast<IntegratorKind>(GetParam()), 0.12, 1e-4));
}

INSTANTIATE_TEST_SUITE_P(
    , EveryScheme,
    ::testing::Range(0, static_cast<int>(integrator_names().size())),
    [](const auto& scheme) {
      std::string name = to_string(static_cast<IntegratorKind>(scheme.param));
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

TEST(Checkpoint, KeepsWhatCouplersRememberAndWhatHasHappened) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "ball", 2.0);
  testing::add_rail(
      builder, mass, "rail",
      {{0, joints::EndStop({.lower = -0.2, .upper = 0.2, .stiffness = 2e4})}});
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].v_WB_W.x() = 3.0;
  expect_runs_go_on(
      scene, make_settings(IntegratorKind::generalized_alpha, 1.1, 1e-3));
}

// A body that starts far beyond linear elasticity gives one warning, at the
// start, whether or not it is still bent as far at the resumption.
TEST(Checkpoint, KeepsTheWarningsThatWereGiven) {
  Scene scene = make_spinning_chain();
  BodyModel& body = scene.model.bodies[1];
  auto sized = std::make_shared<flexbody::ReducedBody>(*body.reduced);
  sized->size.setConstant(1.0);
  body.reduced = sized;
  const DisplacementMeasure measure(body);
  const VectorX shape = VectorX::Unit(body.modes, 0);
  scene.state.eta.segment(body.offset, body.modes) =
      0.3 * body.reduced->size.maxCoeff() / measure.calc_displacement(shape) *
      shape;
  SimulationSettings settings =
      make_settings(IntegratorKind::generalized_alpha, 0.06, 1e-4);
  const Trace whole = run(scene, settings, nullptr, nullptr);
  ASSERT_FALSE(whole.statistics.warnings.empty());
  EXPECT_NE(whole.statistics.warnings[0].find("at t = 0 s: deformed by"),
            std::string::npos);
  expect_runs_go_on(scene, settings);
}

TEST(Checkpoint, OfUnreducedBodiesGoesOnToTheBit) {
  for (const IntegratorKind kind : {IntegratorKind::generalized_alpha,
                                    IntegratorKind::central_differences}) {
    testing::LatticeChain chain;
    chain.add(Fidelity::full);
    chain.add(Fidelity::coupled, 6);
    Scene scene{chain.builder.build(), {}};
    scene.state = chain.place(scene.model, 1e-4, {1.0, 0.0, 0.2}, 1e-4);
    expect_runs_go_on(scene, make_settings(kind, 0.06, 1e-4));
  }
}

TEST(Checkpoint, OfStepsToAToleranceGoesOnInItsPass) {
  SimulationSettings settings =
      make_settings(IntegratorKind::generalized_alpha, 0.5, 0.5);
  settings.tolerance = 1e-6;
  for (const auto passes : {TolerancePasses::one, TolerancePasses::verified}) {
    settings.passes = passes;
    expect_runs_go_on(make_spinning_chain(), settings);
  }
}

// Each contains the state and logs new results only: none grows with time.
TEST(Checkpoint, OfALongRunIsNoLargerThanOfAShortOne) {
  SimulationSettings settings =
      make_settings(IntegratorKind::generalized_alpha, 2.0, 0.5);
  settings.tolerance = 1e-6;
  settings.passes = TolerancePasses::verified;
  settings.output_times = sample(2.0, 2000);
  std::vector<Kept> kept;
  const Trace whole = run(make_spinning_chain(), settings, &kept, nullptr);
  ASSERT_GE(kept.size(), 4U);
  EXPECT_EQ(kept.back().checkpoint.numbers.size(),
            kept.front().checkpoint.numbers.size());
  const std::size_t each = to_numbers(whole.end).size();
  EXPECT_LT(kept.back().checkpoint.numbers.size(), 20 * each);
}

TEST(Checkpoint, ThatIsCutShortIsRefused) {
  const Scene scene = make_spinning_chain();
  const SimulationSettings settings =
      make_settings(IntegratorKind::generalized_alpha, 0.12, 1e-4);
  std::vector<Kept> kept;
  run(scene, settings, &kept, nullptr);
  Checkpoint damaged = kept[0].checkpoint;
  damaged.numbers.resize(damaged.numbers.size() / 2);
  EXPECT_THROW(run(scene, settings, nullptr, &damaged), InputError);
}

}  // namespace
}  // namespace limber::dynamics::checkpoint_test
