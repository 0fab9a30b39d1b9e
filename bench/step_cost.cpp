// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>

#include "beam_chain.hpp"
#include "limber/dynamics/integrators/generalized_alpha.hpp"
#include "limber/dynamics/integrators/runge_kutta.hpp"

/// What a step costs online: against the mesh, against the number of bodies.
namespace limber {
namespace {

using Body = std::shared_ptr<const flexbody::ReducedBody>;

constexpr double kStep = 1e-4;  // [s]

Body reduce_once(const std::string& mesh) {
  static std::map<std::string, Body> known;
  Body& body = known[mesh];
  if (!body) {
    body =
        std::make_shared<const flexbody::ReducedBody>(bench::reduce_beam(mesh));
  }
  return body;
}

// Swung at one end, so that every term of the equations is at work.
bench::BeamChain make_chain(const Body& body, int count) {
  constexpr double kSwing = 1e5;  // [N]
  return bench::make_beam_chain(body, count, kSwing);
}

/// Steps without end; reports microseconds a body a step.
template <typename Integrator>
void time_steps(benchmark::State& state, bench::BeamChain scene,
                Integrator& integrator, double step) {
  long iterations = 0;
  for (auto _ : state) {
    iterations +=
        integrator.step(scene.state, step, scene.state.t + step).iterations;
  }
  const auto bodies = static_cast<double>(scene.model.bodies.size());
  state.counters["newton"] = benchmark::Counter(
      static_cast<double>(iterations), benchmark::Counter::kAvgIterations);
  state.counters["s_per_body_step"] =
      benchmark::Counter(bodies, benchmark::Counter::kIsIterationInvariantRate |
                                     benchmark::Counter::kInvert);
}

void time_generalized_alpha(benchmark::State& state, const Body& body,
                            int count) {
  bench::BeamChain scene = make_chain(body, count);
  dynamics::GeneralizedAlpha integrator(scene.model, {});
  integrator.start(scene.state, kStep);
  time_steps(state, scene, integrator, kStep);
}

void mesh_579_nodes(benchmark::State& state) {
  time_generalized_alpha(state, reduce_once("beam579_v41.msh"), 1);
}
void mesh_29764_nodes(benchmark::State& state) {
  time_generalized_alpha(state, reduce_once("beam30k_v41.msh"), 1);
}
void chain(benchmark::State& state) {
  time_generalized_alpha(state, reduce_once("beam579_v41.msh"),
                         static_cast<int>(state.range(0)));
}
/// For comparison: four evaluations of the right-hand side, no Newton.
void explicit_beam(benchmark::State& state) {
  bench::BeamChain scene = make_chain(reduce_once("beam579_v41.msh"), 1);
  dynamics::RungeKutta4 integrator(scene.model);
  time_steps(state, scene, integrator, 1e-6);
}

BENCHMARK(mesh_579_nodes);
BENCHMARK(mesh_29764_nodes);
BENCHMARK(chain)->Arg(3)->Arg(10)->Arg(30)->Arg(100)->Arg(300);
BENCHMARK(explicit_beam);

}  // namespace
}  // namespace limber
