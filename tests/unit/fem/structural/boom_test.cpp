// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/fem/structural/beam_section.hpp"
#include "unit/fem/structural/shell_grid.hpp"

/// The upper boom of a manipulator of the size of the Space Shuttle's, 6.4 m of
/// tube with a radius of 0.165 m and a wall of 2.5 mm of carbon fibre, clamped
/// at one end: by shells and by beams.
namespace limber::fem::structural_test {
namespace {

constexpr double kBoomLength = 6.4;
constexpr double kRadius = 0.165;  // of the middle of the wall
constexpr double kWall = 0.0025;
constexpr double kModulus = 125e9;
constexpr double kPoisson = 0.3;
constexpr double kDensity = 1600.0;

BeamSection make_boom_section() {
  return make_tube(kRadius + 0.5 * kWall, kRadius - 0.5 * kWall, kPoisson);
}

/// First and second bending of a quarter, whose edges at z = 0 are in a plane
/// of antisymmetry, those at y = 0 in one of symmetry.
VectorX find_shell_frequencies(int columns, int rows, Corners corners) {
  const Laminate wall = make_plate(kModulus, kPoisson, kWall, kDensity);
  const Grid grid =
      make_grid(columns, rows, wall, corners, [](double u, double v) {
        const double angle = 0.5 * M_PI * v;
        return Vector3(kBoomLength * u, kRadius * std::cos(angle),
                       kRadius * std::sin(angle));
      });
  return find_frequencies(grid.structure, 2, [](const Vector3& x, int c) {
    if (x.x() < 1e-9) return true;
    if (std::abs(x.z()) < 1e-9) return c == 0 || c == 1 || c == 5;
    return std::abs(x.y()) < 1e-9 && (c == 1 || c == 3 || c == 5);
  });
}

VectorX find_beam_frequencies(int count) {
  Structure structure;
  structure.beam_properties = {
      {make_boom_section(),
       {kModulus, kModulus / (2.0 + 2.0 * kPoisson), kDensity}}};
  structure.x.resize(3, count + 1);
  for (int i = 0; i <= count; ++i) {
    structure.tags.push_back(static_cast<std::size_t>(i) + 1);
    structure.x.col(i) = Vector3(kBoomLength * i / count, 0.0, 0.0);
    if (i == 0) continue;
    StructureBeam beam;
    beam.nodes = {i - 1, i};
    beam.up = Vector3::UnitY();
    structure.beams.push_back(beam);
  }
  return find_frequencies(structure, 2, [](const Vector3& x, int c) {
    return x.x() < 1e-9 || c == 0 || c == 1 || c == 3 || c == 5;
  });
}

// Slender, so that shear and rotary inertia lower Euler and Bernoulli's first
// frequency by less than 1 %.
TEST(Boom, BendsAsShellsAsItDoesAsBeams) {
  const BeamSection section = make_boom_section();
  const VectorX beams = find_beam_frequencies(24);
  const double euler =
      std::pow(1.8751040687 / kBoomLength, 2) / (2.0 * M_PI) *
      std::sqrt(kModulus * section.I_z / (kDensity * section.area));
  EXPECT_LT(beams[0], euler);
  EXPECT_NEAR(beams[0] / euler, 1.0, 0.01);
  for (const Corners corners : {Corners::four, Corners::three_mixed}) {
    const VectorX coarse = find_shell_frequencies(48, 8, corners);
    const VectorX fine = find_shell_frequencies(96, 16, corners);
    EXPECT_NEAR(coarse[0] / beams[0], 1.0, 0.01);
    EXPECT_NEAR(fine[0] / beams[0], 1.0, 0.003);
    EXPECT_NEAR(fine[1] / beams[1], 1.0, 0.01);
  }
}

}  // namespace
}  // namespace limber::fem::structural_test
