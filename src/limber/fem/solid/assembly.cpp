// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/fem/linalg/parallel.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/element_matrices.hpp"
#include "limber/fem/solid/stiffness_product.hpp"

namespace limber::fem {
namespace {

Neighbours find_neighbours(const Mesh& mesh) {
  Neighbours neighbours(mesh.node_count());
  for (const ElementBlock& block : mesh.blocks) {
    const int count = block.element->node_count;
    for (std::size_t e = 0; e < block.size(); ++e) {
      const int* nodes = block.element_nodes(e);
      for (int a = 0; a < count; ++a) {
        auto& list = neighbours[static_cast<std::size_t>(nodes[a])];
        list.insert(list.end(), nodes, nodes + count);
      }
    }
  }
  for (std::vector<int>& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

/// Position of node i among the neighbours of j at or after j.
std::size_t lower_place(const std::vector<int>& list, int j, int i) {
  const auto diagonal = std::lower_bound(list.begin(), list.end(), j);
  return static_cast<std::size_t>(std::lower_bound(diagonal, list.end(), i) -
                                  diagonal);
}

std::size_t lower_count(const std::vector<int>& list, int j) {
  return static_cast<std::size_t>(
      list.end() - std::lower_bound(list.begin(), list.end(), j));
}

void check_size(const Mesh& mesh, const Neighbours& neighbours) {
  std::size_t entries = 0;
  for (std::size_t j = 0; j < neighbours.size(); ++j)
    entries += 9 * lower_count(neighbours[j], static_cast<int>(j));
  if (entries < std::numeric_limits<int>::max()) return;
  throw InputError(fmt::format(
      "{}: {} nodes give a stiffness matrix of {} entries; at most {} can be "
      "handled. Use a coarser mesh.",
      mesh.source, mesh.node_count(), entries,
      std::numeric_limits<int>::max()));
}

SparseMatrix zero_mass(const Neighbours& neighbours) {
  const auto size = static_cast<Eigen::Index>(neighbours.size());
  SparseMatrix M_s(size, size);
  std::vector<int> counts;
  for (const auto& list : neighbours)
    counts.push_back(static_cast<int>(list.size()));
  M_s.reserve(counts);
  for (Eigen::Index j = 0; j < size; ++j)
    for (const int i : neighbours[static_cast<std::size_t>(j)])
      M_s.insert(i, j) = 0.0;
  M_s.makeCompressed();
  return M_s;
}

/// Column 3j + c holds rows 3j + c .. 3j + 2, then all three of each later
/// neighbour.
SparseMatrix zero_stiffness(const Neighbours& neighbours) {
  const auto nodes = static_cast<int>(neighbours.size());
  SparseMatrix K(3 * nodes, 3 * nodes);
  std::vector<int> counts;
  for (int j = 0; j < nodes; ++j) {
    const auto later = static_cast<int>(
        lower_count(neighbours[static_cast<std::size_t>(j)], j));
    for (int c = 0; c < 3; ++c) counts.push_back(3 * later - c);
  }
  K.reserve(counts);
  for (int j = 0; j < nodes; ++j)
    for (int c = 0; c < 3; ++c)
      for (const int i : neighbours[static_cast<std::size_t>(j)])
        for (int r = 0; r < 3; ++r)
          if (3 * i + r >= 3 * j + c) K.insert(3 * i + r, 3 * j + c) = 0.0;
  K.makeCompressed();
  return K;
}

/// Contribution of one element; an empty matrix adds nothing.
struct ElementMatrices {
  MatrixX M;
  MatrixX K;
};
using ElementFunction =
    std::function<ElementMatrices(const ElementBlock&, std::size_t element)>;

/// Adds element e to the columns of the nodes in [begin, end).
void add_element(const int* nodes, int count, const ElementMatrices& element,
                 const Neighbours& neighbours, int begin, int end,
                 StructuralMatrices& sum) {
  double* mass = sum.M_s.valuePtr();
  double* stiffness = sum.K.valuePtr();
  for (int b = 0; b < count; ++b) {
    const int j = nodes[b];
    if (j < begin || j >= end) continue;
    const auto& list = neighbours[static_cast<std::size_t>(j)];
    for (int a = 0; a < count; ++a) {
      const int i = nodes[a];
      if (element.M.size() > 0) {
        const auto place =
            std::lower_bound(list.begin(), list.end(), i) - list.begin();
        mass[sum.M_s.outerIndexPtr()[j] + place] += element.M(a, b);
      }
      if (i < j) continue;
      const auto place = static_cast<int>(lower_place(list, j, i));
      for (int c = 0; c < 3; ++c)
        for (int r = i == j ? c : 0; r < 3; ++r)
          stiffness[sum.K.outerIndexPtr()[3 * j + c] + 3 * place + r - c] +=
              element.K(3 * a + r, 3 * b + c);
    }
  }
}

/// Adds all elements of a block. Every thread goes through the elements in one
/// order, so each entry is the same sum for any ranges.
void add_block(const ElementBlock& block, const ElementFunction& calc,
               const Neighbours& neighbours, const Progress& progress,
               StructuralMatrices& sum) {
  constexpr std::size_t kChunk = 2048;  // bounds the memory of pending elements
  std::vector<ElementMatrices> elements;
  for (std::size_t first = 0; first < block.size(); first += kChunk) {
    elements.resize(std::min(kChunk, block.size() - first));
    parallel_ranges(elements.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e)
        elements[e] = calc(block, first + e);
    });
    parallel_ranges(neighbours.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = 0; e < elements.size(); ++e)
        add_element(block.element_nodes(first + e), block.element->node_count,
                    elements[e], neighbours, static_cast<int>(begin),
                    static_cast<int>(end), sum);
    });
    report(progress, "assembling",
           static_cast<double>(first + elements.size()) /
               static_cast<double>(block.size()));
  }
}

}  // namespace

StructuralMatrices assemble(const Mesh& mesh,
                            const std::vector<ElasticMaterial>& materials,
                            const Progress& progress) {
  StructuralMatrices sum = assemble_elements(mesh, materials, progress);
  for (const auto& [node, mass] : mesh.masses)
    sum.M_s.coeffRef(node, node) += mass;
  return sum;
}

StructuralMatrices assemble_elements(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    const Progress& progress) {
  LIMBER_EXPECT(materials.size() == mesh.volume_groups.size());
  const Neighbours neighbours = find_neighbours(mesh);
  check_size(mesh, neighbours);
  StructuralMatrices sum{zero_mass(neighbours), zero_stiffness(neighbours)};
  const ElementFunction calc = [&](const ElementBlock& block, std::size_t e) {
    const Matrix3X x = element_positions(mesh, block, e);
    const ElasticMaterial& material =
        materials[static_cast<std::size_t>(block.regions[e])];
    return ElementMatrices{
        calc_element_mass(*block.element, x, material.density),
        calc_element_stiffness(*block.element, x, material)};
  };
  for (const ElementBlock& block : mesh.blocks)
    add_block(block, calc, neighbours, progress, sum);
  sum.product = std::make_shared<const StiffnessProduct>(mesh, materials);
  return sum;
}

StiffnessAssembly::StiffnessAssembly(const Mesh& mesh)
    : mesh_(mesh), neighbours_(find_neighbours(mesh)) {
  check_size(mesh, neighbours_);
}

StructuralMatrices StiffnessAssembly::make_zero() const {
  return {zero_mass(neighbours_), zero_stiffness(neighbours_)};
}

void StiffnessAssembly::assemble(const ElementStiffness& calc,
                                 SparseMatrix& K) const {
  StructuralMatrices sum;
  sum.K.swap(K);
  std::fill_n(sum.K.valuePtr(), sum.K.nonZeros(), 0.0);
  const ElementFunction both = [&](const ElementBlock& block, std::size_t e) {
    return ElementMatrices{MatrixX(), calc(block, e)};
  };
  for (const ElementBlock& block : mesh_.blocks)
    add_block(block, both, neighbours_, {}, sum);
  K.swap(sum.K);
}

}  // namespace limber::fem
