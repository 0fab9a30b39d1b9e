// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "fem/eigenmodes.hpp"
#include "flexbody/mode_selection.hpp"
#include "flexbody/reduce_load_cases.hpp"
#include "flexbody/reduced_basis.hpp"
#include "flexbody/selection_record.hpp"

/// Which eigenmodes enter a basis. Part of limber_reduction.
namespace limber::flexbody {

/// Degrees of freedom up to which all modes of a mesh are found, as the
/// report's measure wants them: the time grows with their third power, from
/// 5 s at 1626.
inline constexpr Eigen::Index kMostDofsForAllModes = 4000;

[[nodiscard]] bool can_find_all_modes(const MeshedBody& body);

/// Sums of the report's effective mass over all modes of the mesh, k.
/// For bodies of which all modes can be found.
[[nodiscard]] VectorX find_report_totals(const LoadCases& cases,
                                         const MeshedBody& body,
                                         const Progress& progress);

/// Participation in translations of a clamped body's base, with the mass of
/// its free nodes, on which all modes together are complete. The rotations'
/// rows are zero.
[[nodiscard]] Participation calc_base_participation(
    const MeshedBody& body, const fem::Eigenmodes& modes);

/// What every mode carries of every load case.
struct CaseShares {
  MatrixX shares;  ///< m x k
  VectorX totals;  ///< k, of all modes of the mesh
};

/// The report's measure needs a body of which all modes can be found.
[[nodiscard]] CaseShares find_shares(ModeMeasure measure,
                                     const fem::Eigenmodes& modes,
                                     const LoadCases& cases,
                                     const MeshedBody& body,
                                     const Progress& progress);

struct ChosenModes {
  fem::Eigenmodes eigenmodes;
  LoadCases cases;
  std::optional<SelectionRecord> record;  ///< none without automatic modes
};

/// As many eigenmodes as the recipe says, or those that its load cases need.
/// @throws InputError
[[nodiscard]] ChosenModes choose_eigenmodes(const MeshedBody& body,
                                            const Recipe& recipe,
                                            const Progress& progress);

/// The record with `basis_error` of every case, for a basis on the free nodes.
[[nodiscard]] std::optional<SelectionRecord> finish_record(
    const ChosenModes& chosen, const ReducedBasis& basis);

}  // namespace limber::flexbody
