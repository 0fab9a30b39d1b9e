// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/place_reader.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/names.hpp"

namespace limber::scene {
namespace {

using flexbody::NodeSelection;

/// For both elements and tables; `prefix` precedes a region's names.
template <typename Source>
NodeSelection read_box(Source& source, const std::string& prefix) {
  const auto lower = source.vector(prefix + "lower");
  const auto upper = source.vector(prefix + "upper");
  if (!lower || !upper) {
    source.fail(fmt::format(
        "needs '{0}lower' and '{0}upper', three numbers each", prefix));
  }
  return flexbody::BoxNodes{lower.value_or(Vector3::Zero()),
                            upper.value_or(Vector3::Zero())};
}

template <typename Source>
NodeSelection read_plane(Source& source, const std::string& prefix) {
  const auto point = source.vector(prefix + "point");
  const auto normal = source.vector(prefix + "normal");
  const auto tolerance = source.number(prefix + "tolerance", kPositive);
  if (!point || !normal) {
    source.fail(fmt::format(
        "needs '{0}point' and '{0}normal', three numbers each", prefix));
    return flexbody::PlaneNodes{};
  }
  try {
    return flexbody::make_plane(*point, *normal, tolerance.value_or(0.0));
  } catch (const InputError& error) {
    source.fail(error.what());
  }
  return flexbody::PlaneNodes{};
}

template <typename Source>
NodeSelection read_cylinder(Source& source, const std::string& prefix) {
  const auto from = source.vector(prefix + "from");
  const auto to = source.vector(prefix + "to");
  const auto radius = source.number(prefix + "radius", kPositive);
  const auto inner = source.number(prefix + "inner_radius", kNonNegative);
  if (!from || !to || !radius) {
    source.fail(
        fmt::format("needs '{0}from' and '{0}to', the ends of the axis, three "
                    "numbers each, and '{0}radius'",
                    prefix));
    return flexbody::CylinderNodes{};
  }
  try {
    return flexbody::make_cylinder(*from, *to, *radius, inner.value_or(0.0));
  } catch (const InputError& error) {
    source.fail(error.what());
  }
  return flexbody::CylinderNodes{};
}

template <typename Source>
NodeSelection read_region(Source& source, const std::string& kind,
                          const std::string& prefix) {
  if (kind == "box") return read_box(source, prefix);
  if (kind == "plane") return read_plane(source, prefix);
  return read_cylinder(source, prefix);
}

/// The value read, and the number of alternatives present.
struct Choice {
  std::optional<NodeSelection> nodes;
  int ways = 0;
};

template <typename Source>
Choice read_simple(Source& source) {
  Choice choice;
  for (const char* key : {"group", "node", "nearest"}) {
    choice.ways += source.has(key) ? 1 : 0;
  }
  if (const auto group = source.text("group")) {
    choice.nodes = flexbody::GroupNodes{*group};
  }
  if (const auto tag = source.integer("node", 1, 2000000000)) {
    choice.nodes = flexbody::TaggedNode{static_cast<std::size_t>(*tag)};
  }
  if (const auto point = source.vector("nearest")) {
    choice.nodes = flexbody::NearestNode{*point};
  }
  return choice;
}

/// A region is a sub-table: box = { lower, upper }.
Choice read_ways(TomlTable& table) {
  Choice choice = read_simple(table);
  for (const std::string kind : {"box", "plane", "cylinder"}) {
    choice.ways += table.has(kind) ? 1 : 0;
    const toml::table* content = table.table(kind);
    if (content == nullptr) continue;
    TomlTable region(*content, table.path() + "." + kind, table.problems());
    choice.nodes = read_region(region, kind, "");
    region.finish();
  }
  return choice;
}

/// A region is a few attributes: box_lower, box_upper.
Choice read_ways(XmlElement& element) {
  Choice choice = read_simple(element);
  const std::vector<std::pair<std::string, std::vector<std::string>>> kinds = {
      {"box", {"lower", "upper"}},
      {"plane", {"point", "normal", "tolerance"}},
      {"cylinder", {"from", "to", "radius", "inner_radius"}}};
  for (const auto& [kind, names] : kinds) {
    const std::string prefix = kind + "_";
    bool is_given = false;
    for (const std::string& name : names) {
      is_given = element.has(prefix + name) || is_given;
    }
    if (!is_given) continue;
    ++choice.ways;
    choice.nodes = read_region(element, kind, prefix);
  }
  return choice;
}

}  // namespace

NodeSelection read_nodes(XmlElement& element) {
  const Choice choice = read_ways(element);
  if (choice.ways != 1) {
    element.fail(
        "needs exactly one of 'group', 'node', 'nearest', 'box_lower' with "
        "'box_upper', 'plane_point' with 'plane_normal', or 'cylinder_from' "
        "with 'cylinder_to' and 'cylinder_radius'");
  }
  return choice.nodes.value_or(flexbody::GroupNodes{});
}

flexbody::Weighting read_weighting(XmlElement& element) {
  const std::string name = element.text("weighting").value_or("uniform");
  if (name == "equal") return flexbody::Weighting::equal;
  if (name != "uniform") {
    element.fail(describe_unknown("weighting", name, {"uniform", "equal"}));
  }
  return flexbody::Weighting::uniform;
}

Place read_place(XmlElement& element) {
  Place place;
  place.link = element.required_text("link");
  const Choice choice = read_ways(element);
  place.nodes = choice.nodes;
  place.interface = element.text("interface").value_or("");
  if (choice.ways + (element.has("interface") ? 1 : 0) > 1) {
    element.fail(
        "has more than one of 'interface', 'group', 'node', 'nearest', 'box_', "
        "'plane_', 'cylinder_'; keep one");
  }
  place.point = element.vector("point");
  place.weighting = read_weighting(element);
  return place;
}

Place read_place(TomlTable& table) {
  Place place;
  place.link = table.required_text("link");
  Choice choice = read_ways(table);
  place.nodes = choice.nodes;
  if (const auto interface = table.text("interface")) {
    place.interface = *interface;
    ++choice.ways;
  }
  place.point = table.vector("point");
  choice.ways += table.has("point") ? 1 : 0;
  if (choice.ways > 1) {
    table.fail(
        "has more than one of 'interface', 'group', 'node', 'nearest', "
        "'box', 'plane', 'cylinder', 'point'; keep one");
  }
  place.weighting = read_choice<flexbody::Weighting>(
      table, "distribution",
      {{"uniform", flexbody::Weighting::uniform},
       {"equal", flexbody::Weighting::equal}},
      flexbody::Weighting::uniform);
  return place;
}

}  // namespace limber::scene
