// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/matrices/section_stress.hpp"
#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// The degree of freedom of a row (and column) of the matrices.
struct MatrixRow {
  int node = -1;       ///< index into MatrixModel::tags; -1: no node (a scalar
                       ///< point, a generalized coordinate)
  int component = -1;  ///< 0 to 2: translation along x, y, z; 3 to 5: rotation
                       ///< about x, y, z; -1: not known
};

/// A matrix as a file gives it.
struct ModelMatrix {
  std::string file;                     ///< for messages
  Eigen::SparseMatrix<double> entries;  ///< rows x rows, both triangles
  int digits = 17;                      ///< significant decimal digits [-]
};

/// A named set of nodes.
struct MatrixNodeSet {
  std::string name;
  std::vector<int> nodes;  ///< sorted indices into MatrixModel::tags
};

/// Surface of a structure that may be in contact with others: solids that fill
/// its shells and beams, and its solid elements.
struct ModelSurface {
  Mesh mesh;  ///< blocks alone; its nodes are those of the model
  std::vector<SolidMaterial> materials;  ///< by region, in SI units
  /// By node: the one that it moves with, of those on faces of shells and
  /// outlines of beams; else itself.
  std::vector<int> bases;
  enum class Side : char { none, bottom, top };
  std::vector<Side> sides;  ///< by node, of shells
};

/// A finite-element model by its matrices, as its files give it: in their
/// units, with all positions, displacements and rotations in one common frame.
struct MatrixModel {
  std::string source;              ///< folder or files, for messages
  std::vector<std::string> found;  ///< what was found: a line for each file
  std::vector<std::size_t> tags;   ///< of nodes
  Matrix3X x;  ///< 3 x nodes, positions [length of the files]
  std::vector<MatrixRow> rows;
  ModelMatrix stiffness;
  ModelMatrix mass;
  /// Unknowns that were condensed (dependent nodes of rigid spiders): all =
  /// equations * rows. No rows if there are none.
  std::vector<MatrixRow> condensed;
  Eigen::SparseMatrix<double> equations;  ///< condensed x rows
  bool has_recovery = false;  ///< whether equations are of recovery rows
  /// Second moments of the mass, xx, yy, zz, xy, xz, yz, rows x rows each; all
  /// empty if they are not known (second_moments.hpp).
  std::array<Eigen::SparseMatrix<double>, 6> moments;
  std::vector<MatrixNodeSet> sets;
  /// For pictures only: edges and triangles of elements, as node indices.
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> triangles;
  /// The last nodes, on faces of shells and outlines of beams, that are there
  /// for pictures and contact only.
  std::size_t drawn = 0;
  ModelSurface mesh_surface;  ///< of structures; else empty
  bool is_structure = false;  ///< of beams, shells and solids of a deck
  /// Of beams and shells, by their motion; empty: not known.
  RecoverSections recover_sections;
  std::vector<std::string> notices;  ///< what is questionable
};

}  // namespace limber::fem
