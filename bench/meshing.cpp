// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <string>

#include "limber/fem/gmsh/gmsh_reader.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"

/// What the mesher's own process costs beside Gmsh in this one.
namespace limber {
namespace {

std::string path_of(const std::string& name) {
  return std::string(LIMBER_SOURCE_DIR) + "/" + name;
}

void in_own_process(benchmark::State& state, const std::string& name) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(fem::read_mesh(path_of(name)).x.cols());
  }
}

void in_this_process(benchmark::State& state, const std::string& name) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(fem::read_mesh_in_process(path_of(name)).x.cols());
  }
}

#define LIMBER_MESHING(name, file)                            \
  BENCHMARK_CAPTURE(in_own_process, name, std::string(file))  \
      ->Unit(benchmark::kMillisecond)                         \
      ->UseRealTime();                                        \
  BENCHMARK_CAPTURE(in_this_process, name, std::string(file)) \
      ->Unit(benchmark::kMillisecond)                         \
      ->UseRealTime()
LIMBER_MESHING(mesh, "meshes/beam579.msh");
LIMBER_MESHING(geometry, "meshes/capture_upper_link.geo");

}  // namespace
}  // namespace limber
