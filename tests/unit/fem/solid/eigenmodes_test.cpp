// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/eigenmodes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/linalg/parallel.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::eigenmodes_test {
namespace {

using testing::BoxKind;
using testing::kBoxSize;
using testing::write_file;

const ElasticMaterial kSteel{210e9, 0.3, 7850.0};

MatrixX full_stiffness(const SparseMatrix& K_lower) {
  const MatrixX lower = K_lower;
  return lower.selfadjointView<Eigen::Lower>();
}

MatrixX full_mass(const SparseMatrix& M_s) {
  return multiply_mass(M_s, MatrixX::Identity(3 * M_s.cols(), 3 * M_s.cols()));
}

/// A box and its matrices, free or held at the face "root".
struct Body {
  explicit Body(const std::filesystem::path& file, bool is_clamped = false,
                double unit = 1.0)
      : mesh(read_mesh(file, {.unit = unit})),
        matrices(assemble(mesh, {kSteel})),
        x(mesh.x),
        R(make_rigid_modes(matrices.M_s, x)) {
    if (!is_clamped) return;
    const std::vector<int>& held = mesh.groups[find_group(mesh, "root")].nodes;
    std::vector<int> free;
    for (int n = 0; n < static_cast<int>(mesh.node_count()); ++n)
      if (!std::binary_search(held.begin(), held.end(), n)) free.push_back(n);
    matrices = restrict_to(matrices, free);
    x = mesh.x(Eigen::all, free);
    R.resize(matrices.dof_count(), 0);
  }

  [[nodiscard]] ElasticInverse inverse() const { return {matrices, R, x}; }

  Mesh mesh;
  StructuralMatrices matrices;
  Matrix3X x;
  MatrixX R;
};

/// 600 to 1000 degrees of freedom: enough for Lanczos, few enough for a dense
/// solver.
std::filesystem::path write_box(BoxKind kind = BoxKind::hexahedra,
                                int order = 2) {
  return testing::convert(write_file("box.geo", testing::box_geo(kind)),
                          "box.msh", {.order = order});
}

class FreeAndClamped : public ::testing::TestWithParam<bool> {
 protected:
  Body body_{write_box(), GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Support, FreeAndClamped, ::testing::Bool(),
                         [](const auto& p) {
                           return p.param ? "Clamped" : "Free";
                         });

/// Lanczos is used for at most a third of all modes.
TEST_P(FreeAndClamped, EigenmodesAreThoseOfADenseSolver) {
  const ElasticInverse inverse = body_.inverse();
  const Eigen::Index dofs = body_.matrices.dof_count();
  ASSERT_GT(dofs, 600);
  const VectorX all = dense::find_eigenpairs(full_stiffness(body_.matrices.K),
                                             full_mass(body_.matrices.M_s))
                          .values;
  const Eigen::Index rigid = inverse.rigid_count();
  for (const int count : {1, 20, static_cast<int>((dofs - rigid) / 3)}) {
    const Eigenmodes modes = find_eigenmodes(inverse, count);
    ASSERT_EQ(modes.lambda.size(), count);
    const VectorX expected = all.segment(rigid, count);
    const double worst =
        ((modes.lambda - expected).array() / expected.array()).abs().maxCoeff();
    // The dense solver is good to eps times the largest eigenvalue.
    const double roundoff = 1e-15 * all[dofs - 1] / expected[0];
    EXPECT_LT(worst, 1e-12 + 10.0 * roundoff);
  }
}

TEST_P(FreeAndClamped, EigenmodesAreOrthonormalAndFreeOfRigidMotion) {
  const Eigenmodes modes = find_eigenmodes(body_.inverse(), 24);
  const MatrixX M_Phi = multiply_mass(body_.matrices.M_s, modes.Phi);
  EXPECT_LT((modes.Phi.transpose() * M_Phi - MatrixX::Identity(24, 24))
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
  EXPECT_LT((body_.R.transpose() * M_Phi).norm(), 1e-12);  // of a free one
  const MatrixX K =
      modes.Phi.transpose() * multiply_stiffness(body_.matrices.K, modes.Phi);
  const MatrixX expected = modes.lambda.asDiagonal();
  EXPECT_LT((K - expected).cwiseAbs().maxCoeff() / modes.lambda[23], 1e-12);
}

TEST_P(FreeAndClamped, ElasticInverseAnswersLoadsToRoundoff) {
  const ElasticInverse inverse = body_.inverse();
  std::mt19937_64 random{7};
  std::normal_distribution<double> normal;
  MatrixX F(body_.matrices.dof_count(), 9);
  for (double& value : F.reshaped()) value = normal(random);
  const MatrixX X = inverse.solve(F);
  // What remains of the load after the rigid acceleration that it causes.
  const MatrixX MR = multiply_mass(body_.matrices.M_s, body_.R);
  const MatrixX load = F - MR * (body_.R.transpose() * F);
  const MatrixX residual = multiply_stiffness(body_.matrices.K, X) - load;
  EXPECT_LT(residual.norm() / load.norm(), 1e-9);
  EXPECT_LE((MR.transpose() * X).norm(), 1e-12 * MR.norm() * X.norm());
  // Betti: the work of one load on the response to another is symmetric.
  const MatrixX work = F.transpose() * X;
  EXPECT_LT((work - work.transpose()).norm() / work.norm(), 1e-11);
}

TEST_P(FreeAndClamped, ElasticInverseLeavesOutTheModesThatItIsGiven) {
  const ElasticInverse inverse = body_.inverse();
  const MatrixX V = find_eigenmodes(inverse, 6).Phi;
  std::mt19937_64 random{7};
  std::normal_distribution<double> normal;
  MatrixX F(body_.matrices.dof_count(), 9);
  for (double& value : F.reshaped()) value = normal(random);
  const MatrixX X = inverse.solve(F, V);
  const MatrixX KX = multiply_stiffness(body_.matrices.K, X);
  EXPECT_LT((V.transpose() * KX).norm(), 1e-9 * V.norm() * F.norm());
  // The load less what holds the modes and rigid motion.
  MatrixX held(V.rows(), V.cols() + body_.R.cols());
  held << V, body_.R;
  const MatrixX load =
      F - multiply_mass(body_.matrices.M_s, held) * (held.transpose() * F);
  EXPECT_LT((KX - load).norm() / load.norm(), 1e-9);
}

TEST_P(FreeAndClamped, ResultsAreTheSameForAnyNumberOfThreads) {
  const auto solve = [&](unsigned threads) {
    set_thread_count(threads);
    EXPECT_EQ(thread_count(), threads);
    const Body body(testing::make_test_folder() / "box.msh", GetParam());
    const ElasticInverse inverse = body.inverse();
    // More loads than are solved for together.
    MatrixX loads(body.matrices.dof_count(), 40);
    for (Eigen::Index i = 0; i < loads.size(); ++i) {
      loads(i) = std::sin(0.1 * static_cast<double>(i * i));
    }
    return std::array{MatrixX(body.matrices.K),
                      multiply_mass(body.matrices.M_s, loads),
                      inverse.solve(loads), find_eigenmodes(inverse, 20).Phi};
  };
  const auto one = solve(1);
  for (const unsigned threads : {2U, 5U}) {
    const auto several = solve(threads);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i], several[i]) << threads << " threads, result " << i;
    }
  }
  set_thread_count(0);
}

/// Frequencies go with 1/L: eigenvalues with 1/L^2.
TEST(Eigenmodes, DoNotDependOnTheUnitOfLength) {
  const auto file = write_box(BoxKind::tetrahedra);
  const auto scaled = [&](double unit) {
    const Body body(file, false, unit);
    EXPECT_GT(body.matrices.dof_count(), 600);
    return VectorX(find_eigenmodes(body.inverse(), 20).lambda * unit * unit);
  };
  const VectorX expected = scaled(1.0);
  for (const double length : {1e-3, 100.0}) {
    const VectorX found = scaled(length / kBoxSize[0]);
    EXPECT_LT(((found - expected).array() / expected.array()).abs().maxCoeff(),
              1e-9)
        << length << " m";
  }
}

/// A cube's symmetry makes modes in pairs and threes, and the spectrum the
/// same along each axis.
TEST(Eigenmodes, FindsTheRepeatedOnesOfACube) {
  const auto geo = write_file(
      "cube.geo",
      "Point(1) = {0, 0, 0};\n"
      "line[] = Extrude {1, 0, 0} { Point{1}; Layers{4}; Recombine; };\n"
      "face[] = Extrude {0, 1, 0} { Line{line[1]}; Layers{4}; Recombine; };\n"
      "body[] = Extrude {0, 0, 1} { Surface{face[1]}; Layers{4}; Recombine; "
      "};\n");
  const Body body(geo);
  const VectorX lambda = find_eigenmodes(body.inverse(), 30).lambda;
  // Irreducible representations of the cube's group have dimension 1, 2, 3.
  constexpr double kSame = 1e-9;
  Eigen::Index first = 0;
  int several = 0;
  for (Eigen::Index i = 1; i < lambda.size(); ++i) {
    if (lambda[i] / lambda[i - 1] - 1.0 < kSame) continue;
    EXPECT_GT(lambda[i] / lambda[i - 1] - 1.0, 1e-6) << "nearly equal";
    EXPECT_LE(i - first, 3);
    if (i - first > 1) ++several;
    first = i;
  }
  EXPECT_GT(several, 5);
}

/// A matrix of `count` equal blocks.
SparseMatrix repeat(const SparseMatrix& block, int count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int b = 0; b < count; ++b) {
    const auto first = static_cast<int>(b * block.cols());
    for (int j = 0; j < block.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator it(block, j); it; ++it) {
        entries.emplace_back(first + static_cast<int>(it.row()), first + j,
                             it.value());
      }
    }
  }
  SparseMatrix whole(count * block.rows(), count * block.cols());
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

/// Twelve boxes that nothing joins: every eigenvalue twelve times, more often
/// than one Krylov space holds it.
TEST(Eigenmodes, ComeAsOftenAsTheirEigenvalueIsRepeated) {
  constexpr int kBoxes = 12;
  const Body box(write_box(), true);
  const VectorX expected = find_eigenmodes(box.inverse(), 3).lambda;
  const StructuralMatrices matrices{.M_s = repeat(box.matrices.M_s, kBoxes),
                                    .K = repeat(box.matrices.K, kBoxes)};
  const ElasticInverse inverse(matrices, MatrixX(matrices.dof_count(), 0),
                               box.x.replicate(1, kBoxes));
  const VectorX found = find_eigenmodes(inverse, kBoxes + 5).lambda;
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i] / expected[i / kBoxes], 1.0, 1e-9) << i;
  }
}

/// Eigenvalues span thirteen decades, of which a dense solver in double
/// precision leaves the lowest four digits; long double has four more. (Against
/// its own rounding of K nothing helps.)
TEST(Eigenmodes, TheLowestOfAThinBarKeepTheirDigits) {
  const auto geo = write_file(
      "bar.geo",
      "Point(1) = {0, 0, 0};\n"
      "line[] = Extrude {1, 0, 0} { Point{1}; Layers{10}; Recombine; };\n"
      "face[] = Extrude {0, 0.001, 0} { Line{line[1]}; Layers{1}; Recombine; "
      "};\n"
      "body[] = Extrude {0, 0, 0.0008} { Surface{face[1]}; Layers{1}; "
      "Recombine; };\n");
  const Body body(geo);
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Matrix K = full_stiffness(body.matrices.K).cast<long double>();
  const Matrix M = full_mass(body.matrices.M_s).cast<long double>();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> exact(
      K, M, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  const Eigenmodes modes = find_eigenmodes(body.inverse(), 8);
  for (Eigen::Index i = 0; i < modes.lambda.size(); ++i) {
    const auto expected = static_cast<double>(exact.eigenvalues()[6 + i]);
    EXPECT_NEAR(modes.lambda[i] / expected, 1.0, 2e-5) << i;
  }
}

TEST(Eigenmodes, MoreThanTheMeshHasAreRefused) {
  const Body body(write_file("one.msh", testing::unit_tetrahedron().str()));
  const ElasticInverse inverse = body.inverse();
  EXPECT_EQ(find_eigenmodes(inverse, 6).lambda.size(), 6);
  EXPECT_EQ(find_eigenmodes(inverse, 0).lambda.size(), 0);
  EXPECT_THROW(static_cast<void>(find_eigenmodes(inverse, 7)), InputError);
  EXPECT_THROW(static_cast<void>(find_eigenmodes(inverse, -1)), ContractError);
}

}  // namespace
}  // namespace limber::fem::eigenmodes_test
