// SPDX-License-Identifier: BSD-3-Clause
// What a file holds and a body of solids has not is reported or refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::mesh_losses_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::find_read_error;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::MshText;
using testing::write_file;

std::vector<std::string> notices_of(const std::filesystem::path& file,
                                    double unit = 0.0) {
  return read_traced_mesh(file, {.unit = unit}).notices;
}

TEST(MeshLosses, AMeshWithoutAnyHasNoNotice) {
  const auto geo = write_file(
      "box.geo",
      "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.3, 0.2, 0.1};\n"
      "Physical Volume(\"body\") = {1};\nMesh.MeshSizeMax = 0.1;\n");
  for (const std::string name : {"box.msh", "box.unv", "box.vtk", "box.bdf"}) {
    const auto file = testing::convert(geo, name, {.order = 2});
    EXPECT_THAT(notices_of(file), IsEmpty()) << name;
  }
}

TEST(MeshLosses, NodesAndShellsOffTheSolidAreReported) {
  MshText text = testing::unit_tetrahedron();
  const int a = text.add_node({5.0, 0.0, 0.0});
  const int b = text.add_node({5.0, 1.0, 0.0});
  const int c = text.add_node({5.0, 2.0, 0.0});
  text.add_element(MshText::kTriangle, {1, 2, 3});
  text.add_element(MshText::kTriangle, {a, b, c});
  text.add_element(MshText::kTriangle, {1, 2, c});
  EXPECT_THAT(notices_of(write_file("extra.msh", text.str())),
              ElementsAre(AllOf(HasSubstr("3 of 7 nodes"), HasSubstr("5, 6, 7"),
                                HasSubstr("2 elements of surfaces"))));
}

/// One tetrahedron of type 111 among other datasets.
std::string unv(const std::string& elements, const std::string& before = "") {
  std::string text = before + "    -1\n  2411\n";
  const std::vector<std::string> places = {"0. 0. 0.", "1.D0 0. 0.", "0. 1. 0.",
                                           "0. 0. 1."};
  for (std::size_t i = 0; i < places.size(); ++i)
    text +=
        fmt::format("{:10}{:10}{:10}{:10}\n  {}\n", i + 1, 2, 1, 11, places[i]);
  text += "    -1\n    -1\n  2412\n";
  text += fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}\n", 1, 111, 1, 1, 7, 4);
  text += fmt::format("{:10}{:10}{:10}{:10}\n", 1, 2, 3, 4);
  return text + elements + "    -1\n";
}

std::string unv_element(int number, int type, const std::string& nodes,
                        int count) {
  return fmt::format("{:10}{:10}{:10}{:10}{:10}{:10}\n{}\n", number, type, 1, 1,
                     7, count, nodes);
}

TEST(MeshLosses, AUniversalFileIsComparedWithItsText) {
  EXPECT_THAT(notices_of(write_file("one.unv", unv(""))), IsEmpty());
  // A mass (161), of which Gmsh reports only the second; spring 136.
  EXPECT_THAT(find_read_error(write_file(
                  "mass.unv", unv(unv_element(2, 161, "         1", 1)))),
              AllOf(HasSubstr("mass.unv:16: "), HasSubstr("type 161")));
  EXPECT_THAT(
      find_read_error(write_file(
          "few.unv",
          unv(unv_element(2, 111, "         1         2         3", 4)))),
      AllOf(HasSubstr("few.unv:16: "), HasSubstr("4 nodes")));
  EXPECT_THAT(find_read_error(
                  write_file("old.unv", "    -1\n   781\n    -1\n" + unv(""))),
              HasSubstr("dataset 781"));
}

TEST(MeshLosses, ATruncatedUniversalFileIsRefused) {
  const std::string whole = unv("");
  for (std::size_t lines = 4; lines + 2 < 16; ++lines) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < lines; ++i) size = whole.find('\n', size) + 1;
    if (size >= whole.rfind("    -1")) break;
    EXPECT_FALSE(
        find_read_error(write_file("cut.unv", whole.substr(0, size))).empty());
  }
  // Behind the elements, too, where the names of groups are.
  EXPECT_THAT(find_read_error(write_file(
                  "groups.unv", unv("") + "    -1\n  2467\n         1\n")),
              AllOf(HasSubstr("groups.unv:17: "), HasSubstr("truncated")));
}

TEST(MeshLosses, CoordinateSystemsOfUniversalFilesMustBeTheGlobalOne) {
  const auto system = [](const std::string& kind, const std::string& origin) {
    return "    -1\n  2420\n         1\nPart\n         2" + kind +
           "         8\nname\n  1. 0. 0.\n  0. 1. 0.\n  0. 0. 1.\n  " + origin +
           "\n    -1\n";
  };
  EXPECT_THAT(notices_of(write_file("same.unv",
                                    unv("", system("         0", "0. 0. 0.")))),
              IsEmpty());
  for (const std::string& own :
       {system("         1", "0. 0. 0."), system("         0", "0. 0. 1.D-2")})
    EXPECT_THAT(find_read_error(write_file("own.unv", unv("", own))),
                AllOf(HasSubstr("own.unv:14: "), HasSubstr("system 2")));
}

TEST(MeshLosses, AnotherLengthUnitThanTheFilesIsReported) {
  const auto file =
      write_file("mm.unv", unv("",
                               "    -1\n   164\n         5mm (milli newton)"
                               "               2\n  1.0D+03  1.0D+03  1.0D+00\n"
                               "  0.0D+00\n    -1\n"));
  EXPECT_THAT(notices_of(file, 1.0),
              ElementsAre(HasSubstr("1000 times as large as its file says")));
  EXPECT_THAT(notices_of(file, 1e-3), IsEmpty());
  EXPECT_THAT(notices_of(file), IsEmpty());
  const double read = read_traced_mesh(file).mesh.size().maxCoeff();
  const double metres =
      read_traced_mesh(file, {.unit = 1.0}).mesh.size().maxCoeff();
  EXPECT_NEAR(read, 1e-3 * metres, 1e-15);
}

TEST(MeshLosses, AGeometryMustNotMergeADeck) {
  write_file("part.bdf",
             "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"
             "GRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n"
             "ENDDATA\n");
  EXPECT_THAT(find_read_error(write_file("merge.geo", "Merge \"part.bdf\";\n")),
              AllOf(HasSubstr("merge.geo"), HasSubstr("part.bdf'")));
}

}  // namespace
}  // namespace limber::fem::mesh_losses_test
