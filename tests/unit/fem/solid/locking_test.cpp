// SPDX-License-Identifier: BSD-3-Clause
// The eigenvalues that second-order elements would have, from first-order
// ones, against meshes of second order.
#include "limber/fem/solid/locking.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/eigenmodes.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::locking_test {
namespace {

using testing::write_file;

const ElasticMaterial kSteel{210e9, 0.3, 7850.0};

enum class Kind { tetrahedra, hexahedra, prisms };

/// A bar along x: 1 x 1 elements in its section of 20 x 20 mm, `layers` along
/// its metre.
std::string bar_geo(Kind kind, int layers) {
  const bool has_quads = kind == Kind::hexahedra;
  return fmt::format(
      "Point(1) = {{0, -0.01, -0.01}}; Point(2) = {{0, 0.01, -0.01}};\n"
      "Point(3) = {{0, 0.01, 0.01}}; Point(4) = {{0, -0.01, 0.01}};\n"
      "Line(1) = {{1,2}}; Line(2) = {{2,3}}; Line(3) = {{3,4}};\n"
      "Line(4) = {{4,1}};\n"
      "Curve Loop(1) = {{1,2,3,4}}; Plane Surface(1) = {{1}};\n"
      "Transfinite Curve {{1,2,3,4}} = 2; Transfinite Surface {{1}};\n{}"
      "e[] = Extrude {{1, 0, 0}} {{ Surface{{1}}; Layers{{{}}};{} }};\n"
      "Physical Surface(\"root\") = {{1}};\n"
      "Physical Volume(\"body\") = {{e[1]}};\n",
      has_quads ? "Recombine Surface {1};\n" : "", layers,
      kind == Kind::tetrahedra ? "" : " Recombine;");
}

struct Body {
  Body(const std::filesystem::path& file, bool is_clamped)
      : mesh(read_mesh(file)), matrices(assemble(mesh, {kSteel})) {
    if (is_clamped) held = mesh.groups[find_group(mesh, "root")].nodes;
    free = find_free_nodes(mesh, held);
    if (is_clamped) matrices = restrict_to(matrices, free);
    const Matrix3X x = mesh.x(Eigen::all, free);
    R.resize(matrices.dof_count(), 0);
    if (!is_clamped) R = make_rigid_modes(matrices.M_s, x);
    modes = find_eigenmodes({matrices, R, x}, 3);
  }

  [[nodiscard]] MatrixX at_all_nodes(const MatrixX& part) const {
    MatrixX all = MatrixX::Zero(3 * mesh.x.cols(), part.cols());
    for (std::size_t i = 0; i < free.size(); ++i)
      all.middleRows<3>(3 * free[i]) =
          part.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    return all;
  }

  Mesh mesh;
  StructuralMatrices matrices;
  std::vector<int> held, free;
  MatrixX R;
  Eigenmodes modes;
};

struct Case {
  Kind kind;
  int layers;
  bool is_clamped;
  double least_error;  ///< of first-order elements' first frequency [-]
};

class Locking : public ::testing::TestWithParam<Case> {};

TEST_P(Locking, IsFoundByOneRefinementOfTheModes) {
  const auto& [kind, layers, is_clamped, least_error] = GetParam();
  const auto geo = write_file("bar.geo", bar_geo(kind, layers));
  const Body first(testing::convert(geo, "first.msh", {.order = 1}),
                   is_clamped);
  const Body second(
      testing::convert(geo, "second.msh", {.order = 2, .serendipity = true}),
      is_clamped);
  ASSERT_TRUE(is_first_order(first.mesh));
  ASSERT_FALSE(is_first_order(second.mesh));
  const VectorX refined = calc_refined_eigenvalues(
      first.mesh, {kSteel},
      {first.modes.lambda, first.at_all_nodes(first.modes.Phi),
       first.at_all_nodes(first.R), first.held});
  const double known = second.modes.lambda[0];
  const double error = std::sqrt(first.modes.lambda[0] / known) - 1.0;
  const double estimate =
      std::sqrt(first.modes.lambda[0] / refined.minCoeff()) - 1.0;
  EXPECT_GT(error, least_error);
  constexpr double kBound = 1e-3;  // quadrature of the edges' mass
  EXPECT_GT(refined.minCoeff(), (1.0 - kBound) * known);
  EXPECT_NEAR(estimate, error, 0.1 * error);
}

INSTANTIATE_TEST_SUITE_P(
    Bars, Locking,
    ::testing::Values(Case{Kind::hexahedra, 30, false, 0.4},
                      Case{Kind::hexahedra, 30, true, 0.4},
                      Case{Kind::hexahedra, 10, true, 1.0},
                      Case{Kind::tetrahedra, 30, false, 1.0},
                      Case{Kind::tetrahedra, 30, true, 1.0},
                      Case{Kind::tetrahedra, 60, true, 0.5},
                      Case{Kind::prisms, 30, false, 0.4},
                      Case{Kind::prisms, 30, true, 0.4}));

}  // namespace
}  // namespace limber::fem::locking_test
