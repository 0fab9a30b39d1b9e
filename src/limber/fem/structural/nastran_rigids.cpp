// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/nastran_rigids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "limber/common/echo.hpp"

namespace limber::fem {
namespace {

constexpr std::string_view kSix = "123456";
constexpr std::string_view kThree = "123";

bool is_real_number(std::string_view field) {
  return field.find('.') != std::string_view::npos;
}

class RigidReader {
 public:
  RigidReader(const BulkCard& card, const std::string& place,
              const NastranNodes& nodes, const std::set<int>& turning,
              DeckProblems& problems, Structure& structure)
      : card_(card),
        place_(place),
        nodes_(nodes),
        turning_(turning),
        problems_(problems),
        structure_(structure) {}

  void read() {
    if (card_.name == "RBAR") return read_bar();
    if (card_.name == "RBE2") return read_spider();
    read_mean();
  }

 private:
  void refuse(const std::string& what) {
    card_.require(false, what, problems_);
  }

  void read_bar() {
    const bool a_leads = card_.field(3) == kSix;
    const bool b_leads = card_.field(4) == kSix;
    if (a_leads == b_leads || !card_.field(a_leads ? 4 : 3).empty())
      return refuse(
          "CNA or CNB is not 123456. Expected a node that leads in all six "
          "components.");
    const std::optional<int> a = nodes_.find(card_, a_leads ? 1 : 2);
    const std::optional<int> b = nodes_.find(card_, a_leads ? 2 : 1);
    if (a && b && *a == *b)
      return refuse("it has one node twice. Expected two nodes.");
    if (a && b) structure_.spiders.push_back({*a, {*b}, place_});
  }

  void read_spider() {
    StructureSpider spider;
    spider.place = place_;
    const std::optional<int> leader = nodes_.find(card_, 1);
    if (!leader) return;
    spider.reference = *leader;
    std::size_t field = 3;
    spider.nodes = nodes_.read_list(card_, field);
    const bool rotates = std::ranges::any_of(
        spider.nodes, [&](int node) { return turning_.contains(node); });
    if (card_.field(2) != kSix && (card_.field(2) != kThree || rotates))
      return refuse(
          "CM is not 123456. Expected a node that leads in all six components, "
          "or in 123 nodes of solids alone.");
    if (spider.nodes.empty() && card_.field(3).empty())
      return refuse("it has no nodes. Expected some.");
    if (std::ranges::count(spider.nodes, *leader) > 0)
      return refuse("its node GN leads itself. Expected other nodes.");
    structure_.spiders.push_back(std::move(spider));
  }

  void read_mean() {
    StructureMean mean;
    mean.place = place_;
    const std::optional<int> node = nodes_.find(card_, 2);
    if (!node) return;
    mean.node = *node;
    if (card_.field(3) != kSix)
      return refuse(
          fmt::format("REFC is '{}'. Expected 123456.", echo(card_.field(3))));
    std::set<int> seen = {*node};
    for (std::size_t field = 4; field < card_.fields.size();) {
      const std::string_view text = card_.field(field);
      if (text == "ALPHA") break;
      if (text.empty()) {
        ++field;
        continue;
      }
      if (!is_real_number(text))
        return refuse(
            fmt::format("'{}' is in place of a weight. Expected a "
                        "real number; UM is not read.",
                        echo(text)));
      const std::optional<double> weight = card_.real(field, problems_);
      if (!weight || !(*weight > 0.0))
        return refuse("a weight is not > 0. Expected one.");
      if (card_.field(field + 1) != kThree)
        return refuse(fmt::format(
            "C is '{}'. Expected 123: rotations of its nodes do not lead.",
            echo(card_.field(field + 1))));
      field += 2;
      for (const int leader : nodes_.read_list(card_, field)) {
        if (!seen.insert(leader).second)
          return refuse("it has a node twice. Expected each once.");
        mean.nodes.push_back(leader);
        mean.weights.push_back(*weight);
      }
    }
    if (mean.nodes.empty()) return refuse("it has no nodes. Expected some.");
    structure_.means.push_back(std::move(mean));
  }

  const BulkCard& card_;
  const std::string& place_;
  const NastranNodes& nodes_;
  const std::set<int>& turning_;
  DeckProblems& problems_;
  Structure& structure_;
};

}  // namespace

std::optional<int> NastranNodes::find(const BulkCard& card,
                                      std::size_t field) const {
  const std::optional<int> id = card.integer(field, std::nullopt, *problems_);
  if (!id) return std::nullopt;
  const auto found = nodes_.find(*id);
  if (found != nodes_.end()) return found->second;
  if (!missing_.insert(*id).second) return std::nullopt;  // told already
  problems_->add(*card.line,
                 fmt::format("{} {} has node {}, which is missing. Expected "
                             "its GRID.",
                             card.name, echo(card.field(0)), *id));
  return std::nullopt;
}

std::vector<int> NastranNodes::read_list(const BulkCard& card,
                                         std::size_t& field) const {
  std::vector<int> nodes;
  const std::size_t first = field;
  for (; field < card.fields.size(); ++field) {
    const std::string_view text = card.field(field);
    if (text.empty()) continue;
    if (is_real_number(text) || text == "UM" || text == "ALPHA") break;
    if (text == "THRU" && field > first) {
      const auto last = card.integer(field + 1, std::nullopt, *problems_);
      const auto from = card.integer(field - 1, std::nullopt, *problems_);
      if (!last || !from) return nodes;
      for (auto at = nodes_.upper_bound(*from);
           at != nodes_.end() && at->first <= *last; ++at)
        nodes.push_back(at->second);
      ++field;
      continue;
    }
    if (const std::optional<int> node = find(card, field))
      nodes.push_back(*node);
  }
  return nodes;
}

void add_nastran_rigid(const BulkCard& card, const std::string& place,
                       const NastranNodes& nodes, const std::set<int>& turning,
                       DeckProblems& problems, Structure& structure) {
  RigidReader(card, place, nodes, turning, problems, structure).read();
}

}  // namespace limber::fem
