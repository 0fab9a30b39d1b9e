// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/reduction/full_body_maker.hpp"
#include "verification/beam_scene.hpp"

/// A spring between the world and the beam's tip, named in several ways.
namespace limber::connector_ends {
namespace {

constexpr double kMass = 40000.0;   // [kg]
constexpr double kStiffness = 1e9;  // [N/m]
constexpr double kStretch = 0.01;   // [m]

/// From (0.5, 0.5, 6) m in the world along the beam's axis to its tip.
scene::Scene make_scene(const scene::Place& tip, dynamics::Fidelity level) {
  scene::Scene scene = test::beam_scene();
  scene.scenario.settings.integrator =
      dynamics::IntegratorKind::generalized_alpha;
  scene.scenario.fidelity = level;
  scene::Connector spring;
  spring.name = "cord";
  spring.from.where.link = "world";
  spring.from.where.point = Vector3(0.5, 0.5, 6.0);
  spring.to.where = tip;
  scene::SpringOptions law;
  law.law.stiffness = kStiffness;
  law.free_length = 1.0 - kStretch;
  spring.law = law;
  scene.robot.connectors = {spring};
  return scene;
}

scene::BuiltScene build(const scene::Scene& scene) {
  static const flexbody::test::TemporaryFolder cache;
  return scene::build_system(
      scene, flexbody::make_reducer(), cache.path(),
      [](const flexbody::Recipe& recipe, const flexbody::FullOptions& options,
         const flexbody::ReducedBody& reduced) {
        return flexbody::make_full_body(recipe, options, {}, &reduced);
      });
}

scene::Place at(const flexbody::NodeSelection& nodes) {
  return {"beam", "", nodes, {}};
}

const std::vector<scene::Place>& ways_to_the_tip() {
  static const std::vector<scene::Place> ways = {
      {"beam", "tip", {}, {}},
      at(flexbody::GroupNodes{"tip"}),
      at(flexbody::make_plane({0, 0, 5}, {0, 0, 1}, 0.0)),
      at(flexbody::BoxNodes{{0, 0, 5}, {1, 1, 5}}),
      at(flexbody::make_cylinder({0.5, 0.5, 4.99}, {0.5, 0.5, 5}, 0.8, 0.0))};
  return ways;
}

/// m z'' = k (stretch - z) along the axis, which goes through the centre of
/// mass.
TEST(ConnectorEnds, SpringOnAnySelectionOfTheTipPullsTheRigidBeamAlongItsAxis) {
  const double omega = std::sqrt(kStiffness / kMass);
  for (const scene::Place& tip : ways_to_the_tip()) {
    const auto built = build(make_scene(tip, dynamics::Fidelity::rigid));
    dynamics::SystemState state = built.initial;
    const double start = state.bodies[0].p_WB.z();
    dynamics::SimulationSettings settings = built.settings;
    settings.end_time = std::numbers::pi / omega;  // half a period
    settings.step = settings.end_time / 1000.0;
    dynamics::simulate(built.model, state, settings, {});
    // The scheme's error is of the order (omega h)^2.
    EXPECT_NEAR(state.bodies[0].p_WB.z() - start, 2.0 * kStretch,
                2.0 * kStretch * 1e-5);
    EXPECT_LT(
        (state.bodies[0].p_WB.head<2>() - Eigen::Vector2d(0.5, 0.5)).norm(),
        1e-9);
  }
}

TEST(ConnectorEnds, SelectionsOfTheSameNodesMoveTheBeamAlikeAtEachLevel) {
  for (const auto level :
       {dynamics::Fidelity::coupled, dynamics::Fidelity::full}) {
    std::vector<VectorX> ends;
    for (const scene::Place& tip : ways_to_the_tip()) {
      const auto built = build(make_scene(tip, level));
      dynamics::SystemState state = built.initial;
      dynamics::SimulationSettings settings = built.settings;
      settings.step = 1e-4;
      settings.end_time = 1e-3;
      dynamics::simulate(built.model, state, settings, {});
      ends.push_back(level == dynamics::Fidelity::full ? state.u_H : state.eta);
    }
    ASSERT_GT(ends[0].norm(), 1e-6);
    for (const VectorX& end : ends) {
      EXPECT_LT((end - ends[0]).norm(), 1e-9 * ends[0].norm());
    }
  }
}

/// A single node has no rotation, and a spring asks none.
TEST(ConnectorEnds, NearestNodeAndItsTagAreOneEnd) {
  const flexbody::NodeSelection nearest =
      flexbody::NearestNode{{1.001, 0.999, 5.002}};
  const auto reduced = flexbody::reduce([&] {
    flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
    recipe.basis.eigenmodes = 1;
    return recipe;
  }());
  const std::size_t row =
      flexbody::find_nearest_row(reduced, {1.001, 0.999, 5.002});
  const flexbody::NodeSelection tagged =
      flexbody::TaggedNode{reduced.rows.tags[row]};
  std::vector<VectorX> ends;
  for (const auto& nodes : {nearest, tagged}) {
    const auto built =
        build(make_scene(at(nodes), dynamics::Fidelity::coupled));
    dynamics::SystemState state = built.initial;
    dynamics::simulate(built.model, state, built.settings, {});
    ends.push_back(state.eta);
  }
  ASSERT_GT(ends[0].norm(), 1e-6);
  EXPECT_LT((ends[1] - ends[0]).norm(), 1e-9 * ends[0].norm());
}

}  // namespace
}  // namespace limber::connector_ends
