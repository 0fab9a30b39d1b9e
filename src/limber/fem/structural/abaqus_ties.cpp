// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/abaqus_ties.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <map>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

constexpr std::string_view kAll = "123456";

/// @throws InputError for a parameter that is not among `known`
void require_known(const DeckPlace& at, const Keyword& keyword,
                   std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : keyword.parameters)
    if (std::ranges::find(known, key) == known.end())
      at.fail(fmt::format("*{} has {}, which is not read. Expected {}.",
                          keyword.name, echo(key), fmt::join(known, ", ")));
}

int find_reference(const AbaqusMesh& mesh, const std::string& reference,
                   const std::string& place) {
  const std::vector<int> nodes = mesh.find_nodes(reference, place);
  if (nodes.size() != 1)
    throw InputError(fmt::format(
        "{}: its reference {} is a set of {} nodes. Expected one node.", place,
        echo(reference), nodes.size()));
  return nodes[0];
}

}  // namespace

bool AbaqusTies::begin(const DeckPlace& at, const Keyword& keyword) {
  reading_ = keyword.name;
  if (reading_ == "SURFACE") {
    surfaces_.begin(at, keyword);
  } else if (reading_ == "RIGID BODY") {
    begin_rigid(at, keyword);
  } else if (reading_ == "COUPLING") {
    begin_coupling(at, keyword);
  } else if (reading_ == "KINEMATIC" || reading_ == "DISTRIBUTING") {
    begin_kind(at, keyword);
  } else if (reading_ == "MPC") {
    require_known(at, keyword, {});
  } else {
    reading_.clear();
  }
  return !reading_.empty();
}

void AbaqusTies::begin_rigid(const DeckPlace& at, const Keyword& keyword) {
  require_known(
      at, keyword,
      {"REF NODE", "NSET", "TIE NSET", "PIN NSET", "ELSET", "ROT NODE"});
  const std::size_t before = ties_.size();
  for (const char* key : {"NSET", "TIE NSET", "PIN NSET", "ELSET"})
    if (keyword.has(key))
      ties_.push_back(
          {at.text(), keyword.get("REF NODE"),
           std::string_view(key) == "ELSET" ? Of::elements : Of::nodes,
           keyword.get(key), key[0] == 'P' ? "123" : std::string(kAll)});
  if (ties_.size() == before || !keyword.has("REF NODE"))
    at.fail("*RIGID BODY. Expected NSET or ELSET and its REF NODE.");
}

void AbaqusTies::begin_coupling(const DeckPlace& at, const Keyword& keyword) {
  require_known(at, keyword, {"REF NODE", "SURFACE", "CONSTRAINT NAME"});
  if (!keyword.has("REF NODE") || !keyword.has("SURFACE"))
    at.fail("*COUPLING. Expected its REF NODE and SURFACE.");
  ties_.push_back({at.text(), keyword.get("REF NODE"), Of::surface,
                   keyword.get("SURFACE")});
  ties_.back().is_open = true;
}

void AbaqusTies::begin_kind(const DeckPlace& at, const Keyword& keyword) {
  if (ties_.empty() || !ties_.back().is_open)
    at.fail(fmt::format("*{} without *COUPLING before.", keyword.name));
  const bool is_mean = keyword.name == "DISTRIBUTING";
  if (is_mean)
    require_known(at, keyword, {"COUPLING", "WEIGHTING METHOD"});
  else
    require_known(at, keyword, {});
  const auto is_default = [&](const char* key, const char* value) {
    return !keyword.has(key) || keyword.get(key) == value;
  };
  if (!is_default("COUPLING", "CONTINUUM") ||
      !is_default("WEIGHTING METHOD", "UNIFORM"))
    at.fail(
        "*DISTRIBUTING of another kind is not read. Expected "
        "COUPLING=CONTINUUM and WEIGHTING METHOD=UNIFORM.");
  ties_.back().is_mean = is_mean;
  ties_.back().is_open = false;
}

void AbaqusTies::add_data(const DeckPlace& at, std::string_view line) {
  const std::vector<std::string_view> fields = split_commas(line);
  if (reading_ == "SURFACE") return surfaces_.add_data(at, line);
  if (reading_ == "MPC") {
    if (fields.size() != 3 || to_upper(std::string(fields[0])) != "BEAM")
      at.fail(fmt::format(
          "*MPC {} is not read. Expected BEAM and two nodes or sets.",
          echo(fields[0])));
    ties_.push_back({at.text(), to_upper(std::string(fields[2])), Of::nodes,
                     to_upper(std::string(fields[1])), std::string(kAll)});
  } else if (reading_ == "KINEMATIC" || reading_ == "DISTRIBUTING") {
    long first = 0;
    if (!parse_whole(fields[0], first)) first = 0;
    long last = first;
    if (fields.size() > 1 && !fields[1].empty() &&
        !parse_whole(fields[1], last))
      last = 0;
    if (first < 1 || last < first || last > 6)
      at.fail(
          fmt::format("*{} has no components 1 to 6. Expected the first "
                      "and the last.",
                      reading_));
    for (long c = first; c <= last; ++c)
      ties_.back().held += static_cast<char>('0' + c);
  } else {
    at.fail(fmt::format("*{} has data. Expected none.", reading_));
  }
}

void AbaqusTies::add_to(const AbaqusMesh& mesh, std::set<int> turning,
                        Structure& structure) const {
  std::vector<int> references;
  for (const Tie& tie : ties_) {
    references.push_back(find_reference(mesh, tie.reference, tie.place));
    turning.insert(references.back());
  }
  for (std::size_t t = 0; t < ties_.size(); ++t) {
    const Tie& tie = ties_[t];
    if (tie.is_open)
      throw InputError(fmt::format(
          "{}: *COUPLING has no kind. Expected *KINEMATIC or *DISTRIBUTING "
          "after it.",
          tie.place));
    const int reference = references[t];
    std::map<int, double> weights;
    if (tie.kind == Of::surface) {
      weights = surfaces_.find_weights(mesh, tie.of, tie.place);
    } else if (tie.kind == Of::nodes) {
      for (const int node : mesh.find_nodes(tie.of, tie.place))
        weights[node] = 1.0;
    } else {
      for (const InputElement* element : mesh.find_elements(tie.of, tie.place))
        for (const int node : element->nodes) weights[node] = 1.0;
    }
    weights.erase(reference);
    std::string held = tie.held.empty() ? std::string(kAll) : tie.held;
    std::ranges::sort(held);
    held.erase(std::unique(held.begin(), held.end()), held.end());
    const bool is_turning = std::ranges::any_of(
        weights, [&](const auto& one) { return turning.contains(one.first); });
    if (held != kAll && (held != "123" || is_turning || tie.is_mean))
      throw InputError(fmt::format(
          "{}: components {} are held. Expected 1 to 6; 1 to 3 of nodes of "
          "solids alone, which are rigid to their reference.",
          tie.place, held));
    if (weights.empty())
      throw InputError(fmt::format(
          "{}: its reference leads no other node. Expected some.", tie.place));
    if (tie.is_mean) {
      StructureMean mean{reference, {}, {}, tie.place};
      for (const auto& [node, weight] : weights) {
        if (weight == 0.0) continue;  // corners of a triangle of second order
        mean.nodes.push_back(node);
        mean.weights.push_back(weight);
      }
      structure.means.push_back(std::move(mean));
    } else {
      StructureSpider spider{reference, {}, tie.place};
      for (const auto& [node, weight] : weights) spider.nodes.push_back(node);
      structure.spiders.push_back(std::move(spider));
    }
  }
}

}  // namespace limber::fem
