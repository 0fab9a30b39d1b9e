// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Everything of limber::limber that most programs need. Reducing a mesh is
/// apart, in "reduction/reduce.hpp" and limber::reduction, because it links
/// Gmsh and CHOLMOD.
#include "limber/dynamics/equations/joint_state.hpp"  // IWYU pragma: export
#include "limber/dynamics/equations/node_motion.hpp"  // IWYU pragma: export
#include "limber/dynamics/simulation/simulation.hpp"  // IWYU pragma: export
#include "limber/dynamics/simulation/simulator.hpp"   // IWYU pragma: export
#include "limber/dynamics/system/system_builder.hpp"  // IWYU pragma: export
#include "limber/flexbody/file/body_file.hpp"         // IWYU pragma: export
#include "limber/joints/joint_kind.hpp"               // IWYU pragma: export
#include "limber/version.hpp"                         // IWYU pragma: export
