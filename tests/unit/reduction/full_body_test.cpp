// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/reduction/full_body_maker.hpp"
#include "unit/reduction/bar.hpp"

/// A body without reduction, against its matrices entry by entry.
namespace limber::flexbody::full_body_test {
namespace {

using testing::Bar;

class FullBar : public ::testing::TestWithParam<bool> {
 protected:
  FullBar()
      : recipe_(testing::make_recipe({.corner = {0.2, -0.1, 0.3},
                                      .material = {200e9, 0.3, 8000.0},
                                      .is_clamped = GetParam()})),
        meshed_(recipe_, {}),
        body_(make_full_body(recipe_, {})),
        solver_(body_->make_solver()) {}

  [[nodiscard]] Eigen::Index nodes() const { return body_->x_B.cols(); }
  [[nodiscard]] Matrix3X make_field(double size, double phase) const {
    Matrix3X field(3, nodes());
    for (Eigen::Index i = 0; i < field.size(); ++i) {
      field.reshaped()[i] =
          size * std::sin(1.7 * static_cast<double>(i) + phase);
    }
    return field;
  }
  [[nodiscard]] Matrix3X hold(Matrix3X field) const {
    for (Eigen::Index n = 0; n < nodes(); ++n) {
      if (body_->held[static_cast<std::size_t>(n)] != 0) field.col(n).setZero();
    }
    return field;
  }
  [[nodiscard]] MatrixX take_free(const Matrix3X& field) const {
    return take_rows(field.reshaped(), meshed_.support.free_nodes);
  }

  Recipe recipe_;
  MeshedBody meshed_;
  std::shared_ptr<const FullBody> body_;
  std::unique_ptr<FullBodySolver> solver_;
};

INSTANTIATE_TEST_SUITE_P(Support, FullBar, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Clamped" : "Free";
                         });

TEST_P(FullBar, HasTheMassAndItsMomentsOfTheBox) {
  const Bar bar;
  EXPECT_NEAR(body_->node_mass.sum(), bar.mass(), 1e-12 * bar.mass());
  EXPECT_LT((body_->x_B * body_->node_mass).norm(), 1e-12 * bar.mass());
  EXPECT_LT(body_->first_moment.rowwise().sum().norm(), 1e-12 * bar.mass());
  // int (x - x_c)^2 dm of each axis.
  const Matrix3 second = body_->first_moment * body_->x_B.transpose();
  const Matrix3 expected =
      (bar.mass() / 12.0 * bar.size.cwiseAbs2()).asDiagonal();
  EXPECT_LT((second - expected).norm(), 1e-12 * expected.norm());
}

TEST_P(FullBar, DividesByTheMassThatItMultipliesBy) {
  const Matrix3X a = hold(make_field(1.0, 0.3));
  Matrix3X force(3, nodes());
  solver_->multiply_mass(a, force);
  EXPECT_LT((force - a * meshed_.M_s).norm(), 1e-14 * force.norm());
  Matrix3X found(3, nodes());
  solver_->divide_mass(force, found);
  EXPECT_LT((found - a).norm(), 1e-11 * a.norm());
}

TEST_P(FullBar, HasTheStiffnessOfHookeAtRest) {
  const Matrix3X u = hold(make_field(1e-9, 0.7));
  Matrix3X force(3, nodes());
  const double energy = solver_->calc_internal_force(u, force);
  const MatrixX K = testing::dense_stiffness(meshed_);
  const VectorX x = take_free(u);
  const VectorX expected = K * x;
  EXPECT_LT((take_free(force) - expected).norm(), 1e-6 * expected.norm());
  EXPECT_NEAR(energy, 0.5 * x.dot(expected), 1e-6 * energy);
}

// (c M + K) x = F on the free nodes, x = 0 on the others; of several columns.
TEST_P(FullBar, SolvesForSeveralLoadsOnAllNodes) {
  constexpr double kShift = 1e7;  // [1/s^2]
  solver_->factor(Matrix3X::Zero(3, nodes()), kShift);
  MatrixX x(3 * nodes(), 2);
  x << make_field(1.0, 0.1).reshaped(), make_field(2.0, 1.1).reshaped();
  const MatrixX load = x;
  solver_->solve(x);
  ASSERT_EQ(x.rows(), 3 * nodes());
  const MatrixX K = testing::dense_stiffness(meshed_);
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Matrix3X field = x.col(k).reshaped(3, nodes());
    EXPECT_EQ(hold(field), field);
    Matrix3X inertia(3, nodes());
    solver_->multiply_mass(field, inertia);
    const VectorX found = kShift * take_free(inertia) + K * take_free(field);
    const VectorX expected = take_free(load.col(k).reshaped(3, nodes()));
    EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm());
  }
}

}  // namespace
}  // namespace limber::flexbody::full_body_test
