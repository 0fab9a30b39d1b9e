// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/model/full_stress.hpp"
#include "limber/scene/probes/probe_column.hpp"
#include "limber/scene/probes/stress_clusters.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// A probe of stress at a link's nodes, the largest if there are several.
///
/// Equation   sigma = Sigma_L eta, at level `nonlinear` Sigma_L [eta;
/// products],
///            the second Piola-Kirchhoff stress; at level `full` Cauchy's
///            stress in the axes of the link as it has moved; of several points
///            the one with the largest von Mises stress, or the largest
///            principal stress or failure index; of section forces of several
///            ends each component with the largest magnitude
/// Source     flexbody/model/stress_modes.hpp, full_stress.hpp
/// Limits     small strain except at level `full`. Not thread-safe: copy it for
///            each thread
struct StressProbe {
  /// For evaluations.
  struct Scratch {
    VectorX stress;       ///< 6p [Pa]
    Matrix6X whole;       ///< 6 x p, at level `full` [Pa]
    VectorX coordinates;  ///< columns of Sigma_L
    int place = -1;       ///< index of the point of the last value
  };
  StressQuantity quantity = StressQuantity::von_mises;
  dynamics::BodyIndex body;
  bool is_of_link = false;        ///< requested by [output], not by a probe
  std::vector<std::size_t> tags;  ///< p: Gmsh node tags of the points
  /// p, of beams and shells: "top", "ply 2 bottom", "beam 7"; else none.
  std::vector<std::string> layers;
  Matrix3X p_L;     ///< 3 x p: places, undeformed [m]
  MatrixX Sigma_L;  ///< 6p rows as StressModes::Sigma_B, axes of the
                    ///< link, columns of the body's coordinates
  /// 6 x p as SectionModes::strengths, of the failure indices; else none.
  MatrixX strengths;
  bool has_own_axes = false;  ///< components along axes 1, 2, 3 of each point
  StressClusters clusters;    ///< of the points, which are in its order
  /// Number of eigenmodes, which come first; the others are static
  /// deformations, which correct for omitted ones. -1: unknown (saved bodies).
  int eigenmodes = -1;
  /// At level `full` in place of the modes: stress at the points, and the axes
  /// of the link in the body's.
  std::shared_ptr<const flexbody::FullStress> full;
  Matrix3 R_BL = Matrix3::Identity();
  mutable Scratch scratch = {};

  /// Of a point; empty for solids.
  [[nodiscard]] std::string layer_of(std::size_t point) const {
    return layers.empty() ? std::string() : layers[point];
  }
};

/// Name and unit of its columns: "NAME.sxx" [Pa], ..., "NAME.von_mises" [Pa].
[[nodiscard]] std::vector<ProbeColumnName> column_names(
    const StressProbe& probe, const std::string& name);

/// Appends the value of each column in `state`, in the units of column_names(),
/// and stores the place in `probe.scratch`.
void append_values(const StressProbe& probe, const dynamics::SystemModel& model,
                   const dynamics::SystemState& state,
                   std::vector<double>& values);

}  // namespace limber::scene
