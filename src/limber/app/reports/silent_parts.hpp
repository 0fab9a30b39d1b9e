// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/reports/start_touches.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// A message for each probe whose values are known before the run, load without
/// effect, and contact that can never occur; and one for all bodies with a
/// <collision> or radius that no contact names.
///
/// Equation   a link of a tree stays within a ball about the joint that carries
///            its branch: the sum of the distances between joints, of the
///            travel of sliders, and of the link's extent. No contact is
///            possible if the distance at the start exceeds what both links can
///            travel within their balls, by more than a twentieth of these.
/// Limits     joints count as unlimited in rotation; free bodies, sliders
///            without stops and couplers that pull joints apart are not bounded
[[nodiscard]] std::vector<std::string> find_silent_parts(
    const scene::Scene& scene, const scene::BuiltScene& built,
    const std::vector<StartTouch>& touches);

}  // namespace limber::app
