// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/solid_attachments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limber/common/echo.hpp"

namespace limber::fem {
namespace {

/// Components 1, 2 and 3 among digits such as "123456".
bool has_translations(std::string_view components) {
  return std::ranges::all_of(std::string_view("123"), [&](char digit) {
    return components.find(digit) != std::string_view::npos;
  });
}

bool is_number(std::string_view field) {
  return !field.empty() &&
         field.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_real(std::string_view field) {
  return field.find('.') != std::string_view::npos;
}

DeckGroup make_node_group(const std::string& name,
                          const std::vector<int>& nodes) {
  constexpr int kPoint = 15;
  DeckGroup group{name, 0, {}};
  RawBlock& block = group.elements[kPoint];
  block.type = kPoint;
  block.nodes_each = 1;
  for (const int node : nodes) {
    block.elements.push_back(static_cast<std::size_t>(node));
    block.nodes.push_back(static_cast<std::size_t>(node));
    block.regions.push_back(0);
  }
  return group;
}

}  // namespace

bool SolidAttachments::add(const BulkCard& card) {
  if (card.name == "CONM2") {
    masses_.push_back(card);
  } else if (card.name == "RBE2" || card.name == "RBE3") {
    spiders_.push_back(card);
  } else if (card.name == "SPC" || card.name == "SPC1") {
    supports_.push_back(card);
  } else {
    return false;
  }
  return true;
}

void SolidAttachments::resolve(const std::unordered_set<int>& solid,
                               double mass_factor, SolidDeck& deck) {
  solid_ = solid;
  for (const BulkCard& card : spiders_) add_spider(card, deck);
  for (const BulkCard& card : masses_) add_mass(card, mass_factor, deck);
  for (const BulkCard& card : supports_) add_support(card);
  for (const auto& [name, nodes] : held_)
    deck.groups.push_back(make_node_group(name, {nodes.begin(), nodes.end()}));
}

void SolidAttachments::add_mass(const BulkCard& card, double mass_factor,
                                SolidDeck& deck) {
  constexpr std::size_t kOffset = 4;
  constexpr std::size_t kInertia = 8;
  constexpr std::size_t kEnd = 14;
  const std::optional<int> node = card.integer(1, std::nullopt, *problems_);
  const std::optional<int> system = card.integer(2, 0, *problems_);
  const std::optional<double> mass = card.real(3, *problems_);
  if (!node || !system || !mass) return;
  const auto refuse = [&](const std::string& text) {
    problems_->add(*card.line,
                   fmt::format("CONM2 {}: {}", echo(card.field(0)), text));
  };
  const auto has_numbers = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (card.real(i, *problems_).value_or(1.0) != 0.0) return true;
    return false;
  };
  if (!(*mass >= 0.0) || !std::isfinite(*mass))
    return refuse(fmt::format("its mass is {}. Expected >= 0.", *mass));
  if (!is_solid(*node)) {
    const auto hub = hubs_.find(*node);
    return refuse(fmt::format(
        "it is at GRID {}, which {}. Expected a node of a solid; a mass on "
        "arms is a link of the scene{}.",
        *node,
        hub == hubs_.end() ? std::string("belongs to no solid element")
                           : fmt::format("is the hub of {}", hub->second),
        hub == hubs_.end()
            ? std::string()
            : fmt::format(", joined to an interface of the set {}",
                          hub->second)));
  }
  if (*system == -1 || has_numbers(kOffset, kOffset + 3) ||
      has_numbers(kInertia, kEnd))
    return refuse(
        "it has an offset or moments of inertia (CID, X, I), and a node of a "
        "solid has no rotation. Expected its mass alone, or a link of the "
        "scene in its place.");
  deck.masses[static_cast<std::size_t>(*node)] += mass_factor * *mass;
}

void SolidAttachments::add_spider(const BulkCard& card, SolidDeck& deck) {
  const bool is_rigid = card.name == "RBE2";
  const std::optional<int> id = card.integer(0, std::nullopt, *problems_);
  const std::optional<int> hub =
      card.integer(is_rigid ? 1 : 2, std::nullopt, *problems_);
  if (!id || !hub) return;
  const std::string name =
      fmt::format("{}:{}", is_rigid ? "rbe2" : "rbe3", *id);
  if (is_solid(*hub))
    return problems_->add(
        *card.line,
        fmt::format("{} {}: its hub, GRID {}, is a node of a solid, so that it "
                    "ties nodes of the solid to each other. Expected a hub of "
                    "its own.",
                    card.name, *id, *hub));
  if (is_rigid && !has_translations(card.field(2)))
    return problems_->add(
        *card.line, fmt::format("RBE2 {}: CM is '{}'. Expected components 1, 2 "
                                "and 3 of the nodes.",
                                *id, echo(card.field(2))));
  const std::vector<int> nodes = read_spider_nodes(card);
  require_solid(card, nodes);
  hubs_.emplace(*hub, name);
  deck.groups.push_back(make_node_group(name, nodes));
  deck.notices.push_back(fmt::format(
      "{} {} is the set {} of {} nodes. An interface of it moves with their "
      "mean{}.",
      card.name, *id, name, nodes.size(),
      is_rigid ? " and does not stiffen them" : ""));
}

std::vector<int> SolidAttachments::read_spider_nodes(
    const BulkCard& card) const {
  std::size_t field = card.name == "RBE2" ? 3 : 4;
  if (card.name == "RBE2") return read_nodes(card, field);
  std::vector<int> nodes;
  std::vector<double> weights;
  while (field < card.fields.size()) {
    if (card.field(field).empty()) {
      ++field;
      continue;
    }
    if (!is_real(card.field(field))) break;  // UM, ALPHA
    weights.push_back(card.real(field, *problems_).value_or(0.0));
    if (!has_translations(card.field(field + 1)))
      problems_->add(
          *card.line,
          fmt::format("RBE3 {}: a component list (C) is '{}'. "
                      "Expected 1, 2 and 3 of the nodes.",
                      echo(card.field(0)), echo(card.field(field + 1))));
    field += 2;
    const std::vector<int> group = read_nodes(card, field);
    nodes.insert(nodes.end(), group.begin(), group.end());
  }
  if (std::ranges::adjacent_find(weights, std::ranges::not_equal_to{}) !=
      weights.end())
    problems_->add(*card.line,
                   fmt::format("RBE3 {}: its nodes have different weights. "
                               "Expected equal ones; interfaces weigh nodes "
                               "by their area, or all alike.",
                               echo(card.field(0))));
  return nodes;
}

std::vector<int> SolidAttachments::read_nodes(const BulkCard& card,
                                              std::size_t& field) const {
  std::vector<int> nodes;
  for (; field < card.fields.size(); ++field) {
    const std::string_view text = card.field(field);
    if (text.empty()) continue;
    if (text == "THRU" && !nodes.empty()) {
      const std::optional<int> last =
          card.integer(++field, std::nullopt, *problems_);
      for (int node = nodes.back() + 1; last && node <= *last; ++node)
        if (is_solid(node)) nodes.push_back(node);
      continue;
    }
    if (is_real(text) || text == "UM" || text == "ALPHA") break;
    if (!is_number(text)) {
      problems_->add(*card.line,
                     fmt::format("{} {} has '{}' among its nodes. Expected "
                                 "numbers, or THRU.",
                                 card.name, echo(card.field(0)), echo(text)));
      break;
    }
    if (const auto node = card.integer(field, std::nullopt, *problems_))
      nodes.push_back(*node);
  }
  return nodes;
}

void SolidAttachments::require_solid(const BulkCard& card,
                                     const std::vector<int>& nodes) const {
  if (nodes.empty())
    problems_->add(*card.line, fmt::format("{} {} has no nodes. Expected some.",
                                           card.name, echo(card.field(0))));
  const auto other =
      std::ranges::find_if_not(nodes, [&](int node) { return is_solid(node); });
  if (other != nodes.end())
    problems_->add(*card.line,
                   fmt::format("{} {} has GRID {}, which belongs to no solid "
                               "element. Expected nodes of solids.",
                               card.name, echo(card.field(0)), *other));
}

/// Nodes that are held in part only, or belong to no solid, are in no set.
void SolidAttachments::add_support(const BulkCard& card) {
  std::set<int> nodes;
  if (card.name == "SPC1") {
    std::size_t field = 2;
    if (has_translations(card.field(1)))
      for (const int node : read_nodes(card, field)) nodes.insert(node);
  } else {
    for (const std::size_t i : {std::size_t{1}, std::size_t{4}})
      if (has_translations(card.field(i + 1)))
        nodes.insert(card.integer(i, 0, *problems_).value_or(0));
  }
  std::erase_if(nodes, [&](int node) { return !is_solid(node); });
  if (!nodes.empty()) held_[fmt::format("spc:{}", card.field(0))].merge(nodes);
}

}  // namespace limber::fem
