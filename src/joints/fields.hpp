// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/fields.hpp"
#include "common/manifest.hpp"
#include "joints/coupler_law.hpp"
#include "joints/coupler_memory.hpp"

/// What couplers are made of, field by field (common/fields.hpp).
namespace limber::joints {

constexpr auto fields_of(const CouplerMemory*) {
  return list_fields("memory", "near [rad, m]", "switches", "latch", "X_FM");
}

constexpr auto fields_of(const Bushing::Parameters*) {
  return list_fields(
      "bushing", "translational stiffness [N/m]",
      "rotational stiffness [N m/rad]", "translational damping [N s/m]",
      "rotational damping [N m s/rad]", "coupling stiffness [N/rad]",
      "coupling damping [N s/rad]");
}

constexpr auto fields_of(const UniversalHold::Parameters*) {
  return list_fields(
      "universal joint", "axis of F", "axis of M",
      "translational stiffness [N/m]", "rotational stiffness [N m/rad]",
      "translational damping [N s/m]", "rotational damping [N m s/rad]");
}

constexpr auto fields_of(const PointSpring::Parameters*) {
  return list_fields("spring", "stiffness [N/m]", "damping [N s/m]",
                     "free length [m]", "quadratic [N/m^2]", "extensions [m]",
                     "forces [N]", "tension only");
}

constexpr auto fields_of(const Latch::Parameters*) {
  return list_fields("latch", "reach [m]", "bushing", "release force [N]",
                     "release time [s]");
}

constexpr auto fields_of(const SpringCurve::Parameters*) {
  return list_fields("curve", "stiffness [N/m, N m/rad]",
                     "quadratic [N/m^2, N m/rad^2]", "extensions [m, rad]",
                     "forces [N, N m]");
}

constexpr auto fields_of(const ScalarSpring::Parameters*) {
  return list_fields("spring", "", "damping [N s/m, N m s/rad]",
                     "rest [m, rad]", "tension only");
}

constexpr auto fields_of(const Friction::Parameters*) {
  return list_fields("friction", "coulomb [N, N m]",
                     "viscous [N s/m, N m s/rad]", "speed [m/s, rad/s]");
}

constexpr auto fields_of(const EndStop::Parameters*) {
  return list_fields("stop", "lower [m, rad]", "upper [m, rad]",
                     "stiffness [N/m, N m/rad]", "damping [s/m, s/rad]");
}

constexpr auto fields_of(const Drive::Parameters*) {
  return list_fields("drive", "mode", "signal", "stiffness [N/m, N m/rad]",
                     "damping [N s/m, N m s/rad]", "max effort [N, N m]",
                     "max speed [m/s, rad/s]", "pulls only");
}

constexpr auto fields_of(const ConstantSignal*) {
  return list_fields("constant", "value");
}

constexpr auto fields_of(const RampSignal*) {
  return list_fields("ramp", "from", "to", "start [s]", "duration [s]", "shape",
                     "rise");
}

constexpr auto fields_of(const TableSignal*) {
  return list_fields("table", "times [s]", "values");
}

constexpr auto fields_of(const SineSignal*) {
  return list_fields("sine", "mean", "amplitude", "frequency [Hz]",
                     "phase [rad]", "start [s]");
}

constexpr auto fields_of(const Impulse*) {
  return list_fields("shaper's impulse", "share", "delay [s]");
}

constexpr auto fields_of(const Signal*) {
  return list_fields("signal", "base", "shaper");
}

constexpr auto fields_of(const AxisCoordinate*) {
  return list_fields("coordinate", "kind", "axis");
}

constexpr auto fields_of(const JointElement*) {
  return list_fields("element", "coordinate", "law");
}

inline std::string_view kind_of(const Joint&) { return "joint"; }

inline void describe(Manifest& out, std::string_view name, const Joint& joint) {
  out.within(name, [&] {
    describe(out, "hold", joint.hold());
    describe(out, "coordinates", joint.coordinates());
    describe(out, "elements", joint.elements());
  });
}

}  // namespace limber::joints
