// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/analysis/small_motion.hpp"

namespace limber::dynamics {

/// Highest natural frequency of each coupler, then of each transmission, with
/// the bodies that it joins free of everything else [Hz].
///
/// Equation   (2 pi f)^2 is the largest eigenvalue of K G M^-1 G', G its six
///            rows of the motion and K its stiffness: sqrt(k / m) of a mass m
///            on a spring k
/// Limits     modes count by their inertia alone
[[nodiscard]] VectorX find_coupler_frequencies(const SmallMotion& motion,
                                               Eigen::Index count);

}  // namespace limber::dynamics
