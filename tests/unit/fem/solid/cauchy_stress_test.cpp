// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/cauchy_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "limber/common/rotation.hpp"
#include "limber/fem/solid/stress_recovery.hpp"
#include "unit/fem/meshes.hpp"

/// Against closed forms of the laws for homogeneous deformations.
namespace limber::fem::cauchy_stress_test {
namespace {

using testing::BoxKind;

const ElasticMaterial kRubber{3e6, 0.4, 1000.0};

Mesh make_box(BoxKind kind) {
  return read_mesh(
      testing::convert(testing::write_file("box.geo", testing::box_geo(kind)),
                       "box.msh", {.order = 2}));
}

Matrix3X sample(const Mesh& mesh,
                const std::function<Vector3(const Vector3&)>& field) {
  Matrix3X u(3, mesh.x.cols());
  for (Eigen::Index n = 0; n < u.cols(); ++n) u.col(n) = field(mesh.x.col(n));
  return u;
}

std::vector<int> all_nodes(const Mesh& mesh) {
  std::vector<int> nodes(mesh.node_count());
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

Vector6 to_components(const Matrix3& t) {
  Vector6 s;
  s << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2);
  return s;
}

/// Written in terms of the left Cauchy-Green tensor b = F F^T.
Matrix3 expect_cauchy(Elasticity law, const Matrix3& F) {
  const double E = kRubber.youngs_modulus;
  const double nu = kRubber.poisson_ratio;
  const double lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const double mu = E / (2.0 * (1.0 + nu));
  const double J = F.determinant();
  const Matrix3 I = Matrix3::Identity();
  const Matrix3 b = F * F.transpose();
  if (law == Elasticity::neo_hookean) {
    return (mu * (b - I) + lambda * std::log(J) * I) / J;
  }
  return (0.5 * lambda * (b.trace() - 3.0) * b + mu * (b * b - b)) / J;
}

Matrix3 large_gradient() {
  Matrix3 F;
  F << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, -0.15, 0.1, 1.1;
  return exp_rotation(Vector3(0.8, -1.1, 0.6)) * F;
}

class CauchyOf : public ::testing::TestWithParam<Elasticity> {};

TEST_P(CauchyOf, AHomogeneousDeformationIsTheLawsOwn) {
  const Matrix3 F = large_gradient();
  const Vector6 expected = to_components(expect_cauchy(GetParam(), F));
  for (const BoxKind kind : {BoxKind::tetrahedra, BoxKind::hexahedra}) {
    const Mesh mesh = make_box(kind);
    const Matrix3X u = sample(mesh, [&](const Vector3& x) -> Vector3 {
      return F * x - x + Vector3(3.0, -2.0, 1.0);
    });
    const CauchyStress cauchy(mesh, {kRubber}, GetParam(), all_nodes(mesh));
    Matrix6X stress(6, mesh.x.cols());
    cauchy.evaluate(u, stress);
    EXPECT_LT((stress.colwise() - expected).cwiseAbs().maxCoeff(),
              1e-10 * expected.norm());
  }
}

// Both laws reduce to Hooke's; what they add is of second order.
TEST_P(CauchyOf, ASmallDeformationIsThatOfHookesLaw) {
  const Mesh mesh = make_box(BoxKind::tetrahedra);
  const auto find_difference = [&](double size) {
    const Matrix3X u = sample(mesh, [&](const Vector3& x) -> Vector3 {
      return size * Vector3(x[0] * x[0], x[0] * x[1] - x[2] * x[2],
                            std::sin(9.0 * x[1]));
    });
    Matrix6X stress(6, mesh.x.cols());
    CauchyStress(mesh, {kRubber}, GetParam(), all_nodes(mesh))
        .evaluate(u, stress);
    const MatrixX linear = recover_stress(mesh, {kRubber}, u.reshaped()).stress;
    return (stress - linear).norm() / linear.norm();
  };
  EXPECT_LT(find_difference(1e-6), 1e-4);
  EXPECT_NEAR(find_difference(1e-5) / find_difference(1e-6), 10.0, 0.5);
}

TEST_P(CauchyOf, SomeNodesIsThatOfAll) {
  const Mesh mesh = make_box(BoxKind::tetrahedra);
  const Matrix3X u = sample(mesh, [](const Vector3& x) -> Vector3 {
    return {x[0] * x[1], 0.5 * x[2] * x[2], x[0] * x[0]};
  });
  Matrix6X all(6, mesh.x.cols());
  CauchyStress(mesh, {kRubber}, GetParam(), all_nodes(mesh)).evaluate(u, all);
  const std::vector<int> some = {2, 5, 11};
  const CauchyStress cauchy(mesh, {kRubber}, GetParam(), some);
  ASSERT_EQ(cauchy.nodes(), some);
  Matrix6X stress(6, 3);
  cauchy.evaluate(u, stress);
  EXPECT_LT((stress - all(Eigen::all, some)).norm(), 1e-12 * all.norm());
}

INSTANTIATE_TEST_SUITE_P(Laws, CauchyOf,
                         ::testing::Values(Elasticity::st_venant_kirchhoff,
                                           Elasticity::neo_hookean));

}  // namespace
}  // namespace limber::fem::cauchy_stress_test
