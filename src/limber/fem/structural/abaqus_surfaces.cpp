// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/abaqus_surfaces.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <optional>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

/// Corners, then nodes between them.
using Side = std::vector<int>;

double calc_area(const Matrix3X& x, const Side& side, std::size_t corners) {
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 1; i + 1 < corners; ++i)
    area += 0.5 * (x.col(side[i]) - x.col(side[0]))
                      .cross(x.col(side[i + 1]) - x.col(side[0]));
  return area.norm();
}

/// int N dA of each node of a side.
void add_weights(const Matrix3X& x, const Side& side,
                 std::map<int, double>& weights) {
  const auto add = [&](std::size_t first, std::size_t last, double weight) {
    for (std::size_t i = first; i < last; ++i) weights[side[i]] += weight;
  };
  switch (side.size()) {
    case 2:
      return add(0, 2, 0.5 * (x.col(side[1]) - x.col(side[0])).norm());
    case 3:
    case 4: {
      const double area = calc_area(x, side, side.size());
      return add(0, side.size(), area / static_cast<double>(side.size()));
    }
    case 6:
      return add(3, 6, calc_area(x, side, 3) / 3.0);
    default: {
      const double area = calc_area(x, side, 4);
      add(0, 4, -area / 12.0);
      return add(4, 8, area / 3.0);
    }
  }
}

/// The nodes of a face or edge; none: the element has no such one.
std::optional<Side> find_side(const InputElement& element,
                              const std::string& face) {
  const bool is_shell = element.type.starts_with('S');
  if (is_shell && (face == "SPOS" || face == "SNEG")) return element.nodes;
  long number = 0;
  if (face.size() != 2 || !parse_whole(face.substr(1), number) || number < 1)
    return std::nullopt;
  const auto place = static_cast<std::size_t>(number) - 1;
  if (is_shell && face[0] == 'E' && place < element.nodes.size())
    return Side{element.nodes[place],
                element.nodes[(place + 1) % element.nodes.size()]};
  if (element.solid == nullptr || face[0] != 'S' ||
      place >= element.solid->faces.size())
    return std::nullopt;
  Side side;
  for (const int at : element.solid->faces[place].places)
    side.push_back(element.nodes[index(at)]);
  return side;
}

}  // namespace

void AbaqusSurfaces::begin(const DeckPlace& at, const Keyword& keyword) {
  name_ = keyword.get("NAME");
  is_of_nodes_ = keyword.get("TYPE") == "NODE";
  if (!surfaces_.try_emplace(name_).second)
    at.fail(fmt::format(
        "surface {} is there twice. Expected a name of its own.", echo(name_)));
}

void AbaqusSurfaces::add_data(const DeckPlace& at, std::string_view line) {
  const std::vector<std::string_view> fields = split_commas(line);
  Part part{at.text(), to_upper(std::string(fields[0])), {}};
  if (!is_of_nodes_)
    part.face = fields.size() > 1 && !fields[1].empty()
                    ? to_upper(std::string(fields[1]))
                    : "all free faces";
  surfaces_[name_].push_back(std::move(part));
}

std::map<int, double> AbaqusSurfaces::find_weights(
    const AbaqusMesh& mesh, const std::string& name,
    const std::string& place) const {
  const auto found = surfaces_.find(name);
  if (found == surfaces_.end() || found->second.empty())
    throw InputError(
        fmt::format("{}: its surface {} is missing or empty. Expected one.",
                    place, echo(name)));
  std::map<int, double> weights;
  for (const Part& part : found->second) {
    if (part.face.empty()) {
      for (const int node : mesh.find_nodes(part.of, part.place))
        weights[node] = 1.0;
      continue;
    }
    for (const InputElement* element :
         mesh.find_elements(part.of, part.place)) {
      const std::optional<Side> side = find_side(*element, part.face);
      if (!side)
        throw InputError(fmt::format(
            "{}: {} of elements {} is not read. Expected S1, S2, ... of "
            "solids, or SPOS, SNEG, E1, E2, ... of shells.",
            part.place, echo(part.face), element->type));
      add_weights(mesh.x, *side, weights);
    }
  }
  return weights;
}

}  // namespace limber::fem
