// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/full_body.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::flexbody {
namespace {

using Names = std::vector<std::string>;

const Names& law_names() {
  static const Names names = {"st-venant-kirchhoff", "neo-hookean"};
  return names;
}

const Names& mass_names() {
  static const Names names = {"consistent", "lumped"};
  return names;
}

}  // namespace

std::string_view to_string(MaterialLaw law) {
  return law_names()[static_cast<std::size_t>(law)];
}

MaterialLaw parse_material_law(std::string_view name) {
  return static_cast<MaterialLaw>(find_name("material law", name, law_names()));
}

std::string_view to_string(NodalMassKind kind) {
  return mass_names()[static_cast<std::size_t>(kind)];
}

NodalMassKind parse_nodal_mass(std::string_view name) {
  return static_cast<NodalMassKind>(
      find_name("nodal mass", name, mass_names()));
}

const NodeSet& find_node_set(const FullBody& body, const std::string& name) {
  Names names;
  for (const NodeSet& set : body.interfaces) {
    if (set.name == name) return set;
    names.push_back(set.name);
  }
  throw InputError(describe_unknown("interface", name, names));
}

}  // namespace limber::flexbody
