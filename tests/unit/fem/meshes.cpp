// SPDX-License-Identifier: BSD-3-Clause
#include "unit/fem/meshes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/fem/gmsh/gmsh_session.hpp"
#include "support/temporary_folder.hpp"

namespace limber::fem::testing {

std::filesystem::path make_test_folder() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name =
      fmt::format("{}.{}", info->test_suite_name(), info->name());
  std::replace(name.begin(), name.end(), '/', '_');
  std::filesystem::path folder =
      limber::test::own_folder() / ("limber_fem." + name);
  std::filesystem::create_directories(folder);
  return folder;
}

std::filesystem::path write_file(const std::string& name,
                                 const std::string& text) {
  std::filesystem::path file = make_test_folder() / name;
  std::ofstream(file) << text;
  return file;
}

std::string find_read_error(const std::filesystem::path& file) {
  try {
    static_cast<void>(read_mesh(file));
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << file << " was accepted";
  return {};
}

int MshText::add_node(const Vector3& x) {
  nodes_ += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", ++node_count_, x[0],
                        x[1], x[2]);
  return node_count_;
}

void MshText::add_element(int gmsh_type, const std::vector<int>& nodes,
                          int volume) {
  elements_ += fmt::format("{} {} 2 {} {} {}\n", ++element_count_, gmsh_type,
                           volume, volume, fmt::join(nodes, " "));
}

void MshText::name_group(int dimension, int tag, const std::string& name) {
  ++name_count_;
  names_ += fmt::format("{} {} \"{}\"\n", dimension, tag, name);
}

std::string MshText::str() const {
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
      "$PhysicalNames\n{}\n{}$EndPhysicalNames\n"
      "$Nodes\n{}\n{}$EndNodes\n"
      "$Elements\n{}\n{}$EndElements\n",
      name_count_, names_, node_count_, nodes_, element_count_, elements_);
}

MshText unit_tetrahedron() {
  MshText text;
  text.name_group(3, 1, "body");
  for (const Vector3& x :
       {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)})
    text.add_node(x);
  text.add_element(MshText::kTetrahedron, {1, 2, 3, 4});
  return text;
}

std::filesystem::path convert(const std::filesystem::path& source,
                              const std::string& name, const MshForm& form) {
  std::filesystem::path file = make_test_folder() / name;
  const GmshSession session;
  gmsh::open(source.string());
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  if (types.empty()) gmsh::model::mesh::generate(3);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete",
                          form.serendipity ? 1 : 0);
  if (form.order > 0) gmsh::model::mesh::setOrder(form.order);
  gmsh::option::setNumber("Mesh.MshFileVersion", form.version);
  gmsh::option::setNumber("Mesh.Binary", form.binary ? 1 : 0);
  gmsh::option::setNumber("Mesh.BdfFieldFormat", form.bulk_fields);
  gmsh::write(file.string());
  return file;
}

std::string box_geo(BoxKind kind) {
  const Vector3& a = kBoxCorner;
  const Vector3 b = kBoxCorner + kBoxSize;
  const bool is_structured = kind != BoxKind::prisms;
  const bool is_layered = kind != BoxKind::tetrahedra;
  std::string text = fmt::format(
      "Point(1) = {{{}, {}, {}}};\nPoint(2) = {{{}, {}, {}}};\n"
      "Point(3) = {{{}, {}, {}}};\nPoint(4) = {{{}, {}, {}}};\n",
      a[0], a[1], a[2], b[0], a[1], a[2], b[0], b[1], a[2], a[0], b[1], a[2]);
  text +=
      "Line(1) = {1, 2};\nLine(2) = {2, 3};\nLine(3) = {3, 4};\n"
      "Line(4) = {4, 1};\nCurve Loop(1) = {1, 2, 3, 4};\n"
      "Plane Surface(1) = {1};\n"
      "Transfinite Curve {1, 3} = 4;\nTransfinite Curve {2, 4} = 3;\n";
  if (is_structured) text += "Transfinite Surface {1};\n";
  if (kind == BoxKind::hexahedra) text += "Recombine Surface {1};\n";
  text +=
      fmt::format("out[] = Extrude {{0, 0, {}}} {{ Surface{{1}}; Layers{{3}};",
                  kBoxSize[2]);
  text += is_layered ? " Recombine; };\n" : " };\n";
  text +=
      "Physical Point(\"corner\") = {1};\nPhysical Surface(\"root\") = {1};\n"
      "Physical Surface(\"tip\") = {out[0]};\n"
      "Physical Volume(\"body\") = {out[1]};\n";
  return text;
}

namespace {

/// A point of the box, from coordinates in [0, 3] x [0, 1] x [0, 1].
Vector3 place(double x, double y, double z) {
  return kBoxCorner + kBoxSize.cwiseProduct(Vector3(x / 3.0, y, z));
}

using Section = std::array<int, 4>;

/// Four nodes of the section at x, in the order (y, z) = 00, 10, 11, 01, each
/// moved along the box's edge.
Section add_section(MshText& text, double x,
                    const std::array<double, 4>& moves = {}) {
  return {text.add_node(place(x + moves[0], 0, 0)),
          text.add_node(place(x + moves[1], 1, 0)),
          text.add_node(place(x + moves[2], 1, 1)),
          text.add_node(place(x + moves[3], 0, 1))};
}

/// The six quadrilaterals between two sections, inner side first.
std::vector<Section> cell_sides(const Section& a, const Section& b) {
  return {{a[0], a[1], a[2], a[3]}, {b[0], b[3], b[2], b[1]},
          {a[0], b[0], b[1], a[1]}, {a[1], b[1], b[2], a[2]},
          {a[2], b[2], b[3], a[3]}, {a[3], b[3], b[0], a[0]}};
}

void add_pyramid(MshText& text, const Section& base, int apex) {
  text.add_element(MshText::kPyramid,
                   {base[0], base[1], base[2], base[3], apex});
}

}  // namespace

std::string mixed_msh(double skew) {
  MshText text;
  text.name_group(3, 1, "body");
  const std::array<double, 4> warped{-skew, skew, -2 * skew, 2 * skew};
  const std::array<double, 4> otherwise{skew, -2 * skew, -skew, skew};
  const Section s0 = add_section(text, 0);
  const Section s1 = add_section(text, 1, warped);
  const Section s2 = add_section(text, 2, otherwise);
  const Section s3 = add_section(text, 3);
  const int apex = text.add_node(place(2.4, 0.55, 0.4));
  // Prisms along y, so that a quadrilateral side meets the hexahedron.
  text.add_element(MshText::kPrism, {s0[0], s0[3], s1[0], s0[1], s0[2], s1[1]});
  text.add_element(MshText::kPrism, {s1[3], s1[0], s0[3], s1[2], s1[1], s0[2]});
  text.add_element(MshText::kHexahedron,
                   {s1[0], s1[1], s1[2], s1[3], s2[0], s2[1], s2[2], s2[3]});
  const std::vector<Section> sides = cell_sides(s2, s3);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Section& q = sides[i];
    if (i < 2) {
      add_pyramid(text, q, apex);
      continue;
    }
    text.add_element(MshText::kTetrahedron, {q[0], q[1], q[2], apex});
    text.add_element(MshText::kTetrahedron, {q[0], q[2], q[3], apex});
  }
  return text.str();
}

std::string pyramids_msh() {
  MshText text;
  text.name_group(3, 1, "body");
  const Section a = add_section(text, 0);
  const Section b = add_section(text, 3);
  const int apex = text.add_node(place(1.2, 0.6, 0.45));
  for (const Section& side : cell_sides(a, b)) add_pyramid(text, side, apex);
  return text.str();
}

}  // namespace limber::fem::testing
