// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/mesh_losses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include <algorithm>
#include <iterator>

#include "limber/common/errors.hpp"
#include "limber/fem/gmsh/raw_block.hpp"

namespace limber::fem {
namespace {

Tags read_node_tags() {
  Tags tags;
  std::vector<double> x;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  std::sort(tags.begin(), tags.end());
  return tags;
}

/// Elements of a dimension: all of them, and those with a node of `nodes`.
struct ElementCounts {
  std::size_t all = 0;
  std::size_t with_nodes = 0;
};

ElementCounts count_elements(int dimension, const Tags& nodes) {
  std::vector<int> types;
  std::vector<Tags> elements;
  std::vector<Tags> element_nodes;
  gmsh::model::mesh::getElements(types, elements, element_nodes, dimension);
  ElementCounts counts;
  for (std::size_t i = 0; i < types.size(); ++i) {
    counts.all += elements[i].size();
    if (elements[i].empty()) continue;
    const auto each = static_cast<std::ptrdiff_t>(element_nodes[i].size() /
                                                  elements[i].size());
    for (auto first = element_nodes[i].begin(); first != element_nodes[i].end();
         first += each)
      if (std::any_of(first, first + each, [&](std::size_t node) {
            return std::binary_search(nodes.begin(), nodes.end(), node);
          }))
        ++counts.with_nodes;
  }
  return counts;
}

std::string describe_unused(const Tags& unused, std::size_t all) {
  constexpr std::size_t kListed = 5;
  const auto listed =
      static_cast<std::ptrdiff_t>(std::min(unused.size(), kListed));
  const ElementCounts curves = count_elements(1, unused);
  const ElementCounts surfaces = count_elements(2, unused);
  std::string text = fmt::format(
      "{} of {} nodes belong to no solid element and are left out: {}{}",
      unused.size(), all,
      fmt::join(unused.begin(), unused.begin() + listed, ", "),
      unused.size() > kListed ? " ..." : "");
  if (surfaces.with_nodes + curves.with_nodes > 0)
    text += fmt::format(
        "; with them {} elements of surfaces and {} of curves, which have no "
        "stiffness and mass here",
        surfaces.with_nodes, curves.with_nodes);
  return text + ".";
}

}  // namespace

void check_counts(const std::filesystem::path& file,
                  const UnvContent& content) {
  const std::size_t nodes = read_node_tags().size();
  std::size_t elements = 0;
  for (const int dimension : {1, 2, 3})
    elements += count_elements(dimension, {}).all;
  if (nodes == content.nodes && elements == content.elements) return;
  throw InputError(fmt::format(
      "{}: has {} nodes and {} elements, of which Gmsh reads {} and {}. "
      "Expected numbers that are there once; save it as .msh or .bdf.",
      file.string(), content.nodes, content.elements, nodes, elements));
}

std::vector<std::string> find_mesh_losses(const GmshSession& session,
                                          const std::filesystem::path& file,
                                          const Mesh& mesh) {
  std::vector<std::string> notices;
  const Tags nodes = read_node_tags();
  Tags unused;
  std::set_difference(nodes.begin(), nodes.end(), mesh.tags.begin(),
                      mesh.tags.end(), std::back_inserter(unused));
  if (!unused.empty())
    notices.push_back(fmt::format("{}: {}", file.string(),
                                  describe_unused(unused, nodes.size())));
  for (const std::string& warning : session.warnings())
    notices.push_back(
        fmt::format("{}: Gmsh warns: {}", file.string(), warning));
  return notices;
}

void check_merged_files(const GmshSession& session,
                        const std::filesystem::path& file) {
  for (const std::string& merged : session.files_read()) {
    std::string extension = std::filesystem::path(merged).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (extension != ".bdf" && extension != ".nas" && extension != ".unv")
      continue;
    throw InputError(
        fmt::format("{}: it merges '{}', of which Gmsh may lose elements, mid-"
                    "side nodes and coordinate systems. Give that file itself.",
                    file.string(), merged));
  }
}

}  // namespace limber::fem
