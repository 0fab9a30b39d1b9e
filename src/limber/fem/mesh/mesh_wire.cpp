// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesh_wire.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "limber/common/records/digest.hpp"
#include "limber/common/records/wire.hpp"

namespace limber::fem {

// Found by argument-dependent lookup.
static void exchange(Wire& wire, Quadrature& rule) {
  wire(rule.weights, rule.shape, rule.gradients);
}

static void exchange(Wire& wire, ReferenceElement& element) {
  wire(element.gmsh_type, element.name, element.dimension, element.order,
       element.node_count, element.corner_count, element.node_uvw,
       element.affine_residual, element.straight, element.curved,
       element.stiffness, element.faces, element.face_corners,
       element.face_rules);
}

static void exchange(Wire& wire, NodeMass& point) {
  wire(point.node, point.mass);
}

namespace {

constexpr std::uint64_t kMagic = 0x34304853454d4d4c;         // "LMMESH04"
constexpr std::uint64_t kContentMagic = 0x32304853454d4d4c;  // "LMMESH02"

using Element = std::shared_ptr<const ReferenceElement>;

/// A block with its element by number.
struct WireBlock {
  std::size_t element = 0;
  std::vector<std::size_t> tags;
  std::vector<int> nodes;
  std::vector<int> regions;
};

struct WireGroup {
  std::string name;
  int dimension = 0;
  std::vector<int> nodes;
  std::vector<WireBlock> blocks;
};

struct WireMaterial {
  std::string name;
  std::string problem;
  std::vector<double> isotropic;  // E, nu, rho
  MatrixX C;                      // 6 x 6, or empty
  bool is_cylindrical = false;
  MatrixX directions;  // 3 x 3
  Vector3 point = Vector3::Zero();
};

void exchange(Wire& wire, WireMaterial& material) {
  wire(material.name, material.problem, material.isotropic, material.C,
       material.is_cylindrical, material.directions, material.point[0],
       material.point[1], material.point[2]);
}

void exchange(Wire& wire, WireBlock& block) {
  wire(block.element, block.tags, block.nodes, block.regions);
}

void exchange(Wire& wire, WireGroup& group) {
  // A list entry begins with its length.
  wire(group.name, group.dimension, group.nodes, group.blocks);
}

/// Elements, each once, in the order in which blocks name them.
class ElementList {
 public:
  std::size_t number_of(const Element& element) {
    const auto found = std::find(list_.begin(), list_.end(), element);
    if (found == list_.end()) {
      list_.push_back(element);
      return list_.size() - 1;
    }
    return static_cast<std::size_t>(found - list_.begin());
  }
  [[nodiscard]] std::vector<ReferenceElement> values() const {
    std::vector<ReferenceElement> values;
    for (const Element& element : list_) values.push_back(*element);
    return values;
  }

 private:
  std::vector<Element> list_;
};

std::vector<WireBlock> to_wire(const std::vector<ElementBlock>& blocks,
                               ElementList& elements) {
  std::vector<WireBlock> result;
  for (const ElementBlock& block : blocks) {
    result.push_back({elements.number_of(block.element), block.tags,
                      block.nodes, block.regions});
  }
  return result;
}

/// Validates the parts of a message.
void require(bool holds) {
  if (!holds) {
    throw InputError("the mesher's reply is inconsistent");
  }
}

void check_rule(const Quadrature& rule, int nodes, int directions) {
  const Eigen::Index points = rule.weights.size();
  require(rule.shape.rows() == nodes && rule.shape.cols() == points &&
          rule.gradients.size() == static_cast<std::size_t>(points));
  for (const MatrixX& gradients : rule.gradients) {
    require(gradients.rows() == directions && gradients.cols() == nodes);
  }
}

bool are_within(const std::vector<int>& values, std::size_t count) {
  return std::all_of(values.begin(), values.end(), [&](int value) {
    return value >= 0 && static_cast<std::size_t>(value) < count;
  });
}

void check_faces(const ReferenceElement& element) {
  require(element.face_corners.size() == element.faces.size() &&
          element.face_rules.size() == element.faces.size());
  const auto count = static_cast<std::size_t>(element.node_count);
  for (std::size_t f = 0; f < element.faces.size(); ++f) {
    const int corners = element.face_corners[f];
    require((corners == 3 || corners == 4) &&
            element.faces[f].size() >= static_cast<std::size_t>(corners) &&
            are_within(element.faces[f], count));
    check_rule(element.face_rules[f], element.node_count, 2);
  }
}

void check_reference_element(const ReferenceElement& element) {
  const int nodes = element.node_count;
  require(element.dimension >= 0 && element.dimension <= 3 && nodes > 0 &&
          element.node_uvw.rows() == 3 && element.node_uvw.cols() == nodes &&
          element.order >= 0 && element.order <= 10 &&
          element.corner_count >= 0 && element.corner_count <= nodes);
  if (element.dimension < 3) return;
  require(element.affine_residual.rows() == nodes &&
          element.affine_residual.cols() == nodes && !element.faces.empty());
  check_rule(element.straight, nodes, 3);
  check_rule(element.curved, nodes, 3);
  check_rule(element.stiffness, nodes, 3);
  check_faces(element);
}

std::vector<Element> make_shared(std::vector<ReferenceElement> values) {
  std::vector<Element> elements;
  for (ReferenceElement& value : values) {
    check_reference_element(value);
    elements.push_back(
        std::make_shared<const ReferenceElement>(std::move(value)));
  }
  return elements;
}

std::vector<ElementBlock> from_wire(std::vector<WireBlock> blocks,
                                    const std::vector<Element>& elements,
                                    std::size_t node_count) {
  std::vector<ElementBlock> result;
  for (WireBlock& block : blocks) {
    require(block.element < elements.size());
    const Element& element = elements[block.element];
    const auto each = static_cast<std::size_t>(element->node_count);
    require(block.regions.size() == block.tags.size() &&
            block.nodes.size() / each == block.tags.size() &&
            block.nodes.size() % each == 0 &&
            are_within(block.nodes, node_count));
    result.push_back({element, std::move(block.tags), std::move(block.nodes),
                      std::move(block.regions)});
  }
  return result;
}

std::vector<WireMaterial> to_wire(
    const std::vector<RegionMaterial>& materials) {
  std::vector<WireMaterial> result;
  for (const auto& [name, material, problem] : materials) {
    WireMaterial wire;
    wire.name = name;
    wire.problem = problem;
    wire.isotropic = {material.youngs_modulus, material.poisson_ratio,
                      material.density};
    if (material.anisotropy) {
      wire.C = material.anisotropy->C;
      wire.is_cylindrical = material.anisotropy->axes.is_cylindrical;
      wire.directions = material.anisotropy->axes.directions;
      wire.point = material.anisotropy->axes.point;
    }
    result.push_back(std::move(wire));
  }
  return result;
}

std::vector<RegionMaterial> from_wire(
    const std::vector<WireMaterial>& materials) {
  std::vector<RegionMaterial> result;
  for (const WireMaterial& wire : materials) {
    require(wire.isotropic.size() == 3);
    RegionMaterial& region = result.emplace_back();
    region.name = wire.name;
    region.problem = wire.problem;
    region.material = {wire.isotropic[0], wire.isotropic[1], wire.isotropic[2]};
    if (wire.C.size() == 0) continue;
    require(wire.C.rows() == 6 && wire.C.cols() == 6 &&
            wire.directions.rows() == 3 && wire.directions.cols() == 3);
    region.material.anisotropy =
        Anisotropy{wire.C, {wire.is_cylindrical, wire.directions, wire.point}};
  }
  return result;
}

/// The mesh in serialised form.
struct WireMesh {
  std::vector<ReferenceElement> elements;
  std::vector<std::size_t> tags;
  Matrix3X x;
  std::vector<WireBlock> blocks;
  std::vector<WireGroup> groups;
  std::vector<std::vector<std::string>> volume_groups;
};

void exchange(Wire& wire, WireMesh& mesh) {
  wire(mesh.elements, mesh.tags, mesh.x, mesh.blocks, mesh.groups,
       mesh.volume_groups);
}

WireMesh to_wire(const Mesh& mesh) {
  ElementList elements;
  WireMesh result;
  result.blocks = to_wire(mesh.blocks, elements);
  for (const PhysicalGroup& group : mesh.groups) {
    result.groups.push_back({group.name, group.dimension, group.nodes,
                             to_wire(group.blocks, elements)});
  }
  result.elements = elements.values();
  result.tags = mesh.tags;
  result.x = mesh.x;
  result.volume_groups = mesh.volume_groups;
  return result;
}

void check_solids(const Mesh& mesh) {
  require(mesh.tags.size() == static_cast<std::size_t>(mesh.x.cols()));
  require(mesh.x.allFinite());
  require(!mesh.tags.empty() &&
          std::is_sorted(mesh.tags.begin(), mesh.tags.end()));
  for (const ElementBlock& block : mesh.blocks) {
    require(block.element->dimension == 3 &&
            are_within(block.regions, mesh.volume_groups.size()));
  }
}

Mesh from_wire(WireMesh wire) {
  Mesh mesh;
  mesh.x = std::move(wire.x);
  mesh.tags = std::move(wire.tags);
  mesh.volume_groups = std::move(wire.volume_groups);
  const std::vector<Element> elements = make_shared(std::move(wire.elements));
  const std::size_t count = mesh.tags.size();
  mesh.blocks = from_wire(std::move(wire.blocks), elements, count);
  check_solids(mesh);
  for (WireGroup& group : wire.groups) {
    require(group.dimension >= 0 && group.dimension <= 3 &&
            std::is_sorted(group.nodes.begin(), group.nodes.end()) &&
            are_within(group.nodes, count));
    mesh.groups.push_back(
        {std::move(group.name), group.dimension, std::move(group.nodes),
         from_wire(std::move(group.blocks), elements, count)});
  }
  return mesh;
}

void check_masses(const std::vector<NodeMass>& masses, std::size_t nodes) {
  for (const auto& [node, mass] : masses)
    require(are_within({node}, nodes) && mass > 0.0 && std::isfinite(mass));
}

void exchange_head(Wire& wire, MeshReply& reply) {
  std::uint64_t magic = kMagic;
  wire(magic);
  require(magic == kMagic);
  wire(reply.problems, reply.notices, reply.is_repeatable, reply.files);
}

}  // namespace

std::string pack_reply(const MeshReply& reply) {
  Wire wire;
  MeshReply head;
  head.problems = reply.problems;
  head.notices = reply.notices;
  head.is_repeatable = reply.is_repeatable;
  head.files = reply.files;
  exchange_head(wire, head);
  if (!reply.problems.empty()) return wire.bytes();
  WireMesh mesh = to_wire(reply.mesh);
  std::vector<WireMaterial> materials = to_wire(reply.mesh.materials);
  std::vector<NodeMass> masses = reply.mesh.masses;
  wire(mesh, materials, masses);
  return wire.bytes();
}

MeshReply unpack_reply(std::string bytes) {
  Wire wire(std::move(bytes));
  MeshReply reply;
  exchange_head(wire, reply);
  if (reply.problems.empty()) {
    WireMesh mesh;
    std::vector<WireMaterial> materials;
    std::vector<NodeMass> masses;
    wire(mesh, materials, masses);
    reply.mesh = from_wire(std::move(mesh));
    reply.mesh.materials = from_wire(materials);
    check_masses(masses, reply.mesh.node_count());
    reply.mesh.masses = std::move(masses);
    require(materials.empty() ||
            materials.size() == reply.mesh.volume_groups.size());
  }
  wire.finish();
  return reply;
}

std::string find_mesh_content(const Mesh& mesh) {
  Wire wire;
  WireMesh parts = to_wire(mesh);
  wire(parts);
  Digest digest;
  digest.add(kContentMagic);
  digest.add_bytes(wire.bytes().data(), wire.bytes().size());
  if (!mesh.materials.empty()) {
    Wire materials;
    std::vector<WireMaterial> values = to_wire(mesh.materials);
    materials(values);
    digest.add_bytes(materials.bytes().data(), materials.bytes().size());
  }
  for (const auto& [node, mass] : mesh.masses) {
    digest.add(node);
    digest.add(mass);
  }
  return digest.text();
}

}  // namespace limber::fem
