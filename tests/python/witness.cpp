// SPDX-License-Identifier: BSD-3-Clause
// A C++ program that runs a scenario by the library alone, and writes times and
// probes as raw doubles, row by row: what Python must have to the bit.
#include <cstdio>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/reduction/reduce.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"

int main(int, char** argv) {
  using namespace limber;
  const scene::Scene scene = scene::load_scene(argv[1]);
  const scene::BuiltScene built =
      scene::build_system(scene, flexbody::make_reducer(), argv[2]);
  dynamics::SystemState state = built.initial;
  dynamics::simulate(
      built.model, state, built.settings,
      [&](const dynamics::SystemState& now, const dynamics::EnergyBalance&) {
        std::vector<double> row = {now.t};
        for (const double value :
             scene::evaluate_all(built.probes, built.model, now)) {
          row.push_back(value);
        }
        std::fwrite(row.data(), sizeof(double), row.size(), stdout);
      });
}
