// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/keyword_effect.hpp"

#include <algorithm>
#include <array>

namespace limber::fem {
namespace {

constexpr std::array<std::string_view, 25> kOfBody = {
    "EQUATION",
    "MPC",
    "TIE",
    "RIGID BODY",
    "COUPLING",
    "KINEMATIC COUPLING",
    "DISTRIBUTING COUPLING",
    "EMBEDDED ELEMENT",
    "SHELL TO SOLID COUPLING",
    "CYCLIC SYMMETRY MODEL",
    "CONTACT PAIR",
    "CONTACT",
    "PRE-TENSION SECTION",
    "SUBSTRUCTURE PROPERTY",
    "BEAM GENERAL SECTION",
    "SHELL GENERAL SECTION",
    "BEAM ADDED INERTIA",
    "TRANSVERSE SHEAR STIFFNESS",
    "TRANSVERSE SHEAR",
    "NONSTRUCTURAL MASS",
    "ROTARY INERTIA",
    "NODAL THICKNESS",
    "FASTENER",
    "MATRIX INPUT",
    "MATRIX ASSEMBLE"};

constexpr std::array<std::string_view, 7> kGenerators = {
    "SYSTEM", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"};

constexpr std::array<std::string_view, 18> kOutside = {
    "BOUNDARY", "CLOAD",        "DLOAD",
    "DSLOAD",   "TEMPERATURE",  "BASE MOTION",
    "FILM",     "RADIATE",      "CFLUX",
    "DFLUX",    "SFILM",        "SRADIATE",
    "FIELD",    "MODEL CHANGE", "INERTIA RELIEF",
    "GAP",      "IMPERFECTION", "INITIAL CONDITIONS"};

constexpr std::array<std::string_view, 13> kLaws = {
    "PLASTIC",         "CREEP",        "VISCOELASTIC",     "EXPANSION",
    "DAMPING",         "CONDUCTIVITY", "CYCLIC HARDENING", "SPECIFIC HEAT",
    "LATENT HEAT",     "POTENTIAL",    "RATE DEPENDENT",   "DAMAGE INITIATION",
    "DAMAGE EVOLUTION"};

/// With those that are read, sections, what only elements that are refused
/// have, and what acts by a keyword that names it.
constexpr std::array<std::string_view, 52> kWithoutEffect = {
    "HEADING",
    "PREPRINT",
    "INCLUDE",
    "NODE",
    "ELEMENT",
    "NSET",
    "ELSET",
    "SURFACE",
    "MATERIAL",
    "ELASTIC",
    "DENSITY",
    "DEPVAR",
    "USER MATERIAL",
    "FAIL STRESS",
    "FAIL STRAIN",
    "ORIENTATION",
    "DISTRIBUTION",
    "DISTRIBUTION TABLE",
    "MASS",
    "SPRING",
    "DASHPOT",
    "NORMAL",
    "PART",
    "END PART",
    "INSTANCE",
    "END INSTANCE",
    "ASSEMBLY",
    "END ASSEMBLY",
    "KINEMATIC",
    "DISTRIBUTING",
    "STEP",
    "END STEP",
    "AMPLITUDE",
    "TRANSFORM",
    "TIME POINTS",
    "PHYSICAL CONSTANTS",
    "SURFACE INTERACTION",
    "SURFACE BEHAVIOR",
    "FRICTION",
    "CONTACT DAMPING",
    "GAP CONDUCTANCE",
    "GAP HEAT GENERATION",
    "SECTION CONTROLS",
    "HOURGLASS STIFFNESS",
    "CONTROLS",
    "RESTART",
    "FILTER",
    "FILE FORMAT",
    "CONNECTOR BEHAVIOR",
    "CONNECTOR ELASTICITY",
    "CONNECTOR DAMPING",
    "NO ANALYSIS"};

template <typename List>
bool is_listed(const List& list, std::string_view name) {
  return std::ranges::find(list, name) != list.end();
}

}  // namespace

KeywordEffect find_keyword_effect(std::string_view name) {
  if (is_listed(kOfBody, name)) return KeywordEffect::on_body;
  if (is_listed(kGenerators, name)) return KeywordEffect::generator;
  if (is_listed(kOutside, name)) return KeywordEffect::outside;
  if (is_listed(kLaws, name)) return KeywordEffect::law;
  const bool is_law_in_place = name.starts_with("HYPER") ||
                               name == "HYPOELASTIC" ||
                               name == "POROUS ELASTIC";
  const bool is_output = name.ends_with("OUTPUT") || name.ends_with(" FILE") ||
                         name.ends_with(" PRINT");
  return is_listed(kWithoutEffect, name) || name.ends_with("SECTION") ||
                 is_law_in_place || is_output
             ? KeywordEffect::none
             : KeywordEffect::unknown;
}

}  // namespace limber::fem
