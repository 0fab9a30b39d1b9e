// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/eigenmodes.hpp"
#include "limber/flexbody/modal/decision_boundary.hpp"
#include "limber/reduction/reduce.hpp"
#include "places.hpp"
#include "support/draw_vector.hpp"
#include "verification/body_reference.hpp"

/// The alpha-Omega decision boundary of the report's section 5.4, ten modes.
namespace limber::report_boundary {
namespace {

/// The allowance: inner nodes of the report's mesh sit elsewhere.
constexpr double kOtherMesh = 0.005;

class ReportBoundaryOfBeam : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
    recipe.basis.eigenmodes = 10;
    recipe.rows.extent = flexbody::KeptRows::Extent::all;
    body_ = std::make_unique<flexbody::ReducedBody>(flexbody::reduce(recipe));
    const fem::Mesh mesh = fem::read_mesh(recipe.mesh.file);
    ASSERT_EQ(mesh.tags, body_->rows.tags);
    M_s_ = std::make_unique<fem::SparseMatrix>(
        fem::assemble(mesh,
                      fem::assign_materials(mesh, {{"", {200e9, 0.0, 8000.0}}}))
            .M_s);
  }
  static void TearDownTestSuite() {
    body_.reset();
    M_s_.reset();
  }
  /// Row sums: the report's masses.
  static VectorX lumped() { return *M_s_ * VectorX::Ones(M_s_->cols()); }
  static double report_limit(double displacement) {
    return flexbody::find_report_displacement_boundary(
        body_->rows.Phi_B, body_->lambda, lumped(), body_->rows.x_B,
        displacement);
  }

  static std::unique_ptr<flexbody::ReducedBody> body_;
  static std::unique_ptr<fem::SparseMatrix> M_s_;
};
std::unique_ptr<flexbody::ReducedBody> ReportBoundaryOfBeam::body_;
std::unique_ptr<fem::SparseMatrix> ReportBoundaryOfBeam::M_s_;

// Report, section 5.4: 1 um and 5 cm.
TEST_F(ReportBoundaryOfBeam, OfDisplacementHasTheReportsFigures) {
  EXPECT_NEAR(report_limit(1e-6) / 1.19, 1.0, kOtherMesh);
  EXPECT_NEAR(report_limit(0.05) / 59570.0, 1.0, kOtherMesh);
}

// Stored in the reduced body, independent of its rows.
TEST_F(ReportBoundaryOfBeam, IsKeptByTheReducedBody) {
  constexpr double kRoundoff = 1e-9;
  const flexbody::InertialLevers& levers = body_->levers;
  EXPECT_NEAR(1e-6 / levers.displacement / report_limit(1e-6), 1.0, kRoundoff);
  EXPECT_NEAR(levers.lumped * flexbody::find_report_force_boundary(
                                  lumped(), body_->rows.x_B, 1.0),
              1.0, kRoundoff);
  const Matrix3X g = (*M_s_ * body_->rows.x_B.transpose()).transpose();
  EXPECT_NEAR(flexbody::InertialForceBound(levers).calc_force(1.5, 1.2) /
                  flexbody::InertialForceBound(g).calc_force(1.5, 1.2),
              1.0, kRoundoff);
}

// The plain box that Gmsh itself meshes to the report's counts; an independent
// program gives 1.191 and 59560 with Gmsh 4.8.
TEST(ReportBoundaryOfBox, OfDisplacementHasTheReportsFigures) {
  const fem::Mesh mesh = fem::read_mesh(
      std::string(LIMBER_SOURCE_DIR) + "/meshes/box/box.geo", {0.55, 2, 1.0});
  const fem::StructuralMatrices matrices = fem::assemble(
      mesh, fem::assign_materials(mesh, {{"", {200e9, 0.0, 8000.0}}}));
  const fem::ElasticInverse inverse(
      matrices, fem::make_rigid_modes(matrices.M_s, mesh.x), mesh.x);
  const fem::Eigenmodes modes = fem::find_eigenmodes(inverse, 10);
  const VectorX m = matrices.M_s * VectorX::Ones(mesh.x.cols());
  const Matrix3X x_B = mesh.x.colwise() - Vector3(mesh.x * m / m.sum());
  const double boundary = flexbody::find_report_displacement_boundary(
      modes.Phi, modes.lambda, m, x_B, 1e-6);
  EXPECT_NEAR(boundary / 1.19, 1.0, kOtherMesh);
  EXPECT_NEAR(0.05 / 1e-6 * boundary / 59570.0, 1.0, kOtherMesh);
}

// Eq. 31 ignores the corners, whose row sums are negative and where the largest
// m |b| is.
TEST_F(ReportBoundaryOfBeam, OfForceIsNoBoundWithRowSums) {
  const VectorX m = lumped();
  const VectorX levers =
      m.cwiseAbs().cwiseProduct(body_->rows.x_B.colwise().norm().transpose());
  Eigen::Index worst = 0;
  const double largest = levers.maxCoeff(&worst);
  EXPECT_LT(m[worst], 0.0);
  const double boundary =
      flexbody::find_report_force_boundary(m, body_->rows.x_B, 1.0);
  EXPECT_GT(boundary * largest, 1.0);  // a force above the limit of 1 N
}

// Nodal forces M a of the consistent mass, for random directions.
TEST_F(ReportBoundaryOfBeam, ForceBoundHoldsForTheConsistentMass) {
  const Matrix3X g = (*M_s_ * body_->rows.x_B.transpose()).transpose();
  const flexbody::InertialForceBound bound(g);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return testing::draw_vector([&] { return normal(random); }).normalized();
  };
  double largest = 0.0;
  for (int sample = 0; sample < 500; ++sample) {
    const Vector3 alpha = 1.5 * direction();
    const Vector3 Omega = 1.2 * direction();
    Matrix3X a = body_->rows.x_B;
    for (Eigen::Index n = 0; n < a.cols(); ++n) {
      const Vector3 b = a.col(n);
      a.col(n) = alpha.cross(b) + Omega.cross(Omega.cross(b));
    }
    const Matrix3X f = (*M_s_ * a.transpose()).transpose();
    largest = std::max(largest, f.colwise().norm().maxCoeff());
  }
  EXPECT_LE(largest, bound.calc_force(1.5, 1.2));
  EXPECT_GE(largest, 0.9 * bound.calc_force(1.5, 1.2));
}

// Inertial forces M a of the whole mesh, through the ten modes.
TEST_F(ReportBoundaryOfBeam, DisplacementBoundHoldsAndTheReportsIsSafe) {
  const flexbody::InertialDisplacementBound bound(*body_);
  const MatrixX& Phi = body_->rows.Phi_B;
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    return testing::draw_vector([&] { return normal(random); });
  };
  double largest = 0.0;
  for (int sample = 0; sample < 500; ++sample) {
    const Vector3 Omega = vector().normalized();
    const Vector3 alpha = vector();
    Matrix3X a = body_->rows.x_B;
    for (Eigen::Index n = 0; n < a.cols(); ++n) {
      const Vector3 b = a.col(n);
      a.col(n) = -alpha.cross(b) - Omega.cross(Omega.cross(b));
    }
    const Matrix3X f = (*M_s_ * a.transpose()).transpose();
    const VectorX eta =
        (Phi.transpose() * f.reshaped()).cwiseQuotient(body_->lambda);
    const VectorX u = Phi * eta;
    largest = std::max(
        largest,
        u.reshaped(3, body_->rows.x_B.cols()).colwise().norm().maxCoeff());
  }
  const double limit = bound.calc_displacement(0.0, 1.0);
  EXPECT_LE(largest, limit * (1.0 + 1e-9));
  EXPECT_GE(largest, 0.7 * limit);
  // The mean-axis frame: the Euler force deforms nothing.
  EXPECT_LT(bound.calc_displacement(1.0, 0.0), 1e-9 * limit);
  // On this beam the report errs to the safe side, even for a sudden spin.
  const flexbody::InertialDisplacementBound sudden(*body_,
                                                   flexbody::Onset::sudden);
  EXPECT_GE(sudden.calc_displacement(0.0, 1.0), 2.0 * largest);
  EXPECT_LE(limit, 1e-6 / report_limit(1e-6));
}

}  // namespace
}  // namespace limber::report_boundary
