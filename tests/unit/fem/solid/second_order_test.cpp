// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/second_order.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "limber/fem/solid/nonlinear_solid.hpp"
#include "unit/fem/meshes.hpp"

/// Against differences of the mesh's own forces and energy in large
/// displacement, which are exact: the force of a St. Venant-Kirchhoff solid is
/// of third degree in the displacements, its energy of fourth.
namespace limber::fem::second_order_test {
namespace {

using testing::BoxKind;

const ElasticMaterial kSteel{200e9, 0.3, 8000.0};
constexpr Elasticity kLaw = Elasticity::st_venant_kirchhoff;

class SecondOrder : public ::testing::TestWithParam<std::tuple<BoxKind, int>> {
 protected:
  explicit SecondOrder(Elasticity law = Elasticity::st_venant_kirchhoff)
      : mesh_(read_mesh(testing::convert(
            testing::write_file("box.geo",
                                testing::box_geo(std::get<0>(GetParam()))),
            "box.msh", {.order = std::get<1>(GetParam())}))),
        solid_(mesh_, {kSteel}, law),
        workspace_(solid_.make_workspace()),
        Phi_(3 * mesh_.x.cols(), 3) {
    // Smooth, so that no element turns inside out.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (Eigen::Index k = 0; k < Phi_.cols(); ++k) {
      const MatrixX a =
          MatrixX::NullaryExpr(3, 9, [&] { return uniform(random); });
      for (Eigen::Index n = 0; n < mesh_.x.cols(); ++n) {
        const Vector3 x = mesh_.x.col(n);
        Eigen::Matrix<double, 9, 1> powers;
        powers << x, x.cwiseProduct(x), x[0] * x[1], x[1] * x[2], x[2] * x[0];
        Phi_.block<3, 1>(3 * n, k) = 0.05 * a * powers;
      }
    }
  }

  VectorX force(const VectorX& u) {
    Matrix3X f(3, mesh_.x.cols());
    energy_ = solid_.calc_force(u.reshaped(3, mesh_.x.cols()), f, workspace_);
    return f.reshaped();
  }
  double energy(const VectorX& u) {
    static_cast<void>(force(u));
    return energy_;
  }
  /// f''[a, a] of a force of third degree, zero at rest.
  VectorX second(const VectorX& a) { return force(a) + force(-a); }
  /// V'''[a, a, a] of an energy of fourth degree without first, at rest.
  double third(const VectorX& a) { return 3.0 * (energy(a) - energy(-a)); }

  /// @param c pairs 00 01 02 11 12 22
  /// @param size of the displacements
  void expect_third_derivatives(const MatrixX& c, double size,
                                const std::array<double, 3>& tolerances) {
    const auto along = [&](double x, double y, double z) {
      return third(size *
                   (x * Phi_.col(0) + y * Phi_.col(1) + z * Phi_.col(2))) /
             (size * size * size);
    };
    EXPECT_NEAR(3.0 * c(0, 0) / along(1, 0, 0), 1.0, tolerances[0]);
    // V'''[a, a, b] = c_b,aa + 2 c_a,ab.
    const double aab =
        (along(1, 1, 0) - along(1, -1, 0) - 2.0 * along(0, 1, 0)) / 6.0;
    EXPECT_NEAR((c(1, 0) + 2.0 * c(0, 1)) / aab, 1.0, tolerances[1]);
    const double abc =
        (along(1, 1, 1) - along(1, 1, -1) - along(1, -1, 1) - along(-1, 1, 1)) /
        24.0;
    EXPECT_NEAR((c(0, 4) + c(1, 2) + c(2, 1)) / abc, 1.0, tolerances[2]);
  }

  Mesh mesh_;
  NonlinearSolid solid_;
  NonlinearSolid::Workspace workspace_;
  MatrixX Phi_;
  double energy_ = 0.0;
};

TEST_P(SecondOrder, LoadsAreSecondDerivativesOfTheForces) {
  const SecondOrderTerms terms = calc_second_order(mesh_, {kSteel}, kLaw, Phi_);
  Eigen::Index pair = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = i; j < 3; ++j, ++pair) {
      const VectorX expected = 0.25 * (second(Phi_.col(i) + Phi_.col(j)) -
                                       second(Phi_.col(i) - Phi_.col(j)));
      const VectorX g = terms.loads.col(pair);
      EXPECT_LT((g - expected).norm(), 1e-11 * expected.norm()) << i << j;
    }
  }
}

TEST_P(SecondOrder, StrainsAreThirdDerivativesOfTheEnergy) {
  const SecondOrderTerms terms = calc_second_order(mesh_, {kSteel}, kLaw, Phi_);
  const MatrixX& c = terms.strain;
  expect_third_derivatives(c, 1.0, {1e-9, 1e-8, 1e-7});
  EXPECT_TRUE((c.cwiseAbs().array() <= terms.scale.array()).all());
}

// Of a law whose stress is not linear in Green's strain: differences of small
// displacements, whose error is of second order.
class SecondOrderOfNeoHookean : public SecondOrder {
 protected:
  static constexpr double kSmall = 1e-3;
  SecondOrderOfNeoHookean() : SecondOrder(Elasticity::neo_hookean) {}
  MatrixX loads(Elasticity law) {
    return calc_second_order(mesh_, {kSteel}, law, Phi_).loads;
  }
};

TEST_P(SecondOrderOfNeoHookean, LoadsAreSecondDerivativesOfTheForces) {
  const MatrixX own = loads(Elasticity::neo_hookean);
  const MatrixX other = loads(kLaw);
  Eigen::Index pair = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = i; j < 3; ++j, ++pair) {
      const VectorX expected = 0.25 / (kSmall * kSmall) *
                               (second(kSmall * (Phi_.col(i) + Phi_.col(j))) -
                                second(kSmall * (Phi_.col(i) - Phi_.col(j))));
      EXPECT_LT((own.col(pair) - expected).norm(), 1e-6 * expected.norm());
      EXPECT_GT((other.col(pair) - expected).norm(), 0.1 * expected.norm());
    }
  }
}

TEST_P(SecondOrderOfNeoHookean, StrainsAreThirdDerivativesOfTheEnergy) {
  const SecondOrderTerms terms =
      calc_second_order(mesh_, {kSteel}, Elasticity::neo_hookean, Phi_);
  expect_third_derivatives(terms.strain, kSmall, {1e-4, 1e-4, 1e-4});
}

INSTANTIATE_TEST_SUITE_P(Meshes, SecondOrderOfNeoHookean,
                         ::testing::Values(std::tuple(BoxKind::hexahedra, 2)));

TEST_P(SecondOrder, RotationRatiosAreThoseOfShearStretchAndTurn) {
  MatrixX fields = MatrixX::Zero(Phi_.rows(), 4);
  for (Eigen::Index n = 0; n < mesh_.x.cols(); ++n) {
    const Vector3 x = mesh_.x.col(n);
    fields(3 * n, 0) = 2.0 * x[1];                     // shear
    fields(3 * n, 1) = 0.1 * x[0];                     // stretch
    fields.block<3, 1>(3 * n, 2) << -x[1], x[0], 0.0;  // turn
    fields.block<3, 1>(3 * n, 3) << -3.0 * x[1], 5.0 * x[0], 0.0;
  }
  const VectorX ratios =
      find_rotation_ratios(find_mean_deformation(mesh_, fields));
  EXPECT_NEAR(ratios[0], 1.0, 1e-12);
  EXPECT_LT(ratios[1], 1e-7);
  EXPECT_GT(ratios[2], 1e7);
  EXPECT_NEAR(ratios[3], 4.0, 1e-11);  // 8 / 2, halves of sum and difference
}

// The energy of fourth degree of a body that moves along a field, its products
// with a stretch, and that of the stretch itself.
TEST_P(SecondOrder, PairEnergiesAreThoseOfGreensStrain) {
  const MatrixX fields = Phi_.leftCols(2);
  MatrixX Theta = MatrixX::Zero(Phi_.rows(), 3);
  Theta.col(0) = Phi_.col(2);
  Theta.col(2) = -2.0 * Phi_.col(2);
  const std::vector<ElasticMaterial> materials = {kSteel};
  const MatrixX W =
      calc_pair_energy(mesh_, materials, fields, Theta, {0, 1, 2});
  const auto even = [&](const VectorX& u) { return energy(u) + energy(-u); };
  const auto fourth = [&](const VectorX& u) {
    return (even(2.0 * u) - 4.0 * even(u)) / 24.0;
  };
  const VectorX stretch = Theta.col(0);
  const double linear = 0.5 * even(stretch) - fourth(stretch);
  const SecondOrderTerms terms =
      calc_second_order(mesh_, materials, kLaw, Phi_);
  const double c_00 = terms.strain(2, 0);  // pairs 00 01 02 11 12 22
  const double c_01 = terms.strain(2, 1);
  const double c_11 = terms.strain(2, 3);
  const double all = std::abs(W.trace());
  EXPECT_NEAR(W(0, 0), 8.0 * fourth(Phi_.col(0)) + 2.0 * c_00 + 2.0 * linear,
              1e-9 * all);
  EXPECT_NEAR(W(2, 2), 8.0 * fourth(Phi_.col(1)) - 4.0 * c_11 + 8.0 * linear,
              1e-9 * all);
  // Of q_0 = q_1: p = (1, 2, 1) / 2.
  const double sum = W(0, 0) + W(2, 2) + 4.0 * W(1, 1) + 4.0 * W(0, 1) +
                     4.0 * W(1, 2) + 2.0 * W(0, 2);
  const VectorX both = Phi_.col(0) + Phi_.col(1);
  EXPECT_NEAR(
      sum, 8.0 * fourth(both) - 2.0 * (c_00 + 2.0 * c_01 + c_11) + 2.0 * linear,
      1e-8 * all);
  const MatrixX part = calc_pair_energy(mesh_, materials, fields,
                                        Theta.middleCols(0, 3), {0, 2});
  EXPECT_NEAR(part(0, 1), W(0, 2), 1e-12 * all);
  EXPECT_LT((calc_pair_energies(mesh_, materials, fields, Theta) - W.diagonal())
                .norm(),
            1e-12 * all);
}

TEST_P(SecondOrder, DeformationsAreRootMeanSquaresOfAngleAndStrain) {
  MatrixX fields = MatrixX::Zero(Phi_.rows(), 2);
  for (Eigen::Index n = 0; n < mesh_.x.cols(); ++n) {
    const Vector3 x = mesh_.x.col(n);
    fields.block<3, 1>(3 * n, 0) = Vector3(0.1, 0.2, -0.2).cross(x);
    fields(3 * n, 1) = 0.1 * x[0];
  }
  const MeanDeformation mean = find_mean_deformation(mesh_, fields);
  EXPECT_NEAR(mean.rotation[0], 0.3, 1e-12);
  EXPECT_NEAR(mean.strain[0], 0.0, 1e-8);
  EXPECT_NEAR(mean.rotation[1], 0.0, 1e-8);
  EXPECT_NEAR(mean.strain[1], 0.1, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Meshes, SecondOrder,
                         ::testing::Values(std::tuple(BoxKind::hexahedra, 2),
                                           std::tuple(BoxKind::tetrahedra, 2),
                                           std::tuple(BoxKind::prisms, 1)));

}  // namespace
}  // namespace limber::fem::second_order_test
