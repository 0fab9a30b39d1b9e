// SPDX-License-Identifier: BSD-3-Clause
// Balanced truncation against closed forms, its bound, and what must stay.
#include "limber/dynamics/analysis/balanced_truncation.hpp"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "limber/common/dense/general_eigen.hpp"
#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/analysis/schur_form.hpp"

namespace limber::dynamics::balanced_truncation_test {
namespace {

using ::testing::HasSubstr;
using Complex = std::complex<double>;
using Index = Eigen::Index;

MatrixX draw(Index rows, Index columns, double phase) {
  return MatrixX::NullaryExpr(rows, columns, [&](Index i, Index j) {
    return std::sin(phase + 7.1 * double(i) + 3.3 * double(j) + double(i * j));
  });
}

LinearModel make_model(const MatrixX& A, const MatrixX& B, const MatrixX& C) {
  LinearModel model{A, B, C, draw(C.rows(), B.cols(), 0.5), {}, {}, {}};
  model.states.resize(static_cast<std::size_t>(A.rows()));
  model.inputs.resize(static_cast<std::size_t>(B.cols()));
  model.outputs.resize(static_cast<std::size_t>(C.rows()));
  return model;
}

/// A chain of masses between springs and dampers. The first spring ties it to
/// the world unless it is free.
MatrixX make_chain(Index masses, double damping, bool is_free) {
  MatrixX K = MatrixX::Zero(masses, masses);
  for (Index i = 0; i < masses; ++i) {
    if (i == 0 && is_free) continue;
    const double k = 1.0 + 0.3 * double(i);
    K(i, i) += k;
    if (i == 0) continue;
    K(i - 1, i - 1) += k;
    K(i, i - 1) -= k;
    K(i - 1, i) -= k;
  }
  MatrixX A = MatrixX::Zero(2 * masses, 2 * masses);
  A.topRightCorner(masses, masses).setIdentity();
  A.bottomLeftCorner(masses, masses) = -K;
  A.bottomRightCorner(masses, masses) = -damping * K;
  return A;
}

MatrixX push_first(const MatrixX& A) {
  MatrixX B = MatrixX::Zero(A.rows(), 2);
  B(A.rows() / 2, 0) = 1.0;
  B(A.rows() - 1, 1) = 2.0;
  return B;
}

Eigen::VectorXcd find_eigenvalues(const MatrixX& A) {
  return dense::find_general_eigenpairs(A, false).values;
}

Eigen::MatrixXcd find_response(const LinearModel& model, double w) {
  const Index n = model.A.rows();
  const Eigen::MatrixXcd pencil =
      Complex(0.0, w) * Eigen::MatrixXcd::Identity(n, n) -
      model.A.cast<Complex>();
  return model.C *
             dense::solve(pencil, Eigen::MatrixXcd(model.B.cast<Complex>())) +
         model.D.cast<Complex>();
}

/// The largest gain of the difference at many frequencies.
double find_difference(const LinearModel& a, const LinearModel& b) {
  double largest = 0.0;
  for (int i = -400; i <= 400; ++i) {
    const double w = std::pow(10.0, 0.005 * i);
    const Eigen::MatrixXcd gap = find_response(a, w) - find_response(b, w);
    largest = std::max(
        largest,
        std::sqrt(dense::find_eigenvalues(Eigen::MatrixXcd(gap.adjoint() * gap))
                      .maxCoeff()));
  }
  return largest;
}

TEST(SchurForm, OrdersEigenvaluesWithoutChangingTheMatrix) {
  const MatrixX A = draw(9, 9, 1.0);
  const auto grows = [](const Complex& s) { return s.real() > 0.0; };
  const SchurForm form = find_schur_form(A, grows);
  EXPECT_LT((form.U * form.T * form.U.adjoint() - A.cast<Complex>()).norm(),
            1e-13 * A.norm());
  EXPECT_LT(
      (form.U.adjoint() * form.U - Eigen::MatrixXcd::Identity(9, 9)).norm(),
      1e-13);
  bool has_ended = false;
  int first = 0;
  for (Index i = 0; i < 9; ++i) {
    for (Index k = 0; k < i; ++k) EXPECT_EQ(form.T(i, k), 0.0);
    if (!grows(form.T(i, i)))
      has_ended = true;
    else
      ++first;
    EXPECT_NE(grows(form.T(i, i)), has_ended);
  }
  EXPECT_GT(first, 0);
  EXPECT_LT(first, 9);
}

TEST(SchurForm, GivesTheFactorOfTheGramian) {
  const MatrixX A = draw(8, 8, 2.0) - 9.0 * MatrixX::Identity(8, 8);
  const MatrixX B = draw(8, 3, 3.0);
  const SchurForm form = find_schur_form(A);
  const Eigen::MatrixXcd L =
      form.U * find_gramian_factor(form.T, form.U.adjoint() * B);
  const Eigen::MatrixXcd P = L * L.adjoint();
  EXPECT_LT(P.imag().norm(), 1e-14 * P.norm());
  const MatrixX X = P.real();
  EXPECT_LT((A * X + X * A.transpose() + B * B.transpose()).norm(),
            1e-13 * (B * B.transpose()).norm());
}

// Of two modes that decay, with P = Q = [1/2 1/3; 1/3 1/4].
TEST(BalancedTruncation, HasTheHankelSingularValuesOfTheClosedForm) {
  const MatrixX A = Vector3(-1.0, -2.0, 0.0).head<2>().asDiagonal();
  const LinearModel model =
      make_model(A, MatrixX::Ones(2, 1), MatrixX::Ones(1, 2));
  const TruncatedModel out = truncate_balanced(model, 1);
  const double root = std::sqrt(0.25 * 0.25 + 4.0 / 9.0);
  ASSERT_EQ(out.hankel.size(), 2);
  EXPECT_NEAR(out.hankel[0], 0.5 * (0.75 + root), 1e-15);
  EXPECT_NEAR(out.hankel[1], 0.5 * (0.75 - root), 1e-15);
  EXPECT_NEAR(out.bound, 0.75 - root, 1e-15);
  EXPECT_EQ(out.kept, 0);
  // The bound is reached at rest by this symmetric system.
  EXPECT_NEAR(find_difference(model, out.model), out.bound, 1e-4 * out.bound);
}

// No model of r states is nearer than the next singular value.
TEST(BalancedTruncation, DiffersByNoMoreThanItsBound) {
  const MatrixX A = make_chain(6, 0.05, false);
  const LinearModel model = make_model(A, push_first(A), draw(2, 12, 1.0));
  for (const Index states : {1, 3, 6, 11}) {
    const TruncatedModel out = truncate_balanced(model, states);
    EXPECT_EQ(out.model.A.rows(), states);
    const double gap = find_difference(model, out.model);
    EXPECT_LE(gap, out.bound);
    EXPECT_GE(gap, 0.99 * out.hankel[states]);
    EXPECT_LT(find_eigenvalues(out.model.A).real().maxCoeff(), 0.0);
  }
  const TruncatedModel all = truncate_balanced(model, 12);
  EXPECT_EQ(all.bound, 0.0);
  EXPECT_LT(find_difference(model, all.model), 1e-9 * all.hankel[0]);
}

// Free, undamped and growing motion beside some that decays, all mixed.
TEST(BalancedTruncation, KeepsWhatDoesNotDecay) {
  const MatrixX chain = make_chain(5, 0.1, true);
  const Index n = chain.rows() + 3;
  MatrixX A = MatrixX::Zero(n, n);
  A.topLeftCorner(10, 10) = chain;
  A(10, 11) = 3.0;
  A(11, 10) = -3.0;
  A(12, 12) = 0.2;
  const MatrixX mix = draw(n, n, 4.0) + 4.0 * MatrixX::Identity(n, n);
  const MatrixX mixed = mix * A * dense::find_inverse(mix);
  const LinearModel model = make_model(mixed, draw(n, 2, 5.0), draw(2, n, 6.0));
  const TruncatedModel out = truncate_balanced(model, 9);
  EXPECT_EQ(out.kept, 5);  // two of free motion, two undamped, one growing
  const Eigen::VectorXcd kept =
      find_eigenvalues(out.model.A.topLeftCorner(5, 5));
  for (const Complex s : {Complex(0, 3), Complex(0, -3), Complex(0.2, 0)}) {
    EXPECT_LT((kept.array() - s).abs().minCoeff(), 1e-9);
  }
  EXPECT_TRUE(out.model.A.topRightCorner(5, 4).isZero(0.0));
  EXPECT_LE(find_difference(model, out.model), out.bound * (1.0 + 1e-6));
}

TEST(BalancedTruncation, IsRefusedInWords) {
  const MatrixX A = make_chain(3, 0.0, true);
  const LinearModel model = make_model(A, push_first(A), draw(1, 6, 1.0));
  const auto refusal = [](const LinearModel& of, Index states) {
    try {
      (void)truncate_balanced(of, states);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(model, 4),
              HasSubstr("6 of 6 do not decay (2 of free motion, 4 undamped, 0 "
                        "growing)"));
  EXPECT_THAT(refusal(model, 7), HasSubstr("the model has only 6"));
  const LinearModel deaf = make_model(A, MatrixX(6, 0), draw(1, 6, 1.0));
  EXPECT_THAT(refusal(deaf, 2), HasSubstr("0 inputs and 1 outputs"));
}

}  // namespace
}  // namespace limber::dynamics::balanced_truncation_test
