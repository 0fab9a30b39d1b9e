// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <string>

#include "limber/reduction/reduce.hpp"

/// The offline part at size: a box of 1 x 1 x 5 m, second-order tetrahedra,
/// 20 eigenmodes and the 12 static-deformation modes of its ends.
///   bench_offline [element size in m]     0.0695: about 100 000 nodes
namespace {

double peak_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1024.0 * 1024.0);
}

}  // namespace

int main(int count, char** arguments) {
  using namespace limber;
  using Clock = std::chrono::steady_clock;
  flexbody::Recipe recipe;
  recipe.name = "box";
  recipe.mesh.file = std::string(LIMBER_SOURCE_DIR) + "/meshes/box/box.geo";
  recipe.mesh.size = count > 1 ? std::strtod(arguments[1], nullptr) : 0.0695;
  recipe.mesh.order = 2;
  recipe.materials = {{"", {200e9, 0.3, 8000.0}}};
  recipe.interfaces = {{"root", flexbody::GroupNodes{"root"}},
                       {"tip", flexbody::GroupNodes{"tip"}}};
  recipe.basis.eigenmodes = 20;
  std::string stage;
  auto begun = Clock::now();
  const auto start = begun;
  const auto seconds_since = [](Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  };
  const Progress log = [&](std::string_view now, double) {
    if (now == stage) return;
    if (!stage.empty()) {
      fmt::print("{:<32}{:8.1f} s   {:6.2f} GiB at most so far\n", stage,
                 seconds_since(begun), peak_gib());
    }
    stage = now;
    begun = Clock::now();
  };
  const auto body = flexbody::reduce(recipe, log);
  log("", 1.0);
  fmt::print("{} nodes, {} elements, {} modes: {:.1f} s, {:.2f} GiB at most\n",
             body.mesh_nodes, body.mesh_elements, body.mode_count(),
             seconds_since(start), peak_gib());
}
