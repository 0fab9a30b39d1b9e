// SPDX-License-Identifier: BSD-3-Clause
#include "beam.hpp"

#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/reduction/reduce.hpp"

namespace limber::bench {

std::filesystem::path find_source_file(const std::string& name) {
  return std::filesystem::path(LIMBER_SOURCE_DIR) / name;
}

flexbody::Recipe make_recipe() {
  flexbody::Recipe recipe;
  recipe.name = "beam";
  recipe.mesh.file = find_source_file("meshes/beam579.msh");
  recipe.materials = {{"", {kYoung, 0.0, kDensity}}};
  recipe.basis.eigenmodes = kModes;
  recipe.rows.extent = flexbody::KeptRows::Extent::all;
  return recipe;
}

Body reduce_beam(const flexbody::Recipe& recipe) {
  return std::make_shared<const flexbody::ReducedBody>(
      flexbody::reduce(recipe));
}

std::vector<Eigen::Index> find_rows(const flexbody::ReducedBody& body,
                                    const Place& wanted) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index n = 0; n < body.rows.x_B.cols(); ++n) {
    if (wanted(body.rows.x_B.col(n) + body.p_MoBcm_M)) rows.push_back(n);
  }
  return rows;
}

VectorX load_rows(const flexbody::ReducedBody& body,
                  const std::vector<Eigen::Index>& rows, const Vector3& force) {
  VectorX load = VectorX::Zero(body.rows.x_B.size());
  for (const Eigen::Index n : rows) load.segment<3>(3 * n) = force;
  return load;
}

VectorX make_couple(const flexbody::ReducedBody& body, const Vector3& force) {
  const auto root =
      find_rows(body, [](const Vector3& x) { return is_at(x[2], 0.0); });
  const auto tip =
      find_rows(body, [](const Vector3& x) { return is_at(x[2], kLength); });
  return load_rows(body, tip, force / static_cast<double>(tip.size())) -
         load_rows(body, root, force / static_cast<double>(root.size()));
}

StepForces make_complex_forcing(const flexbody::ReducedBody& body,
                                double change) {
  const auto first = find_rows(body, [](const Vector3& x) {
    return is_at(x[0], 0.0) && is_at(x[2], 0.0);
  });
  const auto second = find_rows(body, [](const Vector3& x) {
    return is_at(x[0], kSide) && is_at(x[2], kLength);
  });
  const VectorX F1 = load_rows(body, first, Vector3::UnitY());
  const VectorX F2 = load_rows(body, second, Vector3::UnitY());
  StepForces forces{{0.0, change}, MatrixX(F1.size(), 2)};
  forces.forces << -100.0 * F1 + 100.0 * F2, 500.0 * F1 + 300.0 * F2;
  return forces;
}

std::vector<Eigen::Index> find_struck_rows(const flexbody::ReducedBody& body) {
  return find_rows(body, [](const Vector3& x) {
    return is_at(x[0], 0.0) && x[1] > 0.3 && x[2] > 4.1;
  });
}

StepForces make_strike(const flexbody::ReducedBody& body, double duration) {
  const auto rows = find_struck_rows(body);
  const Vector3 each =
      Vector3(100.0, 0.0, 10.0) / static_cast<double>(rows.size());
  StepForces strike{{0.0, duration}, MatrixX::Zero(body.rows.x_B.size(), 2)};
  strike.forces.col(0) = load_rows(body, rows, each);
  return strike;
}

dynamics::SystemModel make_free_beam(const Body& body, dynamics::Fidelity level,
                                     const StepForces& forces) {
  dynamics::SystemBuilder builder;
  const auto beam = builder.add_flexible_body("beam", body, level, {});
  if (!forces.times.empty()) {
    builder.add_nodal_load(
        "forces", beam,
        flexbody::reduce_nodal_load(*body, forces.times, forces.forces));
  }
  return builder.build();
}

Run run(const dynamics::SystemModel& model, dynamics::SystemState state,
        const dynamics::SimulationSettings& settings) {
  Run result;
  result.statistics = simulate(model, state, settings,
                               [&](const dynamics::SystemState& now,
                                   const dynamics::EnergyBalance& energy) {
                                 result.times.push_back(now.t);
                                 result.states.push_back(now);
                                 result.energies.push_back(energy);
                               });
  return result;
}

std::vector<double> spread_times(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

Matrix3X follow_row(const dynamics::SystemModel& model,
                    const std::vector<dynamics::SystemState>& run,
                    std::size_t row) {
  const auto n = model.bodies[0].reduced->rows.x_B.cols();
  MatrixX u(3 * n, std::ssize(run));
  calc_node_displacements(model, dynamics::BodyIndex(0), run, {}, u);
  return u.middleRows<3>(3 * static_cast<Eigen::Index>(row));
}

}  // namespace limber::bench
