// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/interface_rotation.hpp"
#include "limber/joints/coordinates/required_rotations.hpp"
#include "limber/scene/build/attachment_sites.hpp"

/// Uses of a rotation that an interface does not define are rejected.
namespace limber::scene {

using dynamics::check_rotation;
using joints::RequiredRotations;
using joints::RequiredSides;

/// For a site with nodes; the error names its link.
/// @param required_F expressed in the site's frame
void check_rotation(const AttachmentSite& site,
                    const RequiredRotations& required_F);

}  // namespace limber::scene
