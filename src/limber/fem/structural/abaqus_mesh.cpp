// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/abaqus_mesh.hpp"

#include <fmt/format.h>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

/// Numbers of a set, or one; each once.
std::set<long> list_numbers(const DeckSets& sets, const std::string& of,
                            const char* what, const std::string& place) {
  long number = 0;
  if (parse_whole(of, number)) return {number};
  const std::vector<long> numbers = sets.get(of);
  if (numbers.empty())
    throw InputError(
        fmt::format("{}: its set of {} {} is missing or empty. Expected one.",
                    place, what, echo(of)));
  return {numbers.begin(), numbers.end()};
}

}  // namespace

int AbaqusMesh::find_node(long number, const std::string& place) const {
  const auto found = nodes.find(number);
  if (found != nodes.end()) return found->second;
  throw InputError(fmt::format(
      "{}: node {} is missing. Expected it under *NODE.", place, number));
}

std::vector<int> AbaqusMesh::find_nodes(const std::string& of,
                                        const std::string& place) const {
  std::vector<int> found;
  for (const long number : list_numbers(node_sets, of, "nodes", place))
    found.push_back(find_node(number, place));
  return found;
}

std::set<long> AbaqusMesh::list_elements(const std::string& of,
                                         const std::string& place) const {
  std::set<long> numbers = list_numbers(element_sets, of, "elements", place);
  for (const long number : numbers)
    if (!elements.contains(number))
      throw InputError(
          fmt::format("{}: element {} is missing. Expected it under *ELEMENT.",
                      place, number));
  return numbers;
}

std::vector<const InputElement*> AbaqusMesh::find_elements(
    const std::string& of, const std::string& place) const {
  std::vector<const InputElement*> found;
  for (const long number : list_elements(of, place))
    found.push_back(&elements.at(number));
  return found;
}

Vector3 AbaqusMesh::find_default_axis(const InputElement& element) const {
  constexpr double kAlong = 0.9999984769132877;  // cos 0.1 degrees
  const auto at = [&](std::size_t i) {
    return Vector3(x.col(element.nodes[i]));
  };
  const std::size_t last = element.nodes.size() - 1;
  const Vector3 n = (at(2) - at(0)).cross(at(last) - at(1)).normalized();
  return std::abs(n.x()) > kAlong ? Vector3::UnitZ() : Vector3::UnitX();
}

void AbaqusMesh::require_solids(const std::string& elset,
                                const std::string& place) const {
  for (const long number : element_sets.get(elset)) {
    const auto found = elements.find(number);
    if (found != elements.end() && found->second.solid == nullptr)
      throw InputError(fmt::format(
          "{}: element {} is a {}. Expected a section of its own kind.", place,
          number, found->second.type));
  }
}

}  // namespace limber::fem
