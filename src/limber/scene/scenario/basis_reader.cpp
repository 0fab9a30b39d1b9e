// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/basis_reader.hpp"

namespace limber::scene {
namespace {

std::optional<int> read_pieces(TomlTable& table) {
  constexpr int kMostPieces = 1000;
  if (!table.is_text("pieces")) {
    return table.integer("pieces", 1, kMostPieces);
  }
  if (table.text("pieces") == "auto") return 0;
  table.fail("pieces", "expected a number of pieces or \"auto\"");
  return std::nullopt;
}

BasisChoice read_basis_choice(TomlTable& table) {
  BasisChoice choice;
  choice.eigenmodes = table.integer("eigenmodes", 0, 100000);
  choice.pieces = read_pieces(table);
  const toml::table* shapes = table.table("static_deformation");
  if (shapes == nullptr) return choice;
  TomlTable sources(*shapes, table.path() + ".static_deformation",
                    table.problems());
  choice.interfaces = sources.boolean("interfaces");
  choice.loads = sources.boolean("loads");
  choice.terms = sources.integer("terms", 1, 100);
  sources.finish();
  return choice;
}

}  // namespace

void read_basis(TomlTable& table, Scenario& scenario) {
  scenario.basis = read_basis_choice(table);
  const toml::table* links = table.table("links");
  if (links == nullptr) return;
  TomlTable by_name(*links, "basis.links", table.problems());
  for (const auto& [key, node] : *links) {
    const std::string name(key.str());
    const toml::table* item = by_name.table(name);
    if (item == nullptr) continue;
    TomlTable values(*item, "basis.links." + name, table.problems());
    scenario.basis_of_link[name] = read_basis_choice(values);
    values.finish();
  }
}

}  // namespace limber::scene
