// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/fem/solid/eigenmodes.hpp"
#include "limber/flexbody/modal/mode_selection.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/selection_record.hpp"
#include "limber/reduction/modal/load_cases.hpp"

/// Which eigenmodes enter a basis. Part of limber_reduction.
namespace limber::flexbody {

/// Degrees of freedom up to which all modes of a mesh are found, as the
/// report's measure requires: the time is cubic in them, 5 s at 1626.
inline constexpr Eigen::Index kMostDofsForAllModes = 4000;

/// @throws InputError for a negative number of modes.
void check_basis(const Recipe& recipe);

[[nodiscard]] bool can_find_all_modes(const ElasticBody& body);

/// Sums of the report's effective mass over all modes of the mesh, k.
/// For bodies of which all modes can be found.
[[nodiscard]] VectorX find_report_totals(const LoadCases& cases,
                                         const ElasticBody& body,
                                         const Progress& progress);

/// Participation in translations of a clamped body's base, with the mass of its
/// free nodes, on which the set of all modes is complete. The rows of rotation
/// are zero.
[[nodiscard]] Participation calc_base_participation(
    const ElasticBody& body, const fem::Eigenmodes& modes);

/// Contribution of every mode to every load case, in the unit of the measure:
/// compliance [J], report [kg^1/2 N s^2], mass [kg].
struct CaseContributions {
  MatrixX by_mode;  ///< m x k [as the measure]
  VectorX totals;   ///< k, of all modes of the mesh [as the measure]
};

/// The report's measure needs a body for which all modes can be found.
[[nodiscard]] CaseContributions find_contributions(ModeMeasure measure,
                                                   const fem::Eigenmodes& modes,
                                                   const LoadCases& cases,
                                                   const ElasticBody& body,
                                                   const Progress& progress);

struct ChosenModes {
  fem::Eigenmodes eigenmodes;
  LoadCases cases;
  std::optional<SelectionRecord> record;  ///< none without automatic modes
};

/// The recipe's number of eigenmodes, or those that its load cases need.
/// @throws InputError
[[nodiscard]] ChosenModes choose_eigenmodes(const ElasticBody& body,
                                            const Recipe& recipe,
                                            const Progress& progress);

/// The record with `basis_error` of every case, for a basis on the free nodes.
[[nodiscard]] std::optional<SelectionRecord> finish_record(
    const ChosenModes& chosen, const ReducedBasis& basis);

}  // namespace limber::flexbody
