// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/linear_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace limber::fem::linear_fit_test {
namespace {

using Places = Eigen::Matrix<double, 2, Eigen::Dynamic>;

TEST(LinearFit, ReproducesConstantAndLinearFields) {
  for (const double stretch : {1.0, 1e-4}) {
    Places places(2, 7);                          // on one side of the origin
    places << 0.1, 0.9, 0.4, 1.3, 0.7, 0.2, 1.0,  //
        0.3, 0.1, 0.8, 0.6, -0.4, -0.2, 0.9;
    places.row(1) *= stretch;
    const VectorX weights = find_linear_fit(places);
    EXPECT_NEAR(weights.sum(), 1.0, 1e-12);
    EXPECT_LT((places * weights).norm(), 1e-12);  // x and y of the origin
  }
}

/// The normal equations of the best line through four values, at 0.
TEST(LinearFit, IsOfLeastSquares) {
  Places places(2, 4);
  places << 1.0, 2.0, 3.0, 2.0,  //
      0.0, 1.0, 0.0, -1.0;
  const Eigen::Vector4d values(2.0, 3.0, 7.0, 1.0);
  Eigen::Matrix<double, 4, 3> P;
  P << Eigen::Vector4d::Ones(), places.transpose();
  const Eigen::Vector3d line =
      (P.transpose() * P).inverse() * P.transpose() * values;
  EXPECT_NEAR(find_linear_fit(places).dot(values), line[0], 1e-12);
}

TEST(LinearFit, IsTheMeanWherePlacesDetermineNoPlane) {
  Places line(2, 4);
  line << 1.0, 2.0, 3.0, 4.0,  //
      2.0, 4.0, 6.0, 8.0;
  for (const Places& places : {line, Places(line.leftCols<2>())})
    EXPECT_LT((find_linear_fit(places).array() -
               1.0 / static_cast<double>(places.cols()))
                  .abs()
                  .maxCoeff(),
              1e-15);
}

}  // namespace
}  // namespace limber::fem::linear_fit_test
