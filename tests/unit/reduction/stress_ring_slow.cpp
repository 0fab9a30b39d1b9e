// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "limber/fem/solid/stress_recovery.hpp"
#include "limber/flexbody/model/stress_modes.hpp"
#include "limber/reduction/operating_states.hpp"

namespace limber::flexbody {
namespace {

// A thin ring about its axis: the hoop stress at its inner wall is
// rho w^2 ((3 + nu) b^2 + (1 - nu) a^2) / 4 [Timoshenko, Goodier, sec. 32].
TEST(StressOfARing, InSpinIsTheClosedFormAtItsInnerWall) {
  const double a = 0.2, b = 0.3, w = 200.0, nu = 0.3, rho = 7800.0;
  const std::string file = ::testing::TempDir() + "ring.geo";
  std::ofstream(file)
      << "SetFactory(\"Built-in\");\nPoint(1) = {0.2, 0, 0};\n"
         "l[] = Extrude {0.1, 0, 0} { Point{1}; Layers{4}; };\n"
         "s1[] = Extrude {{0,0,1},{0,0,0},Pi/2} { Line{l[1]}; Layers{10}; "
         "Recombine; };\n"
         "s2[] = Extrude {{0,0,1},{0,0,0},Pi/2} { Line{s1[0]}; Layers{10}; "
         "Recombine; };\n"
         "s3[] = Extrude {{0,0,1},{0,0,0},Pi/2} { Line{s2[0]}; Layers{10}; "
         "Recombine; };\n"
         "s4[] = Extrude {{0,0,1},{0,0,0},Pi/2} { Line{s3[0]}; Layers{10}; "
         "Recombine; };\n"
         "v[] = Extrude {0, 0, 0.01} { Surface{s1[1], s2[1], s3[1], s4[1]}; "
         "Layers{1}; Recombine; };\n"
         "Coherence;\n"
         "Physical Volume(\"ring\") = {v[1], v[7], v[13], v[19]};\n";
  Recipe recipe;
  recipe.name = "ring";
  recipe.mesh.file = file;
  recipe.mesh.order = 2;
  recipe.materials = {{"", {210e9, nu, rho}}};
  const MeshedBody body(recipe, {});
  const OperatingState state = find_spinning_state(body, {}, w);
  const fem::NodalStress stress = fem::recover_stress(
      body.mesh, find_materials(body.mesh, recipe), state.u.reshaped());
  const double hoop =
      rho * w * w / 4.0 * ((3.0 + nu) * b * b + (1.0 - nu) * a * a);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < stress.stress.cols(); ++i) {
    const Vector3 x =
        body.mesh.x.col(stress.nodes[static_cast<std::size_t>(i)]);
    const double r = x.head<2>().norm();
    const double mises = calc_von_mises(stress.stress.col(i));
    largest = std::max(largest, mises);
    if (r > a + 1e-9) continue;
    EXPECT_NEAR(mises, hoop, 0.01 * hoop);
  }
  EXPECT_NEAR(largest, hoop, 0.01 * hoop);
}

}  // namespace
}  // namespace limber::flexbody
