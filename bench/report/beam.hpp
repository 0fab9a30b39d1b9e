// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// The report's beam, its loads, and runs of it.
namespace limber::bench {

/// 1 x 1 x 5 m, corner A at the mesh's origin; Table 1 and section 5.1.
inline constexpr double kLength = 5.0;    // [m]
inline constexpr double kSide = 1.0;      // [m]
inline constexpr double kYoung = 200e9;   // [Pa]
inline constexpr double kDensity = 8000;  // [kg/m^3]; Poisson's ratio is 0
inline constexpr int kModes = 10;         // "ten modes for all further tests"

using Body = std::shared_ptr<const flexbody::ReducedBody>;

/// A file of the source tree.
[[nodiscard]] std::filesystem::path find_source_file(const std::string& name);

/// The mesh of 579 nodes, ten eigenmodes and nothing else, with all rows.
[[nodiscard]] flexbody::Recipe make_recipe();
[[nodiscard]] Body reduce_beam(const flexbody::Recipe& recipe);

/// Rows of nodes whose place in the mesh [m] fulfils `wanted`.
using Place = std::function<bool(const Vector3& x_M)>;
[[nodiscard]] std::vector<Eigen::Index> find_rows(
    const flexbody::ReducedBody& body, const Place& wanted);
[[nodiscard]] inline bool is_at(double x, double plane) {
  constexpr double kOnPlane = 1e-9;  // [m]
  return x > plane - kOnPlane && x < plane + kOnPlane;
}
/// The same force [N] on each of these nodes, none on others; 3n.
[[nodiscard]] VectorX load_rows(const flexbody::ReducedBody& body,
                                const std::vector<Eigen::Index>& rows,
                                const Vector3& force);

/// +force [N] shared equally by the nodes of the face z = 5, -force by those of
/// z = 0 (Figure 6b).
[[nodiscard]] VectorX make_couple(const flexbody::ReducedBody& body,
                                  const Vector3& force);

/// Step loads: column i of `forces` (3n) from times[i] on.
struct StepForces {
  std::vector<double> times;  // [s]
  MatrixX forces;             // 3n x T [N]
};
/// Our reading of Figure 6c: F1 along y on each node of the edge x = 0, z = 0,
/// F2 along y on each of the edge x = 1, z = 5; first -100 and 100 N, from
/// `change` [s] on 500 and 300 N.
[[nodiscard]] StepForces make_complex_forcing(const flexbody::ReducedBody& body,
                                              double change);
/// Section 6: 100 N along x and 10 N along z shared equally by the nodes with
/// x = 0, y > 0.3, z > 4.1, for `duration` [s].
[[nodiscard]] std::vector<Eigen::Index> find_struck_rows(
    const flexbody::ReducedBody& body);
[[nodiscard]] StepForces make_strike(const flexbody::ReducedBody& body,
                                     double duration);

/// The beam alone in space at one level; `forces` may be empty.
[[nodiscard]] dynamics::SystemModel make_free_beam(const Body& body,
                                                   dynamics::Fidelity level,
                                                   const StepForces& forces);

/// Every output of a run.
struct Run {
  std::vector<double> times;  // [s]
  std::vector<dynamics::SystemState> states;
  std::vector<dynamics::EnergyBalance> energies;
  dynamics::SimulationStatistics statistics;
};
[[nodiscard]] Run run(const dynamics::SystemModel& model,
                      dynamics::SystemState state,
                      const dynamics::SimulationSettings& settings);

/// `count` + 1 times from 0 to `end` [s].
[[nodiscard]] std::vector<double> spread_times(double end, int count);

/// World displacement of one row's node since the start at the origin, 3 x T.
[[nodiscard]] Matrix3X follow_row(const dynamics::SystemModel& model,
                                  const std::vector<dynamics::SystemState>& run,
                                  std::size_t row);

[[nodiscard]] inline std::vector<double> to_list(const VectorX& values) {
  return {values.begin(), values.end()};
}

}  // namespace limber::bench
