// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/mesh_cut.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "unit/fem/meshes.hpp"

namespace limber::fem::mesh_cut_test {
namespace {

using ::testing::HasSubstr;
using testing::MshText;
using testing::write_file;

constexpr double kNowhere = 1e9;

// A bar along x of one brick a layer, with the layers' ends at `ends`; two
// prisms in place of a brick from `prisms_from` on.
Mesh make_bar(const std::vector<double>& ends, double width, double height,
              double prisms_from = kNowhere) {
  MshText text;
  std::vector<int> last;
  for (const double x : ends) {
    std::vector<int> now;
    for (const Vector3& corner :
         {Vector3(x, 0, 0), Vector3(x, width, 0), Vector3(x, width, height),
          Vector3(x, 0, height)}) {
      now.push_back(text.add_node(corner));
    }
    if (!last.empty() && x > prisms_from) {
      text.add_element(MshText::kPrism,
                       {last[0], now[1], last[1], last[3], now[2], last[2]});
      text.add_element(MshText::kPrism,
                       {last[0], now[0], now[1], last[3], now[3], now[2]});
    } else if (!last.empty()) {
      std::vector<int> nodes = last;
      nodes.insert(nodes.end(), now.begin(), now.end());
      text.add_element(MshText::kHexahedron, nodes);
    }
    last = now;
  }
  text.name_group(3, 1, "body");
  return read_mesh(write_file("bar.msh", text.str()));
}

// `count` layers of equal length from `from` to `to`, without the first end.
void add_layers(std::vector<double>& ends, double to, int count) {
  const double from = ends.back();
  for (int i = 1; i <= count; ++i) {
    ends.push_back(from + (to - from) * i / count);
  }
}

TEST(MeshCut, DividesABarOfUnequalLayersByVolume) {
  std::vector<double> ends{0.0};
  add_layers(ends, 0.2, 20);
  add_layers(ends, 1.0, 16);
  const CutMesh cut = cut_mesh(make_bar(ends, 0.05, 0.04), 2);
  ASSERT_EQ(cut.pieces.size(), 2);
  ASSERT_EQ(cut.cuts.size(), 1);
  // Half of the length; half of the elements end at 0.18 m.
  for (const MeshPiece& piece : cut.pieces) {
    const double length =
        piece.mesh.x.row(0).maxCoeff() - piece.mesh.x.row(0).minCoeff();
    EXPECT_NEAR(length, 0.5, 0.051);
  }
}

TEST(MeshCut, GivesEachPieceOfABarItsShareOfEqualLayers) {
  std::vector<double> ends{0.0};
  add_layers(ends, 1.2, 24);
  const CutMesh cut = cut_mesh(make_bar(ends, 0.05, 0.04), 4);
  ASSERT_EQ(cut.pieces.size(), 4);
  for (const MeshPiece& piece : cut.pieces) {
    EXPECT_EQ(piece.mesh.node_count(), 4 * 7);
  }
  EXPECT_EQ(cut.cuts.size(), 3);
}

// A place along the bar is the mean of an element's corners, six or eight.
TEST(MeshCut, OrdersElementsOfAllKindsAlongTheBar) {
  for (const double unit : {1.0, 1e-3}) {
    std::vector<double> ends{0.0};
    add_layers(ends, 1.2 * unit, 24);
    for (const double prisms_from : {0.401, 0.851, 0.951}) {
      const Mesh bar =
          make_bar(ends, 0.05 * unit, 0.04 * unit, prisms_from * unit);
      for (const int count : {2, 3}) {
        const CutMesh cut = cut_mesh(bar, count);
        ASSERT_EQ(cut.pieces.size(), count);
        for (const MeshPiece& piece : cut.pieces) {
          EXPECT_EQ(piece.mesh.node_count(), 4 * (24 / count + 1))
              << prisms_from << " " << count;
        }
      }
    }
  }
}

TEST(MeshCut, AdvisesTwoPiecesFromTenTimesTheThicknessOn) {
  std::vector<double> ends{0.0};
  add_layers(ends, 1.0, 40);
  // The thickness is the diagonal of the section, 5 : 4 : 3.
  const PieceAdvice slender = advise_pieces(make_bar(ends, 0.076, 0.057));
  EXPECT_EQ(slender.count, 2) << slender.reason;
  const PieceAdvice chunky = advise_pieces(make_bar(ends, 0.084, 0.063));
  EXPECT_EQ(chunky.count, 1);
  EXPECT_THAT(chunky.reason, HasSubstr("9.5"));
}

}  // namespace
}  // namespace limber::fem::mesh_cut_test
