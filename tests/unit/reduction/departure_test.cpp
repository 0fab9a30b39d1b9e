// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/departure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "limber/common/dense/singular_values.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/reduction/modal/krylov.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::flexbody::departure_test {
namespace {

using testing::Bar;
using ::testing::HasSubstr;
using testing::make_recipe;
using Complex = std::complex<double>;

constexpr double kPi = 3.14159265358979323846;

/// The dense model of a bar: matrices of its free nodes and its first
/// frequency without rigid motion.
struct DenseBar {
  explicit DenseBar(const Bar& bar)
      : body(make_recipe(bar), {}),
        K(testing::dense_stiffness(body)),
        M(testing::kron(body.support.matrices.M_s, Matrix3::Identity())) {
    const dense::Eigenpairs modes = dense::find_eigenpairs(K, M);
    const Eigen::Index rigid = body.support.R.cols();
    first_frequency = std::sqrt(modes.values[rigid]);
    Phi = modes.vectors.rightCols(K.cols() - rigid);
    lambda = modes.values.tail(K.cols() - rigid);
  }

  /// The elastic response to F e^(s t) with D = alpha M + beta K.
  [[nodiscard]] Eigen::MatrixXcd answer(const MatrixX& F, Complex s,
                                        const Friction& friction = {}) const {
    const Eigen::MatrixXcd load =
        (Phi.transpose() * take_rows(F, body.support.free_nodes))
            .cast<Complex>();
    Eigen::VectorXcd factor(lambda.size());
    for (Eigen::Index i = 0; i < lambda.size(); ++i)
      factor[i] =
          1.0 /
          (s * s + lambda[i] +
           s * (friction.mass_rate + friction.stiffness_time * lambda[i]));
    return Phi.cast<Complex>() * (factor.asDiagonal() * load);
  }

  [[nodiscard]] double norm(const Eigen::MatrixXcd& x) const {
    return std::sqrt((x.real().transpose() * M * x.real()).trace() +
                     (x.imag().transpose() * M * x.imag()).trace());
  }

  MeshedBody body;
  MatrixX K, M, Phi;
  VectorX lambda;
  double first_frequency = 0.0;
};

/// Loaded at the tip in a direction that causes bending, a little torsion and
/// stretching.
MatrixX push_tip(const MeshedBody& body) {
  return testing::spread(body, 1, {1e3, 2e2, -1e2}).reshaped();
}

Eigen::MatrixXcd expand(const DepartureModel& model, Complex s) {
  return model.basis.Phi.cast<Complex>() * model.calc_response(s);
}

class Departure : public ::testing::TestWithParam<bool> {
 protected:
  /// Stubby: a slender one leaves dense solvers fewer digits.
  Bar bar_{.size = {1.0, 0.5, 0.4}, .is_clamped = GetParam()};
  DenseBar dense_{bar_};
};
INSTANTIATE_TEST_SUITE_P(Support, Departure, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Clamped" : "Free";
                         });

/// Error (w / w_1)^(2n) of n terms under cos(w t), for w well below w_1.
TEST_P(Departure, ErrorOfNTermsHasOrderTwoNInTheFrequency) {
  const MatrixX F = push_tip(dense_.body);
  const auto error = [&](int terms, double fraction) {
    const Complex s(0.0, fraction * dense_.first_frequency);
    const DepartureModel model = make_departure_model(dense_.body, F, terms);
    const Eigen::MatrixXcd exact = dense_.answer(F, s);
    return dense_.norm(expand(model, s) - exact) / dense_.norm(exact);
  };
  for (const auto& [terms, fraction] :
       {std::pair{1, 0.05}, {2, 0.05}, {3, 0.1}, {4, 0.2}}) {
    const double slope =
        std::log2(error(terms, 2.0 * fraction) / error(terms, fraction));
    EXPECT_NEAR(slope, 2.0 * terms, 0.5) << terms;
  }
}

/// alpha x_0 at every instant: order two, as the single term.
TEST_P(Departure, InstantaneousAnswerHasOrderTwo) {
  const MatrixX F = push_tip(dense_.body);
  const VectorX x0 = dense_.answer(F, 0.0).real();
  const auto error = [&](double fraction) {
    return dense_.norm(
        dense_.answer(F, Complex(0.0, fraction * dense_.first_frequency)) - x0);
  };
  EXPECT_NEAR(std::log2(error(0.04) / error(0.02)), 2.0, 0.01);
}

TEST_P(Departure, SingleInputModelIsTheExpansionOfOneTerm) {
  const MeshedBody& body = dense_.body;
  const Friction friction{.mass_rate = 30.0, .stiffness_time = 1e-5};
  const MatrixX F = push_tip(body);
  const OperatingState state =
      find_accelerating_state(body, F.reshaped(3, body.mesh.x.cols()));
  const SingleInputModel single =
      make_single_input_model(body, state, friction);
  const VectorX x0 = take_rows(state.u.reshaped(), body.support.free_nodes);
  EXPECT_NEAR(single.m, x0.dot(dense_.M * x0), 1e-10 * single.m);
  EXPECT_NEAR(single.k, x0.dot(dense_.K * x0), 1e-10 * single.k);
  EXPECT_NEAR(single.d, 30.0 * single.m + 1e-5 * single.k, 1e-10 * single.d);
  const DepartureModel model = make_departure_model(body, F, 1, friction);
  for (const double fraction : {0.1, 0.9, 3.0}) {
    const Complex s(0.0, fraction * dense_.first_frequency);
    const Eigen::MatrixXcd expected = (1.0 + single.calc_transfer(s)) * x0;
    EXPECT_LT(dense_.norm(expand(model, s) - expected),
              1e-9 * dense_.norm(expected));
  }
}

/// For slow changes, alpha + beta is alpha less both delays, to fourth order.
TEST_P(Departure, SlowInputIsDelayedByInertiaAndFriction) {
  const MeshedBody& body = dense_.body;
  const OperatingState state = find_accelerating_state(
      body, push_tip(body).reshaped(3, body.mesh.x.cols()));
  const SingleInputModel free = make_single_input_model(body, state);
  const SingleInputModel damped = make_single_input_model(
      body, state, {.mass_rate = 0.1 * dense_.first_frequency});
  EXPECT_EQ(free.frictional_delay(), 0.0);
  const auto rest = [](const SingleInputModel& model, double w) {
    const Complex s(0.0, w);
    return std::abs(model.calc_transfer(s) + model.inertial_delay() * s * s +
                    model.frictional_delay() * s);
  };
  const double w = 0.01 * dense_.first_frequency;
  EXPECT_NEAR(std::log2(rest(free, 2.0 * w) / rest(free, w)), 4.0, 0.01);
  EXPECT_NEAR(std::log2(rest(damped, 2.0 * w) / rest(damped, w)), 2.0, 0.1);
  // One shape cannot be softer than the body.
  EXPECT_LE(free.inertial_delay(),
            1.0 / std::pow(dense_.first_frequency, 2) * (1.0 + 1e-10));
}

TEST_P(Departure, SeveralInputsShareOneModel) {
  const MeshedBody& body = dense_.body;
  MatrixX F(3 * body.mesh.x.cols(), 2);
  F << push_tip(body), testing::make_load(body).reshaped();
  const Friction friction{.mass_rate = 20.0, .stiffness_time = 1e-5};
  const DepartureModel model = make_departure_model(body, F, 3, friction);
  EXPECT_EQ(model.Q.cols(), 2);
  EXPECT_EQ(model.basis.lambda.size(), 6);
  const Eigen::MatrixXcd held = dense_.answer(F, 0.0);
  const Eigen::MatrixXcd found =
      (model.basis.Phi * model.calc_static()).cast<Complex>();
  EXPECT_LT(dense_.norm(found - held), 1e-9 * dense_.norm(held));
  const Complex s(0.0, 0.2 * dense_.first_frequency);
  const Eigen::MatrixXcd exact = dense_.answer(F, s, friction);
  EXPECT_LT(dense_.norm(expand(model, s) - exact), 1e-4 * dense_.norm(exact));
}

/// Plain powers, each of unit length, against the vectors that are used.
TEST_P(Departure, PlainPowersLoseTheirIndependenceAndTheVectorsUsedDoNot) {
  constexpr int kTerms = 8;
  const DenseBar slender({.cells = 8, .is_clamped = GetParam()});
  const MeshedBody& body = slender.body;
  const MatrixX first = slender.answer(push_tip(body), 0.0).real();
  MatrixX powers(first.rows(), kTerms);
  VectorX x = first.col(0);
  for (int n = 0; n < kTerms; ++n) {
    powers.col(n) = x / std::sqrt(x.dot(slender.M * x));
    x = slender.Phi * slender.lambda.cwiseInverse().asDiagonal() *
        (slender.Phi.transpose() * slender.M * powers.col(n));
  }
  const MatrixX root = slender.M.llt().matrixU();
  const auto condition = [&](const MatrixX& X) {
    const VectorX s = dense::find_singular_form(MatrixX(root * X)).values;
    return s[0] / s[s.size() - 1];
  };
  EXPECT_GT(condition(powers.leftCols(4)), 1e3);
  EXPECT_GT(condition(powers), 1e8);
  const MatrixX vectors = find_krylov_vectors(body, first, kTerms, 1e-8);
  ASSERT_EQ(vectors.cols(), kTerms);
  EXPECT_NEAR(condition(vectors), 1.0, 1e-10);
  // They span the same space, within the precision of the powers.
  const MatrixX lead = powers.leftCols(4);
  const MatrixX Q = vectors.leftCols(4);
  EXPECT_LT((root * (lead - Q * (Q.transpose() * slender.M * lead))).norm(),
            1e-9);
}

/// The hierarchy alpha_n'' + alpha_(n+1) = 0, cut off after A coefficients,
/// is a chain of integrators: a disturbance grows as t^(2A - 2), while that of
/// Lagrange's equations conserves its energy and oscillates at the body's
/// frequencies.
TEST_P(Departure, HierarchyOfCoefficientsGrowsWithoutBound) {
  constexpr int kTerms = 4;
  const DepartureModel model =
      make_departure_model(dense_.body, push_tip(dense_.body), kTerms);
  ASSERT_EQ(model.basis.lambda.size(), kTerms);
  EXPECT_GE(model.basis.lambda[0],
            (1.0 - 1e-9) * std::pow(dense_.first_frequency, 2));
  // In units of 1/w_1, with alpha_n w_1^(2n): y' = N y, from alpha_(A-1) = 1.
  MatrixX N = MatrixX::Zero(2 * kTerms, 2 * kTerms);
  for (int n = 0; n < kTerms; ++n) {
    N(n, kTerms + n) = 1.0;
    if (n + 1 < kTerms) N(kTerms + n, n + 1) = -1.0;
  }
  const auto grown = [&](double t) {
    MatrixX power = MatrixX::Identity(N.rows(), N.cols());
    MatrixX sum = power;  // the series ends: N^(2A) = 0
    for (int k = 1; k <= 2 * kTerms; ++k) {
      power = power * N * t / k;
      sum += power;
    }
    EXPECT_EQ(power.norm(), 0.0);
    return std::abs(sum(0, kTerms - 1));
  };
  const double ten_periods = 20.0 * kPi;
  EXPECT_NEAR(std::log2(grown(2.0 * ten_periods) / grown(ten_periods)),
              2.0 * kTerms - 2.0, 1e-9);
  EXPECT_GT(grown(ten_periods), 1e7);
}

TEST_P(Departure, WithoutFrictionKeepsItsEnergy) {
  const DepartureModel model =
      make_departure_model(dense_.body, push_tip(dense_.body), 4);
  EXPECT_EQ(model.C.norm(), 0.0);
  // Symmetric and positive: r'' = -diag(lambda) r with M-orthonormal shapes.
  const MatrixX& Phi = model.basis.Phi;
  const MatrixX I = MatrixX::Identity(Phi.cols(), Phi.cols());
  EXPECT_LT((Phi.transpose() * dense_.M * Phi - I).norm(), 1e-10);
  const MatrixX reduced = Phi.transpose() * dense_.K * Phi;
  EXPECT_LT((reduced - MatrixX(model.basis.lambda.asDiagonal())).norm(),
            1e-9 * reduced.norm());
}

/// A load is held; at the interval's end another takes its place.
TEST_P(Departure, NextIntervalCarriesWhatTheLastLoadLeaves) {
  const MeshedBody& body = dense_.body;
  MatrixX F(3 * body.mesh.x.cols(), 2);
  F << push_tip(body), testing::make_load(body).reshaped();
  const auto lost = [&](int carried, double rate) {
    const std::vector<DepartureModel> models =
        make_interval_models(body, F, 3, carried);
    const VectorX r = models[0].calc_static();
    const VectorX rdot = rate * r;
    const double energy = 0.5 * (rdot.squaredNorm() +
                                 r.dot(models[0].basis.lambda.cwiseProduct(r)));
    return carry_motion(body, models[0], models[1], {r, rdot}).lost / energy;
  };
  const double w = dense_.first_frequency;
  EXPECT_GT(lost(0, 0.0), 1e-3);
  EXPECT_GT(lost(0, w), 1e-3);
  EXPECT_NEAR(lost(1, 0.0), 0.0, 1e-10);
  EXPECT_NEAR(lost(1, w), 0.0, 1e-10);
}

TEST_P(Departure, CarriedMotionIsTheOldOneWhereAllTermsAreKept) {
  const MeshedBody& body = dense_.body;
  MatrixX F(3 * body.mesh.x.cols(), 2);
  F << push_tip(body), testing::make_load(body).reshaped();
  const std::vector<DepartureModel> models =
      make_interval_models(body, F, 3, 3);
  EXPECT_EQ(models[0].basis.lambda.size(), 3);
  EXPECT_EQ(models[1].basis.lambda.size(), 6);
  const DepartureMotion motion{VectorX::LinSpaced(3, 1.0, -2.0),
                               VectorX::LinSpaced(3, -0.5, 1.0)};
  const DepartureMotion carried =
      carry_motion(body, models[0], models[1], motion).motion;
  const auto difference = [&](const VectorX& old_r, const VectorX& new_r) {
    const VectorX x = models[0].basis.Phi * old_r;
    return dense_.norm((models[1].basis.Phi * new_r - x).cast<Complex>()) /
           dense_.norm(x.cast<Complex>());
  };
  EXPECT_LT(difference(motion.r, carried.r), 1e-9);
  EXPECT_LT(difference(motion.rdot, carried.rdot), 1e-9);
}

TEST(DepartureModel, RefusesWhatDeformsNothing) {
  const MeshedBody body(make_recipe({}), {});
  const auto error_of = [&](const MatrixX& loads, int terms) -> std::string {
    try {
      (void)make_departure_model(body, loads, terms);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const MatrixX push = push_tip(body);
  EXPECT_THAT(error_of(0.0 * push, 1), HasSubstr("deforms nothing"));
  const MatrixX gravity =
      (Vector3(0.0, 0.0, -9.81) *
       (body.M_s * VectorX::Ones(body.M_s.cols())).transpose())
          .reshaped();
  EXPECT_THAT(error_of(gravity, 1), HasSubstr("deforms nothing"));
  EXPECT_THAT(error_of(push, 0), HasSubstr("expected 1 or more"));
}

}  // namespace
}  // namespace limber::flexbody::departure_test
