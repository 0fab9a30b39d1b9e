// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "limber/contact/contact_pair.hpp"
#include "limber/contact/shapes/skin.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"

/// A steel rod of 1 m and 1 cm^2 that strikes a rigid wall flat at 1 m/s, with
/// the closed form's axial modes and residual flexibility: against the wave
/// solution, force E A v / c for 2 L / c. The prototype of
/// this law gave peaks of 1.891, 1.856 and 1.848 of it.
namespace limber::contact {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLength = 1.0;     // [m]
constexpr double kSide = 0.01;      // [m]
constexpr double kModulus = 210e9;  // [Pa]
constexpr double kDensity = 7850.0;
constexpr double kArea = kSide * kSide;
constexpr double kMass = kDensity * kArea * kLength;
const double kSpeed = std::sqrt(kModulus / kDensity);  // of waves [m/s]
const double kForce = kModulus * kArea / kSpeed;       // [N], at 1 m/s
const double kDuration = 2.0 * kLength / kSpeed;       // [s]

double mode_at(int n, double x) {  // from the end that strikes
  return std::sqrt(2.0 / kMass) * std::cos(n * kPi * x / kLength);
}

/// R = L / (3 E A) - sum 2 L / (n^2 pi^2 E A) at the end.
double find_residual(int modes) {
  double sum = 1.0 / 3.0;
  for (int n = 1; n <= modes; ++n) sum -= 2.0 / (n * n * kPi * kPi);
  return sum * kLength / (kModulus * kArea);
}

/// The end that strikes: a square at x = -L / 2, of four pads.
flexbody::ContactSurface make_end(int modes) {
  flexbody::ContactSurface end;
  end.name = "end";
  end.tags = {1, 2, 3, 4};
  end.x_B.resize(3, 4);
  for (int i = 0; i < 4; ++i) {
    end.x_B.col(i) << -0.5 * kLength, (i & 1 ? 0.5 : -0.5) * kSide,
        (i & 2 ? 0.5 : -0.5) * kSide;
  }
  end.Phi_B = MatrixX::Zero(12, modes);
  for (int i = 0; i < 4; ++i) {
    for (int n = 1; n <= modes; ++n) end.Phi_B(3 * i, n - 1) = mode_at(n, 0.0);
  }
  end.residual = VectorX::Constant(4, find_residual(modes));
  end.patch_radius = VectorX::Constant(4, kSide);
  end.faces = {{0, 2, 1, -1, -1, -1}, {1, 2, 3, -1, -1, -1}};
  end.pads.normal_B = -Vector3::UnitX();
  end.pads.x_B = end.x_B;
  end.pads.Phi_B = end.Phi_B;
  end.pads.area = VectorX::Constant(4, 0.25 * kArea);
  // A rod's section stays plane: what presses one corner moves all.
  end.pads.flexibility = MatrixX::Constant(4, 4, find_residual(modes));
  end.youngs_modulus = kModulus;
  end.poisson_ratio = 0.0;
  return end;
}

std::shared_ptr<const flexbody::ReducedBody> make_rod(int modes) {
  auto rod = std::make_shared<flexbody::ReducedBody>();
  rod->name = "rod";
  rod->mass = kMass;
  const double side = kMass * kSide * kSide / 12.0;
  rod->integrals.S0 =
      Vector3(kMass * kLength * kLength / 12.0, side, side).asDiagonal();
  const auto m = static_cast<std::size_t>(modes);
  rod->integrals.S1.assign(m, Matrix3::Zero());
  rod->integrals.S2.assign(m * m, Matrix3::Zero());
  rod->integrals.P = Matrix3X::Zero(3, modes);
  rod->lambda.resize(modes);
  for (int n = 1; n <= modes; ++n) {
    const auto k = static_cast<std::size_t>(n - 1);
    const double omega = n * kPi * kSpeed / kLength;
    rod->lambda[n - 1] = omega * omega;
    rod->integrals.S1[k](0, 0) = std::sqrt(2.0 * kMass) * kLength /
                                 (n * n * kPi * kPi) *
                                 (std::cos(n * kPi) - 1.0);
    rod->integrals.S2[k * m + k](0, 0) = 1.0;
  }
  const flexbody::ContactSurface end = make_end(modes);
  rod->rows.x_B = end.x_B;
  rod->rows.Phi_B = end.Phi_B;
  rod->rows.tags = end.tags;
  return rod;
}

struct Impact {
  dynamics::ContactRecord record;
  std::size_t count = 0;
};

/// The wall is x < 0; the rod comes along -x.
Impact strike(int modes, dynamics::IntegratorKind scheme, double step) {
  dynamics::SystemBuilder builder;
  const auto rod = builder.add_flexible_body("rod", make_rod(modes),
                                             dynamics::Fidelity::coupled, {});
  constexpr double kFixed = std::numeric_limits<double>::infinity();
  Pose wall;
  wall.R.col(0) = -Vector3::UnitZ();
  wall.R.col(1) = Vector3::UnitY();
  wall.R.col(2) = Vector3::UnitX();
  builder.add_pair(
      "wall/rod", dynamics::kWorld, rod,
      std::make_shared<ContactPair>(
          ContactSide{Shape{HalfSpace{}, wall}, std::nullopt, kFixed},
          ContactSide{Shape{std::make_shared<const Skin>(make_end(modes)), {}},
                      SurfaceMaterial{kModulus, 0.0}, kMass},
          ContactParameters{}));
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  state.bodies[0].p_WB = {0.5 * kLength + 1e-6, 0.0, 0.0};
  state.bodies[0].v_WB_W = {-1.0, 0.0, 0.0};
  dynamics::SimulationSettings settings;
  settings.integrator = scheme;
  settings.rho_inf = 1.0;
  settings.step = step;
  settings.end_time = 2.0 * kDuration;
  dynamics::RunRecord record;
  dynamics::SimulationStatistics statistics;
  dynamics::simulate(model, state, settings, {}, {}, statistics, {}, {},
                     record);
  EXPECT_GE(record.contacts.size(), 1U);
  return {record.contacts.front(), record.contacts.size()};
}

class RodOnWall : public ::testing::TestWithParam<std::pair<int, double>> {};

TEST_P(RodOnWall, IsStruckOnceAsTheWaveSolutionSays) {
  const auto [modes, peak] = GetParam();
  for (const auto scheme : {dynamics::IntegratorKind::generalized_alpha,
                            dynamics::IntegratorKind::energy_conserving}) {
    const Impact impact = strike(modes, scheme, kDuration / 2000.0);
    EXPECT_EQ(impact.count, 1U);
    EXPECT_EQ(impact.record.touches, 1);
    EXPECT_NEAR(impact.record.peak_force / kForce, peak, 0.02);
    EXPECT_NEAR(impact.record.duration / kDuration, 1.0, 0.01);
    EXPECT_NEAR(impact.record.impulse / (kForce * kDuration), 1.0, 0.002);
    EXPECT_GE(impact.record.restitution().value_or(0.0), 0.998);
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, RodOnWall,
                         ::testing::Values(std::pair{5, 1.891},
                                           std::pair{10, 1.856},
                                           std::pair{20, 1.848}));

}  // namespace
}  // namespace limber::contact
