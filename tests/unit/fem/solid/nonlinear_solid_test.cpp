// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/nonlinear_solid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/element_matrices.hpp"
#include "limber/fem/solid/nodal_mass.hpp"
#include "limber/fem/solid/static_solid.hpp"
#include "limber/fem/solid/tangent.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::nonlinear_solid_test {
namespace {

using testing::BoxKind;

const ElasticMaterial kSteel{200e9, 0.3, 8000.0};

class SolidBox
    : public ::testing::TestWithParam<std::tuple<BoxKind, int, Elasticity>> {
 protected:
  SolidBox()
      : mesh_(read_mesh(testing::convert(
            testing::write_file("box.geo",
                                testing::box_geo(std::get<0>(GetParam()))),
            "box.msh", {.order = std::get<1>(GetParam())}))),
        solid_(mesh_, {kSteel}, std::get<2>(GetParam())),
        workspace_(solid_.make_workspace()),
        force_(3, mesh_.x.cols()) {}

  double calc(const Matrix3X& u) {
    return solid_.calc_force(u, force_, workspace_);
  }
  [[nodiscard]] std::vector<int> find_root() const {
    return mesh_.groups[find_group(mesh_, "root")].nodes;
  }
  [[nodiscard]] double volume() const { return testing::kBoxSize.prod(); }
  [[nodiscard]] double area() const { return std::pow(volume(), 2.0 / 3.0); }
  [[nodiscard]] Matrix3X random_field(double size, unsigned seed) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-size, size);
    return Matrix3X::NullaryExpr(3, mesh_.x.cols(),
                                 [&] { return uniform(random); });
  }

  Mesh mesh_;
  NonlinearSolid solid_;
  NonlinearSolid::Workspace workspace_;
  Matrix3X force_;
};

TEST_P(SolidBox, ARigidMotionOfAnyAngleCostsNoEnergyAndMeetsNoForce) {
  const double turn = 2.0 * std::numbers::pi;
  for (const double angle : {0.3, 2.0, 3.1, turn}) {
    const Matrix3 R = exp_quaternion(angle * Vector3(1.0, 2.0, -2.0) / 3.0)
                          .toRotationMatrix();
    const Matrix3X u = ((R - Matrix3::Identity()) * mesh_.x).colwise() +
                       Vector3(3.0, -1.0, 2.0);
    // Strains are round-off, so the energy is its square.
    EXPECT_LT(calc(u), 1e-24 * kSteel.youngs_modulus * volume());
    EXPECT_LT(force_.cwiseAbs().maxCoeff(),
              1e-12 * kSteel.youngs_modulus * area());
  }
}

TEST_P(SolidBox, ForceIsTheGradientOfTheEnergy) {
  const Matrix3X u = random_field(2e-3, 3);
  const Matrix3X direction = random_field(1.0, 4);
  const double at = calc(u);
  const double slope = force_.cwiseProduct(direction).sum();
  constexpr double kStep = 1e-6;
  const double forward = calc(u + kStep * direction);
  const double backward = calc(u - kStep * direction);
  // Differences: (step / 2 mm)^2 relative, and round-off of the energy.
  EXPECT_NEAR((forward - backward) / (2.0 * kStep), slope,
              1e-5 * std::abs(slope) + 1e-15 * at / kStep);
}

TEST_P(SolidBox, NoNetForceAndNoNetMoment) {
  const Matrix3X u = random_field(2e-3, 5);
  calc(u);
  const Matrix3X at = mesh_.x + u;
  Vector3 moment = Vector3::Zero();
  double size = 0.0;
  for (Eigen::Index n = 0; n < at.cols(); ++n) {
    moment += Vector3(at.col(n)).cross(Vector3(force_.col(n)));
    size += force_.col(n).norm();
  }
  EXPECT_LT(force_.rowwise().sum().norm(), 1e-13 * size);
  EXPECT_LT(moment.norm(), 1e-13 * size);
}

TEST_P(SolidBox, SmallDisplacementsMeetTheLinearStiffness) {
  const StructuralMatrices matrices = assemble(mesh_, {kSteel});
  const Matrix3X u = random_field(1.0, 6);
  const VectorX linear = multiply_stiffness(
      matrices.K, Eigen::Map<const VectorX>(u.data(), u.size()));
  std::vector<double> errors;
  for (const double size : {1e-6, 1e-7}) {
    calc(size * u);
    errors.push_back(
        (Eigen::Map<const VectorX>(force_.data(), force_.size()) / size -
         linear)
            .norm() /
        linear.norm());
  }
  EXPECT_NEAR(errors[0] / errors[1], 10.0, 0.5);  // what is left is quadratic
  EXPECT_LT(errors[1], 1e-4);
}

TEST_P(SolidBox, TangentIsTheGradientOfTheForce) {
  const Matrix3X u = random_field(2e-3, 8);
  const Matrix3X direction = random_field(1.0, 9);
  const StiffnessAssembly assembly(mesh_);
  StructuralMatrices tangent = assembly.make_zero();
  assembly.assemble(
      [&](const ElementBlock& block, std::size_t e) {
        const int* nodes = block.element_nodes(e);
        const std::vector<int> own(nodes, nodes + block.element->node_count);
        return calc_element_tangent(*block.element, mesh_.x(Eigen::all, own),
                                    u(Eigen::all, own), kSteel,
                                    std::get<2>(GetParam()));
      },
      tangent.K);
  const MatrixX product = multiply_stiffness(tangent.K, direction.reshaped());
  constexpr double kStep = 1e-6;
  calc(u + kStep * direction);
  const Matrix3X forward = force_;
  calc(u - kStep * direction);
  const Matrix3X difference = (forward - force_) / (2.0 * kStep);
  EXPECT_LT((difference.reshaped() - product).norm(), 1e-6 * product.norm());
}

// c M x + (f(u + e x) - f(u - e x)) / 2 e = F on the free nodes; the second
// time without the symbolic analysis.
TEST_P(SolidBox, FactorsOfTheTangentSolveForTheGradientOfTheForce) {
  const std::vector<ElasticMaterial> materials = {kSteel};
  const StructuralMatrices matrices = assemble(mesh_, materials);
  const std::vector<int> free = find_free_nodes(mesh_, find_root());
  for (const std::vector<int>& moving : {free, find_free_nodes(mesh_, {})}) {
    TangentFactor factor(mesh_, materials, std::get<2>(GetParam()),
                         matrices.M_s, moving);
    for (const double size : {0.0, 5e-4}) {
      const Matrix3X u = random_field(size, 11);
      constexpr double kShift = 3e10;  // above the geometric stiffness [1/s^2]
      factor.factor(u, kShift);
      const Matrix3X load = random_field(1e5, 12);
      Matrix3X x = Matrix3X::Zero(3, mesh_.x.cols());
      const MatrixX right_hand_side = load(Eigen::all, moving);
      x(Eigen::all, moving) =
          factor.solve(right_hand_side.reshaped()).reshaped(3, moving.size());
      const double step = 1e-6 / x.cwiseAbs().maxCoeff();
      calc(u + step * x);
      const Matrix3X forward = force_;
      calc(u - step * x);
      const Matrix3X found = (forward - force_) / (2.0 * step) +
                             kShift * x * MatrixX(matrices.M_s);
      EXPECT_LT((found - load)(Eigen::all, moving).norm(), 1e-6 * load.norm());
    }
  }
}

TEST_P(SolidBox, StaticEquilibriumBalancesTheLoadWhereTheBoxIsFree) {
  const std::vector<int> held = find_root();
  const std::vector<int> free = find_free_nodes(mesh_, held);
  const Matrix3X load = random_field(2e5, 13);
  const StaticSolution solution = solve_static(
      mesh_, {kSteel}, std::get<2>(GetParam()), load, held, {.load_steps = 2});
  EXPECT_EQ(calc(solution.u), solution.strain_energy);
  EXPECT_LT((force_ - load)(Eigen::all, free).norm(), 1e-10 * load.norm());
  EXPECT_EQ(solution.u(Eigen::all, held).norm(), 0.0);
  EXPECT_GE(solution.newton_iterations, 4);
}

// The patch test: a uniform deformation gradient has the law's own energy
// and leaves the nodes inside in balance.
TEST_P(SolidBox, AUniformDeformationHasTheClosedFormEnergy) {
  Matrix3 F = Matrix3::Identity();
  F(0, 0) = 1.1;  // stretch and shear, J = 1.1
  F(0, 1) = 0.2;
  const double lambda = kSteel.youngs_modulus * 0.3 / (1.3 * 0.4);
  const double mu = kSteel.youngs_modulus / 2.6;
  double W = 0.0;
  if (std::get<2>(GetParam()) == Elasticity::st_venant_kirchhoff) {
    // E = ((0.105, 0.11, 0), (0.11, 0.02, 0), 0)
    W = 0.5 * lambda * 0.125 * 0.125 +
        mu * (0.105 * 0.105 + 2.0 * 0.11 * 0.11 + 0.02 * 0.02);
  } else {
    const double log_J = std::log(1.1);
    W = 0.5 * mu * (1.21 + 0.04 + 1.0 + 1.0 - 3.0 - 2.0 * log_J) +
        0.5 * lambda * log_J * log_J;
  }
  EXPECT_NEAR(calc((F - Matrix3::Identity()) * mesh_.x), W * volume(),
              1e-12 * W * volume());
  for (int n = 0; n < static_cast<int>(mesh_.node_count()); ++n) {
    if (std::binary_search(mesh_.boundary_nodes.begin(),
                           mesh_.boundary_nodes.end(), n)) {
      continue;
    }
    EXPECT_LT(force_.col(n).norm(), 1e-12 * kSteel.youngs_modulus * area());
  }
}

TEST_P(SolidBox, AnElementInsideOutEndsWithItsTag) {
  // Everything mirrored: det F = -1.
  Matrix3X u = Matrix3X::Zero(3, mesh_.x.cols());
  u.row(0) = -2.0 * mesh_.x.row(0);
  try {
    calc(u);
    FAIL() << "a mirrored body was accepted";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("element "));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("is inverted"));
  }
}

TEST_P(SolidBox, LumpedMassesArePositiveAndSumToTheMass) {
  const VectorX mass = calc_lumped_mass(mesh_, {kSteel});
  EXPECT_GT(mass.minCoeff(), 0.0);
  EXPECT_NEAR(mass.sum(), kSteel.density * volume(),
              1e-12 * kSteel.density * volume());
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, SolidBox,
    ::testing::Values(
        std::tuple(BoxKind::tetrahedra, 1, Elasticity::st_venant_kirchhoff),
        std::tuple(BoxKind::tetrahedra, 2, Elasticity::st_venant_kirchhoff),
        std::tuple(BoxKind::tetrahedra, 2, Elasticity::neo_hookean),
        std::tuple(BoxKind::hexahedra, 2, Elasticity::st_venant_kirchhoff),
        std::tuple(BoxKind::prisms, 2, Elasticity::neo_hookean)));

}  // namespace
}  // namespace limber::fem::nonlinear_solid_test
