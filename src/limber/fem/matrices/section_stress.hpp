// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "limber/common/material/section_place.hpp"
#include "limber/common/types.hpp"

namespace limber::fem {

/// Where the stress of a shell, a beam or a solid beside them is taken.
struct StressPoint {
  int node = -1;     ///< index into MatrixModel::tags
  int drawn = -1;    ///< the node that is drawn there; of inner points `node`
  int property = 0;  ///< index into SectionStress::constants
  SectionFace face = SectionFace::middle;
  int ply = 0;  ///< as name_section_place
  /// Of a shell along the fibre, across it, normal; of a beam x, y, z; of a
  /// solid those of the model.
  Matrix3 axes = Matrix3::Identity();
  /// Xt, Xc, Yt, Yc, S [force/length^2], F12; zeros: not known.
  Vector6 strengths = Vector6::Zero();
  bool on_surface = true;  ///< of a solid false inside of it
};

/// An end of a beam.
struct SectionEnd {
  int node = -1;            ///< index into MatrixModel::tags
  std::size_t element = 0;  ///< number in the deck
};

/// Stress and section forces of beams and shells, and stress of solids beside
/// them, in m motions.
struct SectionStress {
  std::vector<StressPoint> points;
  /// 6 points x m: xx, yy, zz, xy, yz, xz, axes of the model [force/length^2]
  MatrixX stress;
  std::size_t bare_beams = 0;  ///< number without points
  std::vector<SectionEnd> ends;
  /// 6 ends x m: N, Vy, Vz [force], T, My, Mz [force length], section's axes
  MatrixX forces;
  /// 2 x properties: Young's modulus, of a shell its mean along axis 1, and
  /// Poisson's ratio.
  MatrixX constants;
};

/// By motions of a model's rows, rows x m.
using RecoverSections = std::function<SectionStress(const MatrixX& motions)>;

}  // namespace limber::fem
