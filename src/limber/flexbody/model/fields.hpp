// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"
#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/nodal_load.hpp"
#include "limber/flexbody/model/quadratic_frame.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Field lists of bodies (common/records/fields.hpp).
namespace limber::flexbody {

constexpr auto fields_of(const InertiaShapeIntegrals*) {
  return list_fields("integrals", "S0 [kg m^2]", "S1 [kg^1/2 m]", "S2",
                     "P [kg^1/2]");
}

constexpr auto fields_of(const NodeRows*) {
  return list_fields("rows", "tags", "x_B [m]", "Phi_B [kg^-1/2]");
}

constexpr auto fields_of(const NodeGroup*) {
  return list_fields("group", "name", "dimension", "tags", "weights");
}

constexpr auto fields_of(const InterfaceTable*) {
  return list_fields("interface", "name", "p_B [m]", "Phi_B", "Psi_B",
                     "rotation axes", "nodes", "flexibility [m/N, rad/(N m)]",
                     "Phi2_B [kg^-1 m^-1]", "Psi2_B [kg^-1 m^-2]");
}

constexpr auto fields_of(const QuadraticManifold*) {
  return list_fields("manifold", "paired modes", "Q [kg^-1/2 m^-1 rad/s]",
                     "self-strains [kg^-1/2 m^-1 rad/s]", "S2",
                     "Theta_B [kg^-1 m^-1]");
}

constexpr auto fields_of(const SectionModes*) {
  return list_fields("sections", "rows of nodes", "faces", "plies",
                     "strengths [Pa]", "points left out", "bare beams", "beams",
                     "rows of ends", "Force [kg^1/2 s^-2, kg^1/2 m s^-2]");
}

constexpr auto fields_of(const StressModes*) {
  return list_fields("stress", "rows", "materials", "on surface",
                     "Sigma_B [kg^1/2 m^-2 s^-2]", "averaging [rad^2/s^2]",
                     "constants [Pa, -]", "rows of interfaces", "axes",
                     "sections");
}

constexpr auto fields_of(const QuadraticFrame*) {
  return list_fields("second order", "paired modes", "Phi2 [kg^-1 m^-1]",
                     "Psi2 [kg^-1 m^-2]");
}

constexpr auto fields_of(const ContactPart*) {
  return list_fields("contact part", "normal", "centre [m]", "corners [m]",
                     "rim", "motion [kg^-1/2]", "depth [m]", "residual [m/N]",
                     "flexibility [m/N]");
}

constexpr auto fields_of(const ContactSlice*) {
  return list_fields("contact slice", "normals", "heights [m]", "centre [m]",
                     "motion [kg^-1/2]", "flexibility [m/N]",
                     "own flexibility [m/N]");
}

constexpr auto fields_of(const ContactSurface*) {
  return list_fields("contact surface", "name", "tags", "x_B [m]",
                     "Phi_B [kg^-1/2]", "residual [m/N]", "patch radius [m]",
                     "faces", "parts", "slices", "Young's modulus [Pa]",
                     "Poisson's ratio [-]");
}

constexpr auto fields_of(const InertialLevers*) {
  return list_fields("levers", "lumped [kg m]", "consistent [kg m]",
                     "displacement [m s^2]");
}

constexpr auto fields_of(const ProjectedField*) {
  return list_fields("field", "eta", "rigid share", "missed share", "key");
}

constexpr auto fields_of(const InitialDeformation*) {
  return list_fields("initial", "displacement", "velocity");
}

// Records of locking and of how modes were chosen are for information only.
constexpr auto fields_of(const ReducedBody*) {
  return list_fields(
      "reduced body", "name", "clamped", "mass [kg]", "centre of mass [m]",
      "size [m]", "integrals", nullptr, "levers", "eigenvalues [rad^2/s^2]",
      "rows", "groups", "interfaces", "triangles", "contact surfaces",
      "mesh nodes", "mesh elements", "mesh boundary nodes", nullptr, nullptr,
      nullptr, "initial", "content key", "manifold", "stress");
}

constexpr auto fields_of(const NodeSet*) {
  return list_fields("node set", "name", "nodes", "weights", "moments [m]");
}

constexpr auto fields_of(const FullOptions*) {
  return list_fields("level full", "material law", "nodal mass");
}

// The solver is determined by the recipe, whose digest the reduced body has,
// and by FullOptions.
constexpr auto fields_of(const FullBody*) {
  return list_fields("mesh", "nodes [m]", "nodal masses [kg]",
                     "first moments [kg m]", "held nodes", "interfaces",
                     nullptr);
}

constexpr auto fields_of(const NodalLoad*) {
  return list_fields("history", "times [s]", "force [N]", "moment [N m]",
                     "moment by mode [N m]", "modal force [kg^-1/2 N]");
}

}  // namespace limber::flexbody
