// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/displacement_measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "limber/common/index.hpp"
#include "support/chain.hpp"

namespace limber::dynamics::displacement_measure_test {
namespace {

using ::limber::testing::make_uncoupled_chain;

constexpr double kRoundoff = 1e-12;

// Each coupler's end carries all that lies beyond it, but not the larger part
// of the chain, which holds the body; here half of it is not more than the
// rest.
// Of a body's own nodes and of all bodies that it carries.
DisplacementMeasure measure_anywhere(const SystemModel& model, BodyIndex body,
                                     const std::vector<double>& reaches) {
  return {std::make_shared<MovedNodes>(model.bodies[index(body)].reduced),
          model, body, reaches};
}

TEST(Reaches, OfAChainAreTheDiametersBeyond) {
  const SystemModel model = make_uncoupled_chain(4);
  const double diameter = model.bodies[0].reduced->size.norm();
  const std::vector<double> reaches = find_reaches(model);
  ASSERT_EQ(reaches.size(), 8U);  // root and tip of each body
  EXPECT_EQ(reaches.front(), 0.0);
  EXPECT_EQ(reaches.back(), 0.0);
  for (int joint = 0; joint < 3; ++joint) {
    const auto tip = index(2 * joint + 1);
    const int beyond = 3 - joint;  // of 4 equal bodies
    const int behind = joint + 1;
    EXPECT_NEAR(reaches[tip], beyond <= 2 ? beyond * diameter : 0.0, kRoundoff);
    EXPECT_NEAR(reaches[tip + 1], behind <= 2 ? behind * diameter : 0.0,
                kRoundoff);
  }
}

TEST(Reaches, OfWhatTheWorldHoldsAreNone) {
  auto chain = limber::testing::make_chain({.bodies = 2});
  const auto ground = chain.builder.attach_world("ground", {});
  chain.builder.add_coupler("hold", joints::Bushing({}), ground,
                            AttachmentIndex(0));
  const SystemModel model = chain.builder.build();
  const double diameter = model.bodies[0].reduced->size.norm();
  const std::vector<double> reaches = find_reaches(model);
  EXPECT_EQ(reaches[0], 0.0);
  EXPECT_NEAR(reaches[1], diameter, kRoundoff);
}

TEST(DisplacementMeasure, IsTheLargestNodesOfItsOwnBody) {
  const SystemModel model = make_uncoupled_chain(1);
  const flexbody::ReducedBody& body = *model.bodies[0].reduced;
  const VectorX eta = VectorX::LinSpaced(body.mode_count(), -1.0, 2.0);
  double largest = 0.0;
  for (Eigen::Index n = 0; n < body.rows.x_B.cols(); ++n) {
    largest =
        std::max(largest, (body.rows.Phi_B.middleRows<3>(3 * n) * eta).norm());
  }
  EXPECT_NEAR(DisplacementMeasure(model.bodies[0]).calc_displacement(eta),
              largest, kRoundoff * largest);
}

// A flexible body moves the bodies that it carries by its interface's rotation.
TEST(DisplacementMeasure, GrowsWithWhatTheBodyCarries) {
  const SystemModel model = make_uncoupled_chain(2);
  std::vector<double> reaches = find_reaches(model);
  reaches[1] = 1000.0;  // m: far more than the body's own bending
  const Attachment& tip = model.attachments[1];
  const VectorX eta = VectorX::LinSpaced(6, -1.0, 2.0);
  const double carried =
      (tip.Phi_B * eta).norm() + reaches[1] * (tip.Psi_B * eta).norm();
  const double own =
      DisplacementMeasure(model.bodies[0]).calc_displacement(eta);
  ASSERT_GT(carried, own);
  EXPECT_NEAR(
      measure_anywhere(model, BodyIndex(0), reaches).calc_displacement(eta),
      carried, kRoundoff * carried);
}

TEST(DisplacementMeasure, OfOneModeIsThatModesSizeWhateverIsCarried) {
  const SystemModel model = make_uncoupled_chain(2);
  for (const double reach : {0.0, 0.05, 0.3, 20.0}) {
    const std::vector<double> reaches(model.attachments.size(), reach);
    const DisplacementMeasure measure =
        measure_anywhere(model, BodyIndex(0), reaches);
    const Eigen::Index m = measure.mode_sizes().size();
    for (Eigen::Index k = 0; k < m; ++k) {
      const double size = measure.mode_sizes()[k];
      EXPECT_NEAR(measure.calc_displacement(VectorX::Unit(m, k)), size,
                  1e-14 * size);
    }
  }
}

TEST(PeakDisplacement, PassesOverNoneThatIsAThousandthLarger) {
  const SystemModel model = make_uncoupled_chain(3);
  const DisplacementMeasure measure =
      measure_anywhere(model, BodyIndex(1), find_reaches(model));
  PeakDisplacement peak(measure);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  VectorX eta = VectorX::Zero(6);
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    for (double& x : eta) x += 0.1 * normal(random);
    largest = std::max(largest, measure.calc_displacement(eta));
    peak.include(eta, i);
    EXPECT_GE(1.001 * peak.peak().value, largest);
  }
}

// One mode at 12 samples a period, none of them at a crest: the largest of
// them is low by 1 - cos(pi / 12) = 3.4 %.
TEST(PeakDisplacement, OfAnOscillationIsThatBetweenItsSamples) {
  const SystemModel model = make_uncoupled_chain(1);
  const DisplacementMeasure measure(model.bodies[0]);
  PeakDisplacement peak(measure);
  const VectorX crest = VectorX::Unit(measure.mode_sizes().size(), 0);
  const double step = std::numbers::pi / 6.0;
  for (int i = 0; i < 50; ++i) {
    const double t = (i + 0.5) * step;
    peak.include(std::sin(t) * crest, t);
  }
  const double u = measure.calc_displacement(crest);
  EXPECT_NEAR(peak.peak().value / u, 1.0, 0.005);
  EXPECT_NEAR(peak.peak().time, 0.5 * std::numbers::pi, 0.05 * step);
}

TEST(RefinedPeak, OfAParabolaIsItsTopWhateverTheSteps) {
  RefinedPeak peak;
  for (const double t : {0.0, 0.1, 0.5, 0.6, 1.3, 1.4}) {
    peak.include(7.0 - 3.0 * (t - 0.83) * (t - 0.83), t);
  }
  EXPECT_NEAR(peak.peak().value, 7.0, kRoundoff);
  EXPECT_NEAR(peak.peak().time, 0.83, kRoundoff);
}

TEST(RefinedPeak, OfAJumpIsTheValueOnItsSide) {
  RefinedPeak peak;
  peak.include(1.0, 0.0);
  peak.include(5.0, 1.0);
  peak.include(2.0, 1.0);
  peak.include(2.0, 2.0);
  EXPECT_EQ(peak.peak().value, 5.0);
  EXPECT_EQ(peak.peak().time, 1.0);
}

}  // namespace
}  // namespace limber::dynamics::displacement_measure_test
