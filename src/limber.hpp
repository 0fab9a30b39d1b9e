// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Everything of limber::limber that most programs need. Reducing a mesh is
/// apart, in "flexbody/reduce.hpp" and limber::reduction, because it links
/// Gmsh and CHOLMOD.
#include "dynamics/node_motion.hpp"     // IWYU pragma: export
#include "dynamics/simulation.hpp"      // IWYU pragma: export
#include "dynamics/system_builder.hpp"  // IWYU pragma: export
#include "flexbody/body_file.hpp"       // IWYU pragma: export
#include "joints/joint_kind.hpp"        // IWYU pragma: export
