// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/integrators/make_integrator.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/matrices/reduce_matrices.hpp"
#include "places.hpp"
#include "support/free_chain.hpp"
#include "unit/reduction/matrices/exported_mesh.hpp"

/// Motion of bodies from matrices: that of the mesh, and conserved quantities.
namespace limber::flexbody::matrices_test {
namespace {

using dynamics::Fidelity;
using BodyPointer = std::shared_ptr<const ReducedBody>;

/// One free body, spinning about no axis of symmetry, every mode vibrating.
limber::testing::FreeChain tumble(const BodyPointer& body, Fidelity level,
                                  double spin, double vibration) {
  dynamics::SystemBuilder builder;
  builder.add_flexible_body("body", body, level, {});
  limber::testing::FreeChain free{builder.build(), {}, 0.0};
  free.state = dynamics::make_state(free.model);
  dynamics::BodyState& start = free.state.bodies.front();
  start.w_WB_B = spin * Vector3(0.3, 1.0, 0.5).normalized();
  start.v_WB_W = Vector3(0.2, -0.1, 0.3);
  double sign = 1.0;
  for (double& rate : free.state.etadot) {
    rate = sign * vibration;
    sign *= -0.7;
  }
  return free;
}

TEST(MatrixMotion, OfBeamsKeepsMomentumAndEnergy) {
  MeshSource source;
  source.matrices.paths = {LIMBER_SOURCE_DIR "/tests/data/matrices/arch"};
  source.matrices.mass = 7.4186889;
  Recipe recipe;
  recipe.name = "arch";
  recipe.basis.eigenmodes = 8;
  const auto body = std::make_shared<const ReducedBody>(
      reduce_matrices(recipe, read_matrix_part(source)));
  const auto free = tumble(body, Fidelity::coupled, 20.0, 0.5);
  const double h = 0.2 / std::sqrt(body->lambda.maxCoeff());
  const limber::testing::KeptDrift drift =
      limber::testing::find_energy_conserving_drift(free, h, 2000);
  EXPECT_LT(drift.energy, 1e-11);
  EXPECT_LT(drift.linear, 1e-12);
  EXPECT_LT(drift.angular, 1e-12);
}

/// @param h below the limits of explicit schemes [s]
dynamics::SystemState move(const BodyPointer& body, Fidelity level,
                           dynamics::IntegratorKind kind, double h) {
  const auto free = tumble(body, level, 5.0, 0.1);
  dynamics::SystemState state = free.state;
  dynamics::SimulationSettings settings;
  settings.integrator = kind;
  settings.step = h;
  settings.newton_tolerance = 1e-13;
  settings.newton_iterations = 40;
  const auto scheme = dynamics::make_integrator(free.model, settings);
  scheme->start(state, h);
  for (int i = 1; i <= 300; ++i) scheme->step(state, h, i * h);
  return state;
}

TEST(MatrixMotion, IsThatOfTheMeshAtEveryLevelByEveryIntegrator) {
  const testing::Bar bar{.corner = {0.3, -0.2, 0.1}};
  Recipe recipe = testing::make_recipe(bar);
  recipe.interfaces.clear();
  recipe.rows = parse_rows({"all"});
  recipe.basis.eigenmodes = 6;
  const MeshedBody meshed(recipe, {});
  const auto of_mesh = std::make_shared<const ReducedBody>(reduce(recipe));
  const auto part = make_matrix_part(export_mesh(meshed), bar.mass(), 1.0);
  const auto of_matrices = std::make_shared<const ReducedBody>(
      align_signs(reduce_matrices(recipe, part), *of_mesh));
  const double h = 0.2 / std::sqrt(of_mesh->lambda.maxCoeff());
  for (const std::string& name : dynamics::integrator_names()) {
    for (const Fidelity level : {Fidelity::rigid, Fidelity::uncoupled,
                                 Fidelity::one_way, Fidelity::coupled}) {
      const auto kind = dynamics::parse_integrator(name);
      const dynamics::SystemState a = move(of_mesh, level, kind, h);
      const dynamics::SystemState b = move(of_matrices, level, kind, h);
      const dynamics::BodyState& A = a.bodies.front();
      const dynamics::BodyState& B = b.bodies.front();
      EXPECT_LT((A.p_WB - B.p_WB).norm(), 1e-10 * A.p_WB.norm()) << name;
      EXPECT_LT((A.w_WB_B - B.w_WB_B).norm(), 1e-10 * A.w_WB_B.norm()) << name;
      ASSERT_EQ(a.eta.size(), b.eta.size());
      if (a.eta.size() == 0) continue;
      EXPECT_LT((a.eta - b.eta).norm(), 1e-10 * a.eta.norm()) << name;
      EXPECT_LT((a.etadot - b.etadot).norm(), 1e-10 * a.etadot.norm()) << name;
    }
  }
}

}  // namespace
}  // namespace limber::flexbody::matrices_test
