// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "unit/fem/meshes.hpp"

/// Every invalid mesh gives one InputError that names the file, the problem
/// with its place or value, and what was expected.
namespace limber::fem::mesh_errors_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::MshText;
using testing::unit_tetrahedron;
using testing::write_file;

/// The text of the error that reading the file gives.
std::string reading_error(const std::filesystem::path& file,
                          const MeshOptions& options = {}) {
  try {
    static_cast<void>(read_mesh(file, options));
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1U) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(file.filename().string()));
    return error.what();
  }
  ADD_FAILURE() << file << " was accepted";
  return {};
}

std::string reading_error(const MshText& text) {
  return reading_error(write_file("bad.msh", text.str()));
}

TEST(MeshErrors, MissingFile) {
  EXPECT_THAT(reading_error(testing::make_test_folder() / "absent.msh"),
              AllOf(HasSubstr("cannot read this mesh"), HasSubstr("Expected")));
}

TEST(MeshErrors, FolderInPlaceOfAFile) {
  const auto folder = testing::make_test_folder() / "folder.msh";
  std::filesystem::create_directories(folder);
  EXPECT_THAT(reading_error(folder), HasSubstr("cannot read this mesh"));
}

TEST(MeshErrors, UnknownExtension) {
  EXPECT_THAT(reading_error(write_file("body.stl", "solid\n")),
              AllOf(HasSubstr("'.stl'"), HasSubstr("Expected .msh, .geo")));
}

TEST(MeshErrors, TextThatIsNoMesh) {
  EXPECT_THAT(reading_error(write_file("bad.geo", "what is this?\n")),
              AllOf(HasSubstr("Gmsh cannot read it"), HasSubstr("line 1")));
}

TEST(MeshErrors, EmptyFile) {
  EXPECT_THAT(reading_error(write_file("empty.geo", "")),
              HasSubstr("no solid elements"));
}

TEST(MeshErrors, FileCutShort) {
  const std::string text = unit_tetrahedron().str();
  reading_error(write_file("cut.msh", text.substr(0, text.find("$Elements"))));
}

TEST(MeshErrors, ScriptWithASlip) {
  EXPECT_THAT(reading_error(write_file("slip.geo", "Point(1) = {0, 0;\n")),
              HasSubstr("Gmsh cannot read it"));
}

TEST(MeshErrors, ElementWithoutItsNode) {
  MshText text = unit_tetrahedron();
  text.add_element(MshText::kTetrahedron, {2, 3, 4, 99});
  EXPECT_THAT(reading_error(text), HasSubstr("99"));
}

TEST(MeshErrors, SurfacesOnly) {
  MshText text;
  for (const Vector3& x :
       {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)})
    text.add_node(x);
  text.add_element(MshText::kTriangle, {1, 2, 3});
  EXPECT_THAT(reading_error(text),
              AllOf(HasSubstr("surfaces but no solid elements"),
                    HasSubstr("Expected tetrahedra")));
}

TEST(MeshErrors, GeometryWithoutAVolume) {
  EXPECT_THAT(reading_error(write_file("flat.geo",
                                       "SetFactory(\"OpenCASCADE\");\n"
                                       "Rectangle(1) = {0, 0, 0, 1, 1};\n")),
              HasSubstr("surfaces but no volume"));
}

TEST(MeshErrors, InvertedElement) {
  MshText text = unit_tetrahedron();
  text.add_node({1, 1, 1});
  text.add_element(MshText::kTetrahedron, {2, 3, 5, 4});  // left-handed
  EXPECT_THAT(reading_error(text),
              AllOf(HasSubstr("element 2"), HasSubstr("inverted"),
                    HasSubstr("Jacobian determinant is -"),
                    HasSubstr("Expected positive")));
}

TEST(MeshErrors, ElementFoldedAtOneCorner) {
  MshText text;
  for (const Vector3& x :
       {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0.2, 0.2, 0),
        Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(1, 0, 1),
        Vector3(0.2, 0.2, 1), Vector3(0, 1, 1)})
    text.add_node(x);
  text.add_element(MshText::kHexahedron, {1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_THAT(reading_error(text),
              AllOf(HasSubstr("element 1"), HasSubstr("inverted")));
}

TEST(MeshErrors, FlatElement) {
  MshText text = unit_tetrahedron();
  text.add_node({0.3, 0.3, 0.4});  // in the plane of nodes 2, 3, 4
  text.add_element(MshText::kTetrahedron, {2, 3, 4, 5});
  EXPECT_THAT(reading_error(text),
              AllOf(HasSubstr("element 2"), HasSubstr("degenerate"),
                    HasSubstr("Expected positive")));
}

TEST(MeshErrors, PositionThatIsNoNumber) {
  MshText text = unit_tetrahedron();
  text.add_node({1, 1, std::numeric_limits<double>::quiet_NaN()});
  text.add_element(MshText::kTetrahedron, {2, 3, 4, 5});
  reading_error(text);
}

TEST(MeshErrors, TwoPartsApart) {
  MshText text = unit_tetrahedron();
  for (const Vector3& x :
       {Vector3(5, 0, 0), Vector3(6, 0, 0), Vector3(5, 1, 0), Vector3(5, 0, 1)})
    text.add_node(x);
  text.add_element(MshText::kTetrahedron, {5, 6, 7, 8});
  EXPECT_THAT(reading_error(text),
              AllOf(HasSubstr("2 parts"), HasSubstr("no two nodes coincide"),
                    HasSubstr("Expected one connected body")));
}

/// They would turn about the edge freely.
TEST(MeshErrors, TwoPartsThatShareAnEdgeOnly) {
  MshText text = unit_tetrahedron();
  text.add_node({-1, 0, 0});
  text.add_node({0, -1, 0});
  text.add_element(MshText::kTetrahedron, {1, 5, 6, 4});
  EXPECT_THAT(reading_error(text), HasSubstr("2 parts"));
}

TEST(MeshErrors, TwoPartsWhoseCommonNodesAreThereTwice) {
  MshText text = unit_tetrahedron();
  for (const Vector3& x :
       {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(1, 1, 1)})
    text.add_node(x);
  text.add_element(MshText::kTetrahedron, {5, 6, 7, 8});
  EXPECT_THAT(reading_error(text),
              AllOf(HasSubstr("2 parts"), HasSubstr("3 nodes lie on others"),
                    HasSubstr("merge")));
}

/// One large hexahedron beside four small ones: the nodes in the middle of
/// its face hang, so no face is shared.
TEST(MeshErrors, HangingNodes) {
  MshText text;
  const auto corner = [&](double x, double y, double z) {
    return text.add_node({x, y, z});
  };
  std::vector<int> large;
  for (const double z : {0.0, 2.0})
    for (const auto& [x, y] :
         std::vector<std::pair<int, int>>{{0, 0}, {2, 0}, {2, 2}, {0, 2}})
      large.push_back(corner(x, y, z));
  text.add_element(MshText::kHexahedron, large);
  std::vector<int> fine;  // 3 x 3 x 2 nodes on the large one's top and above
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const bool is_shared = k == 0 && i != 1 && j != 1;
        const std::vector<int> top{large[4], large[5], large[7], large[6]};
        fine.push_back(is_shared ? top[index(i / 2 + j)]
                                 : corner(i, j, 2.0 + k));
      }
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const auto node = [&](int a, int b, int c) {
        return fine[index(9 * c + 3 * (j + b) + i + a)];
      };
      text.add_element(
          MshText::kHexahedron,
          {node(0, 0, 0), node(1, 0, 0), node(1, 1, 0), node(0, 1, 0),
           node(0, 0, 1), node(1, 0, 1), node(1, 1, 1), node(0, 1, 1)});
    }
  EXPECT_THAT(reading_error(text), HasSubstr("2 parts that share no face"));
}

/// A quadrilateral against two triangles: along the triangles' common edge
/// the elements part. A pyramid has to stand between.
TEST(MeshErrors, FacesThatDoNotMatch) {
  MshText text;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] :
         std::vector<std::pair<int, int>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      text.add_node({static_cast<double>(x), static_cast<double>(y), z});
  text.add_node({0.5, 0.5, 2.0});
  text.add_element(MshText::kHexahedron, {1, 2, 3, 4, 5, 6, 7, 8});
  text.add_element(MshText::kTetrahedron, {5, 6, 7, 9});
  text.add_element(MshText::kTetrahedron, {5, 7, 8, 9});
  EXPECT_THAT(
      reading_error(text),
      AllOf(HasSubstr("element 1 (Hexahedron 8)"), HasSubstr("(Tetrahedron 4)"),
            HasSubstr("do not match"), HasSubstr("pyramids")));
}

TEST(MeshErrors, ElementThereTwice) {
  MshText once = unit_tetrahedron();
  once.add_node({1, 1, 1});
  once.add_element(MshText::kTetrahedron, {2, 3, 4, 5});
  EXPECT_EQ(read_mesh(write_file("once.msh", once.str())).element_count(), 2U);
  once.add_element(MshText::kTetrahedron, {2, 3, 4, 5});
  EXPECT_THAT(reading_error(once), HasSubstr("share one face"));

  MshText alone = unit_tetrahedron();
  alone.add_element(MshText::kTetrahedron, {1, 2, 3, 4});
  EXPECT_THAT(reading_error(alone), HasSubstr("doubled"));
}

TEST(MeshErrors, ElementsOfFourthOrder) {
  const auto linear = write_file("linear.msh", unit_tetrahedron().str());
  const auto file = testing::convert(linear, "fourth.msh", {.order = 4});
  EXPECT_THAT(reading_error(file),
              AllOf(HasSubstr("not supported"), HasSubstr("order 1 to 3")));
}

TEST(MeshErrors, GroupThatNoElementHas) {
  MshText text = unit_tetrahedron();
  text.name_group(2, 7, "root");
  const Mesh mesh = read_mesh(write_file("good.msh", text.str()));
  try {
    static_cast<void>(find_group(mesh, "root"));
    ADD_FAILURE() << "an empty group was found";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("good.msh"), HasSubstr("'root'"),
                                    HasSubstr("Expected"), HasSubstr("body")));
  }
}

TEST(MeshErrors, SlipInAGroupsNameIsMetWithTheRightOne) {
  const Mesh mesh = read_mesh(write_file("good.msh", unit_tetrahedron().str()));
  try {
    static_cast<void>(find_group(mesh, "bdoy"));
    ADD_FAILURE() << "an unknown group was found";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("'bdoy'"), HasSubstr("'body'")));
  }
}

TEST(MeshErrors, SizeOrOrderForAFinishedMesh) {
  const auto file = write_file("good.msh", unit_tetrahedron().str());
  const auto refusal = HasSubstr("finished mesh");
  EXPECT_THAT(reading_error(file, {.size = 0.1}), refusal);
  for (const int order : {1, 3})
    EXPECT_THAT(reading_error(file, {.order = order}), refusal);
}

TEST(MeshErrors, ValuesOutOfRange) {
  const auto file =
      write_file("box.geo", testing::box_geo(testing::BoxKind::tetrahedra));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double size : {-0.1, nan, infinity})
    EXPECT_THAT(reading_error(file, {.size = size}),
                AllOf(HasSubstr("mesh size"), HasSubstr("expected")));
  for (const double unit : {-1.0, nan, infinity})
    EXPECT_THAT(reading_error(file, {.unit = unit}),
                AllOf(HasSubstr("length unit"), HasSubstr("expected")));
  for (const int order : {-1, 4})
    EXPECT_THAT(reading_error(file, {.order = order}),
                HasSubstr("expected 1, 2 or 3"));
}

TEST(MeshErrors, SeveralProblemsAreReportedAtOnce) {
  const auto file =
      write_file("box.geo", testing::box_geo(testing::BoxKind::tetrahedra));
  try {
    static_cast<void>(
        read_mesh(file, {.size = -1.0, .order = 9, .unit = -1.0}));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 3U);
  }
}

}  // namespace
}  // namespace limber::fem::mesh_errors_test
