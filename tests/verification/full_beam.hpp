// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/full_body_maker.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// The reference beam at level `full`, and the histories of another program
/// (tests/data/beam/full_*.csv).
namespace limber::test {

/// Columns by name, a value a row.
using Table = std::map<std::string, std::vector<double>>;

inline Table read_table(const std::string& name) {
  std::ifstream file(beam_file(name));
  Table table;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    std::size_t i = 0;
    const bool is_heading = names.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++i) {
      if (is_heading) {
        names.push_back(cell);
      } else {
        table[names[i]].push_back(std::stod(cell));
      }
    }
  }
  return table;
}

/// Its rows up to the time `end` [s].
inline Table until(Table table, double end) {
  constexpr double kSame = 1e-9;
  const std::vector<double>& t = table.at("t");
  const auto rows =
      std::upper_bound(t.begin(), t.end(), end + kSame) - t.begin();
  for (auto& [name, values] : table) {
    values.resize(static_cast<std::size_t>(rows));
  }
  return table;
}

/// The beam of 579 nodes, reduced and not, with the rows of all nodes.
struct BeamBodies {
  std::shared_ptr<const flexbody::ReducedBody> reduced;
  std::shared_ptr<const flexbody::FullBody> full;
};

inline flexbody::Recipe full_beam_recipe(int eigenmodes, bool is_clamped) {
  flexbody::Recipe recipe = beam_recipe("beam579_v41.msh", is_clamped);
  recipe.basis.eigenmodes = eigenmodes;
  recipe.rows = flexbody::parse_rows({"all"});
  return recipe;
}

inline BeamBodies make_beam(const flexbody::FullOptions& options = {},
                            int eigenmodes = 0, bool is_clamped = false) {
  const flexbody::Recipe recipe = full_beam_recipe(eigenmodes, is_clamped);
  return {
      std::make_shared<const flexbody::ReducedBody>(flexbody::reduce(recipe)),
      flexbody::make_full_body(recipe, options)};
}

/// Nodal forces of a file of the reference, on from 0 to `until`, in the
/// body's axes.
inline void push_beam(dynamics::SystemBuilder& builder, const BeamBodies& beam,
                      const std::string& file, double until) {
  const Table table = read_table(file);
  const Eigen::Index nodes = beam.full->node_count();
  MatrixX forces = MatrixX::Zero(3 * nodes, 2);
  for (std::size_t i = 0; i < table.at("node").size(); ++i) {
    const auto node = static_cast<Eigen::Index>(table.at("node")[i]) - 1;
    forces.block<3, 1>(3 * node, 0) =
        Vector3(table.at("Fx")[i], table.at("Fy")[i], table.at("Fz")[i]);
  }
  builder.add_nodal_load(
      file, dynamics::BodyIndex(0),
      flexbody::reduce_nodal_load(*beam.reduced, {0.0, until}, forces), forces);
}

/// The displacement of one node [m].
inline Vector3 find_displacement(const dynamics::SystemState& state, int node) {
  return state.u_H.segment<3>(3 * node);
}

}  // namespace limber::test
