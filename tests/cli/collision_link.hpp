// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limber::test {

/// A robot of one rigid link with a collision geometry and its material.
/// @param inertia about each axis
inline std::string make_link(const std::string& name, const std::string& mass,
                             const std::string& inertia,
                             const std::string& geometry,
                             const std::string& modulus) {
  return "<robot name='r'><link name='" + name + "'><inertial><mass value='" +
         mass + "'/><inertia ixx='" + inertia + "' iyy='" + inertia +
         "' izz='" + inertia +
         "' ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry>" +
         geometry + "</geometry></collision></link><contact link='" + name +
         "' youngs_modulus='" + modulus + "' poisson_ratio='0.3'/></robot>";
}

}  // namespace limber::test
