// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "unit/fem/structural/shell_grid.hpp"

/// Published problems of shells: MacNeal and Harder, A proposed standard set of
/// problems to test finite element accuracy, Finite Elem. Anal. Des. 1 (1985)
/// 3-20; NAFEMS, The Standard Benchmark Tests and Natural Frequency Benchmarks
/// (1990).
namespace limber::fem::structural_test {
namespace {

constexpr double kAtZero = 1e-9;

double degrees(double angle) { return angle * M_PI / 180.0; }

Matrix6X make_forces(const Grid& grid) {
  return Matrix6X::Zero(6, grid.structure.x.cols());
}

/// In the plane x = 0 (y = 0, z = 0), about which all is symmetric.
bool is_symmetric(const Vector3& x, int component, int axis) {
  const bool is_held =
      component == axis || (component > 2 && component - 3 != axis);
  return std::abs(x[axis]) < 1e-6 && is_held;
}

/// Vertical deflection in the middle of the free edge, of 0.3024.
double deflect_roof(int n, Corners corners) {
  const Grid grid = make_grid(
      n, n, make_plate(4.32e8, 0.0, 0.25), corners, [](double u, double v) {
        const double a = degrees(40.0) * u;
        return Vector3(25.0 * std::sin(a), 25.0 * v - 25.0, 25.0 * std::cos(a));
      });
  Matrix6X f = make_forces(grid);
  const double area = 25.0 * 25.0 * degrees(40.0);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      f(2, grid.node(i, j)) = -90.0 * area * grid.fraction(i, j);
  const Matrix6X u =
      solve_static(grid.structure, f, [](const Vector3& x, int c) {
        const bool is_diaphragm = x.y() < -25.0 + kAtZero && (c == 0 || c == 2);
        return is_diaphragm || is_symmetric(x, c, 0) || is_symmetric(x, c, 1);
      });
  return -u(2, grid.node(n, n)) / 0.3024;
}

TEST(ShellBenchmark, ScordelisLoRoof) {
  // CalculiX 2.20 with as many S4, and S8R (tests/data/structures/README.md)
  const double coarse = deflect_roof(6, Corners::four);
  EXPECT_LT(std::abs(coarse - 1.0), std::abs(0.8541 - 1.0));
  EXPECT_NEAR(deflect_roof(16, Corners::four), 0.9984, 0.005);
  RecordProperty("quadrilaterals6", std::to_string(coarse));
  for (const Corners corners : {Corners::four, Corners::three}) {
    EXPECT_NEAR(deflect_roof(6, corners), 1.0, 0.02);
    EXPECT_NEAR(deflect_roof(16, corners), 1.0, 0.005);
  }
}

/// Under the force, of 1.8248e-5 (Flugge, Stresses in Shells, by series).
double deflect_cylinder(int n, Corners corners) {
  const Grid grid = make_grid(
      n, n, make_plate(3e6, 0.3, 3.0), corners, [](double u, double v) {
        const double a = degrees(90.0) * u;
        return Vector3(300.0 * std::sin(a), 300.0 * v - 300.0,
                       300.0 * std::cos(a));
      });
  Matrix6X f = make_forces(grid);
  f(2, grid.node(0, n)) = -0.25;
  const Matrix6X u =
      solve_static(grid.structure, f, [](const Vector3& x, int c) {
        const bool is_diaphragm =
            x.y() < -300.0 + kAtZero && (c == 0 || c == 2);
        return is_diaphragm || is_symmetric(x, c, 0) || is_symmetric(x, c, 1) ||
               is_symmetric(x, c, 2);
      });
  return -u(2, grid.node(0, n)) / 1.8248e-5;
}

TEST(ShellBenchmark, PinchedCylinder) {
  EXPECT_NEAR(deflect_cylinder(16, Corners::four), 1.0, 0.08);
  EXPECT_NEAR(deflect_cylinder(32, Corners::four), 1.0, 0.02);
  EXPECT_NEAR(deflect_cylinder(16, Corners::three_mixed), 1.0, 0.02);
}

/// At the tip along its force: out of the plane 0.005424, in it 0.001754.
Vector3 deflect_twisted(int n, Corners corners) {
  const Grid grid = make_grid(
      6 * n, n, make_plate(29e6, 0.22, 0.32), corners, [](double u, double v) {
        const double a = degrees(90.0) * u;
        const double w = 1.1 * (v - 0.5);
        return Vector3(12.0 * u, w * std::cos(a), w * std::sin(a));
      });
  Vector3 ratio = Vector3::Ones();
  for (const int c : {1, 2}) {
    Matrix6X f = make_forces(grid);
    for (int j = 0; j <= n; ++j)
      f(c, grid.node(6 * n, j)) = (j % n == 0 ? 0.5 : 1.0) / n;
    const Matrix6X u =
        solve_static(grid.structure, f,
                     [](const Vector3& x, int) { return x.x() < kAtZero; });
    ratio[c] = u(c, grid.node(6 * n, n / 2)) / (c == 1 ? 0.001754 : 0.005424);
  }
  return ratio;
}

TEST(ShellBenchmark, TwistedBeam) {
  for (const Corners corners : {Corners::four, Corners::three}) {
    EXPECT_LT((deflect_twisted(2, corners) - Vector3::Ones()).norm(), 0.02);
    EXPECT_LT((deflect_twisted(4, corners) - Vector3::Ones()).norm(), 0.006);
  }
}

/// With a hole of 18 degrees, under opposite forces of 1: 0.0940.
double deflect_hemisphere(int n, Corners corners) {
  const Grid grid = make_grid(
      n, n, make_plate(6.825e7, 0.3, 0.04), corners, [](double u, double v) {
        const double a = degrees(90.0) * u;
        const double b = degrees(72.0) * v;
        return Vector3(10.0 * Vector3(std::cos(a) * std::cos(b),
                                      std::sin(a) * std::cos(b), std::sin(b)));
      });
  Matrix6X f = make_forces(grid);
  f(0, grid.node(0, 0)) = 1.0;
  f(1, grid.node(n, 0)) = -1.0;
  const Matrix6X u =
      solve_static(grid.structure, f, [](const Vector3& x, int c) {
        const bool is_held = c == 2 && x.z() < kAtZero && x.y() < kAtZero;
        return is_held || is_symmetric(x, c, 0) || is_symmetric(x, c, 1);
      });
  return u(0, grid.node(0, 0)) / 0.0940;
}

TEST(ShellBenchmark, Hemisphere) {
  EXPECT_NEAR(deflect_hemisphere(8, Corners::four), 1.0, 0.02);
  EXPECT_NEAR(deflect_hemisphere(16, Corners::four), 1.0, 0.011);
  // Triangles are stiff in shells that are thin and curved both ways.
  EXPECT_NEAR(deflect_hemisphere(32, Corners::three), 1.0, 0.02);
}

/// In the middle of a clamped square plate: 0.0056 F a^2 / D (Timoshenko and
/// Woinowsky-Krieger). Thin plates do not lock.
TEST(ShellBenchmark, ClampedPlateOfAnyThickness) {
  for (const Corners corners :
       {Corners::four, Corners::three, Corners::three_mixed})
    for (const double t : {1e-2, 1e-4, 1e-6}) {
      const Grid grid =
          make_grid(8, 8, make_plate(1e7, 0.3, t), corners,
                    [](double u, double v) { return Vector3(u, v, 0.0); });
      Matrix6X f = make_forces(grid);
      f(2, 0) = 0.25;
      const Matrix6X u =
          solve_static(grid.structure, f, [](const Vector3& x, int c) {
            return x.x() > 1.0 - kAtZero || x.y() > 1.0 - kAtZero ||
                   is_symmetric(x, c, 0) || is_symmetric(x, c, 1);
          });
      const double D = 1e7 * t * t * t / 12.0 / (1.0 - 0.09);
      EXPECT_NEAR(u(2, 0) * D / (0.0056 * 4.0), 1.0, 0.02) << t;
    }
}

/// Thin cantilevered square plate, out of its plane (NAFEMS FV16).
TEST(ShellBenchmark, FrequenciesOfACantileveredPlate) {
  const VectorX expected =
      (VectorX(6) << 0.421, 1.029, 2.582, 3.306, 3.753, 6.555).finished();
  for (const Corners corners : {Corners::four, Corners::three_mixed}) {
    const Grid grid = make_grid(
        24, 24, make_plate(200e9, 0.3, 0.05, 8000.0), corners,
        [](double u, double v) { return Vector3(10.0 * u, 10.0 * v, 0.0); });
    const VectorX found =
        find_frequencies(grid.structure, 6, [](const Vector3& x, int c) {
          return c == 0 || c == 1 || c == 5 || x.x() < kAtZero;
        });
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(found[i] / expected[i], 1.0, 0.02) << i;
  }
}

/// Cantilevered tapered membrane, in its plane (NAFEMS FV32).
TEST(ShellBenchmark, FrequenciesOfATaperedMembrane) {
  const VectorX expected =
      (VectorX(6) << 44.623, 130.03, 162.70, 246.05, 379.90, 391.44).finished();
  for (const Corners corners : {Corners::four, Corners::three_mixed}) {
    const Grid grid =
        make_grid(32, 16, make_plate(200e9, 0.3, 0.05, 8000.0), corners,
                  [](double u, double v) {
                    return Vector3(10.0 * u, (5.0 - 4.0 * u) * (v - 0.5), 0.0);
                  });
    const VectorX found =
        find_frequencies(grid.structure, 6, [](const Vector3& x, int c) {
          return c == 2 || c == 3 || c == 4 || x.x() < kAtZero;
        });
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(found[i] / expected[i], 1.0, 0.02) << i;
  }
}

}  // namespace
}  // namespace limber::fem::structural_test
