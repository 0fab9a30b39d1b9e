// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/analysis/linear_system.hpp"
#include "limber/scene/probes/coupler_probe.hpp"

namespace limber::scene {

/// Derivatives of a coupler probe's columns, one row per column.
struct CouplerRows {
  MatrixX by_state;      ///< [column's unit / unit of the state]
  MatrixX by_input;      ///< [column's unit / unit of the input]
  std::string why_none;  ///< why there are none; else empty
};

/// @param turn_F rotation of the coupler's frame F in the world [rad / unit of
/// the state]
[[nodiscard]] CouplerRows find_coupler_rows(
    const CouplerProbe& probe, const dynamics::SystemModel& model,
    const dynamics::SystemState& state, const dynamics::LinearSystem& system,
    const Matrix3X& turn_F);

}  // namespace limber::scene
