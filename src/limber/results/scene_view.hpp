// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"

/// Content and view of a picture of a motion.
namespace limber::results {

/// An output, and the largest deformation of a node there.
struct DeformationPeak {
  std::size_t output = 0;
  double deformation = 0.0;  ///< |Phi eta| [m]
};

/// The output with the largest deformation of a stored node. Of many outputs it
/// is searched among the 64 with the most elastic energy and 64 others, evenly
/// spaced. @param history with at least one state
[[nodiscard]] DeformationPeak find_largest_deformation(
    const dynamics::SystemModel& model, const History& history);

/// The factor by which a deformation is magnified: 1 if it is visible, from 2 %
/// of the size on, else 1, 2 or 5 times a power of ten such that it appears at
/// 2.5 to 6 % of the size. 1 for round-off, below 1e-9 of the size.
/// @param deformation, size of the picture [m]
[[nodiscard]] double find_magnification(double deformation, double size);

/// From where a scene is seen [degrees].
struct ViewAngles {
  double rot_x = 60.0;  ///< of the eye from the vertical
  double rot_z = 30.0;  ///< of what is right for it, from x towards y
};

/// The unit vector from the scene to the eye at these angles.
///
/// Equation   (sin x sin z, -sin x cos z, cos x)
[[nodiscard]] Vector3 find_eye(const ViewAngles& view);

/// From the side of a motion: nearly along the direction in which points move
/// and extend least; from above rather than from below, and never along an axis
/// of the picture, so that depth can be seen.
/// @param shots positions of the same points at several times [m]
[[nodiscard]] ViewAngles find_view(const std::vector<Matrix3X>& shots);

}  // namespace limber::results
