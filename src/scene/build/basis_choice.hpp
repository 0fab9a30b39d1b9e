// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/robot.hpp"
#include "scene/scenario.hpp"

namespace limber::scene {

/// Puts the scenario's choice of bases, and `over` on top of it, into the
/// robot's flexible links: what `over` gives, else what the scenario says of
/// the link, else of every link, else the link's own <basis>.
/// @throws InputError for a link from a saved body, whose basis is made.
void choose_bases(const Scenario& scenario, const BasisChoice& over,
                  Robot& robot);

}  // namespace limber::scene
