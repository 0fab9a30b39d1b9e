// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/linalg/sparse_matrix.hpp"
#include "limber/fem/matrices/matrix_model.hpp"

/// A finite-element model by its matrices, in SI units. Part of
/// limber_reduction.
namespace limber::flexbody {

/// Row of component c (0 to 2 translations, 3 to 5 rotations) of node n in
/// fields of all nodes.
[[nodiscard]] constexpr Eigen::Index field_row(int node, int component) {
  return 6 * static_cast<Eigen::Index>(node) + component;
}

/// K, M and what their rows move. Rows are those of the files.
struct MatrixSystem {
  std::string source;          ///< for messages
  std::string stiffness_file;  ///< for messages
  std::string mass_file;       ///< for messages
  std::vector<std::size_t> tags;
  Matrix3X x;  ///< 3 x N [m]
  std::vector<fem::MatrixRow> rows;
  fem::SparseMatrix M;  ///< both triangles [kg, kg m, kg m^2]
  fem::SparseMatrix K;  ///< both triangles [N/m, N, N m]
  int digits = 17;      ///< of K in its file [-]
  /// 6 N x rows: displacements and rotations of all nodes from the rows, also
  /// of condensed nodes.
  fem::SparseMatrix lift;
  /// Second moments of M, xx, yy, zz, xy, xz, yz; empty if not known.
  std::array<fem::SparseMatrix, 6> moments;
  bool has_recovery = false;  ///< whether `lift` has recovery rows
  /// Per node: whether its translation, and each rotation, is in the model and
  /// is not a null row.
  std::vector<char> is_moving;
  std::vector<std::array<char, 3>> can_rotate;
  std::vector<int> held;  ///< rows with K_ii >= kHeld, sorted
  std::vector<int> null;  ///< rows without stiffness and mass, sorted
  std::vector<fem::MatrixNodeSet> sets;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> triangles;
  std::size_t drawn = 0;  ///< of the nodes, for pictures only (MatrixModel)
  fem::ModelSurface mesh_surface;  ///< of structures
  bool is_structure = false;       ///< of a deck's elements (MatrixModel)
  /// Of beams and shells [Pa, N, N m]; empty: not known.
  fem::RecoverSections recover_sections;
  std::vector<std::string> found;    ///< a line for each file
  std::vector<std::string> notices;  ///< what was changed or questionable

  [[nodiscard]] Eigen::Index row_count() const { return K.cols(); }
  /// Without those that are drawn only.
  [[nodiscard]] std::size_t node_count() const { return tags.size() - drawn; }
  [[nodiscard]] bool has_moments() const { return moments[0].rows() > 0; }
  /// Edges of the bounding box of the moving nodes [m].
  [[nodiscard]] Vector3 size() const;
  /// "node 12, z", "row 7".
  [[nodiscard]] std::string name_row(Eigen::Index row) const;
  /// "nodes 3, 7 and 8 (of 20)", at most four.
  [[nodiscard]] std::string name_nodes(const std::vector<int>& nodes) const;
};

/// Stiffness from which a row is held: Abaqus writes 1e36 for a support [N/m].
inline constexpr double kHeld = 1e30;

/// The model in SI, of consistent units: force in N, time in s, lengths in
/// `unit`, so that masses are in N s^2 per length.
///
/// Equation   u = D u_SI, D = 1/unit for translations and 1 for others;
///            K_SI = unit D K D, M_SI = unit D M D
/// @param unit metres per length of the files, > 0 [m]
/// @throws InputError for matrices that do not fit their rows, and for two rows
/// of one direction
[[nodiscard]] MatrixSystem make_matrix_system(fem::MatrixModel model,
                                              double unit);

}  // namespace limber::flexbody
