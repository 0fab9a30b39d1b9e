// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/spin.hpp"

#include <gtest/gtest.h>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/qr.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/surface_matrix.hpp"
#include "unit/fem/meshes.hpp"

/// Against dense solutions of the same equations.
namespace limber::fem::spin_test {
namespace {

using testing::BoxKind;

constexpr double kRoundoff = 1e-10;  // of a stiffness with condition 1e6

MatrixX full_stiffness(const SparseMatrix& K_lower) {
  const MatrixX lower = K_lower;
  return lower.selfadjointView<Eigen::Lower>();
}

/// M E, built entry by entry.
MatrixX full_centrifugal(const SparseMatrix& M_s, const Vector3& axis) {
  const Matrix3 E = Matrix3::Identity() - axis * axis.transpose();
  const MatrixX M = M_s;
  MatrixX ME(3 * M.rows(), 3 * M.cols());
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    for (Eigen::Index j = 0; j < M.cols(); ++j)
      ME.block<3, 3>(3 * i, 3 * j) = M(i, j) * E;
  return ME;
}

/// A box of steel, free or held at the face "root"; 3 x 2 x 3 hexahedra.
struct Box {
  explicit Box(bool is_clamped)
      : mesh(read_mesh(testing::convert(
                           testing::write_file(
                               "box.geo", testing::box_geo(BoxKind::hexahedra)),
                           "box.msh", {.order = 1}),
                       {})),
        matrices(assemble(mesh, {{210e9, 0.3, 7850.0}})),
        x(mesh.x),
        R(make_rigid_modes(matrices.M_s, x)) {
    if (!is_clamped) return;
    const std::vector<int> free =
        find_free_nodes(mesh, mesh.groups[find_group(mesh, "root")].nodes);
    matrices = restrict_to(matrices, free);
    x = mesh.x(Eigen::all, free);
    R.resize(matrices.dof_count(), 0);
  }

  /// Orthonormal columns that span all motions orthogonal to R in M.
  [[nodiscard]] MatrixX elastic_motions() const {
    const Eigen::Index dofs = matrices.dof_count();
    if (R.cols() == 0) return MatrixX::Identity(dofs, dofs);
    const MatrixX MR = multiply_mass(matrices.M_s, R);
    const MatrixX Q = dense::find_q(MR, MR.rows());
    return Q.rightCols(dofs - R.cols());
  }

  Mesh mesh;
  StructuralMatrices matrices;
  Matrix3X x;
  MatrixX R;
};

class SpunBox : public ::testing::TestWithParam<bool> {
 protected:
  Box box_{GetParam()};
  ElasticInverse inverse_{box_.matrices, box_.R, box_.x};
  Vector3 axis_ = Vector3(1.0, -0.5, 2.0).normalized();
  MatrixX V_ = box_.elastic_motions();
  MatrixX K_ = V_.transpose() * full_stiffness(box_.matrices.K) * V_;
  MatrixX ME_ =
      V_.transpose() * full_centrifugal(box_.matrices.M_s, axis_) * V_;

  /// Of K x = Omega^2 M E x, densely.
  [[nodiscard]] double dense_critical_speed() const {
    const VectorX values = dense::find_eigenpairs(ME_, K_).values;
    return 1.0 / std::sqrt(values[ME_.cols() - 1]);
  }
};

INSTANTIATE_TEST_SUITE_P(Support, SpunBox, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Clamped" : "Free";
                         });

TEST_P(SpunBox, CriticalSpeedIsTheLowestEigenvalueOfTheDensePencil) {
  const double expected = dense_critical_speed();
  EXPECT_NEAR(find_critical_speed(inverse_, axis_) / expected, 1.0, kRoundoff);
}

TEST_P(SpunBox, DeformationIsThatOfADenseSolver) {
  VectorX F(box_.matrices.dof_count());
  for (Eigen::Index i = 0; i < F.size(); ++i)
    F[i] = std::sin(1.7 * static_cast<double>(i));
  for (const double fraction : {0.0, 0.3, 0.9, 0.999}) {
    const double speed = fraction * dense_critical_speed();
    const MatrixX A = K_ - speed * speed * ME_;
    const VectorX expected = V_ * dense::solve(A, VectorX(V_.transpose() * F));
    const VectorX found = solve_spun(inverse_, axis_, speed, F);
    // What the softening leaves of the lowest stiffness is lost in digits.
    const double tolerance = kRoundoff / (1.0 - fraction * fraction);
    EXPECT_LT((found - expected).norm(), tolerance * expected.norm())
        << fraction;
  }
}

TEST_P(SpunBox, NoDeformationIsFoundAboveTheCriticalSpeed) {
  const VectorX F = VectorX::LinSpaced(box_.matrices.dof_count(), -1.0, 3.0);
  EXPECT_THROW(
      (void)solve_spun(inverse_, axis_, 1.2 * dense_critical_speed(), F),
      NumericalError);
}

class SurfaceMatrixOf : public ::testing::TestWithParam<BoxKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, SurfaceMatrixOf,
                         ::testing::Values(BoxKind::tetrahedra,
                                           BoxKind::hexahedra,
                                           BoxKind::prisms));

TEST_P(SurfaceMatrixOf, ABoxHasItsAreaAndItsMoments) {
  for (const int order : {1, 2}) {
    const Mesh mesh = read_mesh(
        testing::convert(
            testing::write_file("box.geo", testing::box_geo(GetParam())),
            "box.msh", {.order = order}),
        {});
    const MatrixX mesh_surface = assemble_surface_matrix(mesh);
    const Vector3& s = testing::kBoxSize;
    const double area = 2.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]);
    EXPECT_NEAR(mesh_surface.sum(), area, 1e-12 * area);
    const VectorX x = mesh.x.row(0).transpose().array() -
                      (testing::kBoxCorner[0] + 0.5 * s[0]);
    // Two faces at x = a/2 and four strips: 2 bc a^2/4 + 2 (b + c) a^3/12.
    const double moment =
        s[0] * s[0] * (0.5 * s[1] * s[2] + s[0] * (s[1] + s[2]) / 6.0);
    EXPECT_NEAR(x.dot(mesh_surface * x), moment, 1e-12 * moment);
    EXPECT_NEAR((mesh_surface * x).sum(), 0.0, 1e-12 * area);
  }
}

TEST(LargestGradient, IsThatOfALinearField) {
  const Mesh mesh =
      read_mesh(testing::write_file("mixed.msh", testing::mixed_msh(0.05)), {});
  Matrix3 H;
  H << 0.0, -0.3, 0.0, 0.3, 0.0, 0.0, 0.0, 0.0, -0.2;
  const LargestGradient found = calc_largest_gradient(mesh, H * mesh.x);
  EXPECT_NEAR(found.strain, 0.2, 1e-12);
  EXPECT_NEAR(found.rotation, 0.3, 1e-12);
}

}  // namespace
}  // namespace limber::fem::spin_test
