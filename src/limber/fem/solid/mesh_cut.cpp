// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/mesh_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/linalg/cholesky.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/assembly.hpp"

namespace limber::fem {
namespace {

/// The lowest mode of diffusion, and the length that it measures.
struct LengthField {
  VectorX f;            ///< per node [-]
  double length = 0.0;  ///< [m]
};

/// int grad N_a . grad N_b, lower triangle: half the trace of a block of K with
/// E = 1, nu = 0.
SparseMatrix find_laplacian(const StructuralMatrices& unit) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(unit.M_s.nonZeros()));
  for (int column = 0; column < unit.K.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator k(unit.K, column); k; ++k) {
      if (k.row() % 3 != k.col() % 3) continue;
      entries.emplace_back(static_cast<int>(k.row() / 3),
                           static_cast<int>(k.col() / 3), 0.5 * k.value());
    }
  }
  SparseMatrix laplacian(unit.M_s.rows(), unit.M_s.cols());
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

/// Nodes' places along the longest axis of the body's second moments.
VectorX project_on_longest_axis(const Mesh& mesh, const SparseMatrix& M_s) {
  const MassProperties body = calc_mass_properties(M_s, mesh.x);
  const auto moments = dense::find_eigenpairs(body.S0);
  Vector3 axis = moments.vectors.col(2);
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  if (axis[largest] < 0.0) axis = -axis;
  return (mesh.x.colwise() - body.center).transpose() * axis;
}

/// By inverse iteration from the longest axis, orthogonal to the constant.
LengthField find_length_field(const Mesh& mesh) {
  constexpr int kMostIterations = 100;
  constexpr double kSettled = 1e-10;
  const std::vector<ElasticMaterial> unit(mesh.volume_groups.size(),
                                          ElasticMaterial{1.0, 0.0, 1.0});
  const StructuralMatrices matrices = assemble_elements(mesh, unit);
  const SparseMatrix& M = matrices.M_s;
  const SparseMatrix L = find_laplacian(matrices);
  const double size = mesh.size().maxCoeff();
  // Below the eigenvalue for any path through the body, for fast convergence.
  const double shift = 1e-4 * std::pow(std::numbers::pi / size, 2);
  const SparseMatrix shifted =
      L + shift * SparseMatrix(M.triangularView<Eigen::Lower>());
  const SparseCholesky factor(shifted, order_nodes(M), "diffusion in the mesh");
  const VectorX ones = VectorX::Ones(M.cols());
  const VectorX masses = M * ones;
  const auto normalise = [&](VectorX& f) {
    f.array() -= masses.dot(f) / masses.sum();
    f /= std::sqrt(f.dot(M * f));
  };
  VectorX f = project_on_longest_axis(mesh, M);
  normalise(f);
  for (int i = 0; i < kMostIterations; ++i) {
    VectorX next = factor.solve(M * f);
    normalise(next);
    const double change = std::min((next - f).norm(), (next + f).norm());
    const bool is_settled = change <= kSettled * next.norm();
    f = next;
    if (is_settled) break;
  }
  const double mu = f.dot(L.selfadjointView<Eigen::Lower>() * f);
  return {f, std::numbers::pi / std::sqrt(mu)};
}

struct OrderedElement {
  std::size_t number = 0;  ///< block by block
  double f = 0.0;          ///< mean of its corners [-]
  double volume = 0.0;     ///< [m^3]
};

double calc_volume(const Mesh& mesh, const ElementBlock& block, std::size_t e) {
  const Matrix3X x = element_positions(mesh, block, e);
  const Quadrature& rule = block.element->curved;
  double volume = 0.0;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Matrix3 jacobian =
        x * rule.gradients[static_cast<std::size_t>(q)].transpose();
    volume += rule.weights[q] * jacobian.determinant();
  }
  return volume;
}

std::vector<OrderedElement> order_elements(const Mesh& mesh, const VectorX& f) {
  std::vector<OrderedElement> elements;
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      double sum = 0.0;
      for (int i = 0; i < block.element->corner_count; ++i) {
        sum += f[block.element_nodes(e)[i]];
      }
      elements.push_back({elements.size(), sum / block.element->corner_count,
                          calc_volume(mesh, block, e)});
    }
  }
  std::stable_sort(elements.begin(), elements.end(),
                   [](const OrderedElement& a, const OrderedElement& b) {
                     return a.f < b.f;
                   });
  return elements;
}

/// Number of ordered elements before the cut near the volume `target`: the
/// nearest step of f of at least half the largest within `window`, since those
/// are between layers.
std::size_t place_cut(const std::vector<OrderedElement>& elements,
                      double target, double window) {
  constexpr double kBetweenLayers = 0.5;
  struct Candidate {
    std::size_t count;
    double off;
    double step;
  };
  std::vector<Candidate> candidates;
  double largest = 0.0;
  double before = 0.0;
  for (std::size_t i = 1; i < elements.size(); ++i) {
    before += elements[i - 1].volume;
    const double off = std::abs(before - target) / window;
    if (off >= 1.0) continue;
    const double step = elements[i].f - elements[i - 1].f;
    candidates.push_back({i, off, step});
    largest = std::max(largest, step);
  }
  std::size_t best = 0;
  double least = 1.0;
  for (const Candidate& one : candidates) {
    if (one.step < kBetweenLayers * largest || one.off >= least) continue;
    least = one.off;
    best = one.count;
  }
  return best;
}

ElementLabels label_elements(const Mesh& mesh, const VectorX& f, int count) {
  constexpr double kWindow = 0.5;  // of a piece's volume: any layer of it
  const std::vector<OrderedElement> elements = order_elements(mesh, f);
  double volume = 0.0;
  for (const OrderedElement& element : elements) volume += element.volume;
  ElementLabels labels(elements.size(), 0);
  for (int cut = 1; cut < count; ++cut) {
    const std::size_t from =
        place_cut(elements, volume * cut / count, kWindow * volume / count);
    if (from == 0) {
      throw InputError(
          fmt::format("{}: its {} elements do not give {} pieces along its "
                      "length: a layer of elements is longer than half a "
                      "piece. Request fewer pieces or a finer mesh.",
                      mesh.source, elements.size(), count));
    }
    for (std::size_t i = from; i < elements.size(); ++i) {
      labels[elements[i].number] = cut;
    }
  }
  return labels;
}

/// Elements joined by faces within their piece: a number for each such part.
class Parts {
 public:
  Parts(const ElementLabels& labels,
        const std::vector<std::pair<std::size_t, std::size_t>>& neighbours)
      : parent_(labels.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (const auto& [a, b] : neighbours) {
      if (labels[a] == labels[b]) parent_[root(a)] = root(b);
    }
  }
  std::size_t root(std::size_t element) {
    while (parent_[element] != element) {
      element = parent_[element] = parent_[parent_[element]];
    }
    return element;
  }

 private:
  std::vector<std::size_t> parent_;
};

std::vector<std::pair<std::size_t, std::size_t>> find_node_pairs(
    const Mesh& mesh) {
  std::vector<std::size_t> first;
  std::size_t count = 0;
  for (const ElementBlock& block : mesh.blocks) {
    first.push_back(count);
    count += block.size();
  }
  std::vector<std::pair<std::size_t, std::size_t>> neighbours;
  for (const SharedFace& face : find_shared_faces(mesh)) {
    neighbours.emplace_back(first[index(face[0].block)] + face[0].element,
                            first[index(face[1].block)] + face[1].element);
  }
  return neighbours;
}

/// Gives elements that share no face with their piece to the adjacent piece;
/// unstructured meshes have some at every cut.
/// @throws InputError if they are more than a small fraction
void absorb_islands(const Mesh& mesh, int count, ElementLabels& labels) {
  constexpr double kSmall = 0.1;  // of a piece's elements
  constexpr int kMostRounds = 10;
  const auto neighbours = find_node_pairs(mesh);
  const std::size_t total = labels.size();
  for (int round = 0; round < kMostRounds; ++round) {
    Parts parts(labels, neighbours);
    std::map<std::size_t, std::size_t> sizes;
    for (std::size_t e = 0; e < total; ++e) ++sizes[parts.root(e)];
    std::vector<std::size_t> largest(index(count), total);
    for (const auto& [root, size] : sizes) {
      std::size_t& known = largest[index(labels[root])];
      if (known == total || size > sizes.at(known)) known = root;
    }
    bool is_whole = true;
    for (const auto& [root, size] : sizes) {
      const int label = labels[root];
      const std::size_t main = largest[index(label)];
      if (root == main) continue;
      is_whole = false;
      if (static_cast<double>(size) >
          kSmall * static_cast<double>(sizes.at(main))) {
        throw InputError(fmt::format(
            "{}: piece {} of {} along its length would be in two parts, of {} "
            "and {} elements: it has branches or a hole there. Choose another "
            "number of pieces, or leave it whole.",
            mesh.source, label + 1, count, sizes.at(main), size));
      }
    }
    if (is_whole) return;
    const ElementLabels before = labels;
    for (const auto& [a, b] : neighbours) {
      if (before[a] == before[b]) continue;
      for (const auto& [island, other] : {std::pair(a, b), std::pair(b, a)}) {
        const std::size_t root = parts.root(island);
        if (root != largest[index(before[island])]) {
          labels[island] = before[other];
        }
      }
    }
  }
  throw InputError(
      fmt::format("{}: no cut into {} connected pieces was found. Leave it "
                  "whole, or use a finer mesh.",
                  mesh.source, count));
}

CutMesh cut_along(const Mesh& mesh, const LengthField& field, int count) {
  ElementLabels labels = label_elements(mesh, field.f, count);
  absorb_islands(mesh, count, labels);
  return separate(mesh, labels);
}

/// The largest distance of two nodes of a cut, to a factor of two at most.
double find_thickness(const Mesh& mesh, const MeshCut& cut) {
  const std::vector<int>& nodes = cut.selection.nodes;
  double largest = 0.0;
  for (const int a : nodes) {
    for (const int b : {nodes.front(), nodes.back()}) {
      largest = std::max(largest, (mesh.x.col(a) - mesh.x.col(b)).norm());
    }
  }
  return largest;
}

}  // namespace

CutMesh cut_mesh(const Mesh& mesh, int count) {
  LIMBER_EXPECT(count >= 1);
  return cut_along(mesh, find_length_field(mesh), count);
}

PieceAdvice advise_pieces(const Mesh& mesh) {
  constexpr int kPieces = 2;
  const LengthField field = find_length_field(mesh);
  try {
    const CutMesh cut = cut_along(mesh, field, kPieces);
    double thickness = 0.0;
    for (const MeshCut& one : cut.cuts) {
      thickness = std::max(thickness, find_thickness(mesh, one));
    }
    const double slenderness = field.length / thickness;
    if (slenderness >= kPieces * kLeastSlenderness) return {kPieces, ""};
    return {1,
            fmt::format("it is {:.3g} times as long as thick, and pieces gain "
                        "nothing below {:.3g} times",
                        slenderness, kPieces * kLeastSlenderness)};
  } catch (const InputError& error) {
    return {1, error.problems().front()};
  }
}

}  // namespace limber::fem
