// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesh_pieces.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"

namespace limber::fem {
namespace {

class Separation {
 public:
  Separation(const Mesh& mesh, const ElementLabels& labels)
      : mesh_(mesh), labels_(labels) {
    for (const ElementBlock& block : mesh.blocks) {
      first_.push_back(count_);
      count_ += block.size();
    }
    LIMBER_EXPECT(labels.size() == count_);
  }

  CutMesh run() {
    const int pieces = *std::max_element(labels_.begin(), labels_.end()) + 1;
    CutMesh cut;
    for (int p = 0; p < pieces; ++p) cut.pieces.push_back(take_piece(p));
    cut.cuts = find_cuts();
    return cut;
  }

 private:
  [[nodiscard]] int label_of(const BoundaryFace& face) const {
    return labels_[first_[index(face.block)] + face.element];
  }

  MeshPiece take_piece(int p) const {
    MeshPiece piece;
    piece.nodes = find_nodes(p);
    Mesh& mesh = piece.mesh;
    mesh.source = mesh_.source;
    mesh.x = mesh_.x(Eigen::all, piece.nodes);
    for (const int node : piece.nodes) {
      mesh.tags.push_back(mesh_.tags[index(node)]);
    }
    mesh.volume_groups = mesh_.volume_groups;
    mesh.materials = mesh_.materials;
    take_elements(p, piece);
    take_masses(p, piece);
    check_connected(mesh);
    take_surface(p, piece);
    for (const PhysicalGroup& group : mesh_.groups) {
      PhysicalGroup part = take_group(group, p, piece);
      if (!part.nodes.empty()) mesh.groups.push_back(std::move(part));
    }
    return piece;
  }

  [[nodiscard]] std::vector<int> find_nodes(int p) const {
    std::vector<bool> is_used(mesh_.node_count(), false);
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const ElementBlock& block = mesh_.blocks[b];
      for (std::size_t e = 0; e < block.size(); ++e) {
        if (labels_[first_[b] + e] != p) continue;
        for (int i = 0; i < block.element->node_count; ++i) {
          is_used[index(block.element_nodes(e)[i])] = true;
        }
      }
    }
    std::vector<int> nodes;
    for (std::size_t n = 0; n < is_used.size(); ++n) {
      if (is_used[n]) nodes.push_back(static_cast<int>(n));
    }
    return nodes;
  }

  /// Adds one element of `from` to `to`, with the piece's node numbers.
  static void add_element(const ElementBlock& from, std::size_t e,
                          const MeshPiece& piece, ElementBlock& to) {
    to.tags.push_back(from.tags[e]);
    for (int i = 0; i < from.element->node_count; ++i) {
      to.nodes.push_back(piece.find(from.element_nodes(e)[i]));
    }
    if (!from.regions.empty()) to.regions.push_back(from.regions[e]);
  }

  void take_elements(int p, MeshPiece& piece) const {
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      ElementBlock part;
      part.element = mesh_.blocks[b].element;
      for (std::size_t e = 0; e < mesh_.blocks[b].size(); ++e) {
        if (labels_[first_[b] + e] != p) continue;
        add_element(mesh_.blocks[b], e, piece, part);
      }
      piece.mesh.blocks.push_back(std::move(part));
    }
  }

  /// A mass on a cut is the first piece's.
  void take_masses(int p, MeshPiece& piece) const {
    for (const NodeMass& point : mesh_.masses)
      if (find_first_label(point.node) == p)
        piece.mesh.masses.push_back({piece.find(point.node), point.mass});
  }

  [[nodiscard]] int find_first_label(int node) const {
    int first = std::numeric_limits<int>::max();
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const ElementBlock& block = mesh_.blocks[b];
      for (std::size_t i = 0; i < block.nodes.size(); ++i)
        if (block.nodes[i] == node)
          first = std::min(
              first, labels_[first_[b] + i / index(block.element->node_count)]);
    }
    return first;
  }

  void take_surface(int p, MeshPiece& piece) const {
    std::vector<std::vector<std::size_t>> places;  // in the piece's blocks
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      std::vector<std::size_t> place(mesh_.blocks[b].size(), 0);
      std::size_t next = 0;
      for (std::size_t e = 0; e < place.size(); ++e) {
        if (labels_[first_[b] + e] == p) place[e] = next++;
      }
      places.push_back(std::move(place));
    }
    std::vector<bool> is_on(piece.nodes.size(), false);
    Mesh& mesh = piece.mesh;
    for (BoundaryFace face : mesh_.boundary_faces) {
      if (label_of(face) != p) continue;
      face.element = places[index(face.block)][face.element];
      mesh.boundary_faces.push_back(face);
      for (const int node : face_nodes(mesh, face)) is_on[index(node)] = true;
    }
    for (std::size_t n = 0; n < is_on.size(); ++n) {
      if (is_on[n]) mesh.boundary_nodes.push_back(static_cast<int>(n));
    }
  }

  /// Piece of each surface face, by its sorted nodes.
  const std::map<std::vector<int>, int>& get_owners() const {
    if (!owners_.empty()) return owners_;
    for (const BoundaryFace& face : mesh_.boundary_faces) {
      std::vector<int> nodes = face_nodes(mesh_, face);
      std::sort(nodes.begin(), nodes.end());
      owners_.emplace(std::move(nodes), label_of(face));
    }
    return owners_;
  }

  /// Whether an element of a group belongs to piece p, which has its nodes. One
  /// on the border of pieces belongs to the piece with this face.
  [[nodiscard]] bool is_owned(const PhysicalGroup& group, int p,
                              const int* nodes, int count,
                              std::size_t tag) const {
    if (group.dimension == 3) return tag_labels().at(tag) == p;
    if (group.dimension != 2) return true;
    std::vector<int> key(nodes, nodes + count);
    std::sort(key.begin(), key.end());
    const auto found = get_owners().find(key);
    return found == get_owners().end() || found->second == p;
  }

  const std::map<std::size_t, int>& tag_labels() const {
    if (!label_of_tag_.empty()) return label_of_tag_;
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      for (std::size_t e = 0; e < mesh_.blocks[b].size(); ++e) {
        label_of_tag_[mesh_.blocks[b].tags[e]] = labels_[first_[b] + e];
      }
    }
    return label_of_tag_;
  }

  [[nodiscard]] PhysicalGroup take_group(const PhysicalGroup& group, int p,
                                         const MeshPiece& piece) const {
    PhysicalGroup part;
    part.name = group.name;
    part.dimension = group.dimension;
    for (const ElementBlock& block : group.blocks) {
      ElementBlock kept;
      kept.element = block.element;
      for (std::size_t e = 0; e < block.size(); ++e) {
        const int* nodes = block.element_nodes(e);
        const int count = block.element->node_count;
        const bool is_here = std::all_of(
            nodes, nodes + count, [&](int n) { return piece.find(n) >= 0; });
        if (!is_here || !is_owned(group, p, nodes, count, block.tags[e])) {
          continue;
        }
        add_element(block, e, piece, kept);
      }
      part.nodes.insert(part.nodes.end(), kept.nodes.begin(), kept.nodes.end());
      if (kept.size() > 0) part.blocks.push_back(std::move(kept));
    }
    if (group.blocks.empty()) {
      for (const int node : group.nodes) {
        if (piece.find(node) >= 0) part.nodes.push_back(piece.find(node));
      }
    }
    std::sort(part.nodes.begin(), part.nodes.end());
    part.nodes.erase(std::unique(part.nodes.begin(), part.nodes.end()),
                     part.nodes.end());
    return part;
  }

  /// Faces between two pieces, in parts that share nodes.
  [[nodiscard]] std::vector<MeshCut> find_cuts() const {
    std::map<std::pair<int, int>, std::vector<BoundaryFace>> between;
    for (SharedFace face : find_shared_faces(mesh_)) {
      if (label_of(face[0]) > label_of(face[1])) std::swap(face[0], face[1]);
      const int first = label_of(face[0]);
      const int second = label_of(face[1]);
      if (first != second) between[{first, second}].push_back(face[0]);
    }
    std::vector<MeshCut> cuts;
    for (const auto& [pieces, faces] : between) {
      for (const std::vector<BoundaryFace>& part : split(faces)) {
        cuts.push_back({pieces.first, pieces.second, weigh_cut(mesh_, part)});
      }
    }
    return cuts;
  }

  /// Faces in parts that share nodes.
  [[nodiscard]] std::vector<std::vector<BoundaryFace>> split(
      const std::vector<BoundaryFace>& faces) const {
    std::vector<std::size_t> parent(faces.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&parent](std::size_t face) {
      while (parent[face] != face) face = parent[face] = parent[parent[face]];
      return face;
    };
    std::map<int, std::size_t> face_of_node;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (const int node : face_nodes(mesh_, faces[f])) {
        const auto known = face_of_node.emplace(node, f).first;
        // The first face of a part is its root.
        const std::size_t one = root(known->second);
        const std::size_t other = root(f);
        parent[std::max(one, other)] = std::min(one, other);
      }
    }
    std::map<std::size_t, std::vector<BoundaryFace>> parts;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      parts[root(f)].push_back(faces[f]);
    }
    std::vector<std::vector<BoundaryFace>> result;
    for (auto& [number, own] : parts) result.push_back(std::move(own));
    return result;
  }

  const Mesh& mesh_;
  const ElementLabels& labels_;
  std::vector<std::size_t> first_;  // number of each block's first element
  std::size_t count_ = 0;
  mutable std::map<std::vector<int>, int> owners_;
  mutable std::map<std::size_t, int> label_of_tag_;
};

}  // namespace

int MeshPiece::find(int node) const {
  const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
  return found != nodes.end() && *found == node
             ? static_cast<int>(found - nodes.begin())
             : -1;
}

CutMesh separate(const Mesh& mesh, const ElementLabels& labels) {
  return Separation(mesh, labels).run();
}

}  // namespace limber::fem
