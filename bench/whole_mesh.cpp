// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <string>

#include "limber/dynamics/integrators/central_differences.hpp"
#include "limber/dynamics/integrators/stable_step.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/fem/linalg/parallel.hpp"
#include "limber/reduction/full_body_maker.hpp"
#include "limber/reduction/reduce.hpp"

/// What an explicit step at level `full` costs: what reduction saves.
namespace limber {
namespace {

using flexbody::NodalMassKind;

dynamics::SystemModel make_model(const std::string& file, NodalMassKind mass) {
  flexbody::Recipe recipe;
  recipe.name = "beam";
  recipe.mesh.file =
      std::string(LIMBER_SOURCE_DIR) + "/tests/data/beam/" + file;
  recipe.materials = {{"", {200e9, 0.0, 8000.0}}};
  recipe.basis.eigenmodes = 0;
  recipe.rows = flexbody::parse_rows({"all"});
  dynamics::SystemBuilder builder;
  builder.add_full_body(
      "beam",
      std::make_shared<const flexbody::ReducedBody>(flexbody::reduce(recipe)),
      flexbody::make_full_body(recipe, {.mass = mass}), {});
  return builder.build();
}

/// Central differences on the report's beam, unloaded, spinning; wall time of
/// a second of motion at its own longest stable step.
void step(benchmark::State& state, const std::string& file,
          NodalMassKind mass) {
  const dynamics::SystemModel model = make_model(file, mass);
  fem::set_thread_count(static_cast<unsigned>(state.range(0)));
  dynamics::SystemState now = make_state(model);
  now.bodies[0].w_WB_B = Vector3::UnitX();
  place_nodes(model, {}, {}, now);
  const double h = dynamics::kStableFraction * find_stable_step(model, now);
  dynamics::CentralDifferences scheme(model);
  scheme.start(now, h);
  for (auto _ : state) scheme.step(now, h, now.t + h);
  state.counters["step"] = h;
  state.counters["s_per_s"] =
      benchmark::Counter(h, benchmark::Counter::kIsIterationInvariantRate |
                                benchmark::Counter::kInvert);
  fem::set_thread_count(0);
}

void consistent_579(benchmark::State& state) {
  step(state, "beam579_v41.msh", NodalMassKind::consistent);
}
void lumped_579(benchmark::State& state) {
  step(state, "beam579_v41.msh", NodalMassKind::lumped);
}
void lumped_29764(benchmark::State& state) {
  step(state, "beam30k_v41.msh", NodalMassKind::lumped);
}

BENCHMARK(consistent_579)->Arg(1)->UseRealTime();
BENCHMARK(lumped_579)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(lumped_29764)->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace limber
