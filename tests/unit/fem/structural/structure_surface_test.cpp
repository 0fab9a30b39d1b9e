// SPDX-License-Identifier: BSD-3-Clause
// What of beams and shells touches others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "limber/fem/gmsh/gmsh_session.hpp"
#include "limber/fem/mesh/linear_cell.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/structural/assemble_structure.hpp"
#include "limber/fem/structural/read_structure.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::structure_surface_test {
namespace {

using testing::write_file;

TEST(LinearCell, HasTheNodesOfGmshAndFacesOutward) {
  const GmshSession session;
  for (const LinearCell kind : {LinearCell::wedge, LinearCell::hexahedron}) {
    const ReferenceElement cell = make_linear_cell(kind);
    const ReferenceElement gmsh = make_reference_element(cell.gmsh_type);
    EXPECT_EQ(cell.node_uvw, gmsh.node_uvw);
    EXPECT_EQ(cell.faces.size(), gmsh.faces.size());
    const Vector3 middle = cell.node_uvw.rowwise().mean();
    for (const std::vector<int>& face : cell.faces) {
      const Matrix3X x = cell.node_uvw(Eigen::all, face);
      const Vector3 normal =
          Vector3(x.col(1) - x.col(0)).cross(Vector3(x.col(2) - x.col(0)));
      EXPECT_GT(normal.dot(Vector3(x.rowwise().mean()) - middle), 0.0);
    }
  }
}

struct Measures {
  double area = 0.0;    // [m^2]
  double volume = 0.0;  // [m^3]
};

Measures measure(const MatrixModel& model) {
  Mesh mesh = model.mesh_surface.mesh;
  mesh.x = model.x;
  mesh.tags = model.tags;
  find_boundary(mesh);
  Measures sum;
  for (const auto& triangle : boundary_triangles(mesh)) {
    const Matrix3X x = mesh.x(Eigen::all, triangle);
    const Vector3 twice =
        Vector3(x.col(1) - x.col(0)).cross(Vector3(x.col(2) - x.col(0)));
    sum.area += 0.5 * twice.norm();
    sum.volume += twice.dot(Vector3(x.col(0))) / 6.0;
  }
  return sum;
}

const std::string kPlate =
    "$ plate or beam\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,3.,0.,0.\n"
    "GRID,4,,0.,1.,0.\nGRID,5,,1.,1.,0.\nGRID,6,,3.,1.,0.\n"
    "CQUAD4,1,1,1,2,5,4\nCTRIA3,2,1,2,3,6\nCTRIA3,3,1,2,6,5\n"
    "PSHELL,1,1,.1,1,,1\nMAT1,1,7.E+10,,.3,2700.\n";

TEST(StructureSurface, OfAPlateIsThatOfABox) {
  const MatrixModel model =
      assemble_structure(read_structure(write_file("p.bdf", kPlate))).model;
  const Measures found = measure(model);
  EXPECT_NEAR(found.area, 2.0 * 3.0 + 8.0 * 0.1, 1e-12);
  EXPECT_NEAR(found.volume, 3.0 * 0.1, 1e-12);
  // Of six nodes each has one below and one above.
  using Side = ModelSurface::Side;
  for (const Side side : {Side::bottom, Side::top}) {
    EXPECT_EQ(std::ranges::count(model.mesh_surface.sides, side), 6);
    for (std::size_t n = 0; n < model.mesh_surface.sides.size(); ++n)
      if (model.mesh_surface.sides[n] == side) {
        const Vector3 arm = model.x.col(static_cast<Eigen::Index>(n)) -
                            model.x.col(model.mesh_surface.bases[n]);
        EXPECT_LT(
            (arm - Vector3(0, 0, side == Side::top ? 0.05 : -0.05)).norm(),
            1e-15);
      }
  }
  ASSERT_EQ(model.mesh_surface.materials.size(), 1U);
  EXPECT_EQ(model.mesh_surface.materials[0].youngs_modulus, 7e10);
  EXPECT_NEAR(model.mesh_surface.materials[0].poisson_ratio, 0.3, 1e-15);
}

/// An offset moves both faces.
TEST(StructureSurface, FollowsTheOffsetOfAShell) {
  std::string text = kPlate;
  const std::size_t first = text.find("CTRIA3");
  text.replace(first, text.find("PSHELL") - first,
               "CQUAD4,2,1,2,3,6,5,0.,.2\n");
  text.replace(text.find("2,5,4"), 5, "2,5,4,0.,.2");
  const MatrixModel model =
      assemble_structure(read_structure(write_file("p.bdf", text))).model;
  EXPECT_NEAR(measure(model).volume, 0.3, 1e-12);
  EXPECT_NEAR(model.x.row(2).maxCoeff(), 0.25, 1e-15);
}

TEST(StructureSurface, OfABeamIsItsOutline) {
  const std::string beam =
      "$ plate or "
      "beam\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\n"
      "MAT1,1,7.E+10,,.3,2700.\n";
  const auto read = [&](const std::string& property) {
    return measure(
        assemble_structure(read_structure(write_file("b.bdf", beam + property)))
            .model);
  };
  const Measures bar = read("PBARL,1,1,,BAR\n,.2,.3\n");
  EXPECT_NEAR(bar.area, 2.0 * (0.2 + 0.3) + 2.0 * 0.06, 1e-12);
  EXPECT_NEAR(bar.volume, 0.06, 1e-12);
  const Measures rod = read("PBARL,1,1,,ROD\n,.1\n");
  EXPECT_NEAR(rod.volume, 3.0 * 0.01, 1e-12);  // a regular dodecagon
}

}  // namespace
}  // namespace limber::fem::structure_surface_test
