// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "limber/fem/mesh/node_weights.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/stress_recovery.hpp"
#include "limber/reduction/meshed_body.hpp"
#include "support/temporary_folder.hpp"

/// NAFEMS LE10 [@nafems1990]: a thick elliptic plate
/// with a hole under pressure. It holds single directions of faces, which
/// recipes cannot: here the whole mesh is solved with these supports, and its
/// stress recovered as for every body.
namespace limber::fem::stress_le10_slow {
namespace {

constexpr double kPressure = 1e6;    // on the upper side [Pa]
constexpr double kTarget = -5.38e6;  // syy at the point D [Pa]
const Vector3 kPointD(2.0, 0.0, 0.6);
const ElasticMaterial kSteel{210e9, 0.3, 7800.0};

/// Number of elements in the plane, and where the layers end, through the
/// thickness: at its middle, among others.
struct Division {
  int across = 0;
  int around = 0;
  std::vector<double> through;
};

/// A quarter, between the ellipses of semi-axes 2 and 1 m, 3.25 and 2.75 m,
/// 0.6 m thick: bricks of second order, smaller towards D.
TracedMesh make_plate(const Division& n) {
  const std::filesystem::path file = limber::test::own_folder() / "le10.geo";
  std::ofstream(file) << fmt::format(
      "SetFactory(\"Built-in\");\n"
      "Point(1) = {{0, 0, 0}};\nPoint(2) = {{2, 0, 0}};\n"
      "Point(3) = {{3.25, 0, 0}};\nPoint(4) = {{0, 1, 0}};\n"
      "Point(5) = {{0, 2.75, 0}};\n"
      "Ellipse(1) = {{2, 1, 3, 4}};\nEllipse(2) = {{3, 1, 3, 5}};\n"
      "Line(3) = {{2, 3}};\nLine(4) = {{4, 5}};\n"
      "Transfinite Line{{1, 2}} = {1} Using Progression 1.2;\n"
      "Transfinite Line{{3, 4}} = {0} Using Progression 1.3;\n"
      "Line Loop(1) = {{3, 2, -4, -1}};\nPlane Surface(1) = {{1}};\n"
      "Transfinite Surface{{1}} = {{2, 3, 5, 4}};\n"
      "Recombine Surface{{1}};\n"
      "v[] = Extrude {{0, 0, 0.6}} {{ Surface{{1}}; Layers{{ {{{2}}}, {{{3}}} "
      "}}; "
      "Recombine; }};\n"
      "Physical Surface(\"top\") = {{v[0]}};\n"
      "Physical Volume(\"plate\") = {{v[1]}};\n",
      n.across + 1, n.around + 1,
      fmt::join(std::vector<int>(n.through.size(), 1), ","),
      fmt::join(n.through, ","));
  flexbody::MeshSource source;
  source.file = file;
  source.order = 2;
  return flexbody::read_source(source, {});
}

/// Degrees of freedom that neither symmetry nor the outer face holds: that face
/// along x and y, its line half-way through the plate along z, too.
std::vector<int> find_free(const Mesh& mesh) {
  constexpr double kNear = 1e-6;
  std::vector<int> free;
  for (int n = 0; n < static_cast<int>(mesh.node_count()); ++n) {
    const Vector3 x = mesh.x.col(n);
    const double ellipse = std::pow(x[0] / 3.25, 2) + std::pow(x[1] / 2.75, 2);
    const bool is_outer = std::abs(ellipse - 1.0) < 1e-3;
    if (!is_outer && std::abs(x[0]) > kNear) free.push_back(3 * n);
    if (!is_outer && std::abs(x[1]) > kNear) free.push_back(3 * n + 1);
    if (!is_outer || std::abs(x[2] - 0.3) > kNear) free.push_back(3 * n + 2);
  }
  return free;
}

/// The pressure's nodal forces; equal to it in sum and spread evenly.
VectorX press(const Mesh& mesh) {
  const WeightedNodes top =
      weigh_group(mesh, mesh.groups[find_group(mesh, "top")]);
  const double area = 0.25 * std::numbers::pi * (3.25 * 2.75 - 2.0 * 1.0);
  VectorX force = VectorX::Zero(3 * mesh.x.cols());
  for (std::size_t i = 0; i < top.nodes.size(); ++i) {
    force[3 * top.nodes[i] + 2] =
        -kPressure * area * top.weights[static_cast<Eigen::Index>(i)];
  }
  return force;
}

VectorX solve(const Mesh& mesh, const VectorX& force) {
  const std::vector<int> free = find_free(mesh);
  const SparseMatrix K = restrict_matrix(assemble(mesh, {kSteel}).K, free);
  const Eigen::SimplicialLDLT<SparseMatrix> factor(K);
  VectorX u = VectorX::Zero(force.size());
  const VectorX loaded = force(free);
  const VectorX moved = factor.solve(loaded);
  u(free) = moved;
  return u;
}

double find_stress_at_d(const Division& division) {
  const TracedMesh made = make_plate(division);
  const Mesh& mesh = made.mesh;
  const NodalStress stress =
      recover_stress(mesh, {kSteel}, solve(mesh, press(mesh)));
  const int d = find_nearest_node(mesh, kPointD);
  EXPECT_LT((mesh.x.col(d) - kPointD).norm(), 1e-9);
  const auto found = std::find(stress.nodes.begin(), stress.nodes.end(), d);
  return stress.stress(1, found - stress.nodes.begin());
}

// The line that holds the outer face is a singularity, so that only D counts.
// Meshes finer than these approach -5.414 MPa; the benchmark's own value, of
// 1990, is 0.6 % from that.
TEST(StressOfAThickPlate, ApproachesThatOfNafemsLe10) {
  const double coarse = find_stress_at_d({6, 9, {0.5, 0.85, 1.0}}) / kTarget;
  const double fine =
      find_stress_at_d({8, 12, {0.5, 0.8, 0.93, 1.0}}) / kTarget;
  EXPECT_NEAR(coarse, 1.0, 0.02);
  EXPECT_NEAR(fine, 1.0, 0.01);
  RecordProperty("coarse", fmt::format("{:.4f}", coarse));
  RecordProperty("fine", fmt::format("{:.4f}", fine));
}

}  // namespace
}  // namespace limber::fem::stress_le10_slow
