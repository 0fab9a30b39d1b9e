// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/stepped_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/dense/general_eigen.hpp"

namespace limber::dynamics::stepped_motion_test {
namespace {

/// p = w q, q'' = -w^2 q - 2 zeta w q' (- y) + u.
MatrixX make_oscillator(double w, double zeta, double weight = 0.0,
                        double time = 1.0) {
  const Eigen::Index size = weight > 0.0 ? 3 : 2;
  MatrixX A = MatrixX::Zero(size, size);
  A(0, 1) = w;
  A(1, 0) = -w;
  A(1, 1) = -2.0 * zeta * w;
  if (size == 3) {
    A(1, 2) = -weight;
    A(2, 1) = weight;
    A(2, 2) = -1.0 / time;
  }
  return A;
}

SteppedMotion::Inputs push(Eigen::Index states, double force = 1.0) {
  SteppedMotion::Inputs inputs;
  inputs.by_value = MatrixX::Zero(states, 1);
  inputs.by_value(1, 0) = force;
  inputs.by_slope = MatrixX::Zero(states, 1);
  inputs.by_steady = MatrixX::Zero(states, 0);
  return inputs;
}

double find_radius(const MatrixX& A, double rho, double h) {
  const SteppedMotion motion(A, 1, find_alpha_parameters(rho), h);
  const MatrixX flow = motion.find_flow(push(A.rows()), h);
  // Without the inputs, the last three.
  const Eigen::Index n = flow.rows() - 3;
  return dense::find_general_eigenpairs(flow.topLeftCorner(n, n), false)
      .values.cwiseAbs()
      .maxCoeff();
}

// Chung and Hulbert (1993): rho at infinite frequency, 1 at zero.
TEST(SteppedMotion, HasTheSpectralRadiusOfGeneralizedAlpha) {
  for (const double rho : {0.0, 0.3, 0.9, 1.0}) {
    EXPECT_NEAR(find_radius(make_oscillator(1e9, 0.0), rho, 1.0), rho, 1e-4)
        << rho;
    EXPECT_NEAR(find_radius(make_oscillator(1e-4, 0.0), rho, 1.0), 1.0, 1e-9)
        << rho;
  }
}

TEST(SteppedMotion, OfAConservingRuleTurnsByTheAngleOfTheTrapezoidalRule) {
  constexpr double kW = 3.0;
  constexpr double kStep = 0.2;
  const MatrixX A = make_oscillator(kW, 0.0);
  const SteppedMotion motion(A, 1, find_alpha_parameters(1.0), kStep);
  const MatrixX flow = motion.find_flow(push(2), kStep);
  const Eigen::VectorXcd poles =
      dense::find_general_eigenpairs(flow.topLeftCorner(4, 4), false).values;
  const double angle = 2.0 * std::atan(0.5 * kW * kStep);
  double closest = 1.0;
  for (const auto& pole : poles) {
    closest = std::min(closest, std::abs(pole - std::polar(1.0, angle)));
  }
  EXPECT_LT(closest, 1e-7);
}

/// Largest error of the place after a unit force for a while from rest.
double find_error(double h, double weight) {
  constexpr double kW = 2.0;
  constexpr double kEnd = 2.0;
  constexpr double kTime = 0.3;
  const MatrixX A = make_oscillator(kW, 0.05, weight, kTime);
  const SteppedMotion motion(A, 1, find_alpha_parameters(0.8), h);
  const SteppedMotion::Inputs inputs = push(A.rows());
  const MatrixX flow = motion.find_flow(inputs, kEnd);
  VectorX start = VectorX::Zero(flow.rows());
  start[flow.rows() - 2] = 1.0;  // the input; it was 0 before
  const double found = (flow * start)[0];
  // By tiny steps of Heun's rule.
  VectorX z = VectorX::Zero(A.rows());
  constexpr int kCount = 200'000;
  constexpr double kTiny = kEnd / kCount;
  for (int i = 0; i < kCount; ++i) {
    const VectorX first = A * z + inputs.by_value;
    const VectorX second = A * (z + kTiny * first) + inputs.by_value;
    z += 0.5 * kTiny * (first + second);
  }
  return std::abs(found - z[0]);
}

TEST(SteppedMotion, ConvergesInSecondOrderAfterAJumpWithAndWithoutRelaxation) {
  for (const double weight : {0.0, 1.5}) {
    const double coarse = find_error(0.04, weight);
    const double fine = find_error(0.02, weight);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15) << weight;
    EXPECT_LT(fine, 1e-3) << weight;
  }
}

TEST(SteppedMotion, MovesAStiffCoordinateToItsNewRestInOneStep) {
  const MatrixX A = make_oscillator(1e6, 0.0);
  const SteppedMotion motion(A, 1, find_alpha_parameters(0.9), 1e-2);
  const MatrixX flow = motion.find_flow(push(2, 1e6), 1e-2);
  VectorX start = VectorX::Zero(flow.rows());
  start[flow.rows() - 2] = 1.0;
  EXPECT_NEAR((flow * start)[0], 1.0, 1e-6);  // p = w q = F / w
}

}  // namespace
}  // namespace limber::dynamics::stepped_motion_test
