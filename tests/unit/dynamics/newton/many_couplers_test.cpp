// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/newton/lu_plan.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/lattice_chain.hpp"

/// Bodies with so many couplers that Newton's matrix keeps their motion among
/// its unknowns. Hinges in one place are one hinge as stiff as all.
namespace limber::dynamics::many_couplers_test {
namespace {

const Vector3 kStart(0.3, -0.2, 0.4);
const Vector3 kFast(20.0, -40.0, 30.0);  // rad/s

joints::Joint make_hinge(double stiffness) {
  return joints::make_joint(joints::JointKind::revolute,
                            Vector3(1.0, 2.0, 2.0) / 3.0,
                            Vector3(2.0, 1.0, -2.0) / 3.0,
                            {.translational_stiffness = stiffness,
                             .rotational_stiffness = 0.1 * stiffness,
                             .translational_damping = 1e-4 * stiffness,
                             .rotational_damping = 1e-5 * stiffness},
                            {});
}

RigidInertia make_inertia(double mass) {
  return {mass, mass * Matrix3(Vector3(0.1, 0.15, 0.2).asDiagonal())};
}

struct Panels {
  SystemModel model;
  SystemState state;
};

/// One on hinges in the world, swinging, or two that turn about each other.
Panels make_panels(bool is_free, int count, double stiffness) {
  SystemBuilder builder;
  const auto panel = builder.add_rigid_body("panel", make_inertia(2.0));
  const BodyIndex other =
      is_free ? builder.add_rigid_body("other", make_inertia(3.0)) : kWorld;
  const Pose arm{Matrix3::Identity(), kStart};
  for (int i = 0; i < count; ++i) {
    builder.add_coupler(fmt::format("hinge {}", i),
                        make_hinge(stiffness / count),
                        is_free ? builder.attach_frame("a", other, {})
                                : builder.attach_world("a", {}),
                        builder.attach_frame("b", panel, arm));
  }
  if (!is_free) builder.set_gravity({0.0, 0.0, -9.81});
  Panels panels{builder.build(), {}};
  panels.state = make_state(panels.model);
  panels.state.bodies[0].p_WB = -kStart;
  if (is_free) {
    const Vector3 w = Vector3(1.0, 2.0, 2.0) / 3.0;
    panels.state.bodies[0].w_WB_B = w;
    panels.state.bodies[0].v_WB_W = w.cross(-kStart);
  }
  return panels;
}

// The round-off of the hinges' stiffness, 0.01 N/m of 1e14, acts on the panel.
double bound_error(double stiffness) {
  return std::max(1e-10, 1e-20 * stiffness);
}

TEST(ManyCouplers, InOnePlaceAreOneAsStiffAsAllHoweverStiff) {
  for (const bool is_free : {false, true}) {
    for (const double stiffness : {1e4, 1e8, 1e12, 1e14}) {
      std::vector<SystemState> ends;
      for (const int count : {1, 40}) {
        Panels panels = make_panels(is_free, count, stiffness);
        simulate(panels.model, panels.state, {.end_time = 1.0, .step = 0.01},
                 {});
        ends.push_back(panels.state);
      }
      const BodyState& one = ends[0].bodies[0];
      const BodyState& many = ends[1].bodies[0];
      const double error = bound_error(stiffness);
      EXPECT_LT((many.p_WB - one.p_WB).norm(), error);
      EXPECT_LT(one.quat_WB.angularDistance(many.quat_WB), error);
    }
  }
}

double find_distance(const SystemState& a, const SystemState& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    largest = std::max(largest, (a.bodies[i].p_WB - b.bodies[i].p_WB).norm());
  }
  return largest;
}

/// A free panel with flaps, the first of which turns.
Panels make_flaps(double stiffness) {
  SystemBuilder builder;
  const auto panel = builder.add_rigid_body("panel", make_inertia(20.0));
  constexpr int kCount = 40;
  for (int i = 0; i < kCount; ++i) {
    const auto flap =
        builder.add_rigid_body(fmt::format("flap {}", i), make_inertia(1.0));
    builder.add_coupler(
        fmt::format("hinge {}", i), make_hinge(stiffness),
        builder.attach_frame("a", panel,
                             {Matrix3::Identity(), Vector3(0.1 * i, 1.0, 0.0)}),
        builder.attach_frame("b", flap, {Matrix3::Identity(), kStart}));
  }
  Panels panels{builder.build(), {}};
  panels.state = make_state(panels.model);
  for (int i = 0; i < kCount; ++i) {
    panels.state.bodies[static_cast<std::size_t>(i) + 1].p_WB =
        Vector3(0.1 * i, 1.0, 0.0) - kStart;
  }
  const Vector3 w = Vector3(1.0, 2.0, 2.0) / 3.0;
  panels.state.bodies[1].w_WB_B = w;
  panels.state.bodies[1].v_WB_W = w.cross(-kStart);
  return panels;
}

// What hinges give falls with their stiffness, at 1e14 N/m, too.
TEST(ManyCouplers, OfManyBodiesTendToIdealOnesAndKeepMomenta) {
  std::vector<SystemState> ends;
  std::vector<double> changes;
  for (const double stiffness : {1e8, 1e10, 1e12, 1e14}) {
    Panels panels = make_flaps(stiffness);
    const EnergyBalance before = calc_energy(panels.model, panels.state);
    const SimulationStatistics statistics = simulate(
        panels.model, panels.state, {.end_time = 1.0, .step = 0.01}, {});
    const EnergyBalance after = calc_energy(panels.model, panels.state);
    EXPECT_LT((after.linear_momentum - before.linear_momentum).norm(), 1e-14);
    EXPECT_LT(statistics.newton_iterations, 2.5 * statistics.steps);
    ends.push_back(panels.state);
    if (ends.size() == 1) continue;
    changes.push_back(find_distance(ends.end()[-1], ends.end()[-2]));
  }
  EXPECT_NEAR(std::log10(changes[0] / changes[1]), 2.0, 0.01);
  EXPECT_NEAR(std::log10(changes[1] / changes[2]), 2.0, 0.1);
}

/// A free chain of panels, neighbours joined by hinges in one place.
Panels make_chain(int bodies, int count, double stiffness) {
  SystemBuilder builder;
  for (int i = 0; i < bodies; ++i) {
    builder.add_rigid_body(fmt::format("panel {}", i), make_inertia(2.0 + i));
    if (i == 0) continue;
    for (int k = 0; k < count; ++k) {
      builder.add_coupler(fmt::format("hinge {} {}", i, k),
                          make_hinge(stiffness / count),
                          builder.attach_frame("a", BodyIndex(i - 1), {}),
                          builder.attach_frame("b", BodyIndex(i),
                                               {Matrix3::Identity(), kStart}));
    }
  }
  Panels panels{builder.build(), {}};
  panels.state = make_state(panels.model);
  for (int i = 1; i < bodies; ++i) {
    panels.state.bodies[index(i)].p_WB = -i * kStart;
  }
  const Vector3 w = Vector3(1.0, 2.0, 2.0) / 3.0;
  panels.state.bodies[0].w_WB_B = w;
  return panels;
}

// Of seven panels the last is eliminated, which is below too many others.
TEST(ManyCouplers, OfAChainInOnePlaceAreOneAsStiffAsAll) {
  for (const int bodies : {3, 7}) {
    for (const double stiffness : {1e4, 1e8, 1e12}) {
      std::vector<SystemState> ends;
      std::vector<long> iterations;
      for (const int count : {1, 40}) {
        Panels panels = make_chain(bodies, count, stiffness);
        iterations.push_back(simulate(panels.model, panels.state,
                                      {.end_time = 0.5, .step = 0.01}, {})
                                 .newton_iterations);
        ends.push_back(panels.state);
      }
      EXPECT_LT(find_distance(ends[0], ends[1]), bound_error(stiffness));
      EXPECT_LE(iterations[1], iterations[0] + iterations[0] / 10);
    }
  }
}

// Half a radian a step: the wrenches act where the step is half done.
TEST(ManyCouplers, OfBodiesThatTurnFarInAStepTakeAsManyIterationsAsOne) {
  for (const double stiffness : {1e4, 1e8, 1e12}) {
    std::vector<long> iterations;
    for (const int count : {1, 40}) {
      Panels panels = make_chain(3, count, stiffness);
      for (int i = 0; i < 3; ++i) {
        BodyState& body = panels.state.bodies[index(i)];
        body.w_WB_B = kFast;
        body.v_WB_W = kFast.cross(body.p_WB);
      }
      iterations.push_back(
          simulate(panels.model, panels.state,
                   {.integrator = IntegratorKind::energy_conserving,
                    .end_time = 1.0,
                    .step = 0.01},
                   {})
              .newton_iterations);
    }
    EXPECT_LE(iterations[1], iterations[0] + iterations[0] / 10) << stiffness;
  }
}

/// Three free panels, each joined to both others, and one beyond; one is
/// pushed off.
Panels make_ring(int count, double stiffness) {
  SystemBuilder builder;
  const std::vector<Vector3> places = {
      {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 1.0, 0.0}, {0.5, 0.3, 1.0}};
  for (int i = 0; i < 4; ++i) {
    builder.add_rigid_body(fmt::format("panel {}", i), make_inertia(2.0 + i));
  }
  for (const auto& [a, b] :
       {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 2}, std::pair{2, 3}}) {
    const Vector3 half = 0.5 * (places[index(b)] - places[index(a)]);
    for (int k = 0; k < count; ++k) {
      builder.add_coupler(
          fmt::format("joint {} {} {}", a, b, k),
          joints::make_joint_bushing(
              joints::JointKind::fixed, Vector3::UnitX(),
              {.translational_stiffness = stiffness / count,
               .rotational_stiffness = 0.1 * stiffness / count,
               .translational_damping = 0.0,
               .rotational_damping = 0.0}),
          builder.attach_frame("a", BodyIndex(a), {Matrix3::Identity(), half}),
          builder.attach_frame("b", BodyIndex(b),
                               {Matrix3::Identity(), -half}));
    }
  }
  Panels panels{builder.build(), {}};
  panels.state = make_state(panels.model);
  for (std::size_t i = 0; i < places.size(); ++i) {
    panels.state.bodies[i].p_WB = places[i];
  }
  panels.state.bodies[1].v_WB_W = Vector3(0.1, -0.2, 0.3);
  return panels;
}

TEST(ManyCouplers, OfARingInOnePlaceAreOneAsStiffAsAll) {
  for (const double stiffness : {1e4, 1e8, 1e12}) {
    std::vector<SystemState> ends;
    std::vector<long> iterations;
    for (const int count : {1, 40}) {
      Panels panels = make_ring(count, stiffness);
      iterations.push_back(
          simulate(panels.model, panels.state,
                   {.integrator = IntegratorKind::energy_conserving,
                    .end_time = 0.2,
                    .step = 1e-3},
                   {})
              .newton_iterations);
      ends.push_back(panels.state);
    }
    EXPECT_LT(find_distance(ends[0], ends[1]), bound_error(stiffness));
    EXPECT_LE(iterations[1], iterations[0] + iterations[0] / 10);
  }
}

// The two lattices have the same modes, so that they can bend together.
TEST(ManyCouplers, OfFlexibleBodiesInOnePlaceAreOneAsStiffAsAll) {
  for (const double stiffness : {1e4, 1e8, 1e12}) {
    std::vector<SystemState> ends;
    std::vector<long> iterations;
    for (const int count : {1, 40}) {
      testing::LatticeChain chain;
      chain.add(Fidelity::coupled);
      chain.add(Fidelity::coupled);
      chain.join(stiffness, 0.0, count);
      const SystemModel model = chain.build();
      SystemState state = chain.place(model, 0.0, {0.3, -0.5, 0.4}, 1e-4);
      iterations.push_back(
          simulate(model, state,
                   {.integrator = IntegratorKind::energy_conserving,
                    .end_time = 0.1,
                    .step = 1e-3},
                   {})
              .newton_iterations);
      ends.push_back(state);
    }
    EXPECT_LE(iterations[1], iterations[0] + iterations[0] / 10);
    EXPECT_LT(find_distance(ends[0], ends[1]), bound_error(stiffness));
    EXPECT_LT((ends[0].eta - ends[1].eta).norm(), 1e-7 * ends[0].eta.norm())
        << stiffness;
  }
}

LinkGraph make_graph(const std::vector<std::vector<int>>& links_of_body,
                     const std::vector<int>& blocks) {
  LinkGraph graph{.links = 0,
                  .links_of_body = links_of_body,
                  .blocks = blocks,
                  .sizes = {},
                  .moves = std::vector<bool>(blocks.size(), true),
                  .grounded = {},
                  .ideal = {},
                  .anchored = {}};
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    graph.sizes.push_back(6 * blocks[b]);
    for (const int link : links_of_body[b]) {
      graph.links = std::max(graph.links, link + 1);
    }
  }
  graph.grounded.resize(index(graph.links), false);
  graph.ideal = graph.anchored = graph.grounded;
  return graph;
}

/// Rigid bodies in a row, with so many links between each and the next.
LinkGraph make_row(const std::vector<int>& counts) {
  std::vector<std::vector<int>> links(counts.size() + 1);
  int link = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (int k = 0; k < counts[i]; ++k, ++link) {
      links[i].push_back(link);
      links[i + 1].push_back(link);
    }
  }
  return make_graph(links, std::vector<int>(links.size(), 1));
}

/// (body, its parent's body or -1), as chosen.
std::vector<std::pair<int, int>> find_retained(const LinkGraph& graph) {
  const std::vector<RetainedBody> retained = choose_retained_bodies(graph);
  std::vector<std::pair<int, int>> bodies;
  for (const RetainedBody& one : retained) {
    bodies.emplace_back(one.body,
                        one.parent < 0 ? -1 : retained[index(one.parent)].body);
  }
  return bodies;
}

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(RetainedBodies, AreBodiesOfManyLinks) {
  std::vector<int> all(20);
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> few = {0, 1, 2};
  const auto find = [](const std::vector<std::vector<int>>& links,
                       const std::vector<int>& blocks) {
    return find_retained(make_graph(links, blocks));
  };
  EXPECT_THAT(find({few, all}, {1, 1}), ElementsAre(Pair(1, -1)));
  EXPECT_THAT(find({all}, {0}), IsEmpty());
  EXPECT_THAT(find({few, all}, {1, 11}), IsEmpty());  // 60 modes
}

TEST(RetainedBodies, ThatShareLinksHaveACommonAncestor) {
  EXPECT_THAT(find_retained(make_row({20, 20})),
              ElementsAre(Pair(1, -1), Pair(0, 1), Pair(2, 1)));
  EXPECT_THAT(find_retained(make_row({20, 20, 20, 20, 20, 20})),
              ElementsAre(Pair(1, -1), Pair(2, 1), Pair(3, 2), Pair(4, 3),
                          Pair(5, 4), Pair(0, 1)));
}

TEST(RetainedBodies, AreNotBodiesBetweenTwoTrees) {
  EXPECT_THAT(find_retained(make_row({30, 20, 20, 30})),
              ElementsAre(Pair(1, -1), Pair(3, -1), Pair(0, 1), Pair(4, 3)));
}

TEST(RetainedBodies, HaveNoParentInABodyThatIsClamped) {
  LinkGraph graph = make_row({20, 20});
  graph.moves[1] = false;
  EXPECT_THAT(find_retained(graph),
              ElementsAre(Pair(1, -1), Pair(0, -1), Pair(2, -1)));
}

TEST(RetainedBodies, LeaveIdealJointsABodyThatMovesAndIsEliminated) {
  LinkGraph graph = make_row({20});
  graph.ideal[3] = true;
  EXPECT_THAT(find_retained(graph), ElementsAre(Pair(0, -1)));
  graph.anchored[3] = true;
  EXPECT_THAT(find_retained(graph), IsEmpty());
}

// Twice n b^2 + b^3 / 3 against n^3 / 3: 362 and 333 products of blocks for ten
// links and 18 modes, 394 and 444 for eleven.
TEST(RetainedBodies, AreBodiesThatCostLessThanHalfOfTheirEliminatedLinks) {
  std::vector<int> links(10);
  std::iota(links.begin(), links.end(), 0);
  EXPECT_THAT(choose_retained_bodies(make_graph({links}, {4})), IsEmpty());
  links.push_back(10);
  EXPECT_THAT(find_retained(make_graph({links}, {4})),
              ElementsAre(Pair(0, -1)));
  EXPECT_THAT(choose_retained_bodies(make_graph({links}, {5})), IsEmpty());
}

TEST(RetainedBodies, NeedSpaceInProportionToTheLinksBetweenThem) {
  const auto count = [](int links) {
    return plan_lu(make_row({links, links}), {}).lu.stored_blocks();
  };
  EXPECT_LE(count(400), 4 * count(100));
  EXPECT_LT(count(100), 1200U);  // 40 000 in dense blocks
}

// The velocity of a point that moves with a turning frame.
TEST(RetainedTransports, MoveABodyWithItsParent) {
  const Vector3 p(0.3, -0.7, 1.1);
  const Vector3 p_parent(-0.2, 0.5, 0.4);
  const Matrix3 R(Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 2.0) / 3.0));
  const Matrix3 R_parent(
      Eigen::AngleAxisd(-1.2, Vector3(2.0, -1.0, 2.0) / 3.0));
  const Vector3 shift(0.4, 0.1, -0.6);
  const Vector3 turn(-0.5, 0.8, 0.2);
  Vector6 x;
  x << shift, turn;
  const Vector6 moved =
      RetainedTransports::transport({R, p}, {R_parent, p_parent}) * x;
  constexpr double kStep = 1e-5;
  const auto place = [&](double by) {
    const Matrix3 turned(
        Eigen::AngleAxisd(by * turn.norm(), R_parent * turn.normalized()));
    const Vector3 at = p_parent + by * shift + turned * (p - p_parent);
    return std::pair<Matrix3, Vector3>(turned * R, at);
  };
  const auto [R_after, p_after] = place(kStep);
  const auto [R_before, p_before] = place(-kStep);
  const Vector3 velocity = (p_after - p_before) / (2.0 * kStep);
  const Eigen::AngleAxisd between(R_before.transpose() * R_after);
  EXPECT_LT((moved.head<3>() - velocity).norm(), 1e-9);
  EXPECT_LT((moved.tail<3>() - between.angle() / (2.0 * kStep) * between.axis())
                .norm(),
            1e-9);
}

}  // namespace
}  // namespace limber::dynamics::many_couplers_test
