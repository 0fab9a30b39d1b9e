// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/initial_deformation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/qr.hpp"

namespace limber::flexbody::initial_deformation_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Twelve nodes, and 36 fields that are orthonormal in their mass: the first six
// stand for rigid motion, the next four for modes.
class InitialField : public ::testing::Test {
 protected:
  InitialField() {
    const MatrixX A = MatrixX::Random(12, 12);
    const MatrixX M = A * A.transpose() + MatrixX::Identity(12, 12);
    M_s_ = M.sparseView();
    MatrixX L = MatrixX::Zero(36, 36);  // M = L L' of all components
    const MatrixX own = dense::find_cholesky(M).value();
    for (Eigen::Index i = 0; i < 12; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        L.block<3, 3>(3 * i, 3 * j) = own(i, j) * Matrix3::Identity();
      }
    }
    const MatrixX Q = dense::find_q(MatrixX::Random(36, 36), 36);
    fields_ = dense::solve_lower_transposed(L, Q);
  }
  [[nodiscard]] ProjectedField project(const VectorX& u) const {
    return project_field(u, fields_.middleCols(6, 4), M_s_,
                         fields_.leftCols(6));
  }

  Eigen::SparseMatrix<double> M_s_;
  MatrixX fields_;
};

TEST_F(InitialField, IsDividedIntoRigidMotionModesAndRest) {
  VectorX parts = VectorX::Zero(36);
  parts[2] = 3.0;                     // rigid
  parts.segment<4>(6) << 2, 0, 1, 2;  // modes: 3 together
  parts[20] = 4.0;                    // neither
  const ProjectedField field = project(fields_ * parts);
  EXPECT_LT((field.eta - parts.segment<4>(6)).norm(), 1e-12);
  EXPECT_NEAR(field.rigid_fraction, 3.0 / std::sqrt(34.0), 1e-12);
  EXPECT_NEAR(field.missed_fraction, 4.0 / 5.0, 1e-12);
}

TEST_F(InitialField, OfRigidMotionAloneMissesNothing) {
  const ProjectedField field = project(5.0 * fields_.col(1));
  EXPECT_LT(field.eta.norm(), 1e-12);
  EXPECT_NEAR(field.rigid_fraction, 1.0, 1e-12);
  EXPECT_EQ(field.missed_fraction, 0.0);
  EXPECT_EQ(project(VectorX::Zero(36)).rigid_fraction, 0.0);
}

TEST_F(InitialField, HasAKeyOfItsValues) {
  VectorX u = fields_.col(7);
  const std::string key = project(u).key;
  EXPECT_EQ(find_field_key(u), key);
  u[35] *= 1.0 + 1e-15;
  EXPECT_NE(find_field_key(u), key);
}

TEST(LossesOfAnInitialField, AreToldFromOnePerCentOn) {
  ProjectedField field;
  field.rigid_fraction = field.missed_fraction = 0.0099;
  EXPECT_THAT(describe_losses(field, "initial velocity"), IsEmpty());
  field.rigid_fraction = 0.25;
  EXPECT_THAT(describe_losses(field, "initial velocity"),
              ElementsAre(AllOf(HasSubstr("25 % of the initial velocity"),
                                HasSubstr("rigid motion"))));
  field.missed_fraction = 0.125;
  EXPECT_THAT(
      describe_losses(field, "field"),
      ElementsAre(HasSubstr("25 %"), AllOf(HasSubstr("12.5 % of the field"),
                                           HasSubstr("not in the basis"))));
}

}  // namespace
}  // namespace limber::flexbody::initial_deformation_test
