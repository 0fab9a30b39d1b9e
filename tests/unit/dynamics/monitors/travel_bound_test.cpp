// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/travel_bound.hpp"

#include <gtest/gtest.h>

#include "limber/dynamics/system/system_builder.hpp"
#include "support/lattice_chain.hpp"

namespace limber::dynamics::travel_bound_test {
namespace {

// |v| + |w| r of the farthest point of all shapes.
TEST(TravelBound, OfARigidBodyIsThatOfItsFarthestPoint) {
  SystemBuilder builder;
  const BodyIndex body =
      builder.add_rigid_body("ball", {2.0, Matrix3::Identity()});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W = Vector3(3.0, 0.0, -4.0);
  state.bodies[0].w_WB_B = Vector3(0.0, 2.0, 0.0);
  TravelBound bound(model);
  std::vector<double> speeds(1);
  bound.find_speeds(model, state, speeds);
  EXPECT_EQ(speeds[0], 0.0);  // nothing of it may touch
  for (const double extent : {0.5, 0.7, 0.1}) {
    bound.include(model, body, {.extent = extent, .modes = {}});
  }
  bound.find_speeds(model, state, speeds);
  EXPECT_NEAR(speeds[0], 5.0 + 2.0 * 0.7, 1e-14);
}

TEST(TravelBound, OfAnUnreducedBodyIsThatOfItsFastestNode) {
  testing::LatticeChain chain;
  chain.add(Fidelity::full);
  const SystemModel model = chain.build();
  SystemState state = make_state(model);
  state.udot_H.setZero();
  state.udot_H.segment<3>(6) = Vector3(0.3, 0.0, 0.4);
  state.udot_H.segment<3>(12) = Vector3(0.0, 0.1, 0.0);
  TravelBound bound(model);
  VectorX spread = VectorX::Zero(model.full_bodies[0].dofs() + 1);
  for (const double most : {1.2, 1.5, 1.0}) {
    spread[spread.size() - 1] = most;
    bound.include(model, BodyIndex(0), {.extent = 0.2, .modes = spread});
  }
  std::vector<double> speeds(1);
  bound.find_speeds(model, state, speeds);
  EXPECT_NEAR(speeds[0], 1.5 * 0.5, 1e-14);
}

TEST(TravelBound, OfAPairIsThatOfBothBodies) {
  SystemBuilder builder;
  builder.add_rigid_body("a", {2.0, Matrix3::Identity()});
  builder.add_rigid_body("b", {2.0, Matrix3::Identity()});
  const SystemModel model = builder.build();
  TravelBound bound(model);
  bound.advance({0.25, 0.5});
  bound.advance({0.125, 0.0});
  EXPECT_EQ(bound.find_way(BodyIndex(0), BodyIndex(1)), 0.875);
  EXPECT_EQ(bound.find_way(kWorld, BodyIndex(0)), 0.375);
}

}  // namespace
}  // namespace limber::dynamics::travel_bound_test
