// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/decision_boundary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "limber/common/errors.hpp"

namespace limber::flexbody::decision_boundary_test {
namespace {

constexpr double kRoundoff = 1e-12;

Vector3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

/// Point masses with modes of any shape: the bound claims nothing about where
/// they come from.
struct PointBody {
  VectorX mass;
  ReducedBody body;
};

PointBody make_point_body(unsigned seed, Eigen::Index modes) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.5, 2.0);
  constexpr Eigen::Index kNodes = 6;
  PointBody made{VectorX(kNodes), {}};
  ReducedBody& body = made.body;
  body.rows.x_B.resize(3, kNodes);
  body.rows.Phi_B.resize(3 * kNodes, modes);
  body.lambda.resize(modes);
  for (Eigen::Index n = 0; n < kNodes; ++n) {
    made.mass[n] = uniform(random);
    body.rows.x_B.col(n) = random_vector(random);
    for (Eigen::Index k = 0; k < modes; ++k)
      body.rows.Phi_B.block<3, 1>(3 * n, k) = random_vector(random);
  }
  for (Eigen::Index k = 0; k < modes; ++k) {
    body.lambda[k] = 10.0 * uniform(random);
    Matrix3 S1 = Matrix3::Zero();
    for (Eigen::Index n = 0; n < kNodes; ++n)
      S1 += made.mass[n] * body.rows.x_B.col(n) *
            body.rows.Phi_B.block<3, 1>(3 * n, k).transpose();
    body.integrals.S1.push_back(S1);
  }
  return made;
}

/// Inertial forces from their definition, not from S1.
VectorX inertial_forces(const PointBody& made, const Vector3& alpha,
                        const Vector3& omega) {
  const Matrix3X& x = made.body.rows.x_B;
  VectorX f(3 * x.cols());
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    const Vector3 b = x.col(n);
    f.segment<3>(3 * n) =
        -made.mass[n] * (alpha.cross(b) + omega.cross(omega.cross(b)));
  }
  return f;
}

double largest_length(const VectorX& field) {
  double length = 0.0;
  for (Eigen::Index n = 0; n < field.size() / 3; ++n)
    length = std::max(length, field.segment<3>(3 * n).norm());
  return length;
}

// One node with m |b| = 10 and one with a negative mass, which Eq. 31 as
// computed in the report ignores.
TEST(ReportBoundary, OfForceIsEquation31) {
  Matrix3X x(3, 2);
  x << 3, 0, 4, 0, 0, 20;
  EXPECT_NEAR(find_report_force_boundary(Eigen::Vector2d(2, -1), x, 5.0), 0.5,
              kRoundoff);
  EXPECT_THROW(static_cast<void>(
                   find_report_force_boundary(Eigen::Vector2d(2, 1), x, 0.0)),
               InputError);
  EXPECT_THROW(static_cast<void>(
                   find_report_force_boundary(Eigen::Vector2d(-2, -1), x, 1.0)),
               NumericalError);
}

// One mode along x at one node: u = phi (phi m |b|) / lambda.
TEST(ReportBoundary, OfDisplacementIsEquation32) {
  Matrix3X x(3, 1);
  x << 3, 4, 0;
  MatrixX Phi = MatrixX::Zero(3, 1);
  Phi(0, 0) = 0.5;
  const double boundary = find_report_displacement_boundary(
      Phi, VectorX::Constant(1, 100.0), VectorX::Constant(1, 2.0), x, 1e-3);
  EXPECT_NEAR(boundary / (1e-3 / (0.25 * 10.0 / 100.0)), 1.0, kRoundoff);
}

TEST(ForceBound, IsAttainedAndNeverPassed) {
  std::mt19937 random(1);
  Matrix3X g(3, 4);
  for (Eigen::Index n = 0; n < 4; ++n) g.col(n) = random_vector(random);
  const InertialForceBound bound(g);
  for (const double alpha : {0.0, 0.3, 2.0})
    for (const double Omega : {0.0, 0.5, 1.7}) {
      const double limit = bound.calc_force(alpha, Omega);
      double largest = 0.0;
      for (int sample = 0; sample < 20000; ++sample) {
        const Vector3 a = alpha * random_vector(random).normalized();
        const Vector3 w = Omega * random_vector(random).normalized();
        for (Eigen::Index n = 0; n < 4; ++n) {
          const Vector3 lever = g.col(n);
          const Vector3 f = a.cross(lever) + w.cross(w.cross(lever));
          largest = std::max(largest, f.norm());
        }
      }
      EXPECT_LE(largest, limit * (1.0 + kRoundoff));
      EXPECT_GE(largest, 0.97 * limit);  // sampled directions come close
      EXPECT_LE(limit, g.colwise().norm().maxCoeff() * (alpha + Omega * Omega) *
                           (1.0 + kRoundoff));
      EXPECT_NEAR(bound.calc_margin(alpha, Omega, 2.0), 0.5 * limit, kRoundoff);
    }
}

class DisplacementBound : public ::testing::TestWithParam<Eigen::Index> {};

TEST_P(DisplacementBound, HoldsForRandomDirectionsAndIsNotFarAbove) {
  const PointBody made = make_point_body(2, GetParam());
  const ReducedBody& body = made.body;
  const InertialDisplacementBound slow(body);
  const InertialDisplacementBound sudden(body, Onset::sudden);
  std::mt19937 random(3);
  for (const auto& [alpha, Omega] :
       {std::pair(0.0, 0.7), std::pair(1.3, 0.0), std::pair(0.4, 0.9)}) {
    const double limit = slow.calc_displacement(alpha, Omega);
    double largest = 0.0;
    for (int sample = 0; sample < 5000; ++sample) {
      const VectorX f =
          inertial_forces(made, alpha * random_vector(random).normalized(),
                          Omega * random_vector(random).normalized());
      const VectorX eta =
          (body.rows.Phi_B.transpose() * f).cwiseQuotient(body.lambda);
      largest = std::max(largest, largest_length(body.rows.Phi_B * eta));
    }
    EXPECT_LE(largest, limit * (1.0 + kRoundoff));
    EXPECT_GE(largest, 0.6 * limit);
    EXPECT_GE(sudden.calc_displacement(alpha, Omega), 2.0 * largest);
  }
}

// Undamped response from rest to a sudden spin, sampled in time.
TEST_P(DisplacementBound, OfASuddenSpinHoldsAtEveryTime) {
  const PointBody made = make_point_body(4, GetParam());
  const ReducedBody& body = made.body;
  const InertialDisplacementBound bound(body, Onset::sudden);
  std::mt19937 random(5);
  double largest = 0.0;
  for (int sample = 0; sample < 200; ++sample) {
    const VectorX f = inertial_forces(made, Vector3::Zero(),
                                      random_vector(random).normalized());
    const VectorX still =
        (body.rows.Phi_B.transpose() * f).cwiseQuotient(body.lambda);
    for (double t = 0.0; t < 20.0; t += 0.1) {
      const VectorX swing =
          (1.0 - (body.lambda.array().sqrt() * t).cos()).matrix();
      largest = std::max(
          largest, largest_length(body.rows.Phi_B * still.cwiseProduct(swing)));
    }
  }
  EXPECT_LE(largest, bound.calc_displacement(0.0, 1.0));
  EXPECT_GE(largest, 0.2 * bound.calc_displacement(0.0, 1.0));
}

// Each mode answers alpha along sum m x cross phi with twice its static
// response.
TEST_P(DisplacementBound, OfASuddenTorqueIsTheSumOfTheModesOwn) {
  const PointBody made = make_point_body(7, GetParam());
  const ReducedBody& body = made.body;
  const auto phi = [&](Eigen::Index n, Eigen::Index k) -> Vector3 {
    return body.rows.Phi_B.block<3, 1>(3 * n, k);
  };
  constexpr double kAlpha = 1.7;
  double largest = 0.0;
  for (Eigen::Index n = 0; n < made.mass.size(); ++n) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < body.lambda.size(); ++k) {
      Vector3 moment = Vector3::Zero();
      for (Eigen::Index i = 0; i < made.mass.size(); ++i) {
        moment += made.mass[i] * Vector3(body.rows.x_B.col(i)).cross(phi(i, k));
      }
      sum += 2.0 * kAlpha * phi(n, k).norm() * moment.norm() / body.lambda[k];
    }
    largest = std::max(largest, sum);
  }
  const InertialDisplacementBound bound(body, Onset::sudden);
  EXPECT_NEAR(bound.calc_displacement(kAlpha, 0.0), largest,
              kRoundoff * largest);
}

INSTANTIATE_TEST_SUITE_P(Modes, DisplacementBound, ::testing::Values(1, 2, 7));

// Two masses m at +-L/2 on z, one stretching mode: the centrifugal force
// m Omega^2 L/2 stretches the spring between them by itself over its stiffness.
TEST(DisplacementBoundOfTwoMasses, IsTheClosedForm) {
  constexpr double m = 3.0;
  constexpr double length = 2.0;
  constexpr double k = 50.0;
  ReducedBody body;
  body.rows.x_B = Matrix3X::Zero(3, 2);
  body.rows.x_B.row(2) << -0.5 * length, 0.5 * length;
  const double phi = 1.0 / std::sqrt(2.0 * m);
  body.rows.Phi_B = MatrixX::Zero(6, 1);
  body.rows.Phi_B(2, 0) = -phi;
  body.rows.Phi_B(5, 0) = phi;
  body.lambda = VectorX::Constant(1, 2.0 * k / m);
  Matrix3 S1 = Matrix3::Zero();
  S1(2, 2) = m * length * phi;
  body.integrals.S1 = {S1};
  const InertialDisplacementBound bound(body);
  const double Omega = 0.8;
  const double stretch = m * Omega * Omega * 0.5 * length / k;
  EXPECT_NEAR(bound.calc_displacement(5.0, Omega), 0.5 * stretch, kRoundoff);
  EXPECT_NEAR(bound.find_omega(5.0, 0.5 * stretch), Omega, kRoundoff);
  EXPECT_NEAR(bound.calc_margin(0.0, Omega, stretch), 0.5, kRoundoff);
  const InertialDisplacementBound sudden(body, Onset::sudden);
  EXPECT_NEAR(sudden.calc_displacement(5.0, Omega), stretch, kRoundoff);
}

TEST(DisplacementBoundCurve, HasAMarginOfOne) {
  const PointBody made = make_point_body(6, 4);
  const InertialDisplacementBound bound(made.body);
  const double limit = bound.calc_displacement(1.0, 1.0);
  const double Omega = bound.find_omega(0.5, limit);
  EXPECT_GT(Omega, 1.0);
  EXPECT_NEAR(bound.calc_margin(0.5, Omega, limit), 1.0, kRoundoff);
  EXPECT_EQ(bound.find_omega(1e6, limit), 0.0);
}

TEST(DisplacementBoundInput, RefusesAClampedBodyAndALimitOfNothing) {
  ReducedBody body = make_point_body(7, 2).body;
  const InertialDisplacementBound bound(body);
  EXPECT_THROW(static_cast<void>(bound.calc_margin(0.0, 1.0, 0.0)), InputError);
  EXPECT_THROW(static_cast<void>(bound.find_omega(0.0, -1.0)), InputError);
  body.clamped = true;
  EXPECT_THROW(InertialDisplacementBound{body}, InputError);
}

}  // namespace
}  // namespace limber::flexbody::decision_boundary_test
