// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"
#include "scene/probe_column.hpp"
#include "scene/scenario.hpp"

namespace limber::scene {

/// A point (and frame) of a body that is followed in time.
///
/// Equation   p = p_WB + R_WB b, b = p_B + Phi_B eta;
///            v = v_WB + R_WB (w_WB x b + Phi_B etadot);
///            R = R_WB exp(Psi_B eta); of an unreduced body, those of its
///            NodalFrame.
struct PointProbe {
  Quantity quantity = Quantity::displacement;
  dynamics::BodyIndex body = 0;
  Vector3 p_B = Vector3::Zero();  ///< undeformed [m]
  Matrix3X Phi_B;                 ///< 3 x m, no columns at level rigid
  Matrix3X Psi_B;                 ///< 3 x m
  std::shared_ptr<const dynamics::NodalFrame> nodal;  ///< of an unreduced body
  Matrix3 R_BL = Matrix3::Identity();                 ///< axes of the link
  Vector3 p_start_W = Vector3::Zero();                ///< [m]
  Matrix3 R_start = Matrix3::Identity();              ///< of the deformed frame
};

/// Name and unit of its three columns: "NAME.ux" [m], ...
[[nodiscard]] std::vector<ProbeColumnName> column_names(
    const PointProbe& probe, const std::string& name);

/// The three values in `state`, in the order of the columns.
[[nodiscard]] Vector3 evaluate(const PointProbe& probe,
                               const dynamics::SystemModel& model,
                               const dynamics::SystemState& state);

/// Takes `state` as the start, from which displacement and rotation count.
void set_start(PointProbe& probe, const dynamics::SystemModel& model,
               const dynamics::SystemState& state);

}  // namespace limber::scene
