// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/factor_cost.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limber/fem/linalg/cholesky.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::factor_cost_test {
namespace {

/// A cube with so many tetrahedra of second order along each edge.
Mesh make_cube(int parts) {
  return read_mesh(
      testing::write_file(fmt::format("cube{}.geo", parts),
                          fmt::format("SetFactory(\"OpenCASCADE\");\n"
                                      "Box(1) = {{0, 0, 0, 1, 1, 1}};\n"
                                      "Physical Volume(\"body\") = {{1}};\n"
                                      "Mesh.MeshSizeMin = {0};\n"
                                      "Mesh.MeshSizeMax = {0};\n",
                                      1.0 / parts)),
      {.order = 2});
}

struct Cost {
  double seconds = 0.0;  // estimated
  double flops = 0.0;    // as CHOLMOD counts them for the whole matrix
};

Cost find_cost(const Mesh& mesh) {
  const ElasticMaterial steel{210e9, 0.3, 7850.0};
  const StructuralMatrices matrices = assemble(mesh, {steel});
  const SparseCholesky factor(shift_stiffness(matrices, -1e6),
                              order_dofs(matrices.M_s), "the stiffness");
  return {estimate_factor_seconds(matrices.M_s, order_nodes(matrices.M_s)),
          factor.flops()};
}

// The pattern of the nodes determines the operations of all three components.
TEST(FactorSeconds, GrowAsTheOperationsOfTheWholeMatrix) {
  const Cost coarse = find_cost(make_cube(3));
  const Cost fine = find_cost(make_cube(6));
  ASSERT_GT(fine.flops, 8.0 * coarse.flops);
  EXPECT_NEAR(fine.seconds / coarse.seconds, fine.flops / coarse.flops,
              0.1 * fine.flops / coarse.flops);
  EXPECT_GT(fine.flops / fine.seconds, 1e9);  // of any processor today
  EXPECT_LT(fine.flops / fine.seconds, 1e12);
}

}  // namespace
}  // namespace limber::fem::factor_cost_test
