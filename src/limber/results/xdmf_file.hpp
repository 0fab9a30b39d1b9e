// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::results {

/// Nodes of a moving surface at one time, in axes of the world.
struct SurfaceFrame {
  Matrix3X points;        ///< 3 x n, from the surface's offset [m]
  Matrix3X deformation;   ///< 3 x n, R Phi eta [m]
  Matrix3X displacement;  ///< 3 x n, from the first output [m]
  /// 6 x n (xx, yy, zz, xy, yz, xz), NaN where there is none [Pa].
  Matrix6X stress;
};

/// Stress at nodes, 6 x n as above, from the axes of a body to the world's.
[[nodiscard]] Matrix6X rotate_to_world(const Matrix6X& stress_B,
                                       const Matrix3& R_WB);

/// A surface and its times.
struct MovingSurface {
  std::vector<std::int64_t> corners;  ///< three a triangle: nodes
  Eigen::Index nodes = 0;
  std::vector<double> times;         ///< [s]
  Vector3 offset = Vector3::Zero();  ///< of points, world [m]
  bool has_stress = false;
  std::function<SurfaceFrame(std::size_t output)> find_frame;
};

/// Writes a time series for ParaView: `file` (XDMF) and its data beside it (the
/// same name with .h5). Point fields: "deformation" (size [m]),
/// "deformation_vector" and "displacement" [m], and with stress "von_mises" and
/// the symmetric tensor "stress" [Pa]. The offset of points, zero except for
/// scenes far from the origin, is the data set "offset" and an Information.
/// @throws InputError if it cannot be written.
void write_xdmf_file(const std::filesystem::path& file,
                     const MovingSurface& surface);

}  // namespace limber::results
