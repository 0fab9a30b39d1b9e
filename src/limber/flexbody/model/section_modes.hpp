// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// Additional data of stress modes of beams and shells: where in the section
/// each point is, and section forces. Empty for solids.
struct SectionModes {
  std::vector<std::size_t> nodes;  ///< p: row of the node of each point
  std::vector<int> faces;          ///< p: SectionFace
  std::vector<int> plies;          ///< p: as name_section_place
  /// 6 x p: Xt, Xc, Yt, Yc, S [Pa], F12 [Pa^-2]; zeros: not known.
  MatrixX strengths;
  std::size_t left_out = 0;    ///< number of points whose node is not kept
  std::size_t bare_beams = 0;  ///< number of beams without points
  std::vector<std::size_t> elements;  ///< e: number of the beam of each end
  std::vector<std::size_t> ends;      ///< e: row of the node of each end
  /// 6 e x m: N, Vy, Vz [kg^1/2 s^-2], T, My, Mz [kg^1/2 m s^-2] in the
  /// section's axes.
  MatrixX Force;

  [[nodiscard]] bool exist() const { return !nodes.empty() || !ends.empty(); }
};

/// Failure index of a stress by Tsai and Wu [-]: failure from 1 on.
///
/// Equation   F1 s11 + F2 s22 + F11 s11^2 + F22 s22^2 + F66 s12^2 + 2 F12 s11
///            s22, F1 = 1/Xt - 1/Xc, F11 = 1/(Xt Xc), F2, F22 the same of Y,
///            F66 = 1/S^2
/// Source     Tsai, Wu, A General Theory of Strength for Anisotropic Materials,
///            J. Compos. Mater. 5 (1971) 58-80
/// @param stress xx, yy, zz, xy, yz, xz in the ply's axes
/// @param strengths as SectionModes::strengths
[[nodiscard]] double calc_tsai_wu(const Vector6& stress,
                                  const Vector6& strengths);

/// Largest of |s11| / X, |s22| / Y, |s12| / S, X and Y of the sign of the
/// stress [-].
[[nodiscard]] double calc_maximum_stress(const Vector6& stress,
                                         const Vector6& strengths);

}  // namespace limber::flexbody
