// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/node_weights.hpp"
#include "unit/fem/meshes.hpp"

/// The surface of a box, and how a load on a part of it is shared.
namespace limber::fem::boundary_test {
namespace {

using testing::BoxKind;
using testing::kBoxCorner;
using testing::kBoxSize;
using testing::write_file;

constexpr double kRoundoff = 1e-12;

std::vector<int> nodes_in_box(const Mesh& mesh, const Vector3& lower,
                              const Vector3& upper) {
  const auto distance = [&](const Vector3& x) {
    return (x - x.cwiseMax(lower).cwiseMin(upper)).norm();
  };
  return find_boundary_nodes(mesh, distance, kRoundoff).nodes;
}

class BoxMeshSurface
    : public ::testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  BoxMeshSurface()
      : mesh_(read_mesh(testing::convert(
            source(), "box.msh", {.order = std::get<1>(GetParam())}))) {}

  static std::filesystem::path source() {
    const std::string& kind = std::get<0>(GetParam());
    if (kind == "mixed")
      return write_file("linear.msh", testing::mixed_msh(0.05));
    return write_file(
        "box.geo", testing::box_geo(kind == "tetrahedra"  ? BoxKind::tetrahedra
                                    : kind == "hexahedra" ? BoxKind::hexahedra
                                                          : BoxKind::prisms));
  }

  Mesh mesh_;
};

TEST_P(BoxMeshSurface, NodesAreThoseOnTheBoxsFaces) {
  std::vector<int> expected;
  for (int n = 0; n < static_cast<int>(mesh_.node_count()); ++n) {
    const Vector3 d = mesh_.x.col(n) - kBoxCorner;
    if (d.cwiseAbs().minCoeff() < kRoundoff ||
        (kBoxSize - d).cwiseAbs().minCoeff() < kRoundoff)
      expected.push_back(n);
  }
  EXPECT_EQ(mesh_.boundary_nodes, expected);
}

/// By the divergence theorem: closed, outward, nothing twice.
TEST_P(BoxMeshSurface, TrianglesEncloseTheBoxsVolume) {
  double volume = 0.0;
  double area = 0.0;
  for (const auto& t : boundary_triangles(mesh_)) {
    const Vector3 a = mesh_.x.col(t[0]) - kBoxCorner;
    const Vector3 b = mesh_.x.col(t[1]) - kBoxCorner;
    const Vector3 c = mesh_.x.col(t[2]) - kBoxCorner;
    volume += a.dot(b.cross(c)) / 6.0;
    area += (b - a).cross(c - a).norm() / 2.0;
  }
  const Vector3& s = kBoxSize;
  EXPECT_NEAR(volume / s.prod(), 1.0, kRoundoff);
  EXPECT_NEAR(area / (2.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0])), 1.0,
              kRoundoff);
}

/// int N_n dA reproduces the area's centre exactly, int N_n (x - p) dA its
/// second moments, and both the means of a linear field.
TEST_P(BoxMeshSurface, LoadOnAFaceHasTheFacesCentreAndMoments) {
  const Vector3 upper = kBoxCorner + Vector3(0, kBoxSize[1], kBoxSize[2]);
  const WeightedNodes face =
      weigh_boundary(mesh_, nodes_in_box(mesh_, kBoxCorner, upper));
  EXPECT_NEAR(face.weights.sum(), 1.0, kRoundoff);
  const Matrix3X x = mesh_.x(Eigen::all, face.nodes);
  const Vector3 center = 0.5 * (kBoxCorner + upper);
  EXPECT_LT((x * face.weights - center).norm(), kRoundoff);
  const Matrix3X d = x.colwise() - center;
  const Matrix3 moments = face.moments * d.transpose();
  const Matrix3 expected =
      Vector3(0, kBoxSize[1] * kBoxSize[1], kBoxSize[2] * kBoxSize[2])
          .asDiagonal();
  EXPECT_LT((moments - expected / 12.0).norm(), kRoundoff);
  EXPECT_LT(face.moments.rowwise().sum().norm(), kRoundoff);
}

TEST_P(BoxMeshSurface, LoadOnTheVolumeGroupHasTheBoxsCentreAndMoments) {
  const WeightedNodes body =
      weigh_group(mesh_, mesh_.groups[find_group(mesh_, "body")]);
  const Matrix3X x = mesh_.x(Eigen::all, body.nodes);
  const Vector3 center = kBoxCorner + 0.5 * kBoxSize;
  EXPECT_LT((x * body.weights - center).norm(), kRoundoff);
  const Matrix3X d = x.colwise() - center;
  const Matrix3 moments = body.moments * d.transpose();
  const Matrix3 expected =
      (kBoxSize.array().square() / 12.0).matrix().asDiagonal();
  EXPECT_LT((moments - expected).norm(), kRoundoff);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, BoxMeshSurface,
    ::testing::Combine(::testing::Values("tetrahedra", "hexahedra", "prisms",
                                         "mixed"),
                       ::testing::Values(1, 2, 3)),
    [](const auto& p) {
      return fmt::format("{}Order{}", std::get<0>(p.param),
                         std::get<1>(p.param));
    });

Mesh hexahedra() {
  return read_mesh(write_file("box.geo", testing::box_geo(BoxKind::hexahedra)));
}

TEST(NodeWeights, GroupAndBoxOfTheSameFaceShareALoadAlike) {
  const Mesh mesh = hexahedra();
  const WeightedNodes by_group =
      weigh_group(mesh, mesh.groups[find_group(mesh, "root")]);
  const Vector3 upper = kBoxCorner + Vector3(kBoxSize[0], kBoxSize[1], 0.0);
  const WeightedNodes by_box =
      weigh_boundary(mesh, nodes_in_box(mesh, kBoxCorner, upper));
  EXPECT_EQ(by_group.nodes, by_box.nodes);
  EXPECT_LT((by_group.weights - by_box.weights).norm(), kRoundoff);
}

TEST(NodeWeights, NodesOfNoFaceShareEqually) {
  const Mesh mesh = hexahedra();
  const Vector3 end = kBoxCorner + Vector3(kBoxSize[0], 0.0, 0.0);
  const auto edge = nodes_in_box(mesh, kBoxCorner, end);
  ASSERT_GT(edge.size(), 3U);
  const WeightedNodes weighted = weigh_boundary(mesh, edge);
  EXPECT_DOUBLE_EQ(weighted.weights.minCoeff(),
                   1.0 / static_cast<double>(edge.size()));
  EXPECT_DOUBLE_EQ(weighted.weights.maxCoeff(), weighted.weights.minCoeff());
}

TEST(NodeWeights, FindsNodesByTagAndPlace) {
  const Mesh mesh = hexahedra();
  const int node = static_cast<int>(mesh.node_count() / 2);
  EXPECT_EQ(find_tagged_node(mesh, mesh.tags[static_cast<std::size_t>(node)]),
            node);
  EXPECT_EQ(find_nearest_node(mesh, mesh.x.col(node) + Vector3::Constant(1e-4)),
            node);
  try {
    static_cast<void>(find_tagged_node(mesh, 123456));
    ADD_FAILURE() << "found";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("123456"));
  }
}

}  // namespace
}  // namespace limber::fem::boundary_test
