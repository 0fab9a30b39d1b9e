// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/shell_element.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/fem/structural/shell_grid.hpp"

/// Elements of shells by themselves. Warped quadrilaterals, laminates of any
/// plies.
namespace limber::fem::structural_test {
namespace {

const PlyMaterial kPly = {1.4e11, 1e10, 0.3, 5e9, 5e9, 3e9, 1600.0};

Laminate make_skew_laminate() {
  return make_laminate(
      {{kPly, 0.001, 0.5}, {kPly, 0.002, 1.2}, {kPly, 0.001, 0.0}}, -0.001);
}

ShellShape make_warped() {
  ShellShape shape{Matrix3X(3, 4), {1.0, 0.2, 0.1}};
  shape.x << 0.0, 1.1, 1.3, -0.1, 0.0, 0.1, 1.2, 0.9, 0.0, 0.2, -0.1, 0.1;
  return shape;
}

void expect_rigid(const StructuralElement& element, const Matrix3X& x) {
  const MatrixX X = make_rigid(x);
  EXPECT_LT((element.K - element.K.transpose()).norm(),
            1e-14 * element.K.norm());
  EXPECT_LT((element.K * X).norm(), 1e-13 * element.K.norm() * X.norm());
  double mass = 0.0;
  Vector3 moment = Vector3::Zero();
  Matrix3 J = Matrix3::Zero();
  MatrixX inertia = MatrixX::Zero(6, 6);
  for (const MassPoint& point : element.points) {
    // Its place follows from what a rotation moves.
    const MatrixX moved = point.N * X;
    const Vector3 y(moved(1, 5), moved(2, 3), moved(0, 4));
    mass += point.mass;
    moment += point.mass * y;
    J += point.mass *
         (y.squaredNorm() * Matrix3::Identity() - y * y.transpose());
    inertia += point.mass * moved.transpose() * moved;
  }
  EXPECT_NEAR(inertia(2, 2), mass, 1e-14 * mass);
  EXPECT_NEAR(inertia(0, 4), moment.z(), 1e-13 * mass);
  EXPECT_LT((inertia.bottomRightCorner<3, 3>() - J).norm(), 1e-13 * J.norm());
}

TEST(ShellElement, HasNoStiffnessAndTheInertiaOfABodyInRigidMotion) {
  const ShellShape quad = make_warped();
  expect_rigid(make_quad_shell(quad, make_skew_laminate()), quad.x);
  const ShellShape triangle{quad.x.leftCols(3), quad.axis};
  expect_rigid(make_triangle_shell(triangle, make_skew_laminate()), triangle.x);
}

TEST(ShellElement, HasSixRigidMotionsAndNoOther) {
  const ShellShape quad = make_warped();
  const ShellShape triangle{quad.x.leftCols(3), quad.axis};
  for (const MatrixX& K :
       {make_quad_shell(quad, make_skew_laminate()).K,
        make_triangle_shell(triangle, make_skew_laminate()).K}) {
    const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(K);
    const VectorX values = eigen.eigenvalues() / eigen.eigenvalues().maxCoeff();
    EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_GT(values[6], 1e-9);
  }
}

TEST(ShellElement, OfAFlatPlateHasItsMassAndMomentsOfInertia) {
  const double t = 0.02;
  const Laminate plate = make_plate(2e11, 0.3, t, 7800.0);
  ShellShape shape{Matrix3X(3, 4), Vector3::UnitX()};
  shape.x << 0.0, 0.5, 0.5, 0.0, 0.0, 0.0, 0.3, 0.3, 0.0, 0.0, 0.0, 0.0;
  const MatrixX X = make_rigid(shape.x);
  Matrix6 inertia = Matrix6::Zero();
  for (const MassPoint& point : make_quad_shell(shape, plate).points)
    inertia += point.mass * (point.N * X).transpose() * (point.N * X);
  const double mass = 7800.0 * 0.5 * 0.3 * t;
  EXPECT_NEAR(inertia(0, 0), mass, 1e-12 * mass);
  EXPECT_NEAR(inertia(3, 3), mass * (0.3 * 0.3 / 3.0 + t * t / 12.0), 1e-13);
  EXPECT_NEAR(inertia(5, 5), mass * (0.3 * 0.3 + 0.5 * 0.5) / 3.0, 1e-13);
}

/// The patch of MacNeal and Harder (1985) with constant strain, curvature.
Structure make_patch(Corners corners, const Laminate& laminate) {
  Structure structure;
  structure.laminates = {laminate};
  structure.x.resize(3, 8);
  structure.x << 0.0, 0.24, 0.24, 0.0, 0.04, 0.18, 0.16, 0.08,  //
      0.0, 0.0, 0.12, 0.12, 0.02, 0.03, 0.08, 0.08,             //
      0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  for (std::size_t i = 1; i <= 8; ++i) structure.tags.push_back(i);
  const auto add = [&](const std::vector<int>& nodes) {
    StructureShell shell;
    shell.nodes = nodes;
    shell.axis = Vector3::UnitX();
    structure.shells.push_back(shell);
  };
  for (const auto& [a, b, c, d] :
       {std::array{0, 1, 5, 4}, std::array{1, 2, 6, 5}, std::array{2, 3, 7, 6},
        std::array{3, 0, 4, 7}, std::array{4, 5, 6, 7}}) {
    if (corners == Corners::four) {
      add({a, b, c, d});
    } else {
      add({a, b, c});
      add({a, c, d});
    }
  }
  return structure;
}

/// Inner nodes follow a field that the outer ones are given.
void expect_patch(Corners corners, const Laminate& laminate,
                  const std::function<Vector6(double, double)>& field) {
  const Structure structure = make_patch(corners, laminate);
  const MatrixX K = assemble_structure(structure).model.stiffness.entries;
  VectorX given(48);
  for (int n = 0; n < 8; ++n)
    given.segment<6>(6 * n) = field(structure.x(0, n), structure.x(1, n));
  const VectorX inner = -K.bottomRightCorner(24, 24).ldlt().solve(
      K.bottomLeftCorner(24, 24) * given.head(24));
  EXPECT_LT((inner - given.tail(24)).norm(), 1e-7 * given.tail(24).norm());
}

TEST(ShellElement, PassesThePatchTestsOfMembraneAndBending) {
  const Laminate plate = make_plate(1e6, 0.25, 0.001);
  for (const Corners corners : {Corners::four, Corners::three}) {
    expect_patch(corners, plate, [](double x, double y) {
      Vector6 u = Vector6::Zero();
      u[0] = 1e-3 * (x + 0.5 * y);
      u[1] = 1e-3 * (y + 0.5 * x);
      return u;
    });
    expect_patch(corners, plate, [](double x, double y) {
      Vector6 u = Vector6::Zero();
      u[2] = 1e-3 * 0.5 * (x * x + x * y + y * y);
      u[3] = 1e-3 * (y + 0.5 * x);
      u[4] = -1e-3 * (x + 0.5 * y);
      return u;
    });
  }
}

TEST(ShellElement, PassesThePatchTestOfACoupledLaminate) {
  for (const Corners corners : {Corners::four, Corners::three})
    for (const double offset : {0.0, 0.003})
      expect_patch(corners, shift_laminate(make_skew_laminate(), offset),
                   [](double x, double y) {
                     Vector6 u;
                     u << 1e-3 * (x + 0.5 * y), -1e-3 * (y - 0.5 * x),
                         0.5 * (x * x + x * y - 2.0 * y * y), 0.5 * x - 2.0 * y,
                         -(x + 0.5 * y), 0.0;
                     return u;
                   });
}

TEST(Laminate, OfOnePlyHasItsPlateStiffness) {
  const double E = 7e10;
  const double nu = 0.33;
  const double t = 0.003;
  const Laminate plate = make_plate(E, nu, t, 2700.0);
  const double D = E * t * t * t / 12.0 / (1.0 - nu * nu);
  EXPECT_NEAR(plate.D(0, 0), D, 1e-12 * D);
  EXPECT_NEAR(plate.D(0, 1), nu * D, 1e-12 * D);
  EXPECT_LT(plate.B.norm(), 1e-9 * t * plate.A.norm());
  const double S = 5.0 / 6.0 * t * E / 2.0 / (1.0 + nu);
  EXPECT_NEAR(plate.S(0, 0), S, 1e-12 * S);
  EXPECT_NEAR(plate.S(1, 1), S, 1e-12 * S);
  EXPECT_NEAR(plate.second_mass, 2700.0 * t * t * t / 12.0, 1e-15);
}

/// A sandwich: its core takes the shear, G_core d^2 / c about (Allen, Analysis
/// and Design of Structural Sandwich Panels, 1969).
TEST(Laminate, OfASandwichHasTheShearOfItsCore) {
  const PlyMaterial face = make_isotropic(7e10, 0.3, 2700.0);
  const PlyMaterial core = make_isotropic(1e8, 0.3, 50.0);
  const double f = 0.0005;
  const double c = 0.02;
  const Laminate panel = make_laminate(
      {{face, f, 0.0}, {core, c, 0.0}, {face, f, 0.0}}, -f - c / 2);
  const double S = core.G_13 * (c + f) * (c + f) / c;
  EXPECT_NEAR(panel.S(0, 0), S, 1e-2 * S);
}

/// [0/90], unsymmetric and coupled: a wide strip under a force at its tip bends
/// with D_11 - B_11^2 / A_11, and shears. Of nu = 0, no anticlastic curvature.
TEST(ShellElement, OfAnUnsymmetricLaminateBendsAsItsClosedForm) {
  PlyMaterial ply = kPly;
  ply.nu_12 = 0.0;
  const double t = 0.002;
  const Laminate laminate =
      make_laminate({{ply, t, 0.0}, {ply, t, M_PI / 2.0}}, -t);
  const double L = 0.5;
  const double b = 0.05;
  const double A = (ply.E_1 + ply.E_2) * t;
  const double B = (ply.E_2 - ply.E_1) * t * t / 2.0;
  const double D = (ply.E_1 + ply.E_2) * t * t * t / 3.0;
  const double exact =
      L * L * L / (3.0 * b * (D - B * B / A)) + L / (b * laminate.S(0, 0));
  for (const Corners corners : {Corners::four, Corners::three_mixed})
    for (const double offset : {0.0, 0.004}) {  // off its nodes: no other
      Grid grid = make_grid(20, 2, laminate, corners, [&](double u, double v) {
        return Vector3(L * u, b * v, 0.0);
      });
      for (StructureShell& shell : grid.structure.shells) {
        shell.axis = Vector3::UnitX();
        shell.offset = offset;
      }
      Matrix6X f = Matrix6X::Zero(6, grid.structure.x.cols());
      for (int j = 0; j <= 2; ++j) f(2, grid.node(20, j)) = j == 1 ? 0.5 : 0.25;
      const Matrix6X u =
          solve_static(grid.structure, f,
                       [](const Vector3& x, int) { return x.x() < 1e-9; });
      EXPECT_NEAR(u(2, grid.node(20, 1)), exact, 3e-3 * exact) << offset;
    }
}

/// [0/90] under tension at its end curves and narrows by classical laminate
/// theory, [e; k] = [A B; B D]^-1 [N; 0]. Of triangles the forces lack the
/// moments about the normal that go with a constant stress at an edge.
TEST(ShellElement, OfAnUnsymmetricLaminateCurvesUnderTension) {
  const double t = 0.002;
  const Laminate laminate =
      make_laminate({{kPly, t, 0.0}, {kPly, t, M_PI / 2.0}}, -t);
  Matrix6 ABD;
  ABD << laminate.A, laminate.B, laminate.B, laminate.D;
  const double N = 1000.0;
  const Vector6 strain = ABD.inverse() * (N * Vector6::Unit(0));
  ASSERT_GT(std::abs(strain[3]) * t, 0.1 * strain[0]);
  const double L = 0.5;
  const double b = 0.1;
  for (const Corners corners :
       {Corners::four, Corners::three, Corners::three_mixed}) {
    const int n = corners == Corners::four ? 3 : 6;
    Grid grid = make_grid(2 * n, n, laminate, corners, [&](double u, double v) {
      const double bump = 0.1 * std::sin(M_PI * u) * std::sin(M_PI * v);
      return Vector3(L * (u + 0.5 * bump), b * (v - bump), 0.0);
    });
    for (StructureShell& shell : grid.structure.shells)
      shell.axis = Vector3::UnitX();
    Matrix6X f = Matrix6X::Zero(6, grid.structure.x.cols());
    for (int j = 0; j <= n; ++j)
      f(0, grid.node(2 * n, j)) = N * b / n * (j % n == 0 ? 0.5 : 1.0);
    // The foot may narrow and curve across, about its corner at the origin.
    const Matrix6X u =
        solve_static(grid.structure, f, [](const Vector3& x, int c) {
          const bool is_corner = x.norm() < 1e-9;
          return x.x() < 1e-9 && (c == 0 || c == 4 || is_corner);
        });
    const int far = grid.node(2 * n, 0);
    const double tolerance = corners == Corners::four ? 1e-7 : 3e-3;
    EXPECT_NEAR(f.cwiseProduct(u).sum() / (N * b), strain[0] * L,
                tolerance * strain[0] * L);
    EXPECT_NEAR(u(2, far), -0.5 * strain[3] * L * L,
                tolerance * std::abs(0.5 * strain[3] * L * L));
  }
}

/// Between steps of refinement both elements come together.
TEST(ShellElement, QuadrilateralsAndTrianglesOfACoupledLaminateAgree) {
  const auto deflect = [](int n, Corners corners) {
    Grid grid =
        make_grid(n, n, make_skew_laminate(), corners, [](double u, double v) {
          return Vector3(0.3 * u, 0.3 * v, 0.02 * u * v);
        });
    for (StructureShell& shell : grid.structure.shells)
      shell.axis = Vector3::UnitX();
    Matrix6X f = Matrix6X::Zero(6, grid.structure.x.cols());
    f.col(grid.node(n, n)).head<3>() = Vector3(20.0, 0.0, 1.0);
    const Matrix6X u = solve_static(
        grid.structure, f, [](const Vector3& x, int) { return x.x() < 1e-9; });
    return u(2, grid.node(n, n));
  };
  const auto differ = [&](int n) {
    return std::abs(
        deflect(n, Corners::three_mixed) / deflect(n, Corners::four) - 1.0);
  };
  const double coarse = differ(6);
  const double fine = differ(24);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, coarse);
}

TEST(ShellElement, RefusesShapesWithoutAnArea) {
  const Laminate plate = make_plate(1.0, 0.3, 0.1);
  ShellShape shape{Matrix3X(3, 4), Vector3::UnitX()};
  shape.x << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0;
  EXPECT_ANY_THROW(static_cast<void>(make_quad_shell(shape, plate)));
  shape.x = Matrix3X::Zero(3, 3);
  shape.x(0, 1) = 1.0;
  shape.x(0, 2) = 2.0;
  EXPECT_ANY_THROW(static_cast<void>(make_triangle_shell(shape, plate)));
}

}  // namespace
}  // namespace limber::fem::structural_test
