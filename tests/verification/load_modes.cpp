// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/SparseLU>
#include <cmath>
#include <random>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/reduction/meshed_body.hpp"
#include "limber/reduction/modal/static_modes.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/shear_load.hpp"

/// Nodal forces as a source of static-deformation modes, and Krylov terms.
namespace limber::load_modes {
namespace {

using flexbody::MeshedBody;
using flexbody::Recipe;
using flexbody::ReducedBody;
using test::beam;

// K^+ is refined to roundoff of K x, condition number 1e7 of this mesh.
constexpr double kSolve = 1e-9;

Recipe recipe_with(const MatrixX& forces, bool is_clamped) {
  Recipe recipe = test::beam_recipe("beam579_v41.msh", is_clamped);
  recipe.basis.eigenmodes = 4;
  recipe.rows = flexbody::parse_rows({"all"});
  std::vector<double> times;
  for (Eigen::Index i = 0; i < forces.cols(); ++i)
    times.push_back(static_cast<double>(i));
  recipe.nodal_forces = {{"forces.txt", times, forces}};
  return recipe;
}

/// On free nodes of the clamped beam: the shear load turning in x and y.
MatrixX turning_shear(Eigen::Index columns) {
  const VectorX x = test::shear_load(beam());
  VectorX y = VectorX::Zero(x.size());
  y.tail(x.size() - 1) = x.head(x.size() - 1);
  MatrixX F(x.size(), columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    const double angle = 0.1 * static_cast<double>(i);
    F.col(i) = std::cos(angle) * x + std::sin(angle) * y;
  }
  return F;
}

TEST(LoadModes, AnswerEveryColumnOfAHistoryStatically) {
  const MatrixX F = turning_shear(300);
  const Recipe recipe = recipe_with(F, true);
  const ReducedBody body = flexbody::reduce(recipe);
  EXPECT_EQ(body.mode_count(), 4 + 2);  // two directions
  const MeshedBody meshed(recipe, {});
  const MatrixX exact = meshed.inverse.solve(F.leftCols(9));
  const MatrixX Phi =
      flexbody::take_rows(body.rows.Phi_B, meshed.support.free_nodes);
  const MatrixX ours = Phi * body.lambda.cwiseInverse().asDiagonal() *
                       (Phi.transpose() * F.leftCols(9));
  EXPECT_LT((ours - exact).norm(), kSolve * exact.norm());
}

// A force field M a accelerates a free body and deforms nothing.
TEST(LoadModes, OfForcesThatOnlyMoveTheBodyAreNone) {
  const MeshedBody meshed(test::beam_recipe("beam579_v41.msh"), {});
  const VectorX a = Vector3(1.0, 2.0, 3.0).replicate(beam().x.cols(), 1);
  const VectorX F = fem::multiply_mass(meshed.support.matrices.M_s, a);
  EXPECT_EQ(flexbody::reduce(recipe_with(F, false)).mode_count(), 4);
  const MatrixX both = F + turning_shear(1).norm() * VectorX::Unit(F.size(), 0);
  EXPECT_EQ(flexbody::reduce(recipe_with(both, false)).mode_count(), 5);
}

TEST(LoadModes, AreTheLargestOfManyAndTheRestIsReported) {
  constexpr Eigen::Index kColumns = 30;
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  MatrixX F = MatrixX::NullaryExpr(test::shear_load(beam()).size(), kColumns,
                                   [&] { return number(engine); });
  for (Eigen::Index i = 0; i < kColumns; ++i)
    F.col(i) *= std::pow(10.0, -0.05 * static_cast<double>(i));
  const Recipe recipe = recipe_with(F, true);
  const ReducedBody body = flexbody::reduce(recipe);
  ASSERT_EQ(body.load_modes.size(), 1U);
  const flexbody::LoadModesRecord& record = body.load_modes[0];
  EXPECT_EQ(record.directions, kColumns);
  EXPECT_EQ(record.taken, flexbody::kMostForceModes);
  EXPECT_EQ(body.mode_count(), 4 + record.taken);
  // Best in the norm of elastic energy: the singular values of L^-1 F.
  const MeshedBody meshed(recipe, {});
  const MatrixX C = F.transpose() * meshed.inverse.solve(F);
  const VectorX energy =
      dense::find_eigenvalues(MatrixX(0.5 * (C + C.transpose())));
  const double expected =
      std::sqrt(energy.head(kColumns - 12).sum() / energy.sum());
  EXPECT_NEAR(record.left_out, expected, 1e-6 * expected);
}

/// Amplitude under F cos(omega t), by a direct solve of the whole mesh.
VectorX shake(const MeshedBody& meshed, const VectorX& F, double omega) {
  const fem::StructuralMatrices& m = meshed.support.matrices;
  const auto n = m.dof_count();
  Eigen::SparseMatrix<double> A = m.K.selfadjointView<Eigen::Lower>();
  std::vector<Eigen::Triplet<double>> mass;
  for (Eigen::Index k = 0; k < m.M_s.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(m.M_s, k); it; ++it)
      for (int c = 0; c < 3; ++c)
        mass.emplace_back(static_cast<int>(3 * it.row() + c),
                          static_cast<int>(3 * it.col() + c), it.value());
  Eigen::SparseMatrix<double> M(n, n);
  M.setFromTriplets(mass.begin(), mass.end());
  A -= omega * omega * M;
  return Eigen::SparseLU<Eigen::SparseMatrix<double>>(A).solve(F);
}

double find_shaking_error(const MeshedBody& meshed, const Recipe& recipe,
                          const VectorX& F, double omega) {
  const ReducedBody body = flexbody::reduce(recipe);
  const MatrixX Phi =
      flexbody::take_rows(body.rows.Phi_B, meshed.support.free_nodes);
  const VectorX eta =
      (Phi.transpose() * F)
          .cwiseQuotient((body.lambda.array() - omega * omega).matrix());
  const VectorX exact = shake(meshed, F, omega);
  return (Phi * eta - exact).norm() / exact.norm();
}

// n terms match the response's expansion in omega^2 up to its term n - 1, so
// the displacement is wrong by (omega / omega_1)^(2 n) (the memorandum's
// section 5; a Galerkin projection onto a Krylov space).
TEST(KrylovTerms, OfNAreWrongByTheFrequencyToThePower2N) {
  const VectorX F = test::shear_load(beam());
  Recipe recipe = recipe_with(F, true);
  recipe.basis.eigenmodes = 0;
  const MeshedBody meshed(recipe, {});
  const double omega1 =
      std::sqrt(test::reference_eigenvalues("beam579", "clamped", 5)[0]);
  for (const int terms : {1, 2, 3}) {
    recipe.basis.terms = terms;
    const double coarse = find_shaking_error(meshed, recipe, F, 0.4 * omega1);
    const double fine = find_shaking_error(meshed, recipe, F, 0.2 * omega1);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0 * terms, 0.5) << terms;
    EXPECT_LT(fine, std::pow(0.2, 2 * terms));
  }
}

TEST(KrylovTerms, StayIndependentWherePlainPowersDoNot) {
  Recipe recipe = recipe_with(test::shear_load(beam()), true);
  recipe.basis.eigenmodes = 0;
  recipe.basis.terms = 16;
  EXPECT_EQ(flexbody::reduce(recipe).mode_count(), 16);
}

}  // namespace
}  // namespace limber::load_modes
