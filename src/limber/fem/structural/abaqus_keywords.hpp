// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

/// Keywords of decks of Abaqus and CalculiX that are not read among beams and
/// shells.
namespace limber::fem {

/// They constrain, make or move nodes, and are not read.
inline constexpr std::array<std::string_view, 19> kLost = {
    "EQUATION",
    "TIE",
    "KINEMATIC COUPLING",
    "DISTRIBUTING COUPLING",
    "SHELL TO SOLID COUPLING",
    "CYCLIC SYMMETRY MODEL",
    "CONTACT PAIR",
    "SYSTEM",
    "NGEN",
    "NFILL",
    "NCOPY",
    "NMAP",
    "ELGEN",
    "ELCOPY",
    "BEAM GENERAL SECTION",
    "SHELL GENERAL SECTION",
    "ROTARY INERTIA",
    "NODAL THICKNESS",
    "SUBSTRUCTURE PROPERTY"};

/// They hold nothing of a body; all others that are not read are listed.
inline constexpr std::array<std::string_view, 19> kOfAnalysis = {
    "HEADING",      "PREPRINT",    "SOLID SECTION", "ASSEMBLY",
    "END ASSEMBLY", "STEP",        "END STEP",      "STATIC",
    "FREQUENCY",    "OUTPUT",      "NODE OUTPUT",   "ELEMENT OUTPUT",
    "NODE FILE",    "EL FILE",     "NODE PRINT",    "EL PRINT",
    "RESTART",      "FILE FORMAT", "INCLUDE"};

/// Whether the body would move otherwise without this keyword's effect.
[[nodiscard]] inline bool loses_motion(std::string_view keyword) {
  return std::ranges::find(kLost, keyword) != kLost.end();
}

[[nodiscard]] inline bool is_of_analysis(std::string_view keyword) {
  return std::ranges::find(kOfAnalysis, keyword) != kOfAnalysis.end();
}

}  // namespace limber::fem
