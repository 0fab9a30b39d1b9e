// SPDX-License-Identifier: BSD-3-Clause
// Shells and beams on groups of Gmsh's meshes and geometries.
#include "limber/fem/sections/sectioned_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/material/anisotropy.hpp"
#include "limber/fem/mesh/mesher.hpp"
#include "limber/fem/structural/assemble_structure.hpp"
#include "limber/fem/structural/read_structure.hpp"
#include "unit/fem/meshes.hpp"

namespace limber::fem::sectioned_mesh_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::write_file;

constexpr double kPi = std::numbers::pi;

const MaterialAssignment kSteel{"", {2.1e11, 0.3, 7850.0}};

AssembledStructure assemble(const SectionedMesh& made) {
  return assemble_structure(made.structure, made.solids);
}

std::string find_error(const std::filesystem::path& file,
                       const MeshSections& sections,
                       const MeshOptions& options = {}) {
  try {
    static_cast<void>(assemble(read_sectioned_mesh(file, options, sections)));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

/// A plate of 2 x 1 in quadrilaterals of a regular grid.
std::string make_plate(int along, int across) {
  return "Point(1) = {0, 0, 0};\nPoint(2) = {2, 0, 0};\nPoint(3) = {2, 1, 0};\n"
         "Point(4) = {0, 1, 0};\nLine(1) = {1, 2};\nLine(2) = {2, 3};\n"
         "Line(3) = {3, 4};\nLine(4) = {4, 1};\nCurve Loop(1) = {1, 2, 3, 4};\n"
         "Plane Surface(1) = {1};\nTransfinite Curve {1, 3} = " +
         std::to_string(along + 1) +
         ";\nTransfinite Curve {2, 4} = " + std::to_string(across + 1) +
         ";\nTransfinite Surface {1};\nRecombine Surface {1};\n"
         "Physical Surface(\"skin\") = {1};\nPhysical Curve(\"root\") = {4};\n"
         "Physical Curve(\"rib\") = {2};\n";
}

/// The same grid as a deck, of sides with six digits. @param property PSHELL or
/// PCOMP 1, and materials
std::string make_deck(int along, int across, const std::string& property) {
  std::string text = property;
  const auto node = [&](int i, int j) { return 1 + i + j * (along + 1); };
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i <= along; ++i)
      text += "GRID," + std::to_string(node(i, j)) + ",," +
              std::to_string(2.0 * i / along) + "," +
              std::to_string(1.0 * j / across) + ",0.\n";
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < along; ++i)
      text += "CQUAD4," + std::to_string(1 + i + j * along) + ",1," +
              std::to_string(node(i, j)) + "," +
              std::to_string(node(i + 1, j)) + "," +
              std::to_string(node(i + 1, j + 1)) + "," +
              std::to_string(node(i, j + 1)) + ",0\n";
  return text;
}

/// Node at each place, to compare models whose nodes have other orders.
int find_node(const MatrixModel& model, const Vector3& x) {
  for (Eigen::Index n = 0; n < model.x.cols(); ++n)
    if ((model.x.col(n) - x).norm() < 1e-9) return static_cast<int>(n);
  return -1;
}

using Rows = std::map<std::pair<int, int>, int>;

Rows list_rows(const MatrixModel& model) {
  Rows rows;
  for (std::size_t i = 0; i < model.rows.size(); ++i)
    rows[{model.rows[i].node, model.rows[i].component}] = static_cast<int>(i);
  return rows;
}

/// Largest difference of both stiffness matrices, and of both mass matrices,
/// over the largest entry.
void expect_same_matrices(const MatrixModel& a, const MatrixModel& b) {
  ASSERT_EQ(a.rows.size(), b.rows.size());
  const Rows rows = list_rows(b);
  std::vector<int> of;  // row of b
  for (const MatrixRow& row : a.rows) {
    const int node = find_node(b, a.x.col(row.node));
    ASSERT_GE(node, 0);
    of.push_back(rows.at({node, row.component}));
  }
  for (const auto part : {&MatrixModel::stiffness, &MatrixModel::mass}) {
    const MatrixX A = (a.*part).entries;
    const MatrixX B = MatrixX((b.*part).entries)(of, of);
    EXPECT_LT((A - B).cwiseAbs().maxCoeff(), 1e-9 * A.cwiseAbs().maxCoeff());
  }
}

TEST(SectionedMesh, OfAPlateIsTheDeckOfTheSameGrid) {
  const auto geometry = write_file("plate.geo", make_plate(8, 4));
  const MeshSections sections{{{"skin", {0.01}}}, {}, {kSteel}};
  const AssembledStructure made =
      assemble(read_sectioned_mesh(geometry, {}, sections));
  const Structure deck = read_structure(write_file(
      "plate.bdf",
      make_deck(8, 4, "MAT1,1,2.1+11,,.3,7850.\nPSHELL,1,1,.01,1,,1\n")));
  expect_same_matrices(made.model, assemble_structure(deck, {}).model);
}

/// An unsymmetric laminate of a lamina at 0 and 30 degrees, with an offset.
TEST(SectionedMesh, OfALaminateIsTheDeckOfTheSameGrid) {
  const auto geometry = write_file("plate.geo", make_plate(4, 4));
  const double E2 = 9e9;
  const EngineeringConstants constants{
      Vector3(140e9, E2, E2), Vector3(0.3, 0.3, 0.3), Vector3(5e9, 4e9, 3e9)};
  const SolidMaterial ply =
      make_material(make_orthotropic(constants), MaterialAxes{}, 1600.0);
  ShellRegion region{"skin", {0.002, 0.003}, {0.0, kPi / 6.0}, {"cfrp"}};
  region.offset = 0.001;
  const MeshSections sections{{region}, {}, {{"cfrp", ply}}};
  const AssembledStructure made =
      assemble(read_sectioned_mesh(geometry, {}, sections));
  const Structure deck = read_structure(write_file(
      "plate.bdf", make_deck(4, 4,
                             "MAT8,1,1.4+11,9.+9,.3,5.+9,4.+9,3.+9,1600.\n"
                             "PCOMP,1,-.0015\n,1,.002,0.,,1,.003,30.\n")));
  expect_same_matrices(made.model, assemble_structure(deck, {}).model);
}

/// Deflection under a load at a node, of a body that is held at another.
double find_deflection(const MatrixModel& model, int held, int loaded,
                       const Vector3& along) {
  const Rows rows = list_rows(model);
  std::vector<int> free;
  for (std::size_t i = 0; i < model.rows.size(); ++i)
    if (model.rows[i].node != held) free.push_back(static_cast<int>(i));
  const MatrixX K = MatrixX(model.stiffness.entries)(free, free);
  VectorX f = VectorX::Zero(std::ssize(model.rows));
  for (int c = 0; c < 3; ++c) f[rows.at({loaded, c})] = along[c];
  const Eigen::SparseMatrix<double> sparse = K.sparseView();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(sparse);
  const VectorX u = factor.solve(VectorX(f(free)));
  return u.dot(f(free));
}

/// Quarter of a circle, P at its end along the radius there: pi P R / 4 (R^2 /
/// (E I) + 1 / (E A) + 1 / (k G A)), by Castigliano.
TEST(SectionedMesh, BendsAsACurvedBeam) {
  const auto geometry = write_file(
      "arc.geo",
      "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\nPoint(3) = {0, 1, 0};\n"
      "Circle(1) = {2, 1, 3};\nTransfinite Curve {1} = N + 1;\n"
      "Physical Curve(\"arc\") = {1};\n");
  const MeshSections sections{
      {}, {{"arc", "tube", {{"radius", 0.05}, {"wall", 0.005}}}}, {kSteel}};
  const BeamSection tube = make_tube(0.05, 0.045, 0.3);
  const double E = kSteel.material.youngs_modulus;
  const double G = E / 2.6;
  const double expected = kPi / 4.0 *
                          (1.0 / (E * tube.I_z) + 1.0 / (E * tube.area) +
                           1.0 / (tube.shear_y * G * tube.area));
  std::vector<double> errors;
  for (const int count : {10, 20}) {
    const auto file =
        write_file("arc" + std::to_string(count) + ".geo",
                   "N = " + std::to_string(count) + ";\nInclude \"" +
                       geometry.string() + "\";\n");
    const MatrixModel model =
        assemble(read_sectioned_mesh(file, {}, sections)).model;
    const double found = find_deflection(
        model, find_node(model, Vector3(1.0, 0.0, 0.0)),
        find_node(model, Vector3(0.0, 1.0, 0.0)), Vector3(0.0, 1.0, 0.0));
    errors.push_back(std::abs(found / expected - 1.0));
  }
  EXPECT_LT(errors[1], 1.5e-3);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.3);  // second order
}

/// Each shape by its own moments.
TEST(SectionedMesh, KnowsItsSections) {
  const auto mass_of = [](const BeamRegion& region) {
    const auto file = write_file(
        "line.geo",
        "Point(1) = {0, 0, 0};\nPoint(2) = {3, 0, 0};\nLine(1) = {1, 2};\n"
        "Transfinite Curve {1} = 4;\nPhysical Curve(\"line\") = {1};\n");
    return assemble(read_sectioned_mesh(file, {}, {{}, {region}, {kSteel}}))
        .mass;
  };
  const Vector3 y(0.0, 1.0, 0.0);
  const double rho = 3.0 * 7850.0;
  EXPECT_NEAR(mass_of({"line", "tube", {{"radius", 0.1}, {"wall", 0.1}}}),
              rho * kPi * 0.01, 1e-9);
  EXPECT_NEAR(mass_of({"", "rectangle", {{"height", 0.2}, {"width", 0.1}}, y}),
              rho * 0.02, 1e-9);
  const std::map<std::string, double> walls = {
      {"height", 0.2}, {"width", 0.1}, {"flange", 0.02}, {"web", 0.01}};
  EXPECT_NEAR(mass_of({"line", "box", walls, y}), rho * (0.02 - 0.16 * 0.08),
              1e-9);
  EXPECT_NEAR(mass_of({"line", "i", walls, y}),
              rho * (2.0 * 0.1 * 0.02 + 0.16 * 0.01), 1e-9);
  EXPECT_NEAR(
      mass_of(
          {"line",
           "values",
           {{"area", 0.01}, {"I_y", 1e-5}, {"I_z", 2e-5}, {"torsion", 1e-5}},
           y}),
      rho * 0.01, 1e-9);
}

/// A block, a plate on one of its edges and a beam from a corner of the plate.
std::string make_mixed() {
  return "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 0.2};\n"
         "Rectangle(20) = {1, 0, 0.2, 1, 1};\nPoint(30) = {2, 0, 1.2};\n"
         "BooleanFragments{ Volume{1}; Delete; }{ Surface{20}; Delete; }\n"
         "p() = Point In BoundingBox {2 - 1e-4, -1e-4, 0.1, 2.1, 1e-4, 0.3};\n"
         "Line(100) = {p(0), 30};\n"
         "Physical Volume(\"block\") = {1};\n"
         "Physical Surface(\"panel\") = {Surface In BoundingBox {0.99, -0.1, "
         "0.19, 2.1, 1.1, 0.21}};\n"
         "Physical Surface(\"foot\") = {Surface In BoundingBox {-0.1, -0.1, "
         "-0.1, 0.01, 1.1, 0.3}};\n"
         "Physical Curve(\"mast\") = {100};\n";
}

MeshSections make_mixed_sections() {
  return {{{"panel", {0.02}}},
          {{"mast", "tube", {{"radius", 0.03}, {"wall", 0.03}}}},
          {kSteel, {"mast", {7e10, 0.33, 2700.0}}}};
}

TEST(SectionedMesh, JoinsSolidsShellsAndBeamsByNodes) {
  const auto file = write_file("mixed.geo", make_mixed());
  MeshOptions options;
  options.size = 0.25;
  const SectionedMesh made =
      read_sectioned_mesh(file, options, make_mixed_sections());
  EXPECT_EQ(made.solids.mesh.blocks.at(0).element->order, 2);
  const AssembledStructure whole = assemble(made);
  const double mass = 7850.0 * (0.2 + 0.02) + 2700.0 * kPi * 9e-4;
  EXPECT_NEAR(whole.mass, mass, 1e-10 * mass);
  const MatrixModel& model = whole.model;
  VectorX q(std::ssize(model.rows));
  const Vector3 u(0.3, -0.7, 0.5);
  const Vector3 theta(-0.2, 0.9, 0.4);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const MatrixRow& row = model.rows[static_cast<std::size_t>(i)];
    const Vector3 x = model.x.col(row.node);
    q[i] = row.component < 3 ? (u + theta.cross(x))[row.component]
                             : theta[row.component - 3];
  }
  const auto& K = model.stiffness.entries;
  EXPECT_LT((K * q).cwiseAbs().maxCoeff(), 1e-11 * K.coeffs().maxCoeff());
  std::set<std::string> sets;
  for (const MatrixNodeSet& set : model.sets) sets.insert(set.name);
  EXPECT_EQ(sets, std::set<std::string>({"block", "panel", "foot", "mast"}));
}

/// Elements of second order are as many of first order with the same nodes.
TEST(SectionedMesh, TakesElementsOfSecondOrder) {
  const auto file = write_file("plate.geo", make_plate(4, 2));
  MeshOptions options;
  options.order = 2;
  const MeshSections sections{{{"", {0.01}}}, {}, {kSteel}};
  const SectionedMesh made = read_sectioned_mesh(file, options, sections);
  EXPECT_EQ(made.structure.shells.size(), 4U * 4U * 2U);
  const auto fine = write_file("fine.geo", make_plate(8, 4));
  expect_same_matrices(assemble(made).model,
                       assemble(read_sectioned_mesh(fine, {}, sections)).model);
  const auto incomplete = write_file(
      "incomplete.geo", "Mesh.SecondOrderIncomplete = 1;\n" + make_plate(2, 2));
  EXPECT_THAT(find_error(incomplete, sections, options),
              AllOf(HasSubstr("element"), HasSubstr("SecondOrderIncomplete")));
}

TEST(SectionedMesh, HasElementsOfTheSizeWanted) {
  const auto file =
      write_file("disk.geo",
                 "SetFactory(\"OpenCASCADE\");\nDisk(1) = {0, 0, 0, 1};\n"
                 "Physical Surface(\"disk\") = {1};\n");
  const MeshSections sections{{{"", {0.01}}}, {}, {kSteel}};
  MeshOptions options;
  options.size = 0.1;
  const SectionedMesh made = read_sectioned_mesh(file, options, sections);
  // equilateral triangles of this side
  const double expected = kPi / (0.25 * std::sqrt(3.0) * 0.01);
  EXPECT_NEAR(static_cast<double>(made.structure.shells.size()), expected,
              0.25 * expected);
  options.unit = 1e-3;
  options.size = 0.2;
  const AssembledStructure small =
      assemble(read_sectioned_mesh(file, options, sections));
  EXPECT_NEAR(small.mass, 7850.0 * kPi * 1e-6 * 0.01, 0.02 * small.mass);
}

/// With elements of all dimensions.
Mesh read_all(const std::filesystem::path& file) {
  MeshOptions options;
  options.with_surfaces = true;
  return run_mesher(find_mesher(), file, options).mesh;
}

std::string find_group_error(const Mesh& mesh, const MeshSections& sections) {
  try {
    static_cast<void>(assemble(assign_sections(mesh, sections)));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(SectionedMesh, SaysWhatIsWrongWithItsGroups) {
  const Mesh plate = read_all(write_file("plate.geo", make_plate(2, 2)));
  const Mesh mixed = read_all(write_file("mixed.geo", make_mixed()));
  const auto plate_error = [&](const ShellRegion& region) {
    return find_group_error(plate, {{region}, {}, {kSteel}});
  };
  EXPECT_THAT(
      plate_error({"skim", {0.01}}),
      AllOf(HasSubstr("plate.geo"), HasSubstr("skim"), HasSubstr("skin")));
  EXPECT_THAT(plate_error({"rib", {0.01}}), HasSubstr("a group of curves"));
  EXPECT_THAT(plate_error({"skin", {0.0}}), HasSubstr("thickness of 0 m"));
  EXPECT_THAT(plate_error({"skin", {-0.01}}), HasSubstr("Expected > 0"));
  EXPECT_THAT(plate_error({"skin", {0.01, 0.02}, {0.0, 1.0, 2.0}}),
              HasSubstr("2 thicknesses and 3 angles"));
  EXPECT_THAT(plate_error({"skin", {0.01}, {}, {"cfrp"}}),
              HasSubstr("material 'cfrp', which is missing"));
  EXPECT_THAT(find_group_error(plate, {{{"skin", {0.01}}}, {}, {}}),
              HasSubstr("has no material"));
  EXPECT_THAT(find_group_error(
                  plate, {{{"skin", {0.01}}, {"skin", {0.02}}}, {}, {kSteel}}),
              HasSubstr("Expected one"));
  EXPECT_THAT(
      find_group_error(
          plate, {{{"skin", {0.01}}}, {}, {kSteel, {"spar", kSteel.material}}}),
      AllOf(HasSubstr("'spar'"), HasSubstr("belongs to nothing")));
  EXPECT_THAT(
      find_group_error(
          plate, {{{"skin", {0.01}}},
                  {{"rib", "rectangle", {{"height", 0.1}, {"width", 0.1}}}},
                  {kSteel}}),
      HasSubstr("needs a y_axis"));
  EXPECT_THAT(find_group_error(
                  plate, {{{"skin", {0.01}}},
                          {{"rib", "tube", {{"radius", 0.1}, {"wall", 0.2}}}},
                          {kSteel}}),
              HasSubstr("give no section 'tube'"));
  EXPECT_THAT(find_group_error(plate, {{{"skin", {0.01}}},
                                       {{"rib",
                                         "rectangle",
                                         {{"height", 0.1}, {"width", 0.1}},
                                         Vector3(0.0, 1.0, 0.0)}},
                                       {kSteel}}),
              AllOf(HasSubstr("'rib', element"), HasSubstr("along")));
  MeshSections sections = make_mixed_sections();
  sections.shells[0].group = "block";
  EXPECT_THAT(find_group_error(mixed, sections),
              HasSubstr("a group of volumes"));
  sections = make_mixed_sections();
  sections.shells[0].group = "";
  EXPECT_THAT(find_group_error(mixed, sections), HasSubstr("Expected a group"));
  sections = make_mixed_sections();
  sections.shells.clear();
  EXPECT_THAT(find_group_error(mixed, sections),
              AllOf(HasSubstr("in group 'panel'"), HasSubstr("no thickness")));
  sections = make_mixed_sections();
  sections.beams.clear();
  sections.materials.pop_back();
  EXPECT_THAT(find_group_error(mixed, sections),
              AllOf(HasSubstr("in group 'mast'"), HasSubstr("no section")));
}

/// Two halves whose normals are opposite.
TEST(SectionedMesh, RefusesAnOffsetWhereTheNormalTurnsOver) {
  const auto file = write_file(
      "halves.geo",
      "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\nPoint(3) = {1, 1, 0};\n"
      "Point(4) = {0, 1, 0};\nPoint(5) = {2, 0, 0};\nPoint(6) = {2, 1, 0};\n"
      "Line(1) = {1, 2};\nLine(2) = {2, 3};\nLine(3) = {3, 4};\n"
      "Line(4) = {4, 1};\nLine(5) = {2, 5};\nLine(6) = {5, 6};\n"
      "Line(7) = {6, 3};\nCurve Loop(1) = {1, 2, 3, 4};\n"
      "Curve Loop(2) = {2, -7, -6, -5};\nPlane Surface(1) = {1};\n"
      "Plane Surface(2) = {2};\nPhysical Surface(\"skin\") = {1, 2};\n");
  ShellRegion region{"skin", {0.01}};
  MeshOptions options;
  options.size = 0.5;
  EXPECT_EQ(find_error(file, {{region}, {}, {kSteel}}, options), "none");
  region.offset = 0.005;
  EXPECT_THAT(find_error(file, {{region}, {}, {kSteel}}, options),
              HasSubstr("turns over at the edge"));
}

TEST(SectionedMesh, RefusesADeck) {
  const auto file = write_file(
      "plate.bdf",
      make_deck(2, 2, "MAT1,1,2.1+11,,.3,7850.\nPSHELL,1,1,.01,1,,1\n"));
  EXPECT_THAT(find_error(file, {{{"", {0.01}}}, {}, {kSteel}}),
              HasSubstr("a deck has sections of its own"));
}

}  // namespace
}  // namespace limber::fem::sectioned_mesh_test
