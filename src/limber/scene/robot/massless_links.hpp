// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

/// Whether the root link, with all that fixed joints merge with it, has no
/// mass, and something that has hangs on it. Other programs place such a robot
/// by its root link, which does not move.
[[nodiscard]] bool has_massless_root(const Robot& robot);

/// Makes joints fixed, at zero, that move nothing but links without mass, with
/// one warning: such a link has no motion of its own. Removes their gears.
/// @param used joints and links that must stay as they are
void fix_massless_ends(const std::set<std::string>& used, Robot& robot);

}  // namespace limber::scene
