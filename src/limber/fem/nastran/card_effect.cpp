// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/card_effect.hpp"

#include <algorithm>
#include <array>

namespace limber::fem {
namespace {

// Cards with C that are no elements: aerodynamics, cyclic symmetry, sets.
constexpr std::array<std::string_view, 17> kNoElements = {
    "CAERO1", "CAERO2", "CAERO3", "CAERO4",  "CAERO5", "CLOAD",
    "CREEP",  "CSET",   "CSET1",  "CSSCHD",  "CYAX",   "CYJOIN",
    "CYSUP",  "CYSYM",  "CONV",   "CONTRLT", "CAMPBLL"};

constexpr std::array<std::string_view, 22> kOfBody = {
    "GENEL",   "MPC",    "RBAR",  "RBAR1",   "RBE1",   "RBE2",
    "RBE3",    "RJOINT", "RROD",  "RSPLINE", "RSSCON", "RTRPLT",
    "RTRPLT1", "RBE2GS", "NSM",   "NSM1",    "NSML",   "NSML1",
    "NSMADD",  "BOLT",   "BGADD", "BGSET"};

/// Beginnings of names without effect: materials, properties and parameters,
/// methods of solution, sets, tables, temperatures, defaults of bars.
constexpr std::array<std::string_view, 13> kWithoutEffect = {
    "MAT",    "P",     "EIG", "SET",  "TABL",  "TABD",  "TEMP",
    "NLPARM", "TSTEP", "DTI", "ECHO", "BAROR", "BEAMOR"};

/// Beginnings of names of supports, loads, sets of unknowns, motions at the
/// start, matrices and equations that the case control selects, contact,
/// design, aerodynamics, heat.
constexpr std::array<std::string_view, 76> kOutside = {
    "ACCEL",   "ACMODL",  "ACSRCE",  "AE",     "AS",      "BC",      "BDYOR",
    "BEDGE",   "BFRIC",   "BLSEG",   "BNDFIX", "BNDFREE", "BNDGRID", "BOUTPUT",
    "BSET",    "BSURF",   "CLOAD",   "DAREA",  "DCON",    "DDVAL",   "DEFORM",
    "DELAY",   "DES",     "DIVERG",  "DLINK",  "DLOAD",   "DMI",     "DOPT",
    "DPHASE",  "DRESP",   "DSCREEN", "DTABLE", "DV",      "EPOINT",  "EXTRN",
    "FLFACT",  "FLUTTER", "FORCE",   "FREEPT", "FREQ",    "GRAV",    "GUST",
    "HYBDAMP", "LOAD",    "LSEQ",    "MKAERO", "MODTRAK", "MOMENT",  "MPCADD",
    "NLOAD",   "NOLIN",   "OMIT",    "OSET",   "OUT",     "QBDY",    "QHBDY",
    "QSET",    "QVECT",   "QVOL",    "RADBC",  "RANDPS",  "RFORCE",  "RLOAD",
    "ROTOR",   "SECSET",  "SEQGP",   "SLOAD",  "SPC",     "SPLINE",  "SPOINT",
    "SUP",     "SWLDPRM", "TF",      "TIC",    "TLOAD",   "TRIM"};

template <typename List>
bool is_listed(const List& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// Names beginning with P that act: pressures.
bool is_pressure(std::string_view name) {
  return name.starts_with("PLOAD") || name == "PRESAX";
}

}  // namespace

CardEffect find_card_effect(std::string_view name) {
  if (is_listed(kOfBody, name)) return CardEffect::on_body;
  if (name.starts_with('C') && !is_listed(kNoElements, name))
    return CardEffect::on_body;
  const auto begins = [&](std::string_view start) {
    return name.starts_with(start);
  };
  if (is_pressure(name) || is_listed(kNoElements, name) ||
      std::ranges::any_of(kOutside, begins))
    return CardEffect::outside;
  return std::ranges::any_of(kWithoutEffect, begins) ? CardEffect::none
                                                     : CardEffect::unknown;
}

bool is_mark_of_surface(std::string_view name) {
  constexpr std::array<std::string_view, 5> kMarks = {
      "CBAR", "CTRIA3", "CTRIA6", "CQUAD4", "CQUAD8"};
  return is_listed(kMarks, name);
}

bool is_property(std::string_view name) {
  return name.starts_with('P') && name != "PARAM" && name != "PLOTEL" &&
         !is_pressure(name);
}

bool is_coordinate_system(std::string_view name) {
  return name.size() == 6 &&
         (name.starts_with("CORD1") || name.starts_with("CORD2")) &&
         (name[5] == 'R' || name[5] == 'C' || name[5] == 'S');
}

}  // namespace limber::fem
