// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/basis_choice.hpp"

#include <fmt/format.h>

#include "limber/scene/text/problems.hpp"

namespace limber::scene {
namespace {

/// Values of `over` where set, else of `base`.
BasisChoice merge(const BasisChoice& base, const BasisChoice& over) {
  BasisChoice choice = base;
  if (over.eigenmodes) choice.eigenmodes = over.eigenmodes;
  if (over.interfaces) choice.interfaces = over.interfaces;
  if (over.loads) choice.loads = over.loads;
  if (over.terms) choice.terms = over.terms;
  if (over.pieces) choice.pieces = over.pieces;
  return choice;
}

void apply_basis(const BasisChoice& choice, FlexibleLink& link) {
  flexbody::BasisOptions& basis = link.basis;
  link.pieces = choice.pieces.value_or(link.pieces);
  if (choice.eigenmodes) {
    basis.eigenmodes = *choice.eigenmodes;
    basis.automatic.reset();
  }
  basis.interface_modes = choice.interfaces.value_or(basis.interface_modes);
  basis.load_modes = choice.loads.value_or(basis.load_modes);
  basis.terms = choice.terms.value_or(basis.terms);
}

}  // namespace

void choose_bases(const Scenario& scenario, const BasisChoice& over,
                  Robot& robot) {
  Problems problems(scenario.file.string());
  for (Link& link : robot.links) {
    if (!link.flexible) continue;
    BasisChoice choice = scenario.basis;
    const auto own = scenario.basis_of_link.find(link.name);
    if (own != scenario.basis_of_link.end())
      choice = merge(choice, own->second);
    choice = merge(choice, over);
    if (choice == BasisChoice{}) continue;
    if (link.flexible->reduced_file.empty()) {
      apply_basis(choice, *link.flexible);
      continue;
    }
    problems.add(
        0, fmt::format("link '{}' comes from the saved body '{}', whose basis "
                       "is made; choose bases by [basis.links.NAME] for links "
                       "with a mesh",
                       link.name, link.flexible->reduced_file.string()));
  }
  problems.raise();
}

}  // namespace limber::scene
