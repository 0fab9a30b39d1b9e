// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Applies the choice of bases to the robot's flexible links. Precedence:
/// `over`, the scenario's choice for the link, its choice for all links, the
/// link's <basis>.
/// @throws InputError for a link from a saved body, whose basis is fixed.
void choose_bases(const Scenario& scenario, const BasisChoice& over,
                  Robot& robot);

}  // namespace limber::scene
