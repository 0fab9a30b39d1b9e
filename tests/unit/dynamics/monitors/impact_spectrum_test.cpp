// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/impact_spectrum.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace limber::dynamics::impact_spectrum_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Frequencies scale n^power [Hz].
SystemModel make_model(double scale, double power, int modes) {
  SystemModel model;
  auto reduced = std::make_shared<flexbody::ReducedBody>();
  reduced->lambda.resize(modes);
  for (int n = 1; n <= modes; ++n) {
    const double omega = 2.0 * std::numbers::pi * scale * std::pow(n, power);
    reduced->lambda[n - 1] = omega * omega;
  }
  model.bodies.resize(2);
  model.bodies[0].name = "bar";
  model.bodies[0].modes = modes;
  model.bodies[0].reduced = reduced;
  model.bodies[1].name = "ball";
  model.pairs.push_back({"bar/ball", BodyIndex(0), BodyIndex(1), nullptr, 0});
  return model;
}

ContactRecord make_record(double duration) {
  ContactRecord record;
  record.pair = "bar/ball";
  record.touches = 1;
  record.impact_duration = duration;
  return record;
}

// n modes reach n^2 of a bar that bends, n of a plate.
TEST(ImpactSpectrum, SaysHowManyModesReachTheImpact) {
  for (const auto& [power, needed] :
       {std::pair{2.0, 64}, std::pair{1.0, 4096}}) {
    const double duration = 2.0 / std::pow(needed, power);
    const auto spectra = find_impact_spectra(make_model(1.0, power, 16),
                                             {make_record(duration)});
    ASSERT_EQ(spectra.size(), 1U);  // the ball has no modes
    EXPECT_EQ(spectra[0].body, "bar");
    EXPECT_NEAR(spectra[0].fraction(), duration * std::pow(16.0, power), 1e-12);
    EXPECT_FALSE(spectra[0].is_enough());
    EXPECT_NEAR(spectra[0].needed.value_or(0), needed, 1);
    EXPECT_THAT(describe(spectra[0]), HasSubstr("modes would respond"));
  }
}

TEST(ImpactSpectrum, JudgesTheShortestImpactOfAPair) {
  const SystemModel model = make_model(100.0, 1.0, 10);  // to 1000 Hz
  EXPECT_TRUE(find_impact_spectra(model, {make_record(3e-3)})[0].is_enough());
  EXPECT_THAT(describe(find_impact_spectra(model, {make_record(3e-3)})[0]),
              Not(HasSubstr("needed")));
  const auto both =
      find_impact_spectra(model, {make_record(3e-3), make_record(1e-3)});
  ASSERT_EQ(both.size(), 1U);
  EXPECT_EQ(both[0].duration, 1e-3);
  EXPECT_FALSE(both[0].is_enough());
  EXPECT_THAT(describe(both[0]), Not(HasSubstr("impulses by 20 %")));
  EXPECT_THAT(describe(find_impact_spectra(model, {make_record(5e-4)})[0]),
              HasSubstr("impulses by 20 %"));
}

TEST(ImpactSpectrum, SaysNothingOfBodiesThatAreRigidOrDoNotTouch) {
  SystemModel model = make_model(100.0, 1.0, 10);
  EXPECT_TRUE(find_impact_spectra(model, {}).empty());
  EXPECT_TRUE(find_impact_spectra(model, {make_record(0.0)}).empty());
  model.bodies[0].modes = 0;
  EXPECT_TRUE(find_impact_spectra(model, {make_record(1e-3)}).empty());
}

// Two or three frequencies have no density.
TEST(ImpactSpectrum, DoesNotGuessFromFewModes) {
  const auto spectra =
      find_impact_spectra(make_model(1.0, 1.0, 3), {make_record(1e-3)});
  EXPECT_FALSE(spectra[0].needed);
  EXPECT_THAT(describe(spectra[0]), Not(HasSubstr("would respond")));
}

}  // namespace
}  // namespace limber::dynamics::impact_spectrum_test
