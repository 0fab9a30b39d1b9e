// SPDX-License-Identifier: BSD-3-Clause
// The elasticity of a body: what it is given, what tells of it, and who refuses
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/level_advice.hpp"
#include "limber/dynamics/analysis/level_observer.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/monitors/linear_limit.hpp"
#include "limber/dynamics/system/model_fields.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/chain.hpp"
#include "support/elastic_kinds.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::body_elasticity_test {
namespace {

using ::testing::HasSubstr;

constexpr int kModes = 4;

testing::PointMassBody make_body() {
  return testing::make_point_mass_body(24, kModes, 4.0, 1.0, 60.0, 42);
}

SystemModel make_model(
    const std::optional<flexbody::ModalElasticity>& elasticity,
    Fidelity fidelity = Fidelity::coupled, const ModalDamping& damping = {}) {
  SystemBuilder builder;
  builder.add_flexible_body("arm", share(make_body()), fidelity, damping,
                            elasticity);
  return builder.build();
}

flexbody::QuadraticStrain make_strain(unsigned seed = 1) {
  return testing::make_quadratic_strain(make_body().reduced.lambda, 2, 1e-2,
                                        seed);
}

flexbody::FullStiffness make_full(unsigned seed = 1) {
  return testing::turn_stiffness(make_body().reduced.lambda,
                                 testing::make_basis(kModes, seed));
}

std::string refuse(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// --- What a run is made of --------------------------------------------------

std::string describe_body(
    const std::optional<flexbody::ModalElasticity>& elasticity) {
  Manifest manifest;
  describe(manifest, "body", make_model(elasticity).bodies[0]);
  return manifest.text();
}

TEST(BodyElasticity, EntersWhatARunIsMadeOf) {
  const std::string plain = describe_body({});
  const VectorX lambda = make_body().reduced.lambda;
  EXPECT_EQ(plain, describe_body(flexbody::DiagonalStiffness({lambda})));
  EXPECT_NE(plain, describe_body(flexbody::DiagonalStiffness({1.01 * lambda})));
  EXPECT_NE(plain, describe_body(make_strain()));
  EXPECT_EQ(describe_body(make_strain()), describe_body(make_strain()));
  EXPECT_NE(describe_body(make_strain(1)), describe_body(make_strain(2)));
  EXPECT_NE(describe_body(make_full(1)), describe_body(make_full(2)));

  flexbody::QuadraticStrain::Parameters other = make_strain().parameters();
  other.Q(1, 2) = std::nextafter(other.Q(1, 2), 1e9);
  const auto differences = find_differences(
      Manifest(describe_body(make_strain())),
      Manifest(describe_body(flexbody::QuadraticStrain(other))));
  ASSERT_EQ(differences.size(), 1U);
  EXPECT_THAT(differences[0], HasSubstr("quadratic strain"));
  other = make_strain().parameters();
  other.paired = {0, 3};
  EXPECT_NE(describe_body(make_strain()),
            describe_body(flexbody::QuadraticStrain(other)));
}

// --- The builder ------------------------------------------------------------

TEST(BodyElasticity, OfAnotherNumberOfModesIsRefused) {
  EXPECT_THAT(refuse([] {
                (void)make_model(flexbody::DiagonalStiffness(
                    {VectorX::Constant(kModes + 1, 3.0)}));
              }),
              HasSubstr("body 'arm': its elasticity is of 5 modes; it has 4"));
}

TEST(BodyElasticity, WithoutModesOfItsOwnTakesNoDampingByFrequency) {
  for (const ModalDamping& damping :
       {ModalDamping{.ratios = {0.01}},
        ModalDamping{.rayleigh_stiffness = 1e-4, .ratios = {}}}) {
    EXPECT_THAT(refuse([&] {
                  (void)make_model(make_full(), Fidelity::coupled, damping);
                }),
                HasSubstr("Rayleigh damping of mass"));
    const SystemModel linear = make_model({}, Fidelity::coupled, damping);
    const SystemModel strain =
        make_model(make_strain(), Fidelity::coupled, damping);
    EXPECT_EQ(linear.bodies[0].damping, strain.bodies[0].damping);
  }
  EXPECT_EQ(make_model(make_full(), Fidelity::coupled,
                       {.rayleigh_mass = 0.2, .ratios = {}})
                .bodies[0]
                .damping,
            VectorX::Constant(kModes, 0.2));
}

TEST(BodyElasticity, IsLeftOutOfARigidBody) {
  const SystemModel model = make_model(make_strain(), Fidelity::rigid);
  EXPECT_EQ(flexbody::count_modes(model.bodies[0].elasticity), 0);
}

// --- Advice on levels -------------------------------------------------------

TEST(BodyElasticity, ThatCouplesModesHasNoAdviceOnLevels) {
  const SystemModel model = make_model(make_strain(), Fidelity::uncoupled);
  const char* why = "body 'arm': its elasticity couples its modes, but advice";
  EXPECT_THAT(refuse([&] { LevelObserver level_observer(model); }),
              HasSubstr(why));
  EXPECT_THAT(
      refuse([&] { (void)estimate_errors(model.bodies[0], BodyPeaks{}); }),
      HasSubstr(why));
}

// --- Small motion and limits ------------------------------------------------

constexpr double kTurn = 2.0 * std::numbers::pi;

TEST(BodyElasticity, InAnotherBasisHasTheSameFrequencies) {
  const MatrixX basis = testing::make_basis(kModes, 3);
  const testing::PointMassBody body = make_body();
  SystemBuilder builder;
  builder.add_flexible_body(
      "turned",
      std::make_shared<const flexbody::ReducedBody>(
          testing::turn_basis(body.reduced, basis)),
      Fidelity::coupled, {},
      testing::turn_stiffness(body.reduced.lambda, basis));
  const SystemModel model = builder.build();
  const VectorX f = find_natural_frequencies(model, make_state(model));
  ASSERT_EQ(f.size(), 6 + kModes);
  EXPECT_EQ(f.head(6).cwiseAbs().maxCoeff(), 0.0);
  for (int k = 0; k < kModes; ++k) {
    EXPECT_NEAR(f[6 + k], std::sqrt(body.reduced.lambda[k]) / kTurn, 1e-6);
  }
  const Vector3 spin(20.0, -50.0, 70.0);
  const SystemModel plain = make_model({});
  EXPECT_GT(find_softening(plain.bodies[0], spin), 0.1);
  EXPECT_NEAR(find_softening(model.bodies[0], spin),
              find_softening(plain.bodies[0], spin), 1e-12);
}

// e = s q + c q^2 of one mode: V' = e (s + 2 c q), V'' = (s + 2 c q)^2 + 2 c e.
TEST(BodyElasticity, OfABentSpringHasItsForceAndFrequency) {
  constexpr double s = 30.0;
  constexpr double c = 2000.0;
  testing::PointMassBody body =
      testing::make_point_mass_body(12, 1, 1.0, 1.0, s, 3);
  body.reduced.clamped = true;
  const flexbody::InterfaceTable table = make_interface(body, 0, 6);
  const Vector3 force(4.0, -3.0, 2.0);
  const double f = table.Phi_B.col(0).dot(force);
  SystemBuilder builder;
  const BodyIndex spring = builder.add_flexible_body(
      "spring", share(body), Fidelity::coupled, {},
      flexbody::QuadraticStrain(
          {VectorX::Constant(1, s * s),
           {0},
           MatrixX::Constant(1, 1, std::copysign(c, f))}));
  builder.add_load("pull",
                   builder.attach_interface("end", spring, table,
                                            {Matrix3::Identity(), table.p_B}),
                   force, Vector3::Zero(), LoadFrame::world, Constant{});
  const SystemModel model = builder.build();
  const Equilibrium found = find_equilibrium(model, make_state(model));
  const double q = std::abs(found.state.eta[0]);
  const double e = s * q + c * q * q;
  EXPECT_NEAR(e * (s + 2.0 * c * q), std::abs(f), 1e-10 * std::abs(f));
  EXPECT_GT(std::abs(f) / (s * s * q), 1.2);  // far from linear
  const VectorX hz = find_natural_frequencies(model, found.state);
  ASSERT_EQ(hz.size(), 1);
  const double curvature = std::pow(s + 2.0 * c * q, 2) + 2.0 * c * e;
  EXPECT_NEAR(std::pow(kTurn * hz[0], 2), curvature, 1e-9 * curvature);
}

// Its second mode, without stiffness, is free.
TEST(BodyElasticity, OfDuffingsOscillatorHasTheFrequencyOfItsTangent) {
  constexpr testing::Duffing kDuffing{100.0, 8e6};
  testing::PointMassBody body =
      testing::make_point_mass_body(12, 2, 1.0, 1.0, 1.0, 3);
  body.reduced.clamped = true;
  SystemBuilder builder;
  builder.add_flexible_body("spring", share(body), Fidelity::coupled, {},
                            kDuffing.elasticity());
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.eta[0] = 4e-3;
  const VectorX hz = find_natural_frequencies(model, state);
  ASSERT_EQ(hz.size(), 2);
  EXPECT_EQ(hz[0], 0.0);
  EXPECT_NEAR(std::pow(kTurn * hz[1], 2), kDuffing.a + 3.0 * kDuffing.b * 16e-6,
              1e-9);
}

}  // namespace
}  // namespace limber::dynamics::body_elasticity_test
