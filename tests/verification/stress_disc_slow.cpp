// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "limber/fem/solid/stress_recovery.hpp"
#include "limber/flexbody/model/stress_modes.hpp"
#include "limber/reduction/operating_states.hpp"
#include "support/temporary_folder.hpp"

namespace limber::flexbody::stress_disc_slow {
namespace {

constexpr double kInner = 0.1;    // [m]
constexpr double kOuter = 0.3;    // [m]
constexpr double kSpeed = 200.0;  // [rad/s]
const Material kSteel{210e9, 0.3, 7800.0};

/// Where the layers of elements end, over the thickness of the wall: each 1.15
/// times as thick as that inside it, as stress changes most at the hole.
std::vector<double> grade_layers(int count) {
  std::vector<double> ends;
  for (int i = 1; i <= count; ++i) {
    ends.push_back((std::pow(1.15, i) - 1.0) / (std::pow(1.15, count) - 1.0));
  }
  return ends;
}

/// Bricks of second order: 10 across the wall, 32 around, one along the axis.
Recipe make_disc() {
  const std::vector<double> layers = grade_layers(10);
  const std::filesystem::path file = limber::test::own_folder() / "disc.geo";
  std::ofstream(file)
      << "SetFactory(\"Built-in\");\nPoint(1) = {0.1, 0, 0};\n"
      << fmt::format(
             "l[] = Extrude {{0.2, 0, 0}} {{ Point{{1}}; Layers{{ {{{}}}, "
             "{{{}}} }}; "
             "}};\n",
             fmt::join(std::vector<int>(layers.size(), 1), ","),
             fmt::join(layers, ","))
      << "s1[] = Extrude {{0,0,1},{0,0,0},Pi/2} { Line{l[1]}; Layers{8}; "
         "Recombine; };\n"
         "s2[] = Extrude {{0,0,1},{0,0,0},Pi/2} { Line{s1[0]}; Layers{8}; "
         "Recombine; };\n"
         "s3[] = Extrude {{0,0,1},{0,0,0},Pi/2} { Line{s2[0]}; Layers{8}; "
         "Recombine; };\n"
         "s4[] = Extrude {{0,0,1},{0,0,0},Pi/2} { Line{s3[0]}; Layers{8}; "
         "Recombine; };\n"
         "v[] = Extrude {0, 0, 0.01} { Surface{s1[1], s2[1], s3[1], s4[1]}; "
         "Layers{1}; Recombine; };\n"
         "Coherence;\n"
         "Physical Volume(\"disc\") = {v[1], v[7], v[13], v[19]};\n";
  Recipe recipe;
  recipe.name = "disc";
  recipe.mesh.file = file;
  recipe.mesh.order = 2;
  recipe.materials = {{"", kSteel}};
  return recipe;
}

struct PolarStress {
  double radial = 0.0;  // [Pa]
  double hoop = 0.0;    // [Pa]
};

/// A disc with a hole, thin along its axis, which it spins about.
///
/// Equation   s_r = (3 + nu) / 8 rho w^2 (a^2 + b^2 - a^2 b^2 / r^2 - r^2)
///            s_t = (3 + nu) / 8 rho w^2 (a^2 + b^2 + a^2 b^2 / r^2
///                                        - (1 + 3 nu) / (3 + nu) r^2)
/// Source     [@timoshenko1970, sec. 32]
PolarStress spin_disc(double r) {
  const double nu = kSteel.poisson_ratio;
  const double unit = (3.0 + nu) / 8.0 * kSteel.density * kSpeed * kSpeed;
  const double both = kInner * kInner + kOuter * kOuter;
  const double wall = std::pow(kInner * kOuter / r, 2);
  return {unit * (both - wall - r * r),
          unit * (both + wall - (1.0 + 3.0 * nu) / (3.0 + nu) * r * r)};
}

/// Axes along the radius, around, and z, as columns.
Matrix3 find_polar_axes(const Vector3& x) {
  const Vector3 radial = Vector3(x[0], x[1], 0.0).normalized();
  Matrix3 R;
  R << radial, Vector3::UnitZ().cross(radial), Vector3::UnitZ();
  return R;
}

TEST(StressOfAThickDisc, InSpinIsTheClosedFormAtAllNodes) {
  const Recipe recipe = make_disc();
  const MeshedBody body(recipe, {});
  const OperatingState state = find_spinning_state(body, {}, kSpeed);
  const fem::NodalStress stress = fem::recover_stress(
      body.mesh, find_materials(body.mesh, recipe), state.u.reshaped());
  ASSERT_EQ(stress.stress.cols(), body.mesh.x.cols());
  // Stiffening by spin, rho w^2 r^2 / E, is 1e-4; the rest is the mesh's.
  const double close = 0.01 * spin_disc(kInner).hoop;
  for (Eigen::Index i = 0; i < stress.stress.cols(); ++i) {
    const Vector3 x =
        body.mesh.x.col(stress.nodes[static_cast<std::size_t>(i)]);
    const double r = x.head<2>().norm();
    const Vector6 polar =
        rotate_stress(stress.stress.col(i), find_polar_axes(x));
    const PolarStress exact = spin_disc(r);
    EXPECT_NEAR(polar[0], exact.radial, close) << r;
    EXPECT_NEAR(polar[1], exact.hoop, close) << r;
    EXPECT_NEAR(polar.tail<4>().norm(), 0.0, close) << r;
  }
}

}  // namespace
}  // namespace limber::flexbody::stress_disc_slow
