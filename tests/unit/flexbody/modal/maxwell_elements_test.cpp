// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/maxwell_elements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "limber/common/errors.hpp"

namespace limber::flexbody::maxwell_elements_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Complex = std::complex<double>;

TEST(MaxwellElements, LossFactorIsConstantOverTheBand) {
  for (const double eta : {0.001, 0.01, 0.04, 0.2}) {
    for (const double decades : {0.1, 1.0, 2.0, 3.0, 4.5}) {
      for (const double low : {1e-3, 1.0, 3e5}) {
        const double high = low * std::pow(10.0, decades);
        const MaxwellElements e = find_maxwell_elements(eta, {low, high});
        for (double w = low; w <= high; w *= 1.01) {
          const Complex G = find_dynamic_stiffness(e, {0.0, w});
          EXPECT_NEAR(G.imag() / G.real(), eta, 0.031 * eta)
              << eta << ' ' << decades << ' ' << w;
        }
        EXPECT_GE(e.strengths.minCoeff(), 0.0);
      }
    }
  }
}

TEST(MaxwellElements, FewElementsCoverDecades) {
  EXPECT_LE(find_maxwell_elements(0.04, {1.0, 1e2}).size(), 4);
  EXPECT_LE(find_maxwell_elements(0.04, {1.0, 1e3}).size(), 5);
  EXPECT_LE(find_maxwell_elements(0.01, {1.0, 1e4}).size(), 7);
}

TEST(MaxwellElements, StiffnessAtTheLowEndIsTheGivenOne) {
  const MaxwellElements e = find_maxwell_elements(0.04, {10.0, 3000.0});
  const Complex G = e.scale * find_dynamic_stiffness(e, {0.0, 10.0});
  EXPECT_NEAR(G.real(), 1.0, 1e-14);
  EXPECT_LT(e.scale, 1.0);
}

// Kramers and Kronig: of a constant loss factor ln|G| rises by 2/pi eta a unit
// of ln(omega), for small eta and within the band.
TEST(MaxwellElements, StiffnessRisesAsCausalityDemands) {
  const double eta = 0.02;
  const MaxwellElements e = find_maxwell_elements(eta, {1.0, 1e4});
  const double rise =
      std::log(std::abs(find_dynamic_stiffness(e, {0.0, 1e3}) /
                        find_dynamic_stiffness(e, {0.0, 10.0})));
  EXPECT_NEAR(rise, 2.0 / std::numbers::pi * eta * std::log(100.0),
              0.04 * rise);
}

TEST(MaxwellElements, RefusesWhatNoElementsMeet) {
  EXPECT_THAT(
      [] {
        (void)find_maxwell_elements(8.0, {1.0, 1e4});
      },
      ThrowsMessage<InputError>(HasSubstr("a smaller loss factor")));
  EXPECT_THROW((void)find_maxwell_elements(0.0, {1.0, 2.0}), InputError);
  EXPECT_THROW((void)find_maxwell_elements(0.1, {0.0, 2.0}), InputError);
  EXPECT_THROW((void)find_maxwell_elements(0.1, {2.0, 2.0}), InputError);
}

// d' = q' - d / tau for q = t, d(0) = d0.
double find_extension(double d0, double tau, double t) {
  return tau + (d0 - tau) * std::exp(-t / tau);
}

TEST(MaxwellStep, LinearMotionIsExact) {
  const MaxwellElements e{VectorX::Constant(2, 0.1),
                          (VectorX(2) << 0.3, 2e-4).finished()};
  MaxwellStep step(2);
  for (const double h : {1e-9, 0.05, 7.0}) {
    set_linear_step(e, h, step);
    for (Eigen::Index j = 0; j < 2; ++j) {
      EXPECT_NEAR(step.keep[j] * 0.7 + step.gain[j] * h,
                  find_extension(0.7, e.times[j], h), 1e-14 * (1.0 + h));
    }
  }
  set_linear_step(e, 0.0, step);
  EXPECT_EQ(step.gain, VectorX::Ones(2));
  EXPECT_DOUBLE_EQ(step.stiffness, 0.2);
}

TEST(MaxwellStep, MiddleStepBalancesEnergies) {
  const MaxwellElements e{VectorX::Constant(1, 0.1), VectorX::Constant(1, 0.3)};
  MaxwellStep step(1);
  set_middle_step(e, 0.4, step);
  const double d0 = 0.7;
  const double dq = -0.2;
  const double d1 = step.keep[0] * d0 + step.gain[0] * dq;
  const double mean = 0.5 * (d0 + d1);
  EXPECT_NEAR(mean * dq,  // work
              0.5 * (d1 * d1 - d0 * d0) + 0.4 * mean * mean / 0.3, 1e-16);
}

}  // namespace
}  // namespace limber::flexbody::maxwell_elements_test
