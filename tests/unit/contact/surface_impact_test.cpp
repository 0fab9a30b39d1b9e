// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "limber/contact/law/hertz_law.hpp"
#include "limber/contact/make_contact.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/shapes/surfaces.hpp"

/// Impacts of bodies whose surfaces are meshes.
namespace limber::contact::surface_impact_test {
namespace {

using dynamics::RunRecord;

constexpr SurfaceMaterial kSteel{2.1e11, 0.3};
constexpr double kRadius = 0.01;  // [m]
constexpr double kMass = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius *
                         kRadius * 7800.0;  // [kg]

// @param residual flexibility [m/N]
Shape make_meshed_ball(double residual = 0.0) {
  auto surface = test::make_ball_surface(kRadius, 3, true);
  surface.residual.setConstant(residual);
  return {std::make_shared<const MeshSurface>(surface), {}};
}

struct Pair {
  dynamics::SystemModel model;
  dynamics::SystemState state;

  // B flies against A.
  Pair(const Shape& A, const Shape& B, const ContactParameters& parameters,
       const Vector3& way, double speed) {
    dynamics::SystemBuilder builder;
    const dynamics::RigidInertia inertia{
        kMass, 0.4 * kMass * kRadius * kRadius * Matrix3::Identity()};
    const auto a = builder.add_rigid_body("a", inertia);
    const auto b = builder.add_rigid_body("b", inertia);
    builder.add_pair(
        "a/b", a, b,
        make_contact(ContactSide{A, kSteel, kMass, inertia.inertia},
                     ContactSide{B, kSteel, kMass, inertia.inertia},
                     parameters));
    model = builder.build();
    state = dynamics::make_state(model);
    state.bodies[1].p_WB = way;
    state.bodies[1].v_WB_W = -speed * way.normalized();
  }

  dynamics::SimulationStatistics statistics = {};

  RunRecord run(double time, double step) {
    RunRecord record;
    simulate(model, state, {.end_time = time, .step = step}, {}, {}, statistics,
             {}, {}, record);
    return record;
  }

  [[nodiscard]] Vector3 find_momentum() const {
    return kMass * (state.bodies[0].v_WB_W + state.bodies[1].v_WB_W);
  }
};

// Hertz's impact [@johnson1985, ch. 11], of faces that leave the ball by 1e-5
// of its radius; the depth is 1e-3 of it.
TEST(SurfaceImpact, OfAMeshedBallAndABallIsHertzs) {
  const double modulus = 2.1e11 / (2.0 * (1.0 - 0.09));
  const double k = 4.0 / 3.0 * modulus * std::sqrt(0.5 * kRadius);
  const double depth = std::pow(1.25 * 0.5 * kMass / k, 0.4);
  const double force = k * std::pow(depth, 1.5);
  const double duration = 2.9432 * depth;
  const Vector3 way = Vector3(0.3, -0.5, 0.7).normalized();
  Pair pair(make_meshed_ball(), Shape{Sphere{kRadius}, {}}, {},
            (2.0 * kRadius + 1e-5) * way, 1.0);
  const double before = calc_energy(pair.model, pair.state).total();
  const Vector3 momentum = pair.find_momentum();
  const RunRecord record = pair.run(8e-5, duration / 100.0);
  ASSERT_EQ(record.contacts.size(), 1U);
  const auto& contact = record.contacts[0];
  EXPECT_EQ(contact.touches, 1);
  EXPECT_NEAR(contact.peak_force / force, 1.0, 5e-3);
  EXPECT_NEAR(contact.peak_depth / depth, 1.0, 5e-3);
  EXPECT_NEAR(contact.duration / duration, 1.0, 5e-3);
  EXPECT_NEAR(*contact.restitution(), 1.0, 3e-3);
  EXPECT_LT((pair.find_momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_NEAR(calc_energy(pair.model, pair.state).total() / before, 1.0, 5e-3);
}

// Of Hertz's law and the residual flexibility in series, which the area and the
// depth in it do not contain.
TEST(SurfaceImpact, IsRecordedByTheDepthAndAreaOfTheSurfacesAlone) {
  const double modulus = 2.1e11 / (2.0 * (1.0 - 0.09));
  const double R_e = 0.5 * kRadius;
  const double k = 4.0 / 3.0 * modulus * std::sqrt(R_e);
  const Vector3 way =
      (2.0 * kRadius + 1e-6) * Vector3(0.3, -0.5, 0.7).normalized();
  for (const double residual : {2e-9, 2e-7}) {
    const auto peak =
        HertzLaw({k, residual}).find_state_of_energy(0.25 * kMass);
    const double fraction = peak.residual_energy / peak.energy();
    for (const bool is_ball_first : {false, true}) {
      const Shape ball{Sphere{kRadius}, {}};
      const Shape mesh = make_meshed_ball(residual);
      Pair pair(is_ball_first ? ball : mesh, is_ball_first ? mesh : ball, {},
                way, 1.0);
      const RunRecord record = pair.run(1e-3, 1e-5);
      ASSERT_EQ(record.contacts.size(), 1U);
      const auto& contact = record.contacts[0];
      EXPECT_NEAR(contact.peak_force / peak.force, 1.0, 1e-2);
      EXPECT_NEAR(contact.peak_depth / peak.hertz_depth, 1.0, 1e-2);
      EXPECT_NEAR(contact.peak_depth_over_radius / (peak.hertz_depth / R_e),
                  1.0, 1e-2);
      const bool is_warned = std::ranges::any_of(
          pair.statistics.warnings, [](const std::string& text) {
            return text.find("that the modes leave out") != std::string::npos;
          });
      EXPECT_EQ(is_warned, fraction > 0.75);
      EXPECT_EQ(pair.statistics.warnings.size(), is_warned ? 1U : 0U);
    }
  }
}

}  // namespace
}  // namespace limber::contact::surface_impact_test
