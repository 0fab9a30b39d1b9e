// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/mode_selection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::flexbody::mode_selection_test {
namespace {

/// Roundoff of small dense problems, on numbers near one.
constexpr double kRoundoff = 1e-11;

/// A made-up structure of a few nodes with all of its modes.
struct Structure {
  Eigen::SparseMatrix<double> M_s;
  Matrix3X x;
  MatrixX M;
  MatrixX K;
  VectorX lambda;  ///< elastic only
  MatrixX Phi;
};

MatrixX random_matrix(std::mt19937& random, Eigen::Index rows,
                      Eigen::Index columns) {
  std::normal_distribution<double> normal;
  MatrixX A(rows, columns);
  for (double& a : A.reshaped()) a = normal(random);
  return A;
}

MatrixX random_positive(std::mt19937& random, Eigen::Index n) {
  const MatrixX A = random_matrix(random, n, n);
  return A * A.transpose() + MatrixX::Identity(n, n);
}

/// Unit translations and rotations about the origin.
MatrixX rigid_motions(const Matrix3X& x) {
  MatrixX r(3 * x.cols(), 6);
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    Matrix3 skew;
    skew << 0, -x(2, n), x(1, n), x(2, n), 0, -x(0, n), -x(1, n), x(0, n), 0;
    r.middleRows<3>(3 * n) << Matrix3::Identity(), skew.transpose();
  }
  return r;
}

Structure make_structure(unsigned seed, bool is_free) {
  std::mt19937 random(seed);
  constexpr Eigen::Index kNodes = 5;
  Structure s;
  const MatrixX nodal = random_positive(random, kNodes);
  s.M_s = nodal.sparseView();
  s.x = random_matrix(random, 3, kNodes);
  s.M = MatrixX::Zero(3 * kNodes, 3 * kNodes);
  for (Eigen::Index i = 0; i < kNodes; ++i)
    for (Eigen::Index j = 0; j < kNodes; ++j)
      s.M.block<3, 3>(3 * i, 3 * j) = nodal(i, j) * Matrix3::Identity();
  s.K = random_positive(random, 3 * kNodes);
  if (is_free) {
    const MatrixX r = rigid_motions(s.x);
    const MatrixX Mr = s.M * r;
    const MatrixX P =
        MatrixX::Identity(s.K.rows(), s.K.cols()) -
        r * dense::find_inverse(r.transpose() * Mr) * Mr.transpose();
    s.K = MatrixX(P.transpose() * s.K * P);
  }
  const dense::Eigenpairs pairs = dense::find_eigenpairs(s.K, s.M);
  const Eigen::Index elastic = s.K.cols() - (is_free ? 6 : 0);
  s.lambda = pairs.values.tail(elastic);
  s.Phi = pairs.vectors.rightCols(elastic);
  return s;
}

/// K^+ f.
VectorX answer(const Structure& s, const VectorX& f) {
  return s.Phi * (s.Phi.transpose() * f).cwiseQuotient(s.lambda);
}

double energy_norm(const Structure& s, const VectorX& u) {
  return std::sqrt(u.dot(s.K * u));
}

// Eq. 36 spelled out on one mode by hand.
TEST(ReportEffectiveMass, IsEquation36) {
  Eigen::SparseMatrix<double> M_s(2, 2);
  M_s.insert(0, 0) = 2.0;
  M_s.insert(0, 1) = M_s.insert(1, 0) = 1.0;
  M_s.insert(1, 1) = 4.0;
  MatrixX Phi = MatrixX::Zero(6, 1);
  Phi(1, 0) = -0.5;
  Phi(4, 0) = 0.25;
  MatrixX loads = MatrixX::Zero(6, 2);
  loads(1, 0) = 3.0;   // M f is (6, 3) in y
  loads(0, 1) = 10.0;  // across the mode
  const MatrixX mass =
      calc_report_effective_mass(Phi, VectorX::Constant(1, 9.0), M_s, loads);
  EXPECT_NEAR(mass(0, 0), 2.25 / 9.0, kRoundoff);
  EXPECT_EQ(mass(0, 1), 0.0);
}

TEST(ModalCompliance, SumsToTheLoadsCompliance) {
  const Structure s = make_structure(1, false);
  std::mt19937 random(2);
  const VectorX f = random_matrix(random, s.K.rows(), 1);
  const VectorX solved = dense::solve(s.K, f);
  EXPECT_NEAR(calc_modal_compliance(s.Phi.transpose() * f, s.lambda).sum() /
                  f.dot(solved),
              1.0, kRoundoff);
}

TEST(Participation, EffectiveMassesOfAllModesSumToTheRigidMass) {
  const Structure s = make_structure(3, false);
  const Participation p = calc_participation(s.Phi, s.M_s, s.x);
  const VectorX sums = p.effective_mass.rowwise().sum();
  const double mass = MatrixX(s.M_s).sum();
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(p.rigid_mass[a] / mass, 1.0, kRoundoff);
    EXPECT_NEAR(sums[a] / mass, 1.0, kRoundoff);
  }
  const Matrix3 S0 = s.x * s.M_s * s.x.transpose();
  const Matrix3 J = S0.trace() * Matrix3::Identity() - S0;
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(sums[3 + a] / J(a, a), 1.0, kRoundoff);
}

TEST(Participation, OfAFreeBodyIsZero) {
  const Structure s = make_structure(4, true);
  const Participation p = calc_participation(s.Phi, s.M_s, s.x);
  EXPECT_LT(p.factors.cwiseAbs().maxCoeff(), 1e-10 * p.rigid_mass.norm());
}

TEST(Selection, TakesTheFewestModesOrTheFirst) {
  const VectorX fractions = Eigen::Vector4d(0.3, 0.05, 0.15, 0.5);
  const VectorX totals = VectorX::Ones(1);
  const ModeSelection few = select_modes(fractions, totals);
  EXPECT_THAT(few.modes, ::testing::ElementsAre(0, 2, 3));
  EXPECT_NEAR(few.reached[0], 0.95, kRoundoff);
  EXPECT_TRUE(few.complete);
  const ModeSelection first =
      select_modes(fractions, totals, {0.5, SelectionOrder::given});
  EXPECT_THAT(first.modes, ::testing::ElementsAre(0, 1, 2));
}

TEST(Selection, IsTheUnionOfItsCases) {
  MatrixX fractions(3, 3);
  fractions << 0.95, 0.0, 0.0, 0.05, 0.0, 0.0, 0.0, 1.0, 0.0;
  const ModeSelection selection =
      select_modes(fractions, Vector3(1.0, 1.0, 0.0));
  EXPECT_THAT(selection.modes, ::testing::ElementsAre(0, 2));
  EXPECT_THAT(selection.cases[0], ::testing::ElementsAre(0));
  EXPECT_THAT(selection.cases[1], ::testing::ElementsAre(2));
  EXPECT_THAT(selection.cases[2], ::testing::IsEmpty());
}

TEST(Selection, SaysWhenTheModesGivenDoNotReachTheThreshold) {
  const ModeSelection selection =
      select_modes(Eigen::Vector2d(0.4, 0.3), VectorX::Ones(1));
  EXPECT_FALSE(selection.complete);
  EXPECT_THAT(selection.modes, ::testing::ElementsAre(0, 1));
  EXPECT_NEAR(selection.reached[0], 0.7, kRoundoff);
}

TEST(Selection, GrowsWithTheThreshold) {
  std::mt19937 random(5);
  const MatrixX fractions = random_matrix(random, 20, 3).cwiseAbs();
  const VectorX totals = fractions.colwise().sum().transpose();
  for (const auto order :
       {SelectionOrder::largest_first, SelectionOrder::given}) {
    std::vector<int> before;
    for (double threshold = 0.0; threshold < 1.0; threshold += 0.05) {
      const ModeSelection now =
          select_modes(fractions, totals, {threshold, order});
      EXPECT_TRUE(std::includes(now.modes.begin(), now.modes.end(),
                                before.begin(), before.end()));
      EXPECT_GE(now.reached.minCoeff(), threshold - kRoundoff);
      before = now.modes;
    }
    EXPECT_TRUE(select_modes(fractions, totals, {1.0, order}).complete);
  }
}

TEST(Selection, RefusesAThresholdThatIsNoShare) {
  for (const double threshold : {-0.1, 90.0, std::nan("")})
    EXPECT_THROW(static_cast<void>(select_modes(
                     VectorX::Ones(1), VectorX::Ones(1), {threshold, {}})),
                 InputError);
}

class ModeErrors : public ::testing::TestWithParam<bool> {
 protected:
  const Structure s = make_structure(6, GetParam());
  std::mt19937 random{7};
  const VectorX f = random_matrix(random, s.K.rows(), 1);
  const VectorX p = s.Phi.transpose() * f;
  const VectorX u0 = answer(s, f);
  static constexpr Eigen::Index kKept = 4;
  const MatrixX Phi = s.Phi.leftCols(kKept);
  const VectorX lambda = s.lambda.head(kKept);
  const double e0 =
      calc_static_error(calc_modal_compliance(p, s.lambda),
                        VectorX::Constant(1, f.dot(u0)), {0, 1, 2, 3})[0];

  [[nodiscard]] double error(const VectorX& u, const VectorX& truth) const {
    return energy_norm(s, u - truth) / energy_norm(s, u0);
  }
};

TEST_P(ModeErrors, StaticErrorIsExactAndModeAccelerationHasNone) {
  const VectorX eta = p.head(kKept).cwiseQuotient(lambda);
  EXPECT_NEAR(error(calc_mode_displacement(Phi, eta), u0), e0, kRoundoff);
  EXPECT_GT(e0, 0.1);  // or nothing below has a meaning
  EXPECT_LT(
      error(calc_mode_acceleration(Phi, lambda, eta, p.head(kKept), u0), u0),
      kRoundoff);
}

TEST_P(ModeErrors, AugmentationAnswersItsLoadStaticallyAndStaysOrthonormal) {
  const ReducedBasis basis = augment_basis({lambda, Phi}, s.M_s, f, u0);
  ASSERT_EQ(basis.lambda.size(), kKept + 1);
  const MatrixX identity = MatrixX::Identity(kKept + 1, kKept + 1);
  EXPECT_LT((basis.Phi.transpose() * s.M * basis.Phi - identity).norm(),
            kRoundoff);
  const MatrixX stiffness = basis.lambda.asDiagonal();
  EXPECT_LT((basis.Phi.transpose() * s.K * basis.Phi - stiffness).norm(),
            kRoundoff * basis.lambda.maxCoeff());
  const VectorX eta = (basis.Phi.transpose() * f).cwiseQuotient(basis.lambda);
  EXPECT_LT(error(basis.Phi * eta, u0), kRoundoff);
  EXPECT_EQ(augment_basis(basis, s.M_s, f, u0).lambda.size(), kKept + 1);
}

TEST_P(ModeErrors, HarmonicErrorsStayBelowTheirBounds) {
  const ReducedBasis more = augment_basis({lambda, Phi}, s.M_s, f, u0);
  const double cut = s.lambda[kKept];
  for (const double part : {0.1, 0.5, 0.8, 0.95}) {
    const double omega2 = part * part * cut;
    const VectorX shifted = (s.lambda.array() - omega2).matrix();
    const VectorX truth = s.Phi * p.cwiseQuotient(shifted);
    const VectorX eta = p.head(kKept).cwiseQuotient(shifted.head(kKept));
    const VectorX md = calc_mode_displacement(Phi, eta);
    const VectorX ma =
        calc_mode_acceleration(Phi, lambda, eta, p.head(kKept), u0);
    const VectorX mta =
        more.Phi * (more.Phi.transpose() * f)
                       .cwiseQuotient((more.lambda.array() - omega2).matrix());
    const HarmonicError bound = calc_harmonic_error(e0, cut, std::sqrt(omega2));
    EXPECT_LE(error(md, truth), bound.mode_displacement);
    EXPECT_LE(error(ma, truth), bound.mode_acceleration);
    EXPECT_LE(error(mta, truth), error(ma, truth));
    EXPECT_LT(error(ma, truth), error(md, truth));
  }
  EXPECT_THROW(static_cast<void>(calc_harmonic_error(e0, 4.0, 2.0)),
               InputError);
}

INSTANTIATE_TEST_SUITE_P(Support, ModeErrors, ::testing::Bool(),
                         [](const auto& named) {
                           return named.param ? "Free" : "Clamped";
                         });

// Two load cases with a history: the columns are independent.
TEST(ModeAcceleration, WorksInstantByInstant) {
  const Structure s = make_structure(8, false);
  std::mt19937 random(9);
  const MatrixX f = random_matrix(random, s.K.rows(), 3);
  const MatrixX statics = dense::solve(s.K, f);
  const MatrixX Phi = s.Phi.leftCols(3);
  const MatrixX loads = Phi.transpose() * f;
  const MatrixX eta = random_matrix(random, 3, 3);
  const MatrixX all =
      calc_mode_acceleration(Phi, s.lambda.head(3), eta, loads, statics);
  for (Eigen::Index t = 0; t < 3; ++t)
    EXPECT_LT(
        (all.col(t) - calc_mode_acceleration(Phi, s.lambda.head(3), eta.col(t),
                                             loads.col(t), statics.col(t)))
            .norm(),
        kRoundoff);
}

TEST(ModeSelectionContracts, RefuseForeignSizes) {
  const MatrixX Phi = MatrixX::Zero(6, 2);
  EXPECT_THROW(static_cast<void>(calc_mode_displacement(Phi, VectorX(3))),
               ContractError);
  EXPECT_THROW(
      static_cast<void>(calc_modal_compliance(VectorX(2), VectorX::Ones(3))),
      ContractError);
  EXPECT_THROW(
      static_cast<void>(select_modes(-VectorX::Ones(1), VectorX::Ones(1))),
      ContractError);
}

}  // namespace
}  // namespace limber::flexbody::mode_selection_test
