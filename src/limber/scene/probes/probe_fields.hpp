// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/model_fields.hpp"
#include "limber/scene/probes/probe.hpp"

/// Field lists of probes (common/records/fields.hpp).
namespace limber::scene {

constexpr auto fields_of(const PointProbe*) {
  return list_fields("point", "quantity", "body", "place [m]", "Phi_B", "Psi_B",
                     "nodal", "axes of the link", "start [m]", "start's axes",
                     "second order", "relative to");
}

constexpr auto fields_of(const CouplerProbeSpec*) {
  return list_fields("what", "coupler", "quantity", "side", "axes");
}

constexpr auto fields_of(const CouplerProbe*) {
  return list_fields("coupler", "what", "coupler index", "transmission index",
                     "coordinates");
}

constexpr auto fields_of(const ContactProbeSpec*) {
  return list_fields("what", "bodies", "quantity");
}

constexpr auto fields_of(const ContactProbe::Part*) {
  return list_fields("part", "pair index", nullptr);
}

constexpr auto fields_of(const ContactProbe*) {
  return list_fields("contact", "what", "turned", "parts");
}

constexpr auto fields_of(const ControllerProbe*) {
  return list_fields("controller", "input index");
}

constexpr auto fields_of(const StressProbe*) {
  return list_fields("stress", "quantity", "body", "of the whole link", "nodes",
                     "layers", "places [m]", "Sigma_L [kg^1/2 m^-2 s^-2]",
                     "strengths [Pa]", "axes of layers", nullptr, "eigenmodes",
                     nullptr, "axes of the link", nullptr);
}

constexpr auto fields_of(const Probe*) {
  return list_fields("probe", "name", "of");
}

}  // namespace limber::scene
