// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/surface.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "unit/fem/meshes.hpp"

/// The boundary of a box of tetrahedra, prisms, pyramids and hexahedra as
/// triangles with middle nodes, and the functions of its faces.
namespace limber::fem::surface_test {
namespace {

using testing::kBoxCorner;
using testing::kBoxSize;
using testing::write_file;

constexpr double kRoundoff = 1e-12;

class BoxSurface : public ::testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  BoxSurface()
      : mesh_(read_mesh(testing::convert(
            write_file("linear.msh", testing::mixed_msh(0.0)), "box.msh",
            {.order = std::get<0>(GetParam()),
             .serendipity = std::get<1>(GetParam())}))),
        surface_(make_surface(mesh_, mesh_.boundary_faces)) {}

  [[nodiscard]] const Vector3& at(int point) const {
    return surface_.points[static_cast<std::size_t>(point)].x;
  }

  Mesh mesh_;
  Surface surface_;
};
INSTANTIATE_TEST_SUITE_P(Orders, BoxSurface,
                         ::testing::Values(std::tuple(1, false),
                                           std::tuple(2, false),
                                           std::tuple(2, true),
                                           std::tuple(3, false)),
                         [](const auto& p) {
                           return "Order" +
                                  std::to_string(std::get<0>(p.param)) +
                                  (std::get<1>(p.param) ? "Serendipity" : "");
                         });

/// Gmsh tabulates the functions at its own places on each face.
TEST_P(BoxSurface, FunctionsOfFacesAreThoseOfGmsh) {
  std::size_t faces = 0;
  for (const ElementBlock& block : mesh_.blocks) {
    for (std::size_t f = 0; f < block.element->faces.size(); ++f, ++faces) {
      const FaceShape shape(*block.element, f);
      const std::vector<int>& nodes = block.element->faces[f];
      const Quadrature& rule = block.element->face_rules[f];
      const MatrixX expected = rule.shape(nodes, Eigen::all);
      // Functions reproduce coordinates.
      const FaceTable table = shape.tabulate(shape.places() * expected);
      EXPECT_LT((table.shape - expected).norm(), kRoundoff * 100.0);
      for (Eigen::Index q = 0; q < expected.cols(); ++q) {
        const MatrixX& gradients = rule.gradients[static_cast<std::size_t>(q)];
        EXPECT_LT((table.along_u.col(q).transpose() -
                   MatrixX(gradients(Eigen::all, nodes)).row(0))
                      .norm(),
                  1e-10);
        EXPECT_LT((table.along_v.col(q).transpose() -
                   MatrixX(gradients(Eigen::all, nodes)).row(1))
                      .norm(),
                  1e-10);
      }
    }
  }
  EXPECT_EQ(faces, 20U);  // of four kinds of elements
}

TEST_P(BoxSurface, RulesAreExactForSecondDegree) {
  for (const FaceShape& shape : surface_.shapes) {
    const bool is_quad = shape.corner_count() == 4;
    for (const int divisions : {1, 2, 5}) {
      const FaceTable rule = shape.make_rule(divisions);
      const MatrixX places = shape.places() * rule.shape;
      const auto u = places.row(0).transpose().array();
      const auto v = places.row(1).transpose().array();
      const auto w = rule.weights.array();
      EXPECT_NEAR(w.sum(), is_quad ? 1.0 : 0.5, kRoundoff);
      EXPECT_NEAR((w * u * v).sum(), is_quad ? 0.25 : 1.0 / 24.0, kRoundoff);
      EXPECT_NEAR((w * v * v).sum(), is_quad ? 1.0 / 3.0 : 1.0 / 12.0,
                  kRoundoff);
    }
  }
}

/// By the divergence theorem: closed, outward, nothing twice.
TEST_P(BoxSurface, TrianglesEncloseTheBoxsVolume) {
  double volume = 0.0;
  for (const auto& t : surface_.triangles) {
    const Vector3 a = at(t[0]) - kBoxCorner;
    const Vector3 b = at(t[1]) - kBoxCorner;
    const Vector3 c = at(t[2]) - kBoxCorner;
    volume += a.dot(b.cross(c)) / 6.0;
  }
  EXPECT_NEAR(volume / kBoxSize.prod(), 1.0, kRoundoff);
}

TEST_P(BoxSurface, MiddlesLieBetweenTheirCorners) {
  const bool has_middles = std::get<0>(GetParam()) > 1;
  for (const auto& t : surface_.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(surface_.points[static_cast<std::size_t>(t[k])].is_corner());
      if (!has_middles) {
        EXPECT_EQ(t[3 + k], -1);
        continue;
      }
      const Vector3 middle = 0.5 * (at(t[k]) + at(t[(k + 1) % 3]));
      EXPECT_LT((at(t[3 + k]) - middle).norm(), kRoundoff);
      const auto ends =
          surface_.points[static_cast<std::size_t>(t[3 + k])].ends;
      EXPECT_LT((0.5 * (at(ends[0]) + at(ends[1])) - middle).norm(), kRoundoff);
    }
  }
}

/// Third-order edges have nodes at a third, serendipity faces none inside.
TEST_P(BoxSurface, PointsAreNodesWhereTheElementsHaveThem) {
  const auto& [order, is_serendipity] = GetParam();
  std::size_t with_node = 0;
  for (const SurfacePoint& point : surface_.points) {
    if (point.node < 0) continue;
    ++with_node;
    EXPECT_EQ(Vector3(mesh_.x.col(point.node)), point.x);
  }
  const std::size_t count = surface_.points.size();
  if (order < 3 && !is_serendipity) {
    EXPECT_EQ(with_node, count);
    EXPECT_EQ(count, mesh_.boundary_nodes.size());
    return;
  }
  EXPECT_LT(with_node, count);
  for (const SurfacePoint& point : surface_.points) {
    if (point.is_corner()) {
      EXPECT_GE(point.node, 0);
    } else if (order == 3) {
      EXPECT_EQ(point.node, -1);
    }
  }
}

TEST_P(BoxSurface, CornersComeFirst) {
  bool was_corner = true;
  for (const SurfacePoint& point : surface_.points) {
    EXPECT_FALSE(point.is_corner() && !was_corner);
    was_corner = point.is_corner();
  }
}

TEST(GroupSurface, IsTheGroupsPartOfTheBoundary) {
  const Mesh mesh = read_mesh(testing::convert(
      write_file("box.geo", testing::box_geo(testing::BoxKind::hexahedra)),
      "box.msh", {.order = 2}));
  const auto faces =
      find_group_faces(mesh, mesh.groups[find_group(mesh, "tip")]);
  EXPECT_EQ(faces.size(), 6U);
  const Surface tip = make_surface(mesh, faces);
  EXPECT_EQ(tip.triangles.size(), 12U);
  for (const SurfacePoint& point : tip.points) {
    EXPECT_NEAR(point.x[2], kBoxCorner[2] + kBoxSize[2], kRoundoff);
  }
  EXPECT_TRUE(
      find_group_faces(mesh, mesh.groups[find_group(mesh, "body")]).empty());
  EXPECT_TRUE(
      find_group_faces(mesh, mesh.groups[find_group(mesh, "corner")]).empty());
}

}  // namespace
}  // namespace limber::fem::surface_test
