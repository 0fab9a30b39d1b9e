// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <string>

#include "fem/assembly.hpp"
#include "fem/explicit_solid.hpp"
#include "fem/mesh_reader.hpp"
#include "fem/parallel.hpp"

/// What an explicit step of the whole mesh costs: what reduction saves.
namespace limber::fem {
namespace {

const std::vector<ElasticMaterial> kSteel = {{200e9, 0.0, 8000.0}};

/// Central differences on the report's beam, unloaded, spinning; wall time of
/// a second of motion at its own longest stable step.
void step(benchmark::State& state, const std::string& file, bool is_lumped) {
  set_thread_count(static_cast<unsigned>(state.range(0)));
  const Mesh mesh =
      read_mesh(std::string(LIMBER_SOURCE_DIR) + "/tests/data/beam/" + file);
  const StructuralMatrices matrices = assemble(mesh, kSteel);
  const NodalMass mass = is_lumped ? NodalMass(calc_lumped_mass(mesh, kSteel))
                                   : NodalMass(matrices.M_s);
  const NonlinearSolid solid(mesh, kSteel, Elasticity::st_venant_kirchhoff);
  ExplicitSolid solver(solid, mass, [](double, Matrix3X&) {});
  SolidState now{0.0, Matrix3X::Zero(3, mesh.x.cols()),
                 Matrix3X::Zero(3, mesh.x.cols())};
  for (Eigen::Index n = 0; n < mesh.x.cols(); ++n) {
    now.v.col(n) = Vector3::UnitX().cross(Vector3(mesh.x.col(n)));
  }
  const double h = 0.9 * estimate_stable_step(matrices.K, mass);
  solver.start(now);
  for (auto _ : state) solver.step(now, h, now.t + h);
  state.counters["step"] = h;
  state.counters["s_per_s"] =
      benchmark::Counter(h, benchmark::Counter::kIsIterationInvariantRate |
                                benchmark::Counter::kInvert);
  set_thread_count(0);
}

void consistent_579(benchmark::State& state) {
  step(state, "beam579_v41.msh", false);
}
void lumped_579(benchmark::State& state) {
  step(state, "beam579_v41.msh", true);
}
void lumped_29764(benchmark::State& state) {
  step(state, "beam30k_v41.msh", true);
}

BENCHMARK(consistent_579)->Arg(1)->UseRealTime();
BENCHMARK(lumped_579)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(lumped_29764)->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace limber::fem
