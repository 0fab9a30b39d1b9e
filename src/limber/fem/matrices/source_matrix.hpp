// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "limber/fem/matrices/matrix_model.hpp"

namespace limber::fem {

/// The degree of freedom of a row, in the file's own numbers.
struct RowLabel {
  long node = 0;
  /// 1 to 3: translations, 4 to 6: rotations; all others (0 of a scalar point,
  /// 7 of warping): not known.
  int component = 0;

  bool operator==(const RowLabel&) const = default;
  bool operator<(const RowLabel& other) const {
    return std::pair(node, component) < std::pair(other.node, other.component);
  }
};

/// "10.1" for node 10, translation along x.
[[nodiscard]] std::string name_row(const RowLabel& label);

enum class MatrixRole {
  unknown,
  stiffness,
  mass,
  recovery,  ///< displacements of points from the rows; need not be square
  moment,    ///< a second moment of the mass, second_moments.hpp
  other
};

/// "KAAX", "job_STIF1", "stiffness": by the words that programs use.
[[nodiscard]] MatrixRole guess_role(const std::string& name);

/// A matrix of a file before it is known what its rows are.
struct SourceMatrix {
  ModelMatrix matrix;
  std::string format;  ///< of the file, for messages
  std::string name;    ///< of the matrix in its file; may be empty
  MatrixRole role = MatrixRole::unknown;
  std::string triangles;  ///< what was given: "lower triangle, mirrored"
  /// Of each row; none if the file only numbers them.
  std::vector<RowLabel> labels;
};

/// "K.mtx KAAX (DMIG, 18 rows)", for messages.
[[nodiscard]] std::string describe_matrix(const SourceMatrix& source);

/// Index in MatrixModel::moments of a file called S_xx.mtx and so on; -1 for
/// any other name.
[[nodiscard]] int find_second_moment(const std::filesystem::path& file);

/// Labels of rows, in the order of the matrices.
struct RowTable {
  std::filesystem::path file;
  std::string format;
  std::vector<RowLabel> labels;
};

}  // namespace limber::fem
