// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/bulk_data.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/nastran/bulk_card.hpp"
#include "limber/fem/nastran/card_counts.hpp"
#include "limber/fem/nastran/card_effect.hpp"
#include "limber/fem/nastran/grid_table.hpp"
#include "limber/fem/nastran/mid_side_nodes.hpp"
#include "limber/fem/nastran/solid_attachments.hpp"
#include "limber/fem/nastran/solid_card.hpp"
#include "limber/fem/nastran/solid_materials.hpp"

namespace limber::fem {
namespace {

const SolidCard* find_solid_card(std::string_view name) {
  const auto* const found =
      std::find_if(kSolidCards.begin(), kSolidCards.end(),
                   [&](const SolidCard& card) { return card.name == name; });
  return found == kSolidCards.end() ? nullptr : found;
}

constexpr std::string_view kExpected =
    "Expected solid elements (CTETRA, CPENTA, CHEXA, CPYRAM), CONM2, RBE2 and "
    "RBE3; beams and shells with properties make it a body of another kind. "
    "Mesh it with solids, or remove it and model it in the scene by links and "
    "joints";

class BulkReader {
 public:
  BulkReader(const std::filesystem::path& file,
             const std::vector<std::string>& ignored)
      : deck_(read_deck(file)),
        problems_(deck_),
        grids_(problems_),
        materials_(deck_, problems_),
        attachments_(problems_) {
    for (const std::string& card : ignored) ignored_.insert(to_upper(card));
  }

  SolidDeck read() {
    CardReader reader(deck_, problems_);
    BulkCard card;
    while (reader.next(card)) add(card);
    if (!has_properties_) pass_over_marks();
    left_out_ = extract_ignored(ignored_, refused_);
    refuse_cards(refused_, "is not a solid", kExpected, problems_);
    set_positions();
    set_materials();
    attachments_.resolve(used_, materials_.mass_factor(), data_);
    problems_.check();
    report_unused();
    name_regions();
    return std::move(data_);
  }

 private:
  void add(const BulkCard& card) {
    has_properties_ |= is_property(card.name);
    if (ignored_.contains(std::string(card.name))) {
      count_card(card, refused_);
    } else if (const SolidCard* const solid = find_solid_card(card.name)) {
      add_solid(card, *solid);
    } else if (card.name == "GRID") {
      grids_.add_grid(card);
      count_supports(card, unused_);
    } else if (card.name == "GRDSET") {
      grids_.add_default(card);
      count_supports(card, unused_);
    } else if (is_coordinate_system(card.name)) {
      grids_.add_system(card);
    } else if (materials_.add(card)) {
      return;
    } else if (attachments_.add(card)) {
      if (card.name.starts_with("SPC"))
        count_card(card, unused_);
      else if (const auto id = card.integer(0, std::nullopt, problems_))
        take_number(*id, card);
    } else {
      add_other(card);
    }
  }

  void add_other(const BulkCard& card) {
    const CardEffect effect = find_card_effect(card.name);
    if (effect == CardEffect::on_body || effect == CardEffect::unknown) {
      count_card(card, refused_);
    } else if (effect == CardEffect::outside ||
               card.name.starts_with("MATS")) {  // a law beyond elasticity
      count_card(card, unused_);
    }
  }

  bool take_number(int id, const BulkCard& card) {
    if (id > 0 && elements_.insert(id).second) return true;
    problems_.add(*card.line,
                  fmt::format("element {} is there twice, or below 1. "
                              "Expected a number of its own.",
                              id));
    return false;
  }

  void add_solid(const BulkCard& card, const SolidCard& solid) {
    const std::optional<int> id = card.integer(0, std::nullopt, problems_);
    const std::optional<int> property =
        card.integer(1, id.value_or(0), problems_);
    const std::optional<std::vector<std::size_t>> nodes =
        read_nodes(card, solid);
    if (!id || !property || !nodes) return;
    if (!take_number(*id, card)) return;
    const bool is_linear =
        nodes->size() == static_cast<std::size_t>(solid.corners);
    const int type = is_linear ? solid.linear_type : solid.quadratic_type;
    RawBlock& block = data_.solids[type];
    block.type = type;
    block.nodes_each = static_cast<int>(nodes->size());
    block.elements.push_back(static_cast<std::size_t>(*id));
    block.regions.push_back(*property);
    if (!is_linear)
      mid_sides_.add(solid, *nodes, block.nodes.size(),
                     fmt::format("{} {}", card.name, *id));
    for (std::size_t i = 0; i < nodes->size(); ++i)
      block.nodes.push_back((*nodes)[static_cast<std::size_t>(solid.order[i])]);
    lines_[type].push_back(card.line);
  }

  /// All corners, and none or all of the mid-side nodes, 0 where one is blank.
  std::optional<std::vector<std::size_t>> read_nodes(const BulkCard& card,
                                                     const SolidCard& solid) {
    constexpr std::size_t kFirst = 2;
    const std::size_t count =
        card.fields.size() < kFirst ? 0 : card.fields.size() - kFirst;
    const auto corners = static_cast<std::size_t>(solid.corners);
    const auto all = static_cast<std::size_t>(solid.nodes);
    std::vector<std::size_t> nodes;
    for (std::size_t i = 0; i < count; ++i) {
      const std::optional<int> node = card.integer(kFirst + i, 0, problems_);
      if (!node) return std::nullopt;
      // 0 as a mid-side node is the same as blank
      nodes.push_back(static_cast<std::size_t>(std::max(*node, 0)));
      if (*node < 0 || (*node == 0 && i < corners)) {
        problems_.add(*card.line,
                      fmt::format("{}'s node G{} is blank or below 1. Expected "
                                  "a GRID.",
                                  card.name, i + 1));
        return std::nullopt;
      }
    }
    if (count > all || count < corners) {
      problems_.add(
          *card.line,
          fmt::format("{} has {} nodes. Expected {} corners, and none "
                      "or up to {} mid-side nodes.",
                      card.name, count, corners, all - corners));
      return std::nullopt;
    }
    std::set<std::size_t> once;
    for (const std::size_t node : nodes)
      if (node > 0 && !once.insert(node).second) {
        problems_.add(*card.line,
                      fmt::format("{} has a node twice. Expected different "
                                  "nodes; a collapsed element is a CPENTA, "
                                  "CPYRAM or CTETRA.",
                                  card.name));
        return std::nullopt;
      }
    nodes.resize(once.size() > corners ? all : corners, 0);
    return nodes;
  }

  void pass_over_marks() {
    for (auto entry = refused_.begin(); entry != refused_.end();) {
      const auto next = std::next(entry);
      if (is_mark_of_surface(entry->first))
        marks_.insert(refused_.extract(entry));
      entry = next;
    }
  }

  void set_positions() {
    std::vector<int> ids;
    for (const auto& [id, grid] : grids_.grids()) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    data_.nodes.assign(ids.begin(), ids.end());
    data_.x.resize(3, static_cast<Eigen::Index>(ids.size()));
    for (std::size_t i = 0; i < ids.size(); ++i)
      data_.x.col(static_cast<Eigen::Index>(i)) =
          grids_.find_position(grids_.grids().at(ids[i]));
    check_nodes();
    problems_.check();
    for (std::string& notice : mid_sides_.fill(deck_.files[0].string(), data_))
      data_.notices.push_back(std::move(notice));
    for (const auto& [type, block] : data_.solids)
      for (const std::size_t node : block.nodes)
        used_.insert(static_cast<int>(node));
  }

  /// Every element's nodes are there.
  void check_nodes() {
    std::set<std::size_t> told;
    for (const auto& [type, block] : data_.solids) {
      const std::vector<const DeckLine*>& lines = lines_[type];
      const auto each = static_cast<std::size_t>(block.nodes_each);
      for (std::size_t i = 0; i < block.nodes.size(); ++i) {
        if (block.nodes[i] == 0 ||
            grids_.grids().contains(static_cast<int>(block.nodes[i])) ||
            !told.insert(block.nodes[i]).second)
          continue;
        problems_.add(*lines[i / each],
                      fmt::format("element {} has node {}, which is missing. "
                                  "Expected its GRID.",
                                  block.elements[i / each], block.nodes[i]));
      }
    }
  }

  void report_unused() {
    report_unused_grids();
    if (!marks_.empty())
      data_.notices.push_back(fmt::format(
          "{}: left out as marks of the surface, as the deck has no "
          "properties: {}.",
          deck_.files[0].string(), list_counts(deck_, marks_)));
    note_left_out(deck_, left_out_, data_.notices);
    if (!unused_.empty())
      data_.notices.push_back(
          fmt::format("{}: not used: {}. Supports and loads are those of the "
                      "scene; nodes of solids that SPC and SPC1 hold in 1, 2 "
                      "and 3 are the sets spc:SID.",
                      deck_.files[0].string(), list_counts(deck_, unused_)));
    if (!deck_.has_end)
      data_.notices.push_back(
          fmt::format("{}: it has no ENDDATA, so whether it is complete is not "
                      "known.",
                      deck_.files[0].string()));
  }

  void report_unused_grids() {
    constexpr std::size_t kListed = 5;
    std::vector<std::size_t> unused;
    std::copy_if(
        data_.nodes.begin(), data_.nodes.end(), std::back_inserter(unused),
        [&](std::size_t id) { return !used_.contains(static_cast<int>(id)); });
    if (unused.empty()) return;
    const auto listed =
        static_cast<std::ptrdiff_t>(std::min(unused.size(), kListed));
    data_.notices.push_back(fmt::format(
        "{}: {} of {} GRIDs belong to no solid element and are left out: "
        "{}{}.",
        deck_.files[0].string(), unused.size(), data_.nodes.size(),
        fmt::join(unused.begin(), unused.begin() + listed, ", "),
        unused.size() > kListed ? " ..." : ""));
  }

  [[nodiscard]] std::set<int> find_properties() const {
    std::set<int> properties;
    for (const auto& [type, block] : data_.solids)
      properties.insert(block.regions.begin(), block.regions.end());
    return properties;
  }

  /// In the order of name_regions.
  void set_materials() {
    for (const int property : find_properties())
      data_.materials.push_back(materials_.find(property, grids_));
  }

  /// In place of the PIDs as regions.
  void name_regions() {
    std::map<int, int> regions;
    for (const int property : find_properties()) {
      regions[property] = static_cast<int>(data_.region_groups.size());
      data_.region_groups.push_back({std::to_string(property)});
    }
    for (auto& [type, block] : data_.solids)
      for (int& region : block.regions) region = regions[region];
  }

  Deck deck_;
  DeckProblems problems_;
  GridTable grids_;
  SolidMaterials materials_;
  SolidAttachments attachments_;
  SolidDeck data_;
  MidSideNodes mid_sides_;
  std::map<int, std::vector<const DeckLine*>> lines_;  // of data_.solids
  std::unordered_set<int> elements_;
  std::unordered_set<int> used_;
  CardCounts refused_;
  CardCounts marks_;
  CardCounts unused_;
  CardCounts left_out_;
  std::set<std::string> ignored_;
  bool has_properties_ = false;
};

}  // namespace

SolidDeck read_bulk_data(const std::filesystem::path& file,
                         const std::vector<std::string>& ignored) {
  return BulkReader(file, ignored).read();
}

}  // namespace limber::fem
