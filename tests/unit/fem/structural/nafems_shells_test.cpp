// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "unit/fem/structural/shell_grid.hpp"

/// Benchmarks of NAFEMS by shells: The Standard NAFEMS Benchmarks, TNSB rev. 3
/// (1990), LE1 and LE3; Selected Benchmarks for Natural Frequency Analysis,
/// R0015 (1987), FV12 and test 21.
namespace limber::fem::structural_test {
namespace {

constexpr double kOnPlane = 1e-9;

bool holds_symmetry(const Vector3& x, int component, int axis) {
  return std::abs(x[axis]) < 1e-6 &&
         (component == axis || (component > 2 && component - 3 != axis));
}

/// LE1: elliptic membrane, 0.1 m thick, pulled outward by 10 MPa at its outer
/// edge. @returns s_yy at D (2, 0) over 92.7 MPa
double stress_membrane(int around, int across, Corners corners) {
  const Grid grid =
      make_grid(around, across, make_plate(210e9, 0.3, 0.1), corners,
                [](double u, double v) {
                  const double a = 0.5 * M_PI * u;
                  return Vector3((2.0 + 1.25 * v) * std::cos(a),
                                 (1.0 + 1.75 * v) * std::sin(a), 0.0);
                });
  Matrix6X f = Matrix6X::Zero(6, grid.structure.x.cols());
  for (int i = 0; i < around; ++i) {
    const int a = grid.node(i, across);
    const int b = grid.node(i + 1, across);
    const Vector3 side = grid.structure.x.col(b) - grid.structure.x.col(a);
    const Vector3 half = 0.5 * 10e6 * 0.1 * Vector3(side.y(), -side.x(), 0.0);
    f.col(a).head<3>() += half;
    f.col(b).head<3>() += half;
  }
  const Matrix6X u =
      solve_static(grid.structure, f, [](const Vector3& x, int c) {
        return c == 2 || c == 3 || c == 4 || holds_symmetry(x, c, 0) ||
               holds_symmetry(x, c, 1);
      });
  return find_stress(grid.structure, u, 0, SectionFace::middle)[1] / 92.7e6;
}

TEST(NafemsShells, EllipticMembrane) {
  for (const auto& [n, tolerance] : {std::pair{1, 0.02}, {2, 0.01}}) {
    const double found = stress_membrane(24 * n, 12 * n, Corners::four);
    EXPECT_NEAR(found, 1.0, tolerance);
    EXPECT_NEAR(found, n == 1 ? 0.9837 : 0.9944, 0.012);  // CalculiX, S8R
    RecordProperty("quadrilaterals" + std::to_string(n), std::to_string(found));
  }
  for (const auto& [n, tolerance] :
       {std::pair{1, 0.04}, {2, 0.01}, {3, 0.01}}) {
    const double found = stress_membrane(24 * n, 12 * n, Corners::three_mixed);
    EXPECT_NEAR(found, 1.0, tolerance);
    RecordProperty("triangles" + std::to_string(n), std::to_string(found));
  }
}

/// An eighth of a sphere of radius 10 m in three blocks of n x n, closed at the
/// pole.
Structure make_octant(int n, bool has_triangles) {
  Structure structure;
  structure.source = "octant";
  structure.laminates = {make_plate(68.25e9, 0.3, 0.04)};
  std::map<std::tuple<long, long, long>, int> known;
  std::vector<Vector3> points;
  const auto add_node = [&](const Vector3& x) {
    const auto key =
        std::tuple(std::lround(1e6 * x[0]), std::lround(1e6 * x[1]),
                   std::lround(1e6 * x[2]));
    const auto [entry, is_new] =
        known.try_emplace(key, static_cast<int>(points.size()));
    if (is_new) {
      points.push_back(x);
      structure.tags.push_back(points.size());
    }
    return entry->second;
  };
  const auto add_shell = [&](std::vector<int> nodes) {
    StructureShell shell;
    shell.nodes = std::move(nodes);
    structure.shells.push_back(std::move(shell));
  };
  for (int block = 0; block < 3; ++block) {
    const auto at = [&](int i, int j) {
      Vector3 x;
      x[block] = 1.0;
      x[(block + 1) % 3] = std::tan(0.25 * M_PI * i / n);
      x[(block + 2) % 3] = std::tan(0.25 * M_PI * j / n);
      return add_node(10.0 * x.normalized());
    };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = at(i, j);
        const int b = at(i + 1, j);
        const int c = at(i + 1, j + 1);
        const int d = at(i, j + 1);
        if (has_triangles) {
          add_shell({a, b, c});
          add_shell({a, c, d});
        } else {
          add_shell({a, b, c, d});
        }
      }
  }
  structure.x.resize(3, std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i)
    structure.x.col(static_cast<Eigen::Index>(i)) = points[i];
  return structure;
}

/// LE3: hemisphere under forces of 2 kN. @returns displacement at A (10, 0, 0)
/// over 0.185 m
double deflect_octant(int n, bool has_triangles) {
  const Structure structure = make_octant(n, has_triangles);
  Matrix6X f = Matrix6X::Zero(6, structure.x.cols());
  int a = -1;
  for (int i = 0; i < static_cast<int>(structure.x.cols()); ++i) {
    const Vector3 x = structure.x.col(i);
    if ((x - Vector3(10.0, 0.0, 0.0)).norm() < 1e-6) f(0, a = i) = 2000.0;
    if ((x - Vector3(0.0, 10.0, 0.0)).norm() < 1e-6) f(1, i) = -2000.0;
  }
  const Matrix6X u = solve_static(structure, f, [](const Vector3& x, int c) {
    const bool is_pole = c == 2 && x.z() > 10.0 - 1e-6;
    return is_pole || holds_symmetry(x, c, 0) || holds_symmetry(x, c, 1);
  });
  return u(0, a) / 0.185;
}

TEST(NafemsShells, HemisphereUnderForces) {
  for (const auto& [n, tolerance] :
       {std::pair{8, 0.02}, {16, 0.01}, {24, 0.01}}) {
    const double found = deflect_octant(n, false);
    EXPECT_NEAR(found, 1.0, tolerance) << n;
    if (n == 16) {
      EXPECT_NEAR(found, 1.0011, 0.01);  // CalculiX, S8R
    }
    RecordProperty("quadrilaterals" + std::to_string(n), std::to_string(found));
  }
  const double found = deflect_octant(24, true);
  EXPECT_NEAR(found, 1.0, 0.02);
  RecordProperty("triangles24", std::to_string(found));
}

/// CalculiX 2.20 with as many elements (tests/data/structures/README.md).
const VectorX kPlateS4 =
    (VectorX(6) << 1.6256, 2.3621, 2.9270, 4.2325, 4.2325, 7.3902).finished();
const VectorX kPlateS8R =
    (VectorX(6) << 1.6187, 2.3592, 2.9218, 4.1827, 4.1827, 7.3537).finished();

/// FV12: free thin square plate. Its target of modes 7 and 8, of 1973, is 1 %
/// above that of Leissa's later coefficient 34.80.
TEST(NafemsShells, FrequenciesOfAFreePlate) {
  const VectorX expected =
      (VectorX(6) << 1.622, 2.360, 2.922, 4.233, 4.233, 7.416).finished();
  for (const Corners corners : {Corners::four, Corners::three_mixed}) {
    const Grid grid = make_grid(
        24, 24, make_plate(200e9, 0.3, 0.05, 8000.0), corners,
        [](double u, double v) { return Vector3(10.0 * u, 10.0 * v, 0.0); });
    const VectorX found = find_frequencies(
        grid.structure, 9,
        [](const Vector3&, int c) { return c == 0 || c == 1 || c == 5; }, 10.0);
    EXPECT_LT(found[2], 1e-3);
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(found[i + 3] / expected[i], 1.0, 0.02) << i;
    for (const VectorX& calculix : {kPlateS4, kPlateS8R})
      for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(found[i + 3] / calculix[i], 1.0, 0.012) << i;
  }
}

/// Test 21: simply supported thick square plate.
TEST(NafemsShells, FrequenciesOfAThickPlate) {
  const VectorX expected =
      (VectorX(6) << 45.897, 109.44, 109.44, 167.89, 204.51, 204.51).finished();
  for (const Corners corners : {Corners::four, Corners::three_mixed}) {
    const Grid grid = make_grid(
        24, 24, make_plate(200e9, 0.3, 1.0, 8000.0), corners,
        [](double u, double v) { return Vector3(10.0 * u, 10.0 * v, 0.0); });
    const VectorX found =
        find_frequencies(grid.structure, 6, [](const Vector3& x, int c) {
          const bool is_x = x.x() < kOnPlane || x.x() > 10.0 - kOnPlane;
          const bool is_y = x.y() < kOnPlane || x.y() > 10.0 - kOnPlane;
          return c == 0 || c == 1 || c == 5 || (c == 2 && (is_x || is_y)) ||
                 (c == 3 && is_x) || (c == 4 && is_y);
        });
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(found[i] / expected[i], 1.0, 0.02) << i;
  }
}

}  // namespace
}  // namespace limber::fem::structural_test
