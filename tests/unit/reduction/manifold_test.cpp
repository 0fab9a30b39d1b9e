// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/manifold.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "limber/common/dense/singular_values.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/solid/nonlinear_solid.hpp"
#include "limber/fem/solid/second_order.hpp"
#include "limber/flexbody/elasticity/quadratic_strain.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/reduction/reduce.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::flexbody::manifold_test {
namespace {

using testing::Bar;

/// A reduced bar with its fields on all nodes.
struct Manifold {
  explicit Manifold(const Bar& bar, int eigenmodes = 4)
      : recipe(make(bar, eigenmodes)),
        meshed(recipe, {}),
        body(reduce(recipe)),
        paired(body.manifold->paired) {}

  static Recipe make(const Bar& bar, int eigenmodes) {
    Recipe recipe = make_recipe(bar);
    recipe.basis.eigenmodes = eigenmodes;
    recipe.rows = parse_rows({"all"});
    recipe.manifold = true;
    return recipe;
  }
  [[nodiscard]] const MatrixX& Phi() const { return body.rows.Phi_B; }
  [[nodiscard]] const MatrixX& Theta() const { return body.manifold->Theta_B; }
  /// Displacements of all nodes to second order.
  [[nodiscard]] VectorX displace(const VectorX& q) const {
    VectorX u = Phi() * q;
    Eigen::Index pair = 0;
    for (std::size_t i = 0; i < paired.size(); ++i) {
      for (std::size_t j = i; j < paired.size(); ++j, ++pair) {
        u += (i == j ? 0.5 : 1.0) * q[paired[i]] * q[paired[j]] *
             Theta().col(pair);
      }
    }
    return u;
  }

  Recipe recipe;
  MeshedBody meshed;
  ReducedBody body;
  std::vector<int> paired;
};

const Bar kBar{.corner = Vector3(0.3, 0.1, -0.2),
               .size = Vector3(1.0, 0.1, 0.05),
               .cells = 5,
               .material = {200e9, 0.3, 8000.0}};

TEST(Manifold, PairsBendingAndTorsionNotStretch) {
  const Manifold made(kBar);
  ASSERT_GT(made.paired.size(), 3U);
  EXPECT_LT(made.paired.size(), made.body.lambda.size());
  const VectorX ratios = fem::find_rotation_ratios(
      fem::find_mean_deformation(made.meshed.mesh, made.Phi()));
  for (const int k : made.paired) EXPECT_GT(ratios[k], 1.5);
}

TEST(Manifold, FieldsBalanceTheSecondOrderForcesOnWhatIsNotPaired) {
  const Manifold made(kBar);
  const MatrixX Phi_P = made.Phi()(Eigen::all, made.paired);
  const fem::SecondOrderTerms terms = fem::calc_second_order(
      made.meshed.mesh, find_materials(made.meshed.mesh, made.recipe),
      fem::Elasticity::st_venant_kirchhoff, Phi_P);
  const MatrixX K = testing::dense_stiffness(made.meshed);
  const MatrixX left = K * made.Theta() + terms.loads;
  // Elastic fields, in K orthogonal to paired modes.
  MatrixX X =
      made.meshed.inverse.project_motion(MatrixX::Random(Phi_P.rows(), 5));
  const VectorX lambda = made.body.lambda(made.paired);
  X -= Phi_P *
       (lambda.cwiseInverse().asDiagonal() * (Phi_P.transpose() * (K * X)));
  const double scale = X.norm() * terms.loads.norm();
  EXPECT_LT((X.transpose() * left).norm(), 1e-9 * scale);
  EXPECT_LT((Phi_P.transpose() * (K * made.Theta())).norm(),
            1e-9 * Phi_P.norm() * terms.loads.norm());
}

// No net motion and rotation, so that the frame is still of mean axes.
TEST(Manifold, FieldsDoNotMoveTheMeanAxes) {
  const Manifold made(kBar);
  const MatrixX R = testing::rigid_motions(made.body.rows.x_B);
  const MatrixX M =
      testing::kron(MatrixX(made.meshed.M_s), Matrix3::Identity());
  EXPECT_LT((R.transpose() * M * made.Theta()).norm(),
            1e-10 * R.norm() * (M * made.Theta()).norm());
}

TEST(Manifold, InterfaceTablesAreDerivativesOfThePolarRotation) {
  const Manifold made(kBar);
  for (std::size_t f = 0; f < 2; ++f) {
    const fem::WeightedNodes& on = made.meshed.interfaces[f].selection;
    const InterfaceTable& table = made.body.interfaces[f];
    const Matrix3X d =
        made.body.rows.x_B(Eigen::all, on.nodes).colwise() - table.p_B;
    const auto move = [&](const VectorX& q) {
      const VectorX all = made.displace(q);
      const Matrix3X u =
          all.reshaped(3, made.body.rows.x_B.cols())(Eigen::all, on.nodes);
      const Matrix3 G = (d + u) * on.weights.asDiagonal() * d.transpose();
      const auto svd = dense::find_singular_form(G);
      Matrix3 R = svd.U * svd.V.transpose();
      if (R.determinant() < 0.0) {  // nodes in a plane
        R -= 2.0 * svd.U.col(2) * svd.V.col(2).transpose();
      }
      Vector6 motion;
      motion << u * on.weights, log_rotation(R);
      return motion;
    };
    const Eigen::Index m = made.body.lambda.size();
    const auto step = [&](int k) {
      return 1e-3 / table.Psi_B.colwise().norm().maxCoeff() *
             VectorX::Unit(m, k);
    };
    const std::size_t p = made.paired.size();
    for (const std::size_t i : {0, 1, 2}) {
      const auto pair =
          static_cast<Eigen::Index>(i * p + i - i * (i + 1) / 2);  // of i, i
      const VectorX a = step(made.paired[i]);
      const VectorX b = step(made.paired[2]);
      const auto j = static_cast<Eigen::Index>(2 - i);
      const Vector6 second =
          (move(a + b) - move(a - b) - move(b - a) + move(-a - b)) /
          (4.0 * a.norm() * b.norm());
      Vector6 expected;
      expected << table.Phi2_B.col(pair + j), table.Psi2_B.col(pair + j);
      EXPECT_LT((second.head<3>() - expected.head<3>()).norm(),
                1e-6 * table.Phi2_B.norm());
      EXPECT_LT((second.tail<3>() - expected.tail<3>()).norm(),
                1e-5 * (table.Psi2_B.norm() + table.Psi_B.squaredNorm()));
    }
  }
}

TEST(Manifold, InertiaIsThatOfTheDisplacedNodes) {
  const Manifold made(kBar);
  const Matrix3X& x = made.body.rows.x_B;
  const Eigen::Index m = made.body.lambda.size();
  const auto inertia = [&](const VectorX& q) {
    const Matrix3X r = x + made.displace(q).reshaped(3, x.cols());
    return Matrix3(r * made.meshed.M_s * r.transpose());
  };
  Eigen::Index pair = 0;
  for (std::size_t i = 0; i < made.paired.size(); ++i) {
    for (std::size_t j = i; j < made.paired.size(); ++j, ++pair) {
      const VectorX a = VectorX::Unit(m, made.paired[i]);
      const VectorX b = VectorX::Unit(m, made.paired[j]);
      const auto difference = [&](double h) {
        return Matrix3((inertia(h * (a + b)) - inertia(h * (a - b)) -
                        inertia(h * (b - a)) + inertia(-h * (a + b))) /
                       (4.0 * h * h));
      };
      // Exact of what is of fourth degree.
      const Matrix3 second = (4.0 * difference(0.01) - difference(0.02)) / 3.0;
      const auto k =
          static_cast<std::size_t>(made.paired[i] * m + made.paired[j]);
      const Matrix3 S2 = made.body.integrals.S2[k];
      const Vector6 c = made.body.manifold->S2.col(pair);
      Matrix3 D;
      D << c[0], c[3], c[4], c[3], c[1], c[5], c[4], c[5], c[2];
      const Matrix3 expected = S2 + S2.transpose() + 2.0 * D;
      EXPECT_LT((second - expected).norm(), 1e-9 * (1.0 + expected.norm()));
    }
  }
}

// A free bar in its first bending mode phi: its ends come nearer by
// int phi'^2 dx = (4.6473 (4.6473 + 6)) / L^2 int phi^2 dx.
// Source: Blevins, Formulas for Natural Frequency and Mode Shape, table C-2b.
TEST(Manifold, ASlenderBarIsForeshortenedByItsSlope) {
  const Bar bar{.size = Vector3(1.0, 0.02, 0.01),
                .cells = 24,
                .material = {200e9, 0.0, 8000.0}};
  const Manifold made(bar);
  ASSERT_EQ(made.paired[0], 0);
  const double shorter = made.body.interfaces[1].Phi2_B(0, 0) -
                         made.body.interfaces[0].Phi2_B(0, 0);
  EXPECT_NEAR(shorter * bar.mass(), -49.481, 0.003 * 49.481);
}

// By symmetry, so that the elasticity of bending costs nothing.
TEST(Manifold, AStraightBarHasNoQuadraticStrainsOfItsBendingModes) {
  const Bar bar{.size = Vector3(1.0, 0.1, 0.05),
                .cells = 6,
                .material = {200e9, 0.0, 8000.0}};
  const Manifold made(bar);
  for (std::size_t r = 0; r < 2; ++r) {
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_EQ(made.body.manifold->Q(static_cast<Eigen::Index>(r),
                                      static_cast<Eigen::Index>(c)),
                0.0);
    }
  }
}

// Energy of the mesh along the manifold, to third order in one mode:
// V = (sqrt(lambda) q + Q q^2)^2 / 2.
TEST(Manifold, CubicEnergyIsThatOfTheMesh) {
  const Manifold made(kBar);
  const fem::NonlinearSolid solid(made.meshed.mesh,
                                  find_materials(made.meshed.mesh, made.recipe),
                                  fem::Elasticity::st_venant_kirchhoff);
  auto workspace = solid.make_workspace();
  const auto energy = [&](const VectorX& q) {
    Matrix3X f(3, made.body.rows.x_B.cols());
    return solid.calc_force(
        made.displace(q).reshaped(3, made.body.rows.x_B.cols()), f, workspace);
  };
  const Eigen::Index m = made.body.lambda.size();
  const MatrixX& Q = made.body.manifold->Q;
  VectorX q = VectorX::Zero(m);
  std::size_t n = 0;
  for (const int k : made.paired) q[k] = 1e-3 * std::cos(1.0 + 2.0 * n++);
  const auto p = static_cast<Eigen::Index>(made.paired.size());
  double cubic = 0.0;
  for (Eigen::Index r = 0; r < p; ++r) {
    double e = 0.0;
    Eigen::Index pair = 0;
    for (Eigen::Index i = 0; i < p; ++i)
      for (Eigen::Index j = i; j < p; ++j, ++pair)
        e += Q(r, pair) * q[made.paired[static_cast<std::size_t>(i)]] *
             q[made.paired[static_cast<std::size_t>(j)]];
    const int k = made.paired[static_cast<std::size_t>(r)];
    cubic += std::sqrt(made.body.lambda[k]) * q[k] * e;
  }
  const double odd = 0.5 * (energy(q) - energy(-q));
  const double odder = 0.5 * (energy(0.5 * q) - energy(-0.5 * q));
  // Without the fifth order.
  const double third = (32.0 * odder - odd) / 3.0;
  const double scale = energy(q);
  EXPECT_GT(std::abs(cubic), 1e-7 * scale);
  EXPECT_NEAR(third, cubic, 1e-3 * std::abs(cubic) + 1e-12 * scale);
}

TEST(Manifold, ASlenderBarHasNoSelfStrains) {
  const Bar bar{.size = Vector3(1.0, 0.02, 0.01),
                .cells = 24,
                .material = {200e9, 0.3, 8000.0}};
  EXPECT_EQ(Manifold(bar).body.manifold->self.rows(), 0);
}

// A plate that twists is stretched in its plane, at three thicknesses with two
// thirds of the energy of its bending.
TEST(Manifold, APlateThatTwistsHasTheFourthOrderEnergyOfTheMesh) {
  const Bar plate{.size = Vector3(1.0, 1.0, 0.01),
                  .cells = 4,
                  .material = {200e9, 0.3, 8000.0}};
  const Manifold made(plate);
  const fem::NonlinearSolid solid(made.meshed.mesh,
                                  find_materials(made.meshed.mesh, made.recipe),
                                  fem::Elasticity::st_venant_kirchhoff);
  auto workspace = solid.make_workspace();
  const QuadraticManifold& tables = *made.body.manifold;
  const QuadraticStrain elasticity(
      {made.body.lambda, tables.paired, tables.Q, tables.self});
  const QuadraticStrain without({made.body.lambda, tables.paired, tables.Q});
  ASSERT_EQ(made.paired[0], 0);
  VectorX q = VectorX::Zero(made.body.lambda.size());
  q[0] = 0.03 / made.Phi().col(0).cwiseAbs().maxCoeff();
  const auto even = [&](const VectorX& at) {
    double sum = 0.0;
    for (const double sign : {1.0, -1.0}) {
      Matrix3X f(3, made.body.rows.x_B.cols());
      sum +=
          0.5 * solid.calc_force(made.displace(sign * at).reshaped(3, f.cols()),
                                 f, workspace);
    }
    return sum;
  };
  const double linear = 0.5 * made.body.lambda[0] * q[0] * q[0];
  const double truth = even(q) - linear;
  EXPECT_GT(truth, 0.5 * linear);
  EXPECT_NEAR(elasticity.energy(q) - linear, truth, 0.02 * truth);
  EXPECT_LT(without.energy(q) - linear, 0.1 * truth);
}

TEST(Manifold, IsLeftOutUnlessAskedFor) {
  Recipe recipe = make_recipe(kBar);
  const ReducedBody without = reduce(recipe);
  EXPECT_FALSE(without.manifold.has_value());
  EXPECT_EQ(without.interfaces[0].Phi2_B.cols(), 0);
  const std::string key = content_key(recipe, "mesh");
  recipe.manifold = true;
  EXPECT_NE(content_key(recipe, "mesh"), key);
  const ReducedBody with = reduce(recipe);
  EXPECT_EQ(with.rows.Phi_B, without.rows.Phi_B);  // to the bit
  EXPECT_EQ(with.lambda, without.lambda);
  EXPECT_EQ(with.integrals.S2, without.integrals.S2);
}

TEST(Manifold, SurvivesABodyFile) {
  const Manifold made(kBar);
  const auto file = limber::test::own_folder() / "manifold_body.h5";
  write_body(made.body, file);
  const ReducedBody read = read_body(file);
  ASSERT_TRUE(read.manifold.has_value());
  EXPECT_EQ(read.manifold->paired, made.body.manifold->paired);
  EXPECT_EQ(read.manifold->Q, made.body.manifold->Q);
  EXPECT_EQ(read.manifold->self, made.body.manifold->self);
  EXPECT_EQ(read.manifold->S2, made.body.manifold->S2);
  EXPECT_EQ(read.manifold->Theta_B, made.body.manifold->Theta_B);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.interfaces[i].Phi2_B, made.body.interfaces[i].Phi2_B);
    EXPECT_EQ(read.interfaces[i].Psi2_B, made.body.interfaces[i].Psi2_B);
  }
}

}  // namespace
}  // namespace limber::flexbody::manifold_test
