// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/block_inertia.hpp"

#include <gtest/gtest.h>

#include "limber/flexbody/model/shape_integrals.hpp"
#include "unit/reduction/matrices/mass_points.hpp"

/// Inertia integrals from a mass matrix, against sums over its mass points.
namespace limber::flexbody::matrices_test {
namespace {

struct Read {
  Read(const fem::MatrixModel& model, const MatrixX& Phi)
      : system(make_matrix_system(model, 1.0)),
        blocks(system),
        X(make_rigid_motions(system)),
        inertia(calc_rigid_inertia(system, X)),
        integrals(calc_block_integrals(system, blocks,
                                       move_origin(X, inertia.center), Phi)) {}

  MatrixSystem system;
  MassBlocks blocks;
  MatrixX X;
  RigidInertia inertia;
  InertiaShapeIntegrals integrals;
};

double find_largest(const std::vector<Matrix3>& all) {
  double largest = 0.0;
  for (const Matrix3& one : all)
    largest = std::max(largest, one.cwiseAbs().maxCoeff());
  return largest;
}

void expect_equal(const InertiaShapeIntegrals& found,
                  const InertiaShapeIntegrals& expected, double tolerance) {
  EXPECT_LT((found.S0 - expected.S0).cwiseAbs().maxCoeff(),
            tolerance * expected.S0.cwiseAbs().maxCoeff());
  EXPECT_LT((found.P - expected.P).cwiseAbs().maxCoeff(),
            tolerance * expected.P.cwiseAbs().maxCoeff());
  const double S1 = find_largest(expected.S1);
  for (std::size_t k = 0; k < expected.S1.size(); ++k)
    EXPECT_LT((found.S1[k] - expected.S1[k]).cwiseAbs().maxCoeff(),
              tolerance * S1)
        << k;
  const double S2 = find_largest(expected.S2);
  for (std::size_t k = 0; k < expected.S2.size(); ++k)
    EXPECT_LT((found.S2[k] - expected.S2[k]).cwiseAbs().maxCoeff(),
              tolerance * S2)
        << k;
}

Matrix3X draw_nodes(Draw& draw, int count) { return draw.matrix(3, count); }

void expect_exact(const PointModel& model, Draw& draw) {
  const MatrixX Phi = draw.matrix(model.rows(), 5);
  const MatrixX none = MatrixX::Zero(model.rows(), model.rows());
  const Read read(make_model(model.x, none, model.mass_matrix()), Phi);
  EXPECT_NEAR(read.inertia.mass, model.mass(), 1e-13 * model.mass());
  EXPECT_LT((read.inertia.center - model.center()).norm(), 1e-13);
  EXPECT_LT(read.inertia.defect, 1e-13);
  EXPECT_LT(calc_block_defect(read.system, read.blocks, read.inertia), 1e-12);
  expect_equal(read.integrals, model.sum(Phi), 1e-12);
}

TEST(BlockInertia, OfAScalarMassIsThatOfAMesh) {
  Draw draw;
  const int nodes = 12;
  const Matrix3X x = draw_nodes(draw, nodes);
  const MatrixX B = draw.matrix(nodes, nodes);
  const MatrixX M_s = B * B.transpose() + MatrixX::Identity(nodes, nodes);
  MatrixX M = MatrixX::Zero(3 * nodes, 3 * nodes);
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j)
      M.block<3, 3>(3 * i, 3 * j) = M_s(i, j) * Matrix3::Identity();
  const MatrixX Phi = draw.matrix(3 * nodes, 6);
  const Read read(make_model(x, MatrixX::Zero(M.rows(), M.cols()), M, 3), Phi);
  const Matrix3X x_B = x.colwise() - read.inertia.center;
  expect_equal(read.integrals, calc_shape_integrals(M_s.sparseView(), x_B, Phi),
               3e-15);
}

TEST(BlockInertia, OfMassesWithInertiaAndOffsetIsExact) {
  Draw draw;
  PointModel model{draw_nodes(draw, 9), {}};
  for (int n = 0; n < 9; ++n)
    for (int p = 0; p < 4; ++p)
      model.points.push_back({1.5 + draw(), {n}, {1.0}, {0.4 * draw.vector()}});
  expect_exact(model, draw);
}

/// As in a plate or shell: at each place the same weights and, through the
/// thickness, the same offset from all nodes.
TEST(BlockInertia, OfInterpolationAlikeInAllDirectionsIsExact) {
  Draw draw;
  PointModel model{draw_nodes(draw, 8), {}};
  model.x.row(2).setZero();
  for (int p = 0; p < 30; ++p) {
    MassPoint point{1.5 + draw(), {p % 8, (p + 1) % 8, (p + 3) % 8}, {}, {}};
    const double a = 0.3 + 0.2 * draw();
    const double b = 0.3 + 0.2 * draw();
    point.N = {a, b, 1.0 - a - b};
    point.d.assign(3, Vector3(0.0, 0.0, 0.1 * draw()));
    model.points.push_back(point);
  }
  expect_exact(model, draw);
}

TEST(BlockInertia, OfAMeanOverDistantNodesHasADefect) {
  Draw draw;
  PointModel model{draw_nodes(draw, 6), {}};
  for (int n = 0; n < 6; ++n)
    model.points.push_back({0.1, {n}, {1.0}, {Vector3::Zero()}});
  // Its offsets from the nodes differ: an averaging connection.
  MassPoint mean{10.0, {0, 1, 2, 3, 4, 5}, std::vector<double>(6, 1.0 / 6), {}};
  for (int n = 0; n < 6; ++n)
    mean.d.push_back(Vector3(0.0, 0.0, 2.0) - model.x.col(n));
  model.points.push_back(mean);
  const MatrixX none = MatrixX::Zero(model.rows(), model.rows());
  const MatrixX F = model.field(mean);
  MatrixX M = model.mass_matrix() - 10.0 * F.transpose() * F;
  // The rotation of such a connection is a mean of translations.
  MatrixX rotation = MatrixX::Zero(3, model.rows());
  Matrix3 A = Matrix3::Zero();
  const Vector3 center = model.x.rowwise().mean();
  for (int n = 0; n < 6; ++n) {
    const Matrix3 d = skew(Vector3(model.x.col(n) - center));
    A -= d * d;
  }
  MatrixX translation = MatrixX::Zero(3, model.rows());
  for (int n = 0; n < 6; ++n) {
    translation.middleCols<3>(6 * n) = Matrix3::Identity() / 6.0;
    rotation.middleCols<3>(6 * n) =
        A.inverse() * skew(Vector3(model.x.col(n) - center));
  }
  const MatrixX motion =
      translation - skew(Vector3(Vector3(0.0, 0.0, 2.0) - center)) * rotation;
  M += 10.0 * motion.transpose() * motion;
  const Read read(make_model(model.x, none, M), MatrixX::Zero(M.rows(), 0));
  EXPECT_LT(read.inertia.defect, 1e-12);
  EXPECT_GT(calc_block_defect(read.system, read.blocks, read.inertia), 0.1);
}

}  // namespace
}  // namespace limber::flexbody::matrices_test
