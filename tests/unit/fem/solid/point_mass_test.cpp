// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/fem/mesh/mesh_pieces.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/nodal_mass.hpp"
#include "places.hpp"
#include "unit/fem/meshes.hpp"

/// Point masses and supports of decks of solids; values by CalculiX:
/// tests/data/attachments.
namespace limber::fem::point_mass_test {
namespace {

constexpr double kMasses = 0.05 + 0.02;

struct Deck {
  std::string file;
  double unit;
  std::string held;  // the group of nodes at the support
};

class PointMass : public ::testing::TestWithParam<Deck> {
 protected:
  Mesh read() const {
    return read_mesh(std::filesystem::path(LIMBER_SOURCE_DIR) /
                         "tests/data/attachments" / GetParam().file,
                     {.unit = GetParam().unit});
  }
};

/// The lowest six after `skipped`, with the nodes `held` fixed.
VectorX find_eigenvalues(const Mesh& mesh, const std::vector<int>& held,
                         Eigen::Index skipped) {
  const StructuralMatrices matrices =
      assemble(mesh, assign_materials(mesh, {}));
  const MatrixX lower = matrices.K;
  const MatrixX K = lower.selfadjointView<Eigen::Lower>();
  const MatrixX M =
      multiply_mass(matrices.M_s, MatrixX::Identity(K.rows(), K.cols()));
  std::vector<int> free;
  for (const int node : find_free_nodes(mesh, held))
    for (int i = 0; i < 3; ++i) free.push_back(3 * node + i);
  return dense::find_eigenpairs(K(free, free), M(free, free))
      .values.segment(skipped, 6);
}

void add_by_tag(const Mesh& mesh, std::map<std::size_t, double>& masses) {
  for (const auto& [node, mass] : mesh.masses)
    masses[mesh.tags[static_cast<std::size_t>(node)]] += mass;
}

void expect_near(const VectorX& found, const Vector6& expected) {
  for (Eigen::Index k = 0; k < 6; ++k)
    EXPECT_NEAR(found[k] / expected[k], 1.0, 5e-7) << k;
}

TEST_P(PointMass, HasTheEigenvaluesOfCalculix) {
  const Mesh mesh = read();
  expect_near(find_eigenvalues(mesh, {}, 6),
              Vector6{{2.021483e8, 2.751965e8, 3.948364e8, 6.063361e8,
                       8.658958e8, 1.405191e9}});
  const std::vector<int>& held =
      mesh.groups[find_group(mesh, GetParam().held)].nodes;
  expect_near(find_eigenvalues(mesh, held, 0),
              Vector6{{8.878801e6, 1.282718e7, 8.856904e7, 2.131433e8,
                       2.700963e8, 4.015650e8}});
}

TEST_P(PointMass, IsInEveryMassOnce) {
  const Mesh mesh = read();
  Mesh bare = mesh;
  bare.masses.clear();
  const std::vector<ElasticMaterial> materials = assign_materials(mesh, {});
  const auto find_total = [&](const Mesh& of) {
    return assemble(of, materials).M_s.sum();
  };
  const double elements = find_total(bare);
  EXPECT_NEAR(find_total(mesh) - elements, kMasses, 1e-12);
  EXPECT_NEAR(calc_lumped_mass(mesh, materials).sum() - elements, kMasses,
              1e-12);
  ElementLabels labels(mesh.element_count(), 0);
  std::fill(labels.begin() + std::ssize(labels) / 2, labels.end(), 1);
  std::map<std::size_t, double> of_pieces;
  for (const MeshPiece& piece : separate(mesh, labels).pieces)
    add_by_tag(piece.mesh, of_pieces);
  std::map<std::size_t, double> of_whole;
  add_by_tag(mesh, of_whole);
  EXPECT_EQ(of_pieces, of_whole);
}

INSTANTIATE_TEST_SUITE_P(Decks, PointMass,
                         ::testing::Values(Deck{"masses.inp", 0.0, "boundary"},
                                           Deck{"masses.bdf", 1e-3, "spc:12"}),
                         [](const auto& tested) {
                           return tested.param.file.substr(7);
                         });

}  // namespace
}  // namespace limber::fem::point_mass_test
