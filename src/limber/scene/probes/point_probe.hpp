// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/scene/probes/probe_column.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// A probe of a point (and frame) of a body.
///
/// Equation   p = p_WB + R_WB b, b = p_B + Phi_B eta;
///            v = v_WB + R_WB (w_WB x b + Phi_B etadot);
///            R = R_WB exp(Psi_B eta); for an unreduced body, those of its
///            NodalFrame; at level nonlinear, to second order in eta. Relative
///            to a base, p = R_b^T (p_W - p_b), v its rate, R = R_b^T R_W, w =
///            R_b^T (w_W - w_b).
struct PointProbe {
  Quantity quantity = Quantity::displacement;
  dynamics::BodyIndex body;
  Vector3 p_B = Vector3::Zero();  ///< undeformed [m]
  Matrix3X Phi_B;  ///< 3 x m, no columns at level rigid [kg^-1/2]
  Matrix3X Psi_B;  ///< 3 x m [kg^-1/2 m^-1]
  std::shared_ptr<const dynamics::NodalFrame> nodal;  ///< of an unreduced body
  Matrix3 R_BL = Matrix3::Identity();                 ///< axes of the link [-]
  Vector3 p_start_W = Vector3::Zero();                ///< [m]
  Matrix3 R_start = Matrix3::Identity();  ///< of the deformed frame [-]
  /// Of an interface or node at level nonlinear.
  std::shared_ptr<const flexbody::QuadraticFrame> second;
  std::shared_ptr<const PointProbe> base;  ///< null: the world
};

/// Name and unit of its three columns: "NAME.ux" [m], ...
[[nodiscard]] std::vector<ProbeColumnName> column_names(
    const PointProbe& probe, const std::string& name);

/// The three values in `state`, in the order of the columns.
[[nodiscard]] Vector3 evaluate(const PointProbe& probe,
                               const dynamics::SystemModel& model,
                               const dynamics::SystemState& state);

/// Sets the start, relative to which displacement and rotation are measured.
void set_start(PointProbe& probe, const dynamics::SystemModel& model,
               const dynamics::SystemState& state);

}  // namespace limber::scene
