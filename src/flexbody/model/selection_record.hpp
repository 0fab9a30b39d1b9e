// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "flexbody/recipe.hpp"

namespace limber::flexbody {

/// What automatic selection found for one load case.
struct SelectedCase {
  std::string name;
  std::vector<int> modes;  ///< that this case asks for, ascending, from 0
  double reached = 1.0;    ///< share that all kept eigenmodes have [-]
  /// Relative error of the static answer in the norm of elastic energy, by the
  /// kept eigenmodes alone and by the body's whole basis [-].
  double eigenmode_error = 0.0;
  double basis_error = 0.0;

  bool operator==(const SelectedCase&) const = default;
};

/// How a body's eigenmodes were chosen, kept with the body.
struct SelectionRecord {
  ModeMeasure measure = ModeMeasure::compliance;
  double threshold = 0.9;  ///< [-]
  int candidates = 0;      ///< eigenmodes there were to choose from
  std::vector<int> modes;  ///< kept, ascending, from 0
  std::vector<SelectedCase> cases;

  bool operator==(const SelectionRecord&) const = default;
};

/// Texts on the load cases that the candidates do not carry to the threshold,
/// the worst first, at most five; none if all do.
[[nodiscard]] std::vector<std::string> describe_shortfalls(
    const SelectionRecord& record);

/// The lowest share and the largest errors of any case, in one line.
[[nodiscard]] std::string summarize(const SelectionRecord& record);

}  // namespace limber::flexbody
