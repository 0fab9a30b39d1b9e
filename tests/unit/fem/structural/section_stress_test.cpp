// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "limber/common/rotation.hpp"
#include "unit/fem/structural/shell_grid.hpp"

/// Stress of shells and beams from their displacements.
namespace limber::fem::structural_test {
namespace {

const Matrix3 kTurn = exp_rotation(Vector3(0.4, -0.7, 0.3));

/// Flat, distorted, turned in space by kTurn.
Grid make_distorted(const Laminate& laminate, Corners corners) {
  return make_grid(4, 4, laminate, corners, [](double u, double v) {
    const double bump = std::sin(3.0 * u) * std::sin(2.0 * v) * 0.1;
    return Vector3(kTurn *
                   Vector3(u + bump * (1 - u), v - 0.7 * bump * (1 - v), 0.0));
  });
}

/// Displacements and rotations of constant strains e and curvatures k [11, 22,
/// 2 12] of the plane, deflection against the curvature.
Matrix6X bend_plane(const Grid& grid, const Vector3& e, const Vector3& k) {
  Matrix6X u(6, grid.structure.x.cols());
  for (Eigen::Index n = 0; n < u.cols(); ++n) {
    const Vector3 x = kTurn.transpose() * grid.structure.x.col(n);
    const Vector3 moved(
        e[0] * x[0] + 0.5 * e[2] * x[1], e[1] * x[1] + 0.5 * e[2] * x[0],
        -0.5 * (k[0] * x[0] * x[0] + k[1] * x[1] * x[1] + k[2] * x[0] * x[1]));
    const Vector3 rotated(-k[1] * x[1] - 0.5 * k[2] * x[0],
                          k[0] * x[0] + 0.5 * k[2] * x[1], 0.0);
    u.col(n) << kTurn * moved, kTurn * rotated;
  }
  return u;
}

Vector6 to_components(const Matrix3& s) {
  return (Vector6() << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2))
      .finished();
}

/// Components in the model's axes of [11, 22, 12] in the turned plane.
Vector6 turn_plane(const Vector3& s) {
  Matrix3 local = Matrix3::Zero();
  local(0, 0) = s[0];
  local(1, 1) = s[1];
  local(0, 1) = local(1, 0) = s[2];
  return to_components(kTurn * local * kTurn.transpose());
}

const Vector3 kStrain(1e-3, -4e-4, 7e-4);
const Vector3 kCurvature(0.02, 0.05, -0.03);

TEST(SectionStress, OfConstantStrainAndCurvatureIsExact) {
  const double E = 7e10;
  const double nu = 0.3;
  const double t = 0.02;
  for (const Corners corners : {Corners::four, Corners::three_mixed}) {
    const Grid grid = make_distorted(make_plate(E, nu, t), corners);
    const Matrix6X u = bend_plane(grid, kStrain, kCurvature);
    for (const auto& [face, z] : {std::pair{SectionFace::bottom, -0.5 * t},
                                  {SectionFace::middle, 0.0},
                                  {SectionFace::top, 0.5 * t}}) {
      const Vector3 e = kStrain + z * kCurvature;
      const Vector3 expected =
          E / (1.0 - nu * nu) *
          Vector3(e[0] + nu * e[1], e[1] + nu * e[0], 0.5 * (1.0 - nu) * e[2]);
      for (const int node : {0, 7, grid.node(2, 2)})
        EXPECT_LT(
            (find_stress(grid.structure, u, node, face) - turn_plane(expected))
                .norm(),
            1e-8 * expected.norm());
    }
  }
}

/// Two plies across each other, off the nodes: 0 degrees from z = 0.01 to
/// 0.012, 90 degrees to 0.015, by the plies' own stiffness.
TEST(SectionStress, OfPliesIsThatOfTheirStrain) {
  const PlyMaterial m{1.4e11, 1e10, 0.3,    5e9,
                      5e9,    3e9,  1600.0, Vector6::Zero()};
  const Laminate laminate =
      make_laminate({{m, 0.002, 0.0}, {m, 0.003, 0.5 * M_PI}}, -0.0025);
  Grid grid = make_distorted(laminate, Corners::four);
  for (StructureShell& shell : grid.structure.shells) {
    shell.axis = kTurn.col(0);
    shell.offset = 0.0125;
  }
  const Matrix6X u = bend_plane(grid, kStrain, kCurvature);
  const double d = 1.0 - 0.09 * m.E_2 / m.E_1;
  const auto expect = [&](SectionFace face, int ply, double z) {
    const Vector3 e = kStrain + z * kCurvature;
    const double E1 = ply == 1 ? m.E_1 : m.E_2;
    const double E2 = ply == 1 ? m.E_2 : m.E_1;
    const double coupling = 0.3 * m.E_2 / d;
    const Vector3 expected(E1 / d * e[0] + coupling * e[1],
                           E2 / d * e[1] + coupling * e[0], m.G_12 * e[2]);
    const Vector6 found = find_stress(grid.structure, u, 12, face, ply);
    // But for shear stress, which balances a varying moment: there is none.
    EXPECT_LT((found - turn_plane(expected)).norm(), 1e-7 * expected.norm())
        << ply << ' ' << z;
  };
  expect(SectionFace::bottom, 1, 0.010);
  expect(SectionFace::ply_top, 1, 0.012);
  expect(SectionFace::ply_bottom, 2, 0.012);
  expect(SectionFace::top, 2, 0.015);
}

TEST(SectionStress, AxesAreThoseOfTheFibre) {
  const PlyMaterial m{1.4e11, 1e10, 0.3,    5e9,
                      5e9,    3e9,  1600.0, Vector6::Zero()};
  Grid grid =
      make_distorted(make_laminate({{m, 0.002, 0.3}, {m, 0.002, -0.5}}, -0.002),
                     Corners::four);
  for (StructureShell& shell : grid.structure.shells) {
    shell.axis = kTurn.col(0);
    shell.angle = 0.1;
  }
  const SectionStress stress =
      recover(grid.structure, Matrix6X::Zero(6, grid.structure.x.cols()));
  for (const StressPoint& point : stress.points) {
    const double angle = point.ply == 1 ? 0.4 : -0.4;
    EXPECT_LT((point.axes.col(0) -
               kTurn * Vector3(std::cos(angle), std::sin(angle), 0.0))
                  .norm(),
              1e-12);
    EXPECT_LT((point.axes.col(2) - kTurn.col(2)).norm(), 1e-12);
  }
}

TEST(SectionStress, TopAndBottomChangeWithTheOrderOfNodes) {
  Grid grid = make_distorted(make_plate(7e10, 0.3, 0.02), Corners::four);
  const Matrix6X u = bend_plane(grid, kStrain, kCurvature);
  const Vector6 top = find_stress(grid.structure, u, 8, SectionFace::top);
  const Vector6 bottom = find_stress(grid.structure, u, 8, SectionFace::bottom);
  EXPECT_GT((top - bottom).norm(), 0.1 * top.norm());
  for (StructureShell& shell : grid.structure.shells)
    std::reverse(shell.nodes.begin(), shell.nodes.end());
  EXPECT_LT(
      (find_stress(grid.structure, u, 8, SectionFace::bottom) - top).norm(),
      1e-9 * top.norm());
  EXPECT_LT(
      (find_stress(grid.structure, u, 8, SectionFace::top) - bottom).norm(),
      1e-9 * top.norm());
}

/// A strip under a force across its end: 3/2 V / A half-way through it.
TEST(SectionStress, ShearIsParabolicThroughTheThickness) {
  for (const Corners corners : {Corners::four, Corners::three}) {
    const Grid grid =
        make_grid(10, 2, make_plate(1e9, 0.0, 0.1), corners,
                  [](double u, double v) { return Vector3(u, 0.2 * v, 0.0); });
    Matrix6X f = Matrix6X::Zero(6, grid.structure.x.cols());
    for (int j = 0; j <= 2; ++j) f(2, grid.node(10, j)) = j == 1 ? 50.0 : 25.0;
    const Matrix6X u =
        solve_static(grid.structure, f, [](const Vector3& x, int c) {
          return x.x() < 1e-9 || c == 1 || c == 3;
        });
    const int at = grid.node(5, 1);
    const Vector6 middle =
        find_stress(grid.structure, u, at, SectionFace::middle);
    const double tolerance = corners == Corners::four ? 1e-3 : 0.07;
    EXPECT_NEAR(middle[5], 1.5 * 100.0 / 0.02, tolerance * 7500.0);
    const Vector6 top = find_stress(grid.structure, u, at, SectionFace::top);
    EXPECT_NEAR(top[5], 0.0, 1e-6);
    // The load lifts the end: the top is compressed.
    const double bend = 100.0 * 0.5 * 0.05 / (0.2 * 0.1 * 0.1 * 0.1 / 12.0);
    EXPECT_NEAR(top[0], -bend, 0.01 * bend);
  }
}

/// Up to its foot and its edges, where triangles lie on one side.
TEST(SectionStress, OfTrianglesGrowsLinearlyToTheFootOfACantilever) {
  const Grid grid =
      make_grid(10, 2, make_plate(1e9, 0.0, 0.1), Corners::three_mixed,
                [](double u, double v) { return Vector3(u, 0.2 * v, 0.0); });
  Matrix6X f = Matrix6X::Zero(6, grid.structure.x.cols());
  for (int j = 0; j <= 2; ++j) f(2, grid.node(10, j)) = j == 1 ? 50.0 : 25.0;
  const Matrix6X u = solve_static(
      grid.structure, f,
      [](const Vector3& x, int c) { return x.x() < 1e-9 || c == 1 || c == 3; });
  const double foot = 100.0 * 0.05 / (0.2 * 0.1 * 0.1 * 0.1 / 12.0);
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j <= 2; ++j)
      EXPECT_NEAR(
          find_stress(grid.structure, u, grid.node(i, j), SectionFace::top)[0],
          -foot * (1.0 - 0.1 * i), 2e-3 * foot)
          << i << ' ' << j;
}

/// sigma = p r / t around a cylinder whose ends are free.
TEST(SectionStress, OfACylinderUnderPressureIsThatOfItsHoop) {
  for (const Corners corners : {Corners::four, Corners::three_mixed}) {
    // Flat triangles bend a little where they meet, long ones more.
    const int count = corners == Corners::four ? 16 : 24;
    const int rows = corners == Corners::four ? 4 : 8;
    const Grid grid = make_grid(count, rows, make_plate(2e11, 0.3, 0.01),
                                corners, [](double u, double v) {
                                  const double a = 0.5 * M_PI * u;
                                  return Vector3(std::cos(a), std::sin(a), v);
                                });
    Matrix6X f = Matrix6X::Zero(6, grid.structure.x.cols());
    for (const StructureShell& shell : grid.structure.shells) {
      const Matrix3X x = grid.structure.x(Eigen::all, shell.nodes);
      const Eigen::Index n = x.cols();
      const Vector3 area =
          0.5 * Vector3(x.col(2) - x.col(0))
                    .cross(n == 4 ? Vector3(x.col(3) - x.col(1))
                                  : Vector3(x.col(2) - x.col(1)));
      for (const int node : shell.nodes)
        f.col(node).head<3>() += 1e5 * area / static_cast<double>(n);
    }
    const Matrix6X u =
        solve_static(grid.structure, f, [](const Vector3& x, int c) {
          const auto holds = [&](int axis) {
            return std::abs(x[axis]) < 1e-9 &&
                   (c == axis || (c > 2 && c - 3 != axis));
          };
          return holds(0) || holds(1) || holds(2);
        });
    const double hoop = 1e5 / 0.01;
    for (const SectionFace face : {SectionFace::bottom, SectionFace::top}) {
      // Along y at x = 1 on the edge of the quarter, and inside of it.
      EXPECT_NEAR(
          find_stress(grid.structure, u, grid.node(0, rows / 2), face)[1], hoop,
          0.02 * hoop);
      const Vector6 s =
          find_stress(grid.structure, u, grid.node(count / 2, rows / 2), face);
      EXPECT_NEAR(0.5 * (s[0] + s[1]) - s[3], hoop, 0.02 * hoop);
      EXPECT_NEAR(s[2], 0.0, 0.02 * hoop);
    }
  }
}

/// Two plates along a fold keep their own stress there.
TEST(SectionStress, IsNotAveragedOverAFold) {
  const Grid grid = make_grid(
      2, 1, make_plate(1e9, 0.0, 0.1), Corners::four, [](double u, double v) {
        return u < 0.6 ? Vector3(u, v, 0.0) : Vector3(0.5, v, u - 0.5);
      });
  Matrix6X u = Matrix6X::Zero(6, 6);  // stretches the second along z alone
  u(2, grid.node(2, 0)) = u(2, grid.node(2, 1)) = 1e-3;
  const SectionStress stress = recover(grid.structure, u);
  const VectorX all = stress.stress.col(0);
  std::vector<double> along;
  for (std::size_t p = 0; p < stress.points.size(); ++p)
    if (stress.points[p].node == grid.node(1, 0) &&
        stress.points[p].face == SectionFace::middle)
      along.push_back(all[6 * static_cast<Eigen::Index>(p) + 2]);
  std::sort(along.begin(), along.end());
  ASSERT_EQ(along.size(), 2U);
  EXPECT_NEAR(along[0], 0.0, 1e-3);
  EXPECT_NEAR(along[1], 1e9 * 2e-3, 1.0);
}

/// Middle of a simply supported square plate under pressure: 0.0479 q a^2
/// (Timoshenko and Woinowsky-Krieger, table 8), so that sigma = 0.2874 q a^2 /
/// t^2.
TEST(SectionStress, OfAPlateUnderPressure) {
  for (const Corners corners : {Corners::four, Corners::three_mixed}) {
    constexpr int kCount = 16;
    const Grid grid = make_grid(
        kCount, kCount, make_plate(2e11, 0.3, 0.01), corners,
        [](double u, double v) { return Vector3(0.5 * u, 0.5 * v, 0.0); });
    Matrix6X f = Matrix6X::Zero(6, grid.structure.x.cols());
    for (int j = 0; j <= kCount; ++j)
      for (int i = 0; i <= kCount; ++i)
        f(2, grid.node(i, j)) = -1000.0 * 0.25 * grid.fraction(i, j);
    const Matrix6X u =
        solve_static(grid.structure, f, [](const Vector3& x, int c) {
          const auto holds = [&](int axis) {
            return std::abs(x[axis]) < 1e-9 &&
                   (c == axis || (c > 2 && c - 3 != axis));
          };
          const bool is_edge = x.x() > 0.5 - 1e-9 || x.y() > 0.5 - 1e-9;
          return holds(0) || holds(1) || (is_edge && c == 2);
        });
    const double expected = 0.2874 * 1000.0 / 1e-4;
    const Vector6 bottom =
        find_stress(grid.structure, u, 0, SectionFace::bottom);
    EXPECT_NEAR(bottom[0], expected, 0.01 * expected);
    EXPECT_NEAR(bottom[1], expected, 0.01 * expected);
    EXPECT_NEAR(find_stress(grid.structure, u, 0, SectionFace::top)[0],
                -expected, 0.01 * expected);
  }
}

}  // namespace
}  // namespace limber::fem::structural_test
