// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "limber/reduction/reduce.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"

/// Time from the command to the first time step: reading all files, making
/// reduced bodies or finding them in the cache.
namespace limber {
namespace {

scene::BuiltScene build(const std::filesystem::path& cache) {
  return scene::build_system(scene::load_scene(std::string(LIMBER_SOURCE_DIR) +
                                               "/examples/struck_finger.toml"),
                             flexbody::make_reducer(), cache);
}

std::filesystem::path make_cache() {
  return std::filesystem::temp_directory_path() /
         ("limber-bench-" + std::to_string(getpid()));
}

void first_start(benchmark::State& state) {
  for (auto _ : state) {
    const auto cache = make_cache();
    std::filesystem::remove_all(cache);
    benchmark::DoNotOptimize(build(cache).bodies_reduced);
  }
  std::filesystem::remove_all(make_cache());
}

void second_start(benchmark::State& state) {
  const auto cache = make_cache();
  build(cache);
  for (auto _ : state) {
    const scene::BuiltScene built = build(cache);
    if (built.bodies_reduced != 0) state.SkipWithError("the cache was missed");
  }
  std::filesystem::remove_all(cache);
}

BENCHMARK(first_start)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(second_start)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace limber
