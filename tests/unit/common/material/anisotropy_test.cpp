// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/material/anisotropy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/material/half_space.hpp"
#include "limber/common/material/stated_material.hpp"

namespace limber::anisotropy_test {
namespace {

/// A carbon-fibre laminate.
const EngineeringConstants kLaminate{
    {140e9, 10e9, 12e9}, {0.3, 0.25, 0.4}, {5e9, 4e9, 3.4e9}};

Matrix3 turn(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).matrix();
}

std::string find_error(const EngineeringConstants& constants) {
  try {
    static_cast<void>(make_orthotropic(constants));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Anisotropy, ComplianceHasTheEngineeringConstants) {
  const MatrixX S = dense::find_inverse(make_orthotropic(kLaminate));
  EXPECT_NEAR(S(0, 0) * 140e9, 1.0, 1e-12);
  EXPECT_NEAR(-S(0, 1) * 140e9, 0.3, 1e-12);
  EXPECT_NEAR(-S(0, 2) * 140e9, 0.25, 1e-12);
  EXPECT_NEAR(-S(1, 2) * 10e9, 0.4, 1e-12);
  EXPECT_NEAR(S(3, 3) * 5e9, 1.0, 1e-12);
  EXPECT_NEAR(S(4, 4) * 3.4e9, 1.0, 1e-12);
  EXPECT_NEAR(S(5, 5) * 4e9, 1.0, 1e-12);
}

TEST(Anisotropy, OffAxisModulusIsThatOfTheClosedForm) {
  for (const double degrees : {0.0, 15.0, 45.0, 80.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Matrix6 C = turn_stiffness(make_orthotropic(kLaminate),
                                     turn(angle, Vector3::UnitZ()));
    const double c = std::cos(angle), s = std::sin(angle);
    // Jones, Mechanics of Composite Materials, eq. 2.97
    const double expected = std::pow(c, 4) / 140e9 + std::pow(s, 4) / 10e9 +
                            (1.0 / 5e9 - 0.6 / 140e9) * c * c * s * s;
    EXPECT_NEAR(dense::find_inverse(C)(0, 0) / expected, 1.0, 1e-12);
  }
}

TEST(Anisotropy, TurningKeepsTheEigenvaluesAndAnIsotropicMaterial) {
  const Matrix3 Q = turn(0.7, {0.2, -0.5, 0.8});
  const double root = std::sqrt(2.0);
  const Vector6 mandel{{1.0, 1.0, 1.0, root, root, root}};
  const auto eigenvalues = [&](const Matrix6& C) {
    return dense::find_eigenvalues(
        Matrix6(mandel.asDiagonal() * C * mandel.asDiagonal()));
  };
  const Matrix6 C = make_orthotropic(kLaminate);
  EXPECT_LT((eigenvalues(turn_stiffness(C, Q)) - eigenvalues(C)).norm(),
            1e-13 * C.norm());
  const Matrix6 steel = make_isotropic(210e9, 0.3);
  EXPECT_LT((turn_stiffness(steel, Q) - steel).norm(), 1e-14 * steel.norm());
}

TEST(Anisotropy, ConditionsAreThoseOfAPositiveStrainEnergy) {
  std::mt19937 random(1);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int admissible = 0;
  for (int i = 0; i < 2000; ++i) {
    EngineeringConstants k;
    for (int j = 0; j < 3; ++j) {
      k.E[j] = std::pow(10.0, draw(9.0, 11.5));
      k.G[j] = std::pow(10.0, draw(8.0, 11.0));
    }
    k.nu = {draw(-1.2, 1.2) * std::sqrt(k.E[0] / k.E[1]),
            draw(-1.2, 1.2) * std::sqrt(k.E[0] / k.E[2]),
            draw(-1.2, 1.2) * std::sqrt(k.E[1] / k.E[2])};
    Matrix3 S;
    S << 1.0, -k.nu[0], -k.nu[1], -k.nu[0], k.E[0] / k.E[1],
        -k.nu[2] * k.E[0] / k.E[1], -k.nu[1], -k.nu[2] * k.E[0] / k.E[1],
        k.E[0] / k.E[2];
    const bool is_positive = dense::find_eigenvalues(S).minCoeff() > 0.0;
    EXPECT_EQ(find_error(k).empty(), is_positive) << find_error(k);
    admissible += is_positive ? 1 : 0;
  }
  EXPECT_GT(admissible, 200);
  EXPECT_LT(admissible, 1800);
}

TEST(Anisotropy, ErrorNamesTheConditionThatFails) {
  EngineeringConstants k = kLaminate;
  k.G[1] = -1.0;
  EXPECT_NE(find_error(k).find("G13 is -1 Pa"), std::string::npos);
  k = kLaminate;
  k.nu[2] = 1.2;
  EXPECT_NE(find_error(k).find("|nu23| < sqrt(E2 / E3) = 0.912871"),
            std::string::npos)
      << find_error(k);
  k = {Vector3::Constant(1e9), Vector3::Constant(0.6), Vector3::Constant(1e9)};
  EXPECT_NE(find_error(k).find("2 nu21 nu32 nu13 is -0.512"), std::string::npos)
      << find_error(k);
  Constants21 upper = list_constants(make_isotropic(1e9, 0.3));
  upper[1] = 2e9;  // C12 above C11
  try {
    static_cast<void>(make_anisotropic(upper));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("first 2 rows and columns"),
              std::string::npos);
  }
}

TEST(Anisotropy, MeanOfAnIsotropicMaterialIsItself) {
  const SolidMaterial mean = make_material(make_isotropic(70e9, 0.33), {}, 1.0);
  EXPECT_NEAR(mean.youngs_modulus / 70e9, 1.0, 1e-14);
  EXPECT_NEAR(mean.poisson_ratio, 0.33, 1e-14);
}

TEST(Anisotropy, AxesOfACylinderAreRadialTangentialAndAxial) {
  const MaterialAxes axes =
      make_cylindrical_axes({0.0, 0.0, 2.0}, {1.0, 0.0, 5.0});
  const Matrix3 at = axes.at({1.0, 3.0, -7.0});
  EXPECT_LT((at.col(0) - Vector3::UnitY()).norm(), 1e-15);
  EXPECT_LT((at.col(1) + Vector3::UnitX()).norm(), 1e-15);
  EXPECT_LT((at.col(2) - Vector3::UnitZ()).norm(), 1e-15);
  EXPECT_NEAR(axes.at({1.0, 0.0, 8.0}).determinant(), 1.0, 1e-15);
}

TEST(Anisotropy, StatedMaterialsNameWhatIsMissing) {
  const auto error_of = [](const StatedMaterial& stated) {
    try {
      static_cast<void>(make_material(stated));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  StatedMaterial stated;
  stated.youngs_modulus = {1e9, 1e9, 1e9};
  stated.poisson_ratio = {0.3};
  stated.density = 1.0;
  EXPECT_NE(error_of(stated).find("one Young's modulus"), std::string::npos);
  stated.shear_modulus = {1e9, 1e9, 1e9};
  EXPECT_NE(error_of(stated).find("nu12, nu13, nu23; given: 1"),
            std::string::npos);
  stated.poisson_ratio = {0.3, 0.3, 0.3};
  EXPECT_EQ(error_of(stated), "");
  stated.axis_1 = Vector3::UnitX();
  EXPECT_NE(error_of(stated).find("both axis 1 and axis 2"), std::string::npos);
  stated.axis_2 = Vector3(-3.0 * Vector3::UnitX());
  EXPECT_NE(error_of(stated).find("parallel"), std::string::npos);
}

TEST(HalfSpace, OfAnIsotropicMaterialHasItsOwnConstants) {
  const SolidMaterial found = find_isotropic_surface(find_surface_compliance(
      make_isotropic(70e9, 0.33), Vector3(1.0, 2.0, -0.5).normalized()));
  EXPECT_NEAR(found.youngs_modulus / 70e9, 1.0, 1e-12);
  EXPECT_NEAR(found.poisson_ratio, 0.33, 1e-12);
}

TEST(HalfSpace, AcrossFibresHasTheIndentationModulusOfTransverseIsotropy) {
  // 1, 2 in the plane of isotropy; C12 = C11 - 2 C66.
  const EngineeringConstants zinc{
      {10e9, 10e9, 140e9}, {0.4, 0.022, 0.022}, {10e9 / 2.8, 5e9, 5e9}};
  const Matrix6 C = make_orthotropic(zinc);
  const double C11 = C(0, 0), C33 = C(2, 2), C13 = C(0, 2), C44 = C(4, 4);
  // Hanson, J. Appl. Mech. 59 (1992): circular contact on the plane of isotropy
  const double expected =
      2.0 * std::sqrt((C11 * C33 - C13 * C13) / C11 /
                      (1.0 / C44 + 2.0 / (C13 + std::sqrt(C11 * C33))));
  const SurfaceCompliance compliance =
      find_surface_compliance(C, Vector3::UnitZ());
  EXPECT_NEAR(2.0 / compliance.normal / expected, 1.0, 1e-6);
}

}  // namespace
}  // namespace limber::anisotropy_test
