// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/shape_integrals.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace limber::flexbody::shape_integrals_test {
namespace {

constexpr double kMass = 3.0;    // [kg]
constexpr double kLength = 2.0;  // [m]
constexpr int kNodes = 8;

/// A uniform bar along x about its centre, of elements of different lengths.
Matrix3X make_nodes() {
  Matrix3X x = Matrix3X::Zero(3, kNodes);
  for (int i = 0; i < kNodes; ++i) {
    const double fraction = static_cast<double>(i) / (kNodes - 1);
    x(0, i) = kLength * (fraction * fraction - 0.5);
  }
  return x;
}

/// Consistent mass of linear elements: products of linear fields are exact.
Eigen::SparseMatrix<double> make_mass(const Matrix3X& x) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i + 1 < kNodes; ++i) {
    const double mass = kMass / kLength * (x(0, i + 1) - x(0, i));
    entries.emplace_back(i, i, mass / 3.0);
    entries.emplace_back(i + 1, i + 1, mass / 3.0);
    entries.emplace_back(i, i + 1, mass / 6.0);
    entries.emplace_back(i + 1, i, mass / 6.0);
  }
  Eigen::SparseMatrix<double> M(kNodes, kNodes);
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

/// phi = a + b x.
struct LinearField {
  Vector3 a;
  Vector3 b;
};

class ShapeIntegralsOfABar : public ::testing::Test {
 protected:
  ShapeIntegralsOfABar() : x_(make_nodes()), Phi_(3 * kNodes, 2) {
    for (int k = 0; k < 2; ++k) {
      for (int i = 0; i < kNodes; ++i) {
        Phi_.block<3, 1>(Eigen::Index{3} * i, k) =
            fields_[k].a + fields_[k].b * x_(0, i);
      }
    }
    found_ = calc_shape_integrals(make_mass(x_), x_, Phi_);
  }

  static constexpr double kSecondMoment = kMass * kLength * kLength / 12.0;
  const LinearField fields_[2] = {{{1.0, -2.0, 0.5}, {0.3, 4.0, -1.0}},
                                  {{0.2, 3.0, -0.7}, {-2.0, 0.6, 5.0}}};
  Matrix3X x_;
  MatrixX Phi_;
  InertiaShapeIntegrals found_;
};

TEST_F(ShapeIntegralsOfABar, HaveTheSecondMomentOfTheBar) {
  const Matrix3 expected = Vector3(kSecondMoment, 0.0, 0.0).asDiagonal();
  EXPECT_LT((found_.S0 - expected).norm(), 1e-14);
}

TEST_F(ShapeIntegralsOfABar, HaveTheMomentumOfEachField) {
  for (int k = 0; k < 2; ++k) {
    EXPECT_LT((found_.P.col(k) - kMass * fields_[k].a).norm(), 1e-13);
  }
}

TEST_F(ShapeIntegralsOfABar, HaveTheMomentsOfEachFieldWithThePlace) {
  for (int k = 0; k < 2; ++k) {
    const Matrix3 expected =
        kSecondMoment * Vector3::UnitX() * fields_[k].b.transpose();
    EXPECT_LT((found_.S1[static_cast<std::size_t>(k)] - expected).norm(),
              1e-13);
  }
}

TEST_F(ShapeIntegralsOfABar, HaveTheProductsOfAllPairsOfFields) {
  for (int k = 0; k < 2; ++k) {
    for (int l = 0; l < 2; ++l) {
      const Matrix3 expected =
          kMass * fields_[k].a * fields_[l].a.transpose() +
          kSecondMoment * fields_[k].b * fields_[l].b.transpose();
      const std::size_t pair =
          2 * static_cast<std::size_t>(k) + static_cast<std::size_t>(l);
      EXPECT_LT((found_.S2[pair] - expected).norm(), 1e-13);
    }
  }
}

}  // namespace
}  // namespace limber::flexbody::shape_integrals_test
