// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/model/fields.hpp"

/// Field lists of a system and its settings (common/records/fields.hpp).
namespace limber::dynamics {

constexpr auto fields_of(const Constant*) {
  return list_fields("constant", "from [s]", "until [s]");
}

constexpr auto fields_of(const StepSequence*) {
  return list_fields("steps", "times [s]", "values");
}

constexpr auto fields_of(const Pulse*) {
  return list_fields("pulse", "shape", "start [s]", "duration [s]");
}

constexpr auto fields_of(const Sinusoid*) {
  return list_fields("sinusoid", "frequency [Hz]", "phase [rad]", "from [s]",
                     "until [s]");
}

constexpr auto fields_of(const Harmonic*) {
  return list_fields("term", "omega [rad/s]", "cosine", "sine");
}

constexpr auto fields_of(const HarmonicSum*) {
  return list_fields("sum of sinusoids", "mean", "terms", "from [s]",
                     "until [s]");
}

constexpr auto fields_of(const Table*) {
  return list_fields("table", "times [s]", "values");
}

constexpr auto fields_of(const InputFunction*) {
  return list_fields("input", "index", "factor");
}

constexpr auto fields_of(const Input*) {
  return list_fields("input", "name", "initial", "between samples");
}

constexpr auto fields_of(const Measurement*) {
  return list_fields("measurement", "name", "of", nullptr);
}

/// Adds the law's own description.
inline void describe(Manifest& out, std::string_view name,
                     const Controller& law) {
  out.within(name, [&] { law.describe(out); });
}

constexpr auto fields_of(const ControllerModel*) {
  return list_fields("controller", "name", "period [s]", "offset [s]", "writes",
                     "measures", "memory", "law");
}

constexpr auto fields_of(const ModalInertia*) {
  return list_fields("inertia by mode", "modes", "columns");
}

constexpr auto fields_of(const BodyModel*) {
  return list_fields("body", "name", "level", "clamped", "mass [kg]",
                     "inertia [kg m^2]", "modes", "offset", "row", "elasticity",
                     "damping [1/s]", "Maxwell elements",
                     "first Maxwell element", "inertia by mode", "P [kg^1/2]",
                     "reduced", "full");
}

constexpr auto fields_of(const FullModel*) {
  return list_fields("unreduced body", "body", "first", "mesh", "damped modes",
                     "damping [1/s]", "needs frame");
}

constexpr auto fields_of(const NodalFrame*) {
  return list_fields("nodal frame", "nodes", "weights", "mean [m]", "arm [m]",
                     "turns", "turning nodes", "d_B [m]", "y_B [m]",
                     "lever [m]", "line [m^2]");
}

constexpr auto fields_of(const Attachment*) {
  return list_fields("attachment", "name", "body", "origin [m]", "axes",
                     "Phi_B", "Psi_B", "nodal", "second order");
}

constexpr auto fields_of(const Coupler*) {
  return list_fields("coupler", "name", "law", "frame F", "frame M");
}

constexpr auto fields_of(const PathCoordinate*) {
  return list_fields("path", "points");
}

constexpr auto fields_of(const JointSum::Term*) {
  return list_fields("term", "coupler", "coordinate", "factor");
}

constexpr auto fields_of(const JointSum*) {
  return list_fields("sum of joints", "terms", "offset");
}

constexpr auto fields_of(const Transmission*) {
  return list_fields("transmission", "name", "coordinate", "law");
}

constexpr auto fields_of(const Load*) {
  return list_fields("load", "name", "attachment", "force [N]", "moment [N m]",
                     "in world", "time");
}

constexpr auto fields_of(const BodyLoad*) {
  return list_fields("load", "name", "body", "history", "nodal forces [N]");
}

constexpr auto fields_of(const Pair*) {
  return list_fields("pair", "name", "body A", "body B", "law", "first memory");
}

constexpr auto fields_of(const SystemModel*) {
  return list_fields("system", "bodies", "attachments", "couplers",
                     "transmissions", "loads", "body loads", "gravity [m/s^2]",
                     "modal coordinates", "Maxwell elements",
                     "unreduced bodies", "nodal coordinates", "inputs",
                     "controllers", "pairs", "pair memories");
}

}  // namespace limber::dynamics
