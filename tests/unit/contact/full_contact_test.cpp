// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "limber/contact/make_contact.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/full_lattice.hpp"

/// A ball strikes a lattice without reduction, and the same with all of its
/// modes: for small strain both are one system.
namespace limber::contact::full_contact_test {
namespace {

constexpr int kModes = 42;  // 3 of 16 nodes, less rigid motion
constexpr double kMass = 0.5;
constexpr double kRadius = 0.05;
constexpr SurfaceMaterial kRubber{1e7, 0.3};

// The four nodes of the last layer, anticlockwise from above.
std::vector<int> find_top(const Matrix3X& x) {
  std::vector<int> all(static_cast<std::size_t>(x.cols()));
  std::iota(all.begin(), all.end(), 0);
  std::sort(all.begin(), all.end(),
            [&](int a, int b) { return x(2, a) > x(2, b); });
  all.resize(4);
  std::sort(all.begin(), all.end(), [&](int a, int b) {
    return std::atan2(x(1, a), x(0, a)) < std::atan2(x(1, b), x(0, b));
  });
  return all;
}

flexbody::FullContactSurface make_surface(const Matrix3X& x) {
  const std::vector<int> nodes = find_top(x);
  flexbody::FullContactSurface full;
  flexbody::ContactSurface& surface = full.surface;
  surface.name = "top";
  surface.tags = {1, 2, 3, 4};
  surface.x_B = x(Eigen::all, nodes);
  surface.Phi_B.resize(12, 0);
  surface.residual = VectorX::Zero(4);
  surface.patch_radius = VectorX::Constant(4, 0.05);
  surface.faces = {{0, 1, 2, -1, -1, -1}, {0, 2, 3, -1, -1, -1}};
  surface.youngs_modulus = kRubber.youngs_modulus;
  surface.poisson_ratio = kRubber.poisson_ratio;
  full.means = {{0, 1, 2, 3, 4}, nodes, {1.0, 1.0, 1.0, 1.0}};
  return full;
}

struct Outcome {
  dynamics::ContactRecord contact;
  Vector3 velocity;  // of the ball
  double gain = 0.0;
  Vector3 momentum_error;
};

Outcome strike(bool is_full) {
  const testing::SpringNetwork network = testing::make_lattice();
  const auto reduced = testing::make_reduced(network, kModes);
  flexbody::FullContactSurface surface = make_surface(network.x_B);
  const Vector3 middle = surface.surface.x_B.rowwise().mean();
  dynamics::SystemBuilder builder;
  std::shared_ptr<const MeshSurface> mesh_surface;
  if (is_full) {
    builder.add_full_body("lattice", reduced, testing::make_full(network), {});
    mesh_surface =
        std::make_shared<const MeshSurface>(surface, network.x_B.cols());
  } else {
    builder.add_flexible_body("lattice", reduced, dynamics::Fidelity::coupled,
                              {});
    surface.surface.Phi_B.resize(12, kModes);
    for (Eigen::Index i = 0; i < 4; ++i) {
      surface.surface.Phi_B.middleRows<3>(3 * i) =
          reduced->rows.Phi_B.middleRows<3>(
              3 * surface.means.nodes[static_cast<std::size_t>(i)]);
    }
    mesh_surface = std::make_shared<const MeshSurface>(surface.surface);
  }
  const auto ball = builder.add_rigid_body(
      "ball", {kMass, 0.4 * kMass * kRadius * kRadius * Matrix3::Identity()});
  builder.add_pair(
      "lattice/ball", dynamics::BodyIndex(0), ball,
      make_contact(ContactSide{Shape{mesh_surface, {}}, kRubber, reduced->mass},
                   ContactSide{Shape{Sphere{kRadius}, {}}, kRubber, kMass},
                   ContactParameters{.friction = {.sliding = 0.3}}));
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = make_state(model);
  state.bodies[1].p_WB = middle + Vector3(0.01, 0.005, kRadius + 1e-6);
  state.bodies[1].v_WB_W = Vector3(5e-4, 0.0, -1e-3);
  dynamics::place_nodes(model, {}, {}, state);
  const Vector3 before = kMass * state.bodies[1].v_WB_W;
  const double energy = calc_energy(model, state).total();
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::SimulationSettings settings;
  settings.step = 5e-5;
  settings.end_time = 0.03;
  simulate(model, state, settings, {}, {}, statistics, {}, {}, record);
  EXPECT_GE(record.contacts.size(), 1U);
  if (record.contacts.empty()) return {};
  const Vector3 after = kMass * state.bodies[1].v_WB_W;
  Vector3 lattice = reduced->mass * state.bodies[0].v_WB_W;
  if (is_full) {
    const Eigen::Map<const Matrix3X> udot(state.udot_H.data(), 3,
                                          network.x_B.cols());
    lattice = udot * network.node_mass();
  }
  return {record.contacts.front(), state.bodies[1].v_WB_W,
          calc_energy(model, state).total() / energy - 1.0,
          after + lattice - before};
}

TEST(FullContact, IsThatOfAllModesForSmallStrain) {
  const Outcome full = strike(true);
  const Outcome modal = strike(false);
  EXPECT_GT(full.contact.peak_force, 0.0);
  EXPECT_EQ(full.contact.touches, modal.contact.touches);
  EXPECT_NEAR(full.contact.peak_force / modal.contact.peak_force, 1.0, 2e-3);
  EXPECT_NEAR(full.contact.impulse / modal.contact.impulse, 1.0, 2e-3);
  EXPECT_NEAR(full.contact.duration / modal.contact.duration, 1.0, 5e-3);
  EXPECT_LT((full.velocity - modal.velocity).norm(), 5e-6);
}

TEST(FullContact, KeepsMomentumAndGainsNoEnergy) {
  const Outcome full = strike(true);
  EXPECT_LT(full.momentum_error.norm(), 1e-9 * kMass * 1e-3);
  EXPECT_LT(full.gain, 5e-3);
}

}  // namespace
}  // namespace limber::contact::full_contact_test
