// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/draw_structure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/mesh/linear_cell.hpp"
#include "limber/fem/structural/place_element.hpp"

namespace limber::fem {
namespace {

using Side = ModelSurface::Side;

class StructureDrawer {
 public:
  StructureDrawer(const PlacedStructure& placed, MatrixModel& model)
      : placed_(placed), structure_(placed.structure), model_(model) {}

  DrawnStructure draw() {
    next_tag_ = find_first_tag();
    for (int n = 0; n < static_cast<int>(model_.tags.size()); ++n)
      model_.mesh_surface.bases.push_back(n);
    model_.mesh_surface.sides.assign(model_.tags.size(), Side::none);
    add_led_nodes();
    draw_shells();
    for (const StructureBeam& beam : structure_.beams) draw_beam(beam);
    draw_solids();
    fill_surface();
    finish();
    return std::move(drawn_);
  }

 private:
  /// A power of ten beyond all tags.
  [[nodiscard]] std::size_t find_first_tag() const {
    std::size_t tag = 1;
    for (const std::size_t other : structure_.tags)
      while (tag <= other) tag *= 10;
    return tag + 1;
  }

  /// Adds a part of an unknown of a node to the last condensed row.
  void add_unknown(int node, int component, double factor) {
    const auto row = static_cast<int>(model_.condensed.size()) - 1;
    for (NodeMap::InnerIterator it(placed_.map, 6 * node + component); it; ++it)
      entries_.emplace_back(row, it.col(), factor * it.value());
  }

  void add_led_nodes() {
    for (int n = 0; n < static_cast<int>(placed_.places.size()); ++n) {
      if (placed_.places[index(n)] < 0 || !placed_.motions.is_led(n)) continue;
      for (int c = 0; c < 6; ++c) {
        model_.condensed.push_back({placed_.places[index(n)], c});
        add_unknown(n, c, 1.0);
      }
    }
  }

  /// A node at `d` from another, with which it moves. @returns its index
  int add_node(int node, const Vector3& d, Side side = Side::none) {
    const auto drawn = static_cast<int>(model_.tags.size());
    model_.mesh_surface.bases.push_back(placed_.places[index(node)]);
    model_.mesh_surface.sides.push_back(side);
    model_.tags.push_back(next_tag_++);
    points_.emplace_back(structure_.x.col(node) + d);
    const Matrix3 rotation = -skew(d);
    for (int c = 0; c < 3; ++c) {
      model_.condensed.push_back({drawn, c});
      add_unknown(node, c, 1.0);
      for (int k = 0; k < 3; ++k)
        if (rotation(c, k) != 0.0) add_unknown(node, 3 + k, rotation(c, k));
    }
    return drawn;
  }

  void add_quad(int a, int b, int c, int d) {
    model_.triangles.push_back({a, b, c});
    model_.triangles.push_back({a, c, d});
  }

  // ---- shells
  int find_face_node(int node, const Vector3& normal, double bottom,
                     double top) {
    for (const int i : faces_of_[node]) {
      FaceNode& face = drawn_.faces[index(i)];
      if (face.normal.dot(normal) < kSameDirection || face.bottom != bottom ||
          face.top != top)
        continue;
      face.sum += normal;
      return i;
    }
    faces_of_[node].push_back(static_cast<int>(drawn_.faces.size()));
    drawn_.faces.push_back({node, normal, normal, bottom, top, {-1, -1}});
    return static_cast<int>(drawn_.faces.size()) - 1;
  }

  void draw_shells() {
    std::map<std::pair<int, int>, int> sides;
    for (const StructureShell& shell : structure_.shells) {
      const Laminate& laminate = structure_.laminates[index(shell.laminate)];
      const std::vector<int>& nodes = shell.nodes;
      const Vector3 normal = Vector3(structure_.x.col(nodes[2 % nodes.size()]) -
                                     structure_.x.col(nodes[0]))
                                 .cross(Vector3(structure_.x.col(nodes.back()) -
                                                structure_.x.col(nodes[1])))
                                 .normalized();
      std::vector<int> polygon;
      for (const int node : nodes)
        polygon.push_back(find_face_node(node, normal,
                                         laminate.bottom + shell.offset,
                                         laminate.top + shell.offset));
      for (std::size_t i = 0; i < polygon.size(); ++i)
        ++sides[{polygon[i], polygon[(i + 1) % polygon.size()]}];
      drawn_.corners.push_back(std::move(polygon));
    }
    for (FaceNode& face : drawn_.faces) {
      const Vector3 n = face.sum.normalized();
      face.drawn = {add_node(face.node, face.bottom * n, Side::bottom),
                    add_node(face.node, face.top * n, Side::top)};
    }
    for (std::size_t i = 0; i < drawn_.corners.size(); ++i) {
      draw_shell(drawn_.corners[i], sides);
      fill_shell(drawn_.corners[i], structure_.shells[i].laminate);
    }
  }

  void fill_shell(const std::vector<int>& polygon, int laminate) {
    std::vector<int> nodes;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
      for (const int face : polygon)
        nodes.push_back(drawn_.faces[index(face)].drawn[side]);
    add_cell(nodes, laminate);
  }

  /// Of six or eight nodes.
  void add_cell(const std::vector<int>& nodes, int region) {
    ElementBlock& block = cells_[nodes.size() == 8 ? 1 : 0];
    block.tags.push_back(block.tags.size() + 1);
    block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
    block.regions.push_back(region);
  }

  void draw_shell(const std::vector<int>& polygon,
                  const std::map<std::pair<int, int>, int>& sides) {
    const auto drawn = [&](std::size_t i, std::size_t side) {
      return drawn_.faces[index(polygon[i % polygon.size()])].drawn[side];
    };
    model_.triangles.push_back({drawn(0, 1), drawn(1, 1), drawn(2, 1)});
    model_.triangles.push_back({drawn(0, 0), drawn(2, 0), drawn(1, 0)});
    if (polygon.size() == 4) {
      model_.triangles.push_back({drawn(0, 1), drawn(2, 1), drawn(3, 1)});
      model_.triangles.push_back({drawn(0, 0), drawn(3, 0), drawn(2, 0)});
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const int a = polygon[i];
      const int b = polygon[(i + 1) % polygon.size()];
      const auto other = sides.find({b, a});
      const bool is_inside =
          other != sides.end() && other->second == 1 && sides.at({a, b}) == 1;
      if (is_inside) continue;
      add_quad(drawn(i, 0), drawn(i + 1, 0), drawn(i + 1, 1), drawn(i, 1));
    }
  }

  // ---- beams
  void draw_beam(const StructureBeam& beam) {
    const Matrix3 axes = find_axes(structure_, beam);
    const auto outline =
        list_outline(structure_.beam_properties[index(beam.property)].section);
    std::array<std::vector<int>, 2> rings;
    for (std::size_t end = 0; end < 2; ++end)
      for (const auto& [y, z] : outline)
        rings[end].push_back(
            add_node(beam.nodes[end],
                     beam.offsets[end] + y * axes.col(1) + z * axes.col(2)));
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i < n; ++i)
      add_quad(rings[0][i], rings[0][(i + 1) % n], rings[1][(i + 1) % n],
               rings[1][i]);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      model_.triangles.push_back({rings[0][0], rings[0][i + 1], rings[0][i]});
      model_.triangles.push_back({rings[1][0], rings[1][i], rings[1][i + 1]});
    }
    fill_beam(rings,
              static_cast<int>(structure_.laminates.size()) + beam.property);
    drawn_.outlines.push_back(std::move(rings));
  }

  void fill_beam(const std::array<std::vector<int>, 2>& rings, int region) {
    const std::size_t n = rings[0].size();
    if (n == 4) {
      std::vector<int> nodes = rings[0];
      nodes.insert(nodes.end(), rings[1].begin(), rings[1].end());
      return add_cell(nodes, region);
    }
    for (std::size_t i = 1; i + 1 < n; ++i)
      add_cell({rings[0][0], rings[0][i], rings[0][i + 1], rings[1][0],
                rings[1][i], rings[1][i + 1]},
               region);
  }

  /// Moduli of faces: of a ply across its fibres, as through its thickness.
  void fill_surface() {
    ModelSurface& mesh_surface = model_.mesh_surface;
    const double area = placed_.solids.unit * placed_.solids.unit;
    for (const Laminate& laminate : structure_.laminates)
      mesh_surface.materials.push_back(
          {laminate.outer.E_2 / area, laminate.outer.nu_12, 0.0});
    for (const BeamProperty& property : structure_.beam_properties) {
      const BeamMaterial& m = property.material;
      mesh_surface.materials.push_back(
          {m.youngs_modulus / area, m.poissons_ratio(), 0.0});
    }
    const auto first = static_cast<int>(mesh_surface.materials.size());
    mesh_surface.materials.insert(mesh_surface.materials.end(),
                                  placed_.solids.materials.begin(),
                                  placed_.solids.materials.end());
    constexpr std::array<LinearCell, 2> kCells = {LinearCell::wedge,
                                                  LinearCell::hexahedron};
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].tags.empty()) continue;
      cells_[i].element =
          std::make_shared<const ReferenceElement>(make_linear_cell(kCells[i]));
      mesh_surface.mesh.blocks.push_back(std::move(cells_[i]));
    }
    for (ElementBlock block : placed_.solids.mesh.blocks) {
      for (int& node : block.nodes)
        node = placed_.places[index(placed_.solid_nodes[index(node)])];
      for (int& region : block.regions) region += first;
      mesh_surface.mesh.blocks.push_back(std::move(block));
    }
  }

  void draw_solids() {
    for (const auto& triangle : boundary_triangles(placed_.solids.mesh)) {
      std::array<int, 3>& own = model_.triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        own[i] = placed_.places[index(placed_.solid_nodes[index(triangle[i])])];
    }
  }

  void finish() {
    const Eigen::Index own = model_.x.cols();
    Matrix3X x(3, own + static_cast<Eigen::Index>(points_.size()));
    x.leftCols(own) = model_.x;
    for (std::size_t i = 0; i < points_.size(); ++i)
      x.col(own + static_cast<Eigen::Index>(i)) = points_[i];
    model_.x = std::move(x);
    model_.drawn = points_.size();
    model_.equations.resize(static_cast<Eigen::Index>(model_.condensed.size()),
                            static_cast<Eigen::Index>(model_.rows.size()));
    model_.equations.setFromTriplets(entries_.begin(), entries_.end());
  }

  const PlacedStructure& placed_;
  const Structure& structure_;
  MatrixModel& model_;
  std::size_t next_tag_ = 1;
  std::vector<Vector3> points_;
  std::vector<Eigen::Triplet<double>> entries_;
  DrawnStructure drawn_;
  std::array<ElementBlock, 2> cells_;  // wedges and hexahedra
  std::map<int, std::vector<int>> faces_of_;
};

}  // namespace

std::vector<std::array<double, 2>> list_outline(const BeamSection& section) {
  double y = section.half_height;
  double z = section.half_width;
  if (!(y > 0.0 && z > 0.0)) {  // a rectangle of these moments
    y = std::sqrt(3.0 * section.I_z / section.area);
    z = std::sqrt(3.0 * section.I_y / section.area);
  }
  if (!section.is_round) return {{-y, -z}, {y, -z}, {y, z}, {-y, z}};
  std::vector<std::array<double, 2>> outline;
  for (int i = 0; i < kRoundCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRoundCorners;
    outline.push_back({y * std::cos(angle), z * std::sin(angle)});
  }
  return outline;
}

DrawnStructure draw_structure(const PlacedStructure& placed,
                              MatrixModel& model) {
  return StructureDrawer(placed, model).draw();
}

}  // namespace limber::fem
