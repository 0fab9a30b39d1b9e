// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/flexbody/model/recipe.hpp"

namespace limber::flexbody {

/// Result of automatic selection for one load case.
struct SelectedCase {
  std::string name;
  std::vector<int> modes;  ///< indices of those this case needs, ascending
  double reached = 1.0;    ///< fraction of all selected eigenmodes [-]
  /// Relative error of the static response in the norm of elastic energy, with
  /// the selected eigenmodes alone and with the whole basis.
  double eigenmode_error = 0.0;  ///< [-]
  double basis_error = 0.0;      ///< [-]

  bool operator==(const SelectedCase&) const = default;
};

/// How a body's eigenmodes were selected, stored with the body.
struct SelectionRecord {
  ModeMeasure measure = ModeMeasure::compliance;
  double threshold = 0.9;  ///< [-]
  int candidates = 0;      ///< number of eigenmodes to select from
  std::vector<int> modes;  ///< indices of the selected, ascending
  std::vector<SelectedCase> cases;

  bool operator==(const SelectionRecord&) const = default;
};

/// Texts on the load cases for which all candidates miss the threshold, the
/// worst first, at most five.
[[nodiscard]] std::vector<std::string> describe_shortfalls(
    const SelectionRecord& record);

/// The lowest fraction and the largest errors of any case, in one line.
[[nodiscard]] std::string summarize(const SelectionRecord& record);

}  // namespace limber::flexbody
