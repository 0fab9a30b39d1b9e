// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::fem {
namespace {

using LocalTriangle = std::array<int, 3>;

/// A face in its own lattice coordinates: corner a at (0, 0), b at (p, 0), d
/// (the last corner) at (0, p).
using Lattice = std::map<std::pair<int, int>, int>;

Lattice make_lattice(const ReferenceElement& element, std::size_t face) {
  const std::vector<int>& nodes = element.faces[face];
  const bool is_quad = element.face_corners[face] == 4;
  const Vector3 origin = element.node_uvw.col(nodes[0]);
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = element.node_uvw.col(nodes[1]) - origin;
  axes.col(1) = element.node_uvw.col(nodes[is_quad ? 3 : 2]) - origin;
  const Eigen::Matrix<double, 2, 3> inverse =
      (axes.transpose() * axes).inverse() * axes.transpose();
  Lattice lattice;
  for (const int node : nodes) {
    const Eigen::Vector2d place =
        inverse * (Vector3(element.node_uvw.col(node)) - origin);
    lattice[{static_cast<int>(std::lround(place[0] * element.order)),
             static_cast<int>(std::lround(place[1] * element.order))}] = node;
  }
  return lattice;
}

std::vector<LocalTriangle> split_lattice(const Lattice& lattice, int order) {
  std::vector<LocalTriangle> triangles;
  const auto add = [&](std::pair<int, int> a, std::pair<int, int> b,
                       std::pair<int, int> c) {
    const auto ia = lattice.find(a);
    const auto ib = lattice.find(b);
    const auto ic = lattice.find(c);
    if (ia == lattice.end() || ib == lattice.end() || ic == lattice.end())
      return;
    triangles.push_back({ia->second, ib->second, ic->second});
  };
  for (int i = 0; i < order; ++i)
    for (int j = 0; j < order; ++j) {
      add({i, j}, {i + 1, j}, {i, j + 1});
      add({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
    }
  return triangles;
}

/// A face's triangles, as local nodes. Faces without their inner nodes
/// (serendipity elements) cannot use the lattice.
std::vector<LocalTriangle> face_triangles(const ReferenceElement& element,
                                          std::size_t face) {
  const std::vector<int>& nodes = element.faces[face];
  const bool is_quad = element.face_corners[face] == 4;
  const auto p = static_cast<std::size_t>(element.order);
  const std::size_t complete =
      is_quad ? (p + 1) * (p + 1) : (p + 1) * (p + 2) / 2;
  const Lattice lattice = make_lattice(element, face);
  if (nodes.size() == complete) return split_lattice(lattice, element.order);
  if (is_quad && p == 2) {
    const auto at = [&](int i, int j) { return lattice.at({i, j}); };
    return {{at(0, 0), at(1, 0), at(0, 1)}, {at(2, 0), at(2, 1), at(1, 0)},
            {at(2, 2), at(1, 2), at(2, 1)}, {at(0, 2), at(0, 1), at(1, 2)},
            {at(1, 0), at(2, 1), at(1, 2)}, {at(1, 0), at(1, 2), at(0, 1)}};
  }
  std::vector<LocalTriangle> triangles{{nodes[0], nodes[1], nodes[2]}};
  if (is_quad) triangles.push_back({nodes[0], nodes[2], nodes[3]});
  return triangles;
}

}  // namespace

std::size_t Mesh::element_count() const {
  std::size_t count = 0;
  for (const ElementBlock& block : blocks) count += block.size();
  return count;
}

Vector3 Mesh::size() const {
  return x.rowwise().maxCoeff() - x.rowwise().minCoeff();
}

bool is_first_order(const Mesh& mesh) {
  return std::all_of(
      mesh.blocks.begin(), mesh.blocks.end(),
      [](const ElementBlock& block) { return block.element->order == 1; });
}

std::size_t find_group(const Mesh& mesh, const std::string& name) {
  std::vector<std::string> known;
  std::vector<std::size_t> found;
  for (std::size_t index = 0; index < mesh.groups.size(); ++index) {
    if (mesh.groups[index].name == name) found.push_back(index);
    known.push_back(mesh.groups[index].name);
  }
  if (found.size() == 1) return found.front();
  if (found.size() > 1)
    throw InputError(fmt::format(
        "{}: {} physical groups are called '{}'. Give each its own name.",
        mesh.source, found.size(), name));
  throw InputError(
      fmt::format("{}: {}. Expected a physical group that at least one "
                  "element of the mesh belongs to.",
                  mesh.source, describe_unknown("group", name, known)));
}

std::vector<int> find_free_nodes(const Mesh& mesh,
                                 const std::vector<int>& held) {
  std::vector<int> nodes;
  for (int n = 0; n < static_cast<int>(mesh.node_count()); ++n) {
    if (!std::binary_search(held.begin(), held.end(), n)) nodes.push_back(n);
  }
  return nodes;
}

std::vector<int> face_nodes(const Mesh& mesh, const BoundaryFace& face) {
  const ElementBlock& block = mesh.blocks[static_cast<std::size_t>(face.block)];
  const int* nodes = block.element_nodes(face.element);
  std::vector<int> result;
  for (const int local :
       block.element->faces[static_cast<std::size_t>(face.face)])
    result.push_back(nodes[local]);
  return result;
}

std::vector<std::array<int, 3>> boundary_triangles(const Mesh& mesh) {
  // Split each kind of face once.
  std::vector<std::vector<std::vector<LocalTriangle>>> local(
      mesh.blocks.size());
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (std::size_t f = 0; f < mesh.blocks[b].element->faces.size(); ++f)
      local[b].push_back(face_triangles(*mesh.blocks[b].element, f));
  std::vector<std::array<int, 3>> triangles;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const auto block = static_cast<std::size_t>(face.block);
    const int* nodes = mesh.blocks[block].element_nodes(face.element);
    for (const LocalTriangle& t :
         local[block][static_cast<std::size_t>(face.face)])
      triangles.push_back({nodes[t[0]], nodes[t[1]], nodes[t[2]]});
  }
  return triangles;
}

}  // namespace limber::fem
