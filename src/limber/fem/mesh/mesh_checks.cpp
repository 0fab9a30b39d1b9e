// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesh_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "limber/common/errors.hpp"

namespace limber::fem {
namespace {

/// Sorted corner nodes of a face; -1 fills a triangle's fourth place.
using FaceKey = std::array<int, 4>;

struct KeyedFace {
  FaceKey key;
  BoundaryFace face;
};

template <typename Visit>
void for_each_face(const Mesh& mesh, Visit visit) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    for (std::size_t e = 0; e < block.size(); ++e)
      for (std::size_t f = 0; f < block.element->faces.size(); ++f)
        visit(BoundaryFace{static_cast<int>(b), e, static_cast<int>(f)});
  }
}

FaceKey key_of(const Mesh& mesh, const BoundaryFace& face) {
  const ElementBlock& block = mesh.blocks[static_cast<std::size_t>(face.block)];
  const auto f = static_cast<std::size_t>(face.face);
  const int* nodes = block.element_nodes(face.element);
  FaceKey key{-1, -1, -1, -1};
  for (int i = 0; i < block.element->face_corners[f]; ++i)
    key[static_cast<std::size_t>(i)] =
        nodes[block.element->faces[f][static_cast<std::size_t>(i)]];
  std::sort(key.begin(), key.end());
  return key;
}

/// All faces of all elements; shared faces are adjacent.
std::vector<KeyedFace> sorted_faces(const Mesh& mesh) {
  std::vector<KeyedFace> faces;
  for_each_face(mesh, [&](const BoundaryFace& face) {
    faces.push_back({key_of(mesh, face), face});
  });
  std::stable_sort(
      faces.begin(), faces.end(),
      [](const KeyedFace& a, const KeyedFace& b) { return a.key < b.key; });
  return faces;
}

/// Disjoint sets with path halving.
class Partition {
 public:
  explicit Partition(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

/// Three corners of a face, and the face.
struct KeyedTriple {
  std::array<int, 3> key;
  BoundaryFace face;
};

/// All triples of corners of the boundary faces: one of a triangle, four of a
/// quadrilateral.
std::vector<KeyedTriple> boundary_triples(const Mesh& mesh) {
  std::vector<KeyedTriple> triples;
  for (const BoundaryFace& face : mesh.boundary_faces) {
    const FaceKey key = key_of(mesh, face);
    triples.push_back({{key[1], key[2], key[3]}, face});
    if (key[0] < 0) continue;
    triples.push_back({{key[0], key[2], key[3]}, face});
    triples.push_back({{key[0], key[1], key[3]}, face});
    triples.push_back({{key[0], key[1], key[2]}, face});
  }
  std::stable_sort(
      triples.begin(), triples.end(),
      [](const KeyedTriple& a, const KeyedTriple& b) { return a.key < b.key; });
  return triples;
}

std::string describe_element(const Mesh& mesh, const BoundaryFace& face) {
  const ElementBlock& block = mesh.blocks[static_cast<std::size_t>(face.block)];
  return fmt::format("element {} ({})", block.tags[face.element],
                     block.element->name);
}

void check_element(const Mesh& mesh, const ElementBlock& block, std::size_t e) {
  const ReferenceElement& element = *block.element;
  const Matrix3X x = element_positions(mesh, block, e);
  const Vector3 extent = x.rowwise().maxCoeff() - x.rowwise().minCoeff();
  // Relative to a cube of the element's length; a usable sliver has 1e-4.
  constexpr double kDegenerate = 1e-10;
  const double least = kDegenerate * std::pow(extent.maxCoeff(), 3);
  const Quadrature& rule =
      is_parallel_sided(element, x) ? element.straight : element.curved;
  for (const MatrixX& gradients : rule.gradients) {
    const Matrix3 jacobian = x * gradients.transpose();
    const double det = jacobian.determinant();
    if (det > least) continue;
    throw InputError(fmt::format(
        "{}: element {} ({}) is {}: its Jacobian determinant is {:.6g} m^3. "
        "Expected positive; {}.",
        mesh.source, block.tags[e], element.name,
        det < -least ? "inverted" : "degenerate", det,
        element.order > 1 ? "if a curved edge is the cause, use a finer mesh "
                            "or straight edges (Mesh.SecondOrderLinear = 1); "
                            "else correct the element's nodes"
                          : "correct the element's nodes or their order"));
  }
}

/// Nodes that coincide with an earlier one: two meshes side by side, not
/// joined.
std::size_t count_coincident_nodes(const Mesh& mesh) {
  std::map<std::array<double, 3>, int> places;
  for (Eigen::Index n = 0; n < mesh.x.cols(); ++n)
    ++places[{mesh.x(0, n), mesh.x(1, n), mesh.x(2, n)}];
  return mesh.node_count() - places.size();
}

/// @param first, last range of faces with one key
void check_shared_face(const Mesh& mesh, const KeyedFace* first,
                       const KeyedFace* last) {
  if (last - first <= 2) return;
  const auto tag = [&](const KeyedFace& keyed) {
    return mesh.blocks[static_cast<std::size_t>(keyed.face.block)]
        .tags[keyed.face.element];
  };
  throw InputError(fmt::format(
      "{}: {} elements share one face (elements {}, {}, {} ...), so some "
      "overlap. Expected two at most; remove the doubled elements.",
      mesh.source, last - first, tag(first[0]), tag(first[1]), tag(first[2])));
}

/// Faces that two elements share have all their nodes in common.
void check_face_orders(const Mesh& mesh) {
  for (const auto& [a, b] : find_shared_faces(mesh)) {
    std::vector<int> nodes_a = face_nodes(mesh, a);
    std::vector<int> nodes_b = face_nodes(mesh, b);
    if (nodes_a.size() == nodes_b.size()) {
      std::sort(nodes_a.begin(), nodes_a.end());
      std::sort(nodes_b.begin(), nodes_b.end());
      if (nodes_a == nodes_b) continue;
    }
    throw InputError(fmt::format(
        "{}: {} and {} share the corners of a face, but not its other nodes "
        "({} and {} nodes), so that the mesh would separate there. Expected "
        "the same nodes; give both elements the same order.",
        mesh.source, describe_element(mesh, a), describe_element(mesh, b),
        nodes_a.size(), nodes_b.size()));
  }
}

}  // namespace

Matrix3X element_positions(const Mesh& mesh, const ElementBlock& block,
                           std::size_t element) {
  const int* nodes = block.element_nodes(element);
  Matrix3X x(3, block.element->node_count);
  for (int i = 0; i < block.element->node_count; ++i)
    x.col(i) = mesh.x.col(nodes[i]);
  return x;
}

bool is_parallel_sided(const ReferenceElement& element, const Matrix3X& x) {
  constexpr double kStraight = 1e-9;  // of the element's length
  const double length =
      (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
  return (x * element.affine_residual).cwiseAbs().maxCoeff() <=
         kStraight * length;
}

std::vector<SharedFace> find_shared_faces(const Mesh& mesh) {
  std::vector<SharedFace> shared;
  const std::vector<KeyedFace> faces = sorted_faces(mesh);
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i].key == faces[i - 1].key)
      shared.push_back({faces[i - 1].face, faces[i].face});
  return shared;
}

void find_boundary(Mesh& mesh) {
  const std::vector<KeyedFace> faces = sorted_faces(mesh);
  std::vector<bool> on_boundary(mesh.node_count(), false);
  mesh.boundary_faces.clear();
  const KeyedFace* const end = faces.data() + faces.size();
  for (const KeyedFace* first = faces.data(); first != end;) {
    const KeyedFace* last = std::find_if(
        first, end, [&](const KeyedFace& f) { return f.key != first->key; });
    check_shared_face(mesh, first, last);
    if (last - first == 1) {
      mesh.boundary_faces.push_back(first->face);
      for (const int node : face_nodes(mesh, first->face))
        on_boundary[static_cast<std::size_t>(node)] = true;
    }
    first = last;
  }
  if (mesh.boundary_faces.empty())
    throw InputError(
        fmt::format("{}: no face lies on a surface, so every element is given "
                    "twice. Remove the doubled elements.",
                    mesh.source));
  mesh.boundary_nodes.clear();
  for (std::size_t node = 0; node < on_boundary.size(); ++node)
    if (on_boundary[node])
      mesh.boundary_nodes.push_back(static_cast<int>(node));
}

void check_faces(const Mesh& mesh) {
  check_face_orders(mesh);
  const std::vector<KeyedTriple> triples = boundary_triples(mesh);
  for (std::size_t i = 1; i < triples.size(); ++i)
    if (triples[i].key == triples[i - 1].key)
      throw InputError(
          fmt::format("{}: {} and {} have three corners of a face in common, "
                      "but their faces do not match, so that the mesh would "
                      "separate there. Expected faces shared whole; put "
                      "pyramids between quadrilaterals and triangles.",
                      mesh.source, describe_element(mesh, triples[i - 1].face),
                      describe_element(mesh, triples[i].face)));
}

void check_elements(const Mesh& mesh) {
  for (const ElementBlock& block : mesh.blocks)
    for (std::size_t e = 0; e < block.size(); ++e)
      check_element(mesh, block, e);
}

void check_connected(const Mesh& mesh) {
  std::vector<std::size_t> first;
  std::size_t count = 0;
  for (const ElementBlock& block : mesh.blocks) {
    first.push_back(count);
    count += block.size();
  }
  // Parts that meet only in an edge or a node could rotate freely there, so
  // only a shared face connects.
  Partition parts(count);
  const auto element = [&](const KeyedFace& keyed) {
    return first[static_cast<std::size_t>(keyed.face.block)] +
           keyed.face.element;
  };
  const std::vector<KeyedFace> faces = sorted_faces(mesh);
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i].key == faces[i - 1].key)
      parts.join(element(faces[i]), element(faces[i - 1]));
  std::map<std::size_t, std::size_t> sizes;
  for (std::size_t e = 0; e < count; ++e) ++sizes[parts.root(e)];
  if (sizes.size() <= 1) return;
  std::size_t largest = 0;
  for (const auto& [root, size] : sizes) largest = std::max(largest, size);
  const std::size_t doubled = count_coincident_nodes(mesh);
  throw InputError(fmt::format(
      "{}: the mesh is in {} parts that share no face (the largest has {} of "
      "{} elements; {}). Expected one connected body; merge the parts' common "
      "faces or make each part a body of its own.",
      mesh.source, sizes.size(), largest, count,
      doubled == 0 ? std::string("no two nodes coincide")
                   : fmt::format("{} nodes lie on others", doubled)));
}

}  // namespace limber::fem
