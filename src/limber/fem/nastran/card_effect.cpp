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

constexpr std::array<std::string_view, 14> kConstraints = {
    "GENEL",  "MPC",  "RBAR",    "RBAR1",  "RBE1",   "RBE2",    "RBE3",
    "RJOINT", "RROD", "RSPLINE", "RSSCON", "RTRPLT", "RTRPLT1", "RBE2GS"};

/// Beginnings of names without effect: materials, properties and parameters,
/// methods of solution, sets, tables, temperatures.
constexpr std::array<std::string_view, 9> kWithoutEffect = {
    "MAT", "P", "EIG", "SET", "TABL", "TEMP", "NLPARM", "TSTEP", "DTI"};

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
  if (is_listed(kConstraints, name)) return CardEffect::on_body;
  if (name.starts_with('C') && !is_listed(kNoElements, name))
    return CardEffect::on_body;
  if (is_pressure(name)) return CardEffect::outside;
  return std::any_of(kWithoutEffect.begin(), kWithoutEffect.end(),
                     [&](auto start) { return name.starts_with(start); })
             ? CardEffect::none
             : CardEffect::outside;
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
