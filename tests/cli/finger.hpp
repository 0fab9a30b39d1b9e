// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// A flexible finger on a hinge with a motor, as one writes it first.
namespace limber::test {

inline constexpr const char* kFingerGeometry = R"(SetFactory("OpenCASCADE");
Box(1) = {0, -0.01, -0.003, 0.4, 0.02, 0.006};
Physical Volume("finger") = {1};
Physical Surface("hinge") = {1};
Physical Surface("tip") = {2};
)";

/// With an effort of 4 N m up to a speed of 10 rad/s.
inline constexpr const char* kFinger = R"(<robot name="claw">
  <link name="base"/>
  <link name="finger"/>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="finger"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1.5" upper="1.5" effort="4" velocity="10"/>
    <dynamics damping="0.01"/>
  </joint>
  <flexible link="finger">
    <mesh file="finger.geo"/>
    <material youngs_modulus="70e9" poisson_ratio="0.33" density="2700"/>
    <damping ratio="0.01"/>
    <interface name="hinge" group="hinge"/>
    <interface name="tip" group="tip"/>
  </flexible>
</robot>
)";

}  // namespace limber::test
