// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/calculix_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "limber/common/echo.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

constexpr int kUnknownComponent = 10;  // and more: rows of one label differ

std::vector<long> read_whole_numbers(const TextScanner& scanner) {
  std::vector<long> numbers;
  std::string_view rest = scanner.line();
  for (std::string_view word; !(word = take_word(rest)).empty();) {
    long value = 0;
    if (!parse_whole(word, value) || value < 0)
      scanner.fail(
          fmt::format("'{}' is not a node. Expected integers.", echo(word)));
    numbers.push_back(value);
  }
  return numbers;
}

/// Of each expanded node those of the solid, sorted: a solid's node belongs to
/// the nearest node of its element.
std::map<long, std::set<long>> find_solid_nodes(
    const std::vector<ExpandedElement>& elements,
    const std::unordered_map<long, Vector3>& solid,
    const std::unordered_map<long, Vector3>& flat) {
  std::map<long, std::set<long>> nodes;
  for (const ExpandedElement& element : elements) {
    for (const long node : element.nodes) nodes[node];
    for (const long node : element.topology) {
      const auto x = solid.find(node);
      if (x == solid.end()) continue;  // 0, or a node in the middle
      long nearest = 0;
      double least = kInfinity;
      for (const long candidate : element.nodes) {
        const auto position = flat.find(candidate);
        if (position == flat.end()) continue;
        const double distance = (position->second - x->second).norm();
        if (distance < least) {
          least = distance;
          nearest = candidate;
        }
      }
      if (nearest != 0) nodes[nearest].insert(node);
    }
  }
  return nodes;
}

std::unordered_map<long, Vector3> map_positions(const ModelFile& model) {
  std::unordered_map<long, Vector3> positions;
  for (std::size_t i = 0; i < model.tags.size(); ++i)
    positions[model.tags[i]] = model.x[i];
  return positions;
}

ModelElement::Shape shape_of_topology(std::size_t size) {
  return size == 6 || size == 15 ? ModelElement::Shape::wedge
                                 : ModelElement::Shape::hexa;
}

/// Rows of a run with one node's name, as nodes of the solid.
void name_run(const std::set<long>& nodes, std::size_t first, std::size_t last,
              std::vector<RowLabel>& rows) {
  std::vector<std::size_t> starts;
  for (std::size_t i = first; i < last; ++i)
    if (i == first || rows[i].component <= rows[i - 1].component)
      starts.push_back(i);
  starts.push_back(last);
  if (starts.size() - 1 != nodes.size()) {
    for (std::size_t i = first; i < last; ++i)
      rows[i].component = kUnknownComponent + static_cast<int>(i - first);
    return;
  }
  std::size_t part = 0;
  for (const long node : nodes) {
    for (std::size_t i = starts[part]; i < starts[part + 1]; ++i)
      rows[i].node = node;
    ++part;
  }
}

}  // namespace

std::vector<ExpandedElement> read_expansion(const std::filesystem::path& file) {
  TextScanner scanner(file);
  std::vector<ExpandedElement> elements;
  while (scanner.next_text()) {
    std::string_view line = scanner.line();
    if (take_word(line) != "ELEMENT") {
      // Knots and mean rotations: 'a KNOT was generated in node', and axes.
      if (scanner.line().find(" was generated in node") != std::string::npos ||
          scanner.line().find("about the axis") != std::string::npos)
        continue;
      scanner.fail(
          fmt::format("'{}'. Expected ELEMENT, its nodes and its "
                      "topology.",
                      echo(scanner.line())));
    }
    ExpandedElement element;
    if (!scanner.next_text()) scanner.fail_at_end("an element's nodes");
    element.nodes = read_whole_numbers(scanner);
    if (!scanner.next_text() ||
        !contains_word(scanner.line(), "IS EXPANDED INTO"))
      scanner.fail_at_end("'is expanded into a ... with topology'");
    while (scanner.next()) {
      if (scanner.line().empty()) break;
      const std::string_view text = trim_blanks(scanner.line());
      if (text.starts_with("ELEMENT") || contains_word(text, "KNOT")) {
        scanner.stay();
        break;
      }
      for (const long node : read_whole_numbers(scanner))
        if (node > 0) element.topology.push_back(node);
    }
    if (element.topology.empty()) scanner.fail_at_end("a topology");
    elements.push_back(std::move(element));
  }
  return elements;
}

ModelFile read_frd(const std::filesystem::path& file) {
  constexpr std::size_t kNode = 3;
  constexpr std::size_t kNodeColumns = 10;
  constexpr std::size_t kColumns = 12;
  TextScanner scanner(file);
  ModelFile model;
  model.file = file;
  model.format = "CalculiX results";
  bool is_inside = false;
  while (scanner.next_text()) {
    const std::string_view line = scanner.line();
    if (!is_inside) {
      is_inside = trim_blanks(line).starts_with("2C");
      continue;
    }
    if (trim_blanks(line).starts_with("-3")) return model;
    long node = 0;
    Vector3 x;
    bool is_right =
        line.starts_with(" -1") &&
        line.size() > kNode + kNodeColumns + 2 * kColumns &&
        parse_whole(trim_blanks(line.substr(kNode, kNodeColumns)), node) &&
        node > 0;
    for (std::size_t i = 0; is_right && i < 3; ++i)
      is_right = parse_real(trim_blanks(line.substr(
                                kNode + kNodeColumns + i * kColumns, kColumns)),
                            x[static_cast<Eigen::Index>(i)]);
    if (!is_right)
      scanner.fail(
          fmt::format("'{}' is not a node. Expected -1, number and three "
                      "coordinates in 12 columns each.",
                      echo(line)));
    model.tags.push_back(node);
    model.x.push_back(x);
  }
  if (is_inside) scanner.fail_at_end("the end of the nodes (-3)");
  return model;  // without nodes: a run that stored matrices writes none
}

void expand_nodes(const std::vector<ExpandedElement>& elements,
                  const ModelFile& solid, InputDeck& deck,
                  std::vector<RowLabel>& rows) {
  ModelFile& model = deck.model;
  const std::map<long, std::set<long>> nodes =
      find_solid_nodes(elements, map_positions(solid), map_positions(model));
  std::unordered_set<long> known(model.tags.begin(), model.tags.end());
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t last = first;
    while (last < rows.size() && rows[last].node == rows[first].node) ++last;
    const auto found = nodes.find(rows[first].node);
    if (found != nodes.end()) name_run(found->second, first, last, rows);
    first = last;
  }
  std::unordered_set<long> expanded;
  for (const auto& [node, solid_nodes] : nodes) expanded.insert(node);
  ModelFile all;
  for (std::size_t i = 0; i < model.tags.size(); ++i) {
    if (expanded.contains(model.tags[i])) continue;
    all.tags.push_back(model.tags[i]);
    all.x.push_back(model.x[i]);
  }
  for (std::size_t i = 0; i < solid.tags.size(); ++i) {
    if (known.contains(solid.tags[i])) continue;
    all.tags.push_back(solid.tags[i]);
    all.x.push_back(solid.x[i]);
  }
  model.tags = std::move(all.tags);
  model.x = std::move(all.x);
  for (NamedNodes& set : model.sets) {
    std::set<long> replaced;
    for (const long node : set.nodes) {
      const auto found = nodes.find(node);
      if (found == nodes.end()) {
        replaced.insert(node);
      } else {
        replaced.insert(found->second.begin(), found->second.end());
      }
    }
    set.nodes.assign(replaced.begin(), replaced.end());
  }
  // What "node:TAG" means of a node that is in no matrix.
  for (const auto& [node, solid_nodes] : nodes)
    model.sets.push_back({fmt::format("node:{}", node),
                          {solid_nodes.begin(), solid_nodes.end()}});
  std::erase_if(model.elements, [&](const ModelElement& element) {
    return expanded.contains(element.corners[0]);
  });
  for (const ExpandedElement& element : elements) {
    const auto shape = shape_of_topology(element.topology.size());
    if (element.topology.size() < count_corners(shape)) continue;
    model.elements.push_back(
        {shape,
         {element.topology.begin(),
          element.topology.begin() +
              static_cast<std::ptrdiff_t>(count_corners(shape))}});
  }
}

}  // namespace limber::fem
