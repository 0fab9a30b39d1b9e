// SPDX-License-Identifier: BSD-3-Clause
// The contract of kinds of modal elasticity.
#include "limber/flexbody/elasticity/modal_elasticity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "support/differences.hpp"
#include "support/elastic_kinds.hpp"

namespace limber::flexbody::modal_elasticity_test {
namespace {

using testing::differentiate;
using testing::Margin;

constexpr int kModes = 5;
constexpr double kDifferences = 1e-9;
constexpr double kRoundoff = 1e-13;

VectorX make_lambda() {
  VectorX lambda(kModes);
  lambda << 1.0, 2.5, 0.7, 4.0, 9.0;
  return lambda;
}

struct Kind {
  std::string name;
  ModalElasticity elasticity;
};

std::vector<Kind> make_kinds() {
  const VectorX lambda = make_lambda();
  MatrixX one_row = MatrixX::Zero(2, 3);
  one_row.row(1) << 0.3, -0.8, 0.5;
  // Modes 0 and 2, 3 times themselves; mode 3, 0 times 2.
  MatrixX two_classes = MatrixX::Zero(3, 6);
  two_classes << 0.4, 0.0, 0.0, 0.0, 0.0, 0.7,  //
      -0.3, 0.0, 0.0, 0.5, 0.0, 0.0,            //
      0.0, 0.9, 0.0, 0.0, 0.0, 0.0;
  MatrixX self(2, 6);
  self << 0.2, 0.0, 0.0, 0.6, 0.0, -0.4,  //
      0.0, 0.3, 0.0, 0.0, 0.8, 0.0;
  return {
      {"Diagonal", DiagonalStiffness({lambda})},
      {"Full", testing::turn_stiffness(lambda, testing::make_basis(kModes, 7))},
      {"QuadraticStrain", testing::make_quadratic_strain(lambda, 4, 1.0, 3)},
      {"QuadraticStrainOfOneMode", QuadraticStrain({lambda, {1, 3}, one_row})},
      {"QuadraticStrainOfTwoClasses",
       QuadraticStrain({lambda, {0, 2, 3}, two_classes})},
      {"QuadraticStrainWithSelfStrains",
       QuadraticStrain({lambda, {0, 2, 3}, two_classes, self})},
      {"QuadraticStrainOfSelfStrainsAlone",
       QuadraticStrain({lambda, {0, 2, 3}, MatrixX::Zero(3, 6), self})},
      {"QuadraticStrainWithoutPairs", QuadraticStrain({lambda, {}, {}})},
  };
}

class Elasticity : public ::testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] VectorX draw() {
    VectorX v(kModes);
    for (double& x : v) x = uniform_(random_);
    return v;
  }
  [[nodiscard]] VectorX force(const VectorX& q) const {
    VectorX f(kModes);
    calc_elastic_force(own_, q, f);
    return f;
  }
  [[nodiscard]] MatrixX tangent(const VectorX& q) const {
    MatrixX K(kModes, kModes);
    calc_elastic_tangent(own_, q, K);
    return K;
  }
  [[nodiscard]] VectorX over_step(const VectorX& q0, const VectorX& q1) const {
    VectorX f(kModes);
    calc_elastic_force_over_step(own_, q0, q1, f);
    return f;
  }
  [[nodiscard]] MatrixX tangent_over_step(const VectorX& q0,
                                          const VectorX& q1) const {
    MatrixX K(kModes, kModes);
    calc_elastic_tangent_over_step(own_, q0, q1, K);
    return K;
  }
  ModalElasticity own_ = make_kinds()[GetParam()].elasticity;

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST_P(Elasticity, ForceIsTheGradientOfItsEnergy) {
  Margin margin;
  for (int i = 0; i < 10; ++i) {
    const VectorX q = draw();
    const VectorX d = draw();
    const double slope = differentiate(
        [&](double h) { return calc_elastic_energy(own_, q + h * d); });
    margin.add(std::abs(slope - force(q).dot(d)), std::abs(slope));
  }
  margin.expect_below(kDifferences);
}

TEST_P(Elasticity, TangentIsTheDerivativeOfItsForceAndSymmetric) {
  Margin margin;
  for (int i = 0; i < 10; ++i) {
    const VectorX q = draw();
    const VectorX d = draw();
    const VectorX slope =
        differentiate([&](double h) { return force(q + h * d); });
    const MatrixX K = tangent(q);
    margin.add((slope - K * d).norm(), slope.norm());
    EXPECT_LE((K - K.transpose()).norm(), kRoundoff * K.norm());
  }
  margin.expect_below(kDifferences);
}

TEST_P(Elasticity, ForceOverAStepDoesTheWorkThatIsStored) {
  Margin margin;
  for (int i = 0; i < 10; ++i) {
    const VectorX q0 = draw();
    const VectorX q1 = q0 + std::pow(10.0, -i % 3) * draw();
    const double stored =
        calc_elastic_energy(own_, q1) - calc_elastic_energy(own_, q0);
    margin.add(std::abs(over_step(q0, q1).dot(q1 - q0) - stored),
               calc_elastic_energy(own_, q1));
    EXPECT_LE((over_step(q0, q1) - over_step(q1, q0)).norm(),
              kRoundoff * over_step(q0, q1).norm());
    EXPECT_LE((over_step(q0, q0) - force(q0)).norm(),
              kRoundoff * force(q0).norm());
  }
  margin.expect_below(kRoundoff);
}

TEST_P(Elasticity, TangentOverAStepIsTheDerivativeOfTwiceItsForce) {
  Margin margin;
  for (int i = 0; i < 10; ++i) {
    const VectorX q0 = draw();
    const VectorX q1 = draw();
    const VectorX d = draw();
    const VectorX slope = differentiate(
        [&](double h) { return VectorX(2.0 * over_step(q0, q1 + h * d)); });
    margin.add((slope - tangent_over_step(q0, q1) * d).norm(), slope.norm());
    EXPECT_LE((tangent_over_step(q0, q0) - tangent(q0)).norm(),
              kRoundoff * tangent(q0).norm());
  }
  margin.expect_below(kDifferences);
}

TEST_P(Elasticity, StoresNoLessThanNothingAndNothingAtRest) {
  EXPECT_EQ(calc_elastic_energy(own_, VectorX::Zero(kModes)), 0.0);
  EXPECT_EQ(force(VectorX::Zero(kModes)).norm(), 0.0);
  for (int i = 0; i < 100; ++i) {
    EXPECT_GE(calc_elastic_energy(own_, 10.0 * draw()), 0.0);
  }
}

TEST_P(Elasticity, TellsItsTraitsAsItsTangentHasThem) {
  const MatrixX rest = tangent(VectorX::Zero(kModes));
  const MatrixX bent = tangent(draw());
  const auto off_diagonal = [](const MatrixX& K) {
    return (K - MatrixX(K.diagonal().asDiagonal())).norm();
  };
  EXPECT_EQ(count_modes(own_), kModes);
  EXPECT_EQ(is_linear(own_), (bent - rest).norm() == 0.0);
  EXPECT_EQ(is_diagonal(own_), is_linear(own_) && off_diagonal(rest) == 0.0);
  EXPECT_EQ(is_diagonal_at_rest(own_), off_diagonal(rest) == 0.0);
  EXPECT_LE((rest_stiffness(own_) - rest.diagonal()).norm(), kRoundoff);
  EXPECT_NEAR(lowest_rest_stiffness(own_),
              dense::find_eigenvalues(rest).minCoeff(), 1e-12);
  if (is_diagonal(own_)) {
    EXPECT_EQ(*find_eigenvalues(own_), make_lambda());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Elasticity,
                         ::testing::Range<std::size_t>(0, make_kinds().size()),
                         [](const auto& i) {
                           return make_kinds()[i.param].name;
                         });

// --- Quadratic strains ------------------------------------------------------

TEST(QuadraticStrain, StoresTheSumOfSquaresOfItsStrains) {
  VectorX lambda = make_lambda();
  const std::vector<int> paired = {0, 2, 3};
  MatrixX Q(3, 6);
  Q << 0.1, -0.2, 0.3, 0.4, 0.5, -0.6,  //
      0.7, 0.8, -0.9, 1.0, 1.1, 1.2,    //
      -1.3, 1.4, 1.5, 1.6, -1.7, 1.8;
  VectorX q(kModes);
  q << 0.3, -0.4, 0.6, 0.9, -0.2;
  // Pairs 00, 01, 02, 11, 12, 22 of P.
  const double a = q[0];
  const double b = q[2];
  const double c = q[3];
  double V = 0.5 * (lambda[1] * q[1] * q[1] + lambda[4] * q[4] * q[4]);
  for (int r = 0; r < 3; ++r) {
    const int k = paired[static_cast<std::size_t>(r)];
    const double e = std::sqrt(lambda[k]) * q[k] + Q(r, 0) * a * a +
                     Q(r, 1) * a * b + Q(r, 2) * a * c + Q(r, 3) * b * b +
                     Q(r, 4) * b * c + Q(r, 5) * c * c;
    V += 0.5 * e * e;
  }
  EXPECT_NEAR(QuadraticStrain({lambda, paired, Q}).energy(q), V, 1e-14 * V);
  // A self-strain is of no mode.
  MatrixX self(1, 6);
  self << 0.5, -0.1, 0.2, 0.7, 0.4, -0.3;
  const double e = 0.5 * a * a - 0.1 * a * b + 0.2 * a * c + 0.7 * b * b +
                   0.4 * b * c - 0.3 * c * c;
  EXPECT_NEAR(QuadraticStrain({lambda, paired, Q, self}).energy(q),
              V + 0.5 * e * e, 1e-14 * V);
}

// Of more pairs than are treated at once; those of a table with many zeros by
// classes.
TEST(QuadraticStrain, OfManyModesHasTheSumsOfItsDefinition) {
  constexpr int kMany = 40;
  constexpr int kPaired = 34;
  const VectorX lambda = VectorX::LinSpaced(kMany, 1.0, 9.0);
  std::vector<int> paired(kPaired);
  std::iota(paired.begin(), paired.end(), 3);
  const VectorX q = VectorX::NullaryExpr(kMany, [](Eigen::Index i) {
    return 0.2 * std::sin(1.0 + 1.7 * static_cast<double>(i));
  });
  for (const int period : {1, 3, 7}) {
    MatrixX Q = MatrixX::Zero(kPaired, kPaired * (kPaired + 1) / 2);
    VectorX e = lambda.cwiseSqrt().cwiseProduct(q);
    MatrixX D = lambda.cwiseSqrt().asDiagonal();
    for (int r = 0; r < kPaired; ++r) {
      Eigen::Index pair = 0;
      for (int i = 0; i < kPaired; ++i) {
        for (int j = i; j < kPaired; ++j, ++pair) {
          if ((r + i + j) % period != 0) continue;
          const double value = 0.1 * std::cos(r + 2.3 * i + 0.7 * j);
          Q(r, pair) = value;
          e[r + 3] += value * q[i + 3] * q[j + 3];
          D(r + 3, i + 3) += value * q[j + 3];
          D(r + 3, j + 3) += value * q[i + 3];
        }
      }
    }
    MatrixX K = D.transpose() * D;
    for (int r = 0; r < kPaired; ++r) {
      Eigen::Index pair = 0;
      for (int i = 0; i < kPaired; ++i) {
        for (int j = i; j < kPaired; ++j, ++pair) {
          K(i + 3, j + 3) += e[r + 3] * Q(r, pair);
          K(j + 3, i + 3) += e[r + 3] * Q(r, pair);
        }
      }
    }
    const QuadraticStrain own({lambda, paired, Q});
    EXPECT_NEAR(own.energy(q), 0.5 * e.squaredNorm(), 1e-13 * e.squaredNorm());
    VectorX force(kMany);
    own.calc_force(q, force);
    EXPECT_LT((force - D.transpose() * e).norm(), 1e-13 * force.norm());
    MatrixX tangent(kMany, kMany);
    own.calc_tangent(q, tangent);
    EXPECT_LT((tangent - K).norm(), 1e-13 * K.norm()) << period;
  }
}

TEST(QuadraticStrain, WithoutATableIsDiagonalToTheBit) {
  const VectorX lambda = make_lambda();
  const ModalElasticity plain = DiagonalStiffness({lambda});
  const ModalElasticity zero =
      QuadraticStrain({lambda, {0, 1}, MatrixX::Zero(2, 3)});
  ASSERT_TRUE(is_diagonal(zero));
  const VectorX q = VectorX::LinSpaced(kModes, -0.3, 0.8);
  EXPECT_EQ(calc_elastic_energy(zero, q), calc_elastic_energy(plain, q));
}

// --- Refusals ---------------------------------------------------------------

void expect_refused(const std::function<void()>& make, const std::string& why) {
  try {
    make();
    FAIL() << "accepted: " << why;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(why));
  }
}

TEST(ElasticityParameters, WithoutMeaningAreRefused) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const VectorX lambda = make_lambda();
  VectorX bad = lambda;
  bad[2] = kNaN;
  expect_refused([&] { DiagonalStiffness({bad}); }, "eigenvalue 3");
  bad[2] = -1.0;
  expect_refused([&] { DiagonalStiffness({bad}); }, "eigenvalue 3 is -1");
  expect_refused([&] { QuadraticStrain({bad, {}, {}}); }, "eigenvalue 3");
  MatrixX Q = MatrixX::Zero(2, 3);
  expect_refused([&] { QuadraticStrain({lambda, {1, 0}, Q}); }, "increase");
  expect_refused([&] { QuadraticStrain({lambda, {1, 1}, Q}); }, "increase");
  expect_refused([&] { QuadraticStrain({lambda, {0, 5}, Q}); }, "5 modes");
  expect_refused([&] { QuadraticStrain({lambda, {-1, 0}, Q}); }, "-1");
  expect_refused(
      [&] {
        QuadraticStrain({lambda, {0, 1, 2}, Q});
      },
      "2 x 3; expected 3 x 6");
  MatrixX self = MatrixX::Zero(1, 4);
  expect_refused(
      [&] {
        QuadraticStrain({lambda, {0, 1}, Q, self});
      },
      "self-strains");
  self.setZero(QuadraticStrain::kMostPaired, 3);
  expect_refused(
      [&] {
        QuadraticStrain({lambda, {0, 1}, Q, self});
      },
      "256 self-strains; expected at most 254");
  Q(1, 2) = kNaN;
  expect_refused([&] { QuadraticStrain({lambda, {0, 1}, Q}); }, "entry 2, 3");
  expect_refused([&] { FullStiffness({MatrixX()}); }, "no rows");
  expect_refused([&] { FullStiffness({Q}); }, "2 x 3; expected 2 x 2");
  MatrixX K(2, 2);
  K << 1.0, 0.5, 0.4, 1.0;
  expect_refused([&] { FullStiffness({K}); }, "not symmetric");
  K << 1.0, 2.0, 2.0, 1.0;
  expect_refused([&] { FullStiffness({K}); }, "eigenvalue -1");
  K(0, 0) = kNaN;
  expect_refused([&] { FullStiffness({K}); }, "entry 1, 1");
}

TEST(ElasticityParameters, OfAnotherNumberOfModesIsACallersDefect) {
  const ModalElasticity own = DiagonalStiffness({make_lambda()});
  VectorX force(3);
  EXPECT_THROW(calc_elastic_force(own, VectorX::Zero(3), force), ContractError);
  EXPECT_THROW((void)calc_elastic_energy(own, VectorX::Zero(6)), ContractError);
}

}  // namespace
}  // namespace limber::flexbody::modal_elasticity_test
