// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/stress_recovery.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "unit/fem/meshes.hpp"

/// Against closed forms of Hooke's law for fields that elements reproduce.
namespace limber::fem::stress_recovery_test {
namespace {

using testing::BoxKind;

const ElasticMaterial kSteel{200e9, 0.3, 8000.0};

/// Displacement gradients of a field, written out.
Vector6 hooke(const ElasticMaterial& material, const Matrix3& H) {
  const double E = material.youngs_modulus;
  const double nu = material.poisson_ratio;
  const Matrix3 e = 0.5 * (H + H.transpose());
  const double fraction = E / ((1.0 + nu) * (1.0 - 2.0 * nu));
  Vector6 s;
  s[0] = fraction * ((1.0 - nu) * e(0, 0) + nu * (e(1, 1) + e(2, 2)));
  s[1] = fraction * ((1.0 - nu) * e(1, 1) + nu * (e(2, 2) + e(0, 0)));
  s[2] = fraction * ((1.0 - nu) * e(2, 2) + nu * (e(0, 0) + e(1, 1)));
  s[3] = E / (1.0 + nu) * e(0, 1);
  s[4] = E / (1.0 + nu) * e(1, 2);
  s[5] = E / (1.0 + nu) * e(0, 2);
  return s;
}

MatrixX sample(const Mesh& mesh,
               const std::function<Vector3(const Vector3&)>& field) {
  MatrixX u(3 * mesh.x.cols(), 1);
  for (Eigen::Index n = 0; n < mesh.x.cols(); ++n) {
    u.block<3, 1>(3 * n, 0) = field(mesh.x.col(n));
  }
  return u;
}

struct Case {
  std::string kind;
  int order = 1;
  bool serendipity = false;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.kind << c.order << (c.serendipity ? "_serendipity" : "");
}

class StressOf : public ::testing::TestWithParam<Case> {
 protected:
  StressOf() : mesh_(read()) {}

  static Mesh read() {
    using namespace testing;
    const auto& [kind, order, serendipity] = GetParam();
    const auto source =
        kind == "skew"       ? write_file("linear.msh", mixed_msh(0.05))
        : kind == "pyramids" ? write_file("linear.msh", pyramids_msh())
        : kind == "tetrahedra"
            ? write_file("box.geo", box_geo(BoxKind::tetrahedra))
        : kind == "hexahedra"
            ? write_file("box.geo", box_geo(BoxKind::hexahedra))
            : write_file("box.geo", box_geo(BoxKind::prisms));
    return read_mesh(convert(source, "box.msh",
                             {.order = order, .serendipity = serendipity}));
  }

  /// Moves all nodes smoothly, so that edges and faces are curved.
  void warp() {
    for (Eigen::Index n = 0; n < mesh_.x.cols(); ++n) {
      const Vector3 x = mesh_.x.col(n);
      mesh_.x.col(n) += 0.01 * Vector3(std::sin(9.0 * x[1] + 5.0 * x[2]),
                                       std::cos(11.0 * x[0]),
                                       std::sin(8.0 * x[0] - 7.0 * x[1]));
    }
  }

  Mesh mesh_;
};

TEST_P(StressOf, ALinearFieldIsConstantInCurvedElementsToo) {
  Matrix3 H;
  H << 1.0, -0.4, 0.3, 0.7, -0.2, 0.5, 0.1, 0.6, 0.9;
  warp();
  const NodalStress stress = recover_stress(
      mesh_, {kSteel}, sample(mesh_, [&](const Vector3& x) -> Vector3 {
        return Vector3(0.1, -0.2, 0.3) + 1e-3 * H * x;
      }));
  const Vector6 expected = hooke(kSteel, 1e-3 * H);
  ASSERT_EQ(stress.stress.cols(), mesh_.x.cols());
  EXPECT_LT((stress.stress.colwise() - expected).cwiseAbs().maxCoeff(),
            1e-10 * expected.norm());
  const double energy = expected.squaredNorm() / kSteel.youngs_modulus * 0.006;
  EXPECT_LT(std::abs(stress.averaging(0, 0)), 1e-18 * energy);
}

TEST_P(StressOf, RigidMotionIsZero) {
  warp();
  MatrixX rigid(3 * mesh_.x.cols(), 6);
  for (int a = 0; a < 3; ++a) {
    const Vector3 axis = Vector3::Unit(a);
    rigid.col(a) = sample(mesh_, [&](const Vector3&) { return axis; });
    rigid.col(3 + a) = sample(
        mesh_, [&](const Vector3& x) -> Vector3 { return axis.cross(x); });
  }
  const NodalStress stress = recover_stress(mesh_, {kSteel}, rigid);
  EXPECT_LT(stress.stress.cwiseAbs().maxCoeff(), 1e-11 * kSteel.youngs_modulus);
}

// Green's strain is quadratic in a displacement: with the products of all
// fields and without theta the stress is that of St. Venant-Kirchhoff's law.
TEST_P(StressOf, ProductsOfLinearFieldsAreTheRestOfGreensStrain) {
  Matrix3 H;
  H << 1.0, -0.4, 0.3, 0.7, -0.2, 0.5, 0.1, 0.6, 0.9;
  const Matrix3 gradients[] = {H, H.transpose() * H, H - 2.0 * H.transpose()};
  const Matrix3 T = 0.5 * H * H - H.transpose();
  warp();
  MatrixX Phi(3 * mesh_.x.cols(), 3);
  for (int k = 0; k < 3; ++k) {
    Phi.col(k) = sample(
        mesh_, [&](const Vector3& x) -> Vector3 { return gradients[k] * x; });
  }
  PairedFields second{{0, 2}, MatrixX::Zero(Phi.rows(), 3), {}};
  second.Theta.col(1) =
      sample(mesh_, [&](const Vector3& x) -> Vector3 { return T * x; });
  const NodalStress stress = recover_stress(mesh_, {kSteel}, Phi, second);
  ASSERT_EQ(stress.stress.rows(), 6 * 6);
  EXPECT_EQ(stress.averaging.rows(), 3);
  const double q[] = {0.3, -0.2, 0.5};
  const double p[] = {0.5 * q[0] * q[0], q[0] * q[2], 0.5 * q[2] * q[2]};
  MatrixX sum = MatrixX::Zero(6, stress.stress.cols());
  for (int k = 0; k < 3; ++k) {
    sum += q[k] * stress.stress.middleRows<6>(6 * k) +
           p[k] * stress.stress.middleRows<6>(18 + 6 * k);
  }
  const Matrix3 paired = q[0] * gradients[0] + q[2] * gradients[2];
  const Vector6 expected =
      hooke(kSteel, paired + q[1] * gradients[1] + p[1] * T +
                        0.5 * paired.transpose() * paired);
  EXPECT_LT((sum.colwise() - expected).cwiseAbs().maxCoeff(),
            1e-10 * expected.norm());
}

// Of another law: second differences of its own stress.
TEST_P(StressOf, ProductsHaveTheSecondOrderOfTheLaw) {
  constexpr double kSmall = 1e-4;
  Matrix3 H;
  H << 0.3, -0.4, 0.3, 0.7, -0.2, 0.5, 0.1, 0.6, 0.5;
  const PairedFields second{
      {0}, MatrixX::Zero(3 * mesh_.x.cols(), 1), Elasticity::neo_hookean};
  const NodalStress stress = recover_stress(
      mesh_, {kSteel},
      sample(mesh_, [&](const Vector3& x) -> Vector3 { return H * x; }),
      second);
  const auto evaluate = [&](double factor) {
    Tensor<double> gradient;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) gradient[i][j] = factor * H(i, j);
    }
    const Tensor<double> S =
        calc_stress(second.law, find_lame_constants(kSteel), gradient).S;
    Vector6 s;
    s << S[0][0], S[1][1], S[2][2], S[0][1], S[1][2], S[0][2];
    return s;
  };
  const Vector6 expected =
      (evaluate(kSmall) + evaluate(-kSmall)) / (kSmall * kSmall);
  EXPECT_LT((stress.stress.bottomRows<6>().colwise() - expected)
                .cwiseAbs()
                .maxCoeff(),
            1e-6 * expected.norm());
}

// The nodes' stress of a field of second degree is linear, which elements of
// second order on affine meshes have exactly, each for itself.
TEST_P(StressOf, AFieldOfSecondDegreeIsExactInAffineElementsOfSecondOrder) {
  if (GetParam().order < 2 || GetParam().kind == "skew") return;
  const auto field = [](const Vector3& x) {
    return Vector3(x[0] * x[0] - x[1] * x[2], 2.0 * x[0] * x[1] + x[2] * x[2],
                   x[1] * x[1] - 3.0 * x[0] * x[2]);
  };
  const auto gradient = [](const Vector3& x) {
    Matrix3 H;
    H << 2.0 * x[0], -x[2], -x[1],           //
        2.0 * x[1], 2.0 * x[0], 2.0 * x[2],  //
        -3.0 * x[2], 2.0 * x[1], -3.0 * x[0];
    return H;
  };
  const NodalStress stress =
      recover_stress(mesh_, {kSteel}, sample(mesh_, field));
  for (Eigen::Index n = 0; n < mesh_.x.cols(); ++n) {
    const Vector6 expected = hooke(kSteel, gradient(mesh_.x.col(n)));
    EXPECT_LT((stress.stress.col(n) - expected).norm(), 1e-9 * expected.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Elements, StressOf,
    ::testing::Values(Case{"tetrahedra", 1}, Case{"tetrahedra", 2},
                      Case{"tetrahedra", 3}, Case{"hexahedra", 1},
                      Case{"hexahedra", 2}, Case{"hexahedra", 2, true},
                      Case{"hexahedra", 3}, Case{"prisms", 1},
                      Case{"prisms", 2}, Case{"prisms", 2, true},
                      Case{"pyramids", 1}, Case{"pyramids", 2}, Case{"skew", 1},
                      Case{"skew", 2}));

/// Bricks of length h along x, of one or two materials.
Mesh make_row(int cells, int order, bool has_halves) {
  std::string text = fmt::format(
      "Point(1) = {{0, 0, 0}};\n"
      "l[] = Extrude {{0, 1, 0}} {{ Point{{1}}; Layers{{1}}; }};\n"
      "s[] = Extrude {{0, 0, 1}} {{ Line{{l[1]}}; Layers{{1}}; Recombine; }};\n"
      "v[] = Extrude {{1, 0, 0}} {{ Surface{{s[1]}}; Layers{{{0}}}; "
      "Recombine; }};\n",
      cells);
  text += has_halves ? fmt::format(
                           "w[] = Extrude {{1, 0, 0}} {{ Surface{{v[0]}}; "
                           "Layers{{{0}}}; Recombine; }};\n"
                           "Physical Volume(\"left\") = {{v[1]}};\n"
                           "Physical Volume(\"right\") = {{w[1]}};\n",
                           cells)
                     : "Physical Volume(\"all\") = {v[1]};\n";
  return read_mesh(testing::convert(testing::write_file("row.geo", text),
                                    "row.msh", {.order = order}));
}

TEST(StressAtABorder, IsNotAveragedOverMaterials) {
  const Mesh mesh = make_row(2, 2, true);
  const ElasticMaterial soft{70e9, 0.2, 2700.0};
  const std::vector<ElasticMaterial> materials =
      assign_materials(mesh, {{"left", kSteel}, {"right", soft}});
  Matrix3 H = Matrix3::Zero();
  H(0, 0) = 1e-3;
  H(0, 1) = 2e-4;
  const NodalStress stress = recover_stress(
      mesh, materials,
      sample(mesh, [&](const Vector3& x) -> Vector3 { return H * x; }));
  Eigen::Index at_border = 0;
  for (std::size_t i = 0; i < stress.nodes.size(); ++i) {
    const auto point = static_cast<Eigen::Index>(i);
    const double x = mesh.x(0, stress.nodes[i]);
    const ElasticMaterial& own =
        stress.constants[static_cast<std::size_t>(stress.materials[i])];
    EXPECT_TRUE(own.youngs_modulus == 200e9 ? x < 1.0 + 1e-9 : x > 1.0 - 1e-9);
    const Vector6 expected = hooke(own, H);
    EXPECT_LT((stress.stress.col(point) - expected).norm(),
              1e-11 * expected.norm());
    if (std::abs(x - 1.0) < 1e-9) ++at_border;
  }
  EXPECT_EQ(at_border, 2 * 9);  // a 27-node brick's face, both sides
  EXPECT_LT(stress.averaging(0, 0), 1e-9);
}

TEST(StressAtABorder, IsAveragedOverGroupsOfOneMaterial) {
  const Mesh mesh = make_row(1, 2, true);
  ElasticMaterial heavier = kSteel;
  heavier.density = 9000.0;
  const NodalStress stress = recover_stress(
      mesh, assign_materials(mesh, {{"left", kSteel}, {"right", heavier}}),
      MatrixX::Zero(3 * mesh.x.cols(), 1));
  EXPECT_EQ(stress.stress.cols(), mesh.x.cols());
  EXPECT_EQ(stress.constants.size(), 1U);
}

// u = x^2 on n bricks of first order, nu = 0: an element's stress is that of
// its middle, E (2 i + 1) h, the true one 2 E x, so the error's energy is E n
// h^3 / 3. The average is true at all inner nodes; in the end elements the
// estimate is as large as in the others.
TEST(AveragingError, IsTheTrueErrorOfLinearBricks) {
  const int n = 5;
  const Mesh mesh = make_row(n, 1, false);
  const ElasticMaterial material{3.0, 0.0, 1.0};
  const NodalStress stress = recover_stress(
      mesh, {material}, sample(mesh, [](const Vector3& x) -> Vector3 {
        return {x[0] * x[0], 0.0, 0.0};
      }));
  const double h = 1.0 / n;
  EXPECT_NEAR(stress.averaging(0, 0), 3.0 * n * h * h * h / 3.0, 1e-12);
}

// int d C^-1 d of a product of two fields: sums have their squares.
TEST(AveragingError, IsAQuadraticForm) {
  const Mesh mesh = make_row(3, 1, false);
  const auto first = sample(mesh, [](const Vector3& x) -> Vector3 {
    return {x[0] * x[0], x[0] * x[1], 0.3 * x[2] * x[0]};
  });
  const auto second = sample(mesh, [](const Vector3& x) -> Vector3 {
    return {x[1] * x[0], -x[0] * x[0], x[1] * x[2]};
  });
  MatrixX both(first.rows(), 2);
  both << first, second;
  const MatrixX Z = recover_stress(mesh, {kSteel}, both).averaging;
  const MatrixX sum = recover_stress(mesh, {kSteel}, first + second).averaging;
  EXPECT_NEAR(Z.sum() / sum(0, 0), 1.0, 1e-12);
  EXPECT_GT(Z(0, 0), 0.0);
  EXPECT_EQ(Z(0, 1), Z(1, 0));
}

}  // namespace
}  // namespace limber::fem::stress_recovery_test
