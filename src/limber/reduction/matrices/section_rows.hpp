// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/flexbody/model/stress_modes.hpp"
#include "limber/reduction/matrices/matrix_body.hpp"

/// Part of limber_reduction.
namespace limber::flexbody {

/// Stress modes of beams, shells and solids beside them, without an estimate of
/// averaging.
/// @param kept nodes whose rows are stored, sorted
/// @param Phi modes on the system's rows [kg^-1/2]
[[nodiscard]] StressModes make_section_stress(const MatrixBody& meshed,
                                              const std::vector<int>& kept,
                                              const MatrixX& Phi);

}  // namespace limber::flexbody
