// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/deck_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/abaqus/keyword_effect.hpp"
#include "limber/fem/text/flat_deck.hpp"

namespace limber::fem {
namespace {

class ContentReader {
 public:
  DeckContent read(const std::filesystem::path& file) {
    deck_.notices = read_flat_deck(
        file,
        {[this](const DeckPlace& at, const Keyword& keyword, const Pose& pose) {
           begin(at, keyword, pose);
           return is_used();
         },
         [this](const DeckPlace& at, std::string_view line) {
           add_data(at, line);
         }});
    if (!element_.empty())
      throw InputError(fmt::format(
          "{}: the last element is not complete. Expected more nodes.",
          file.string()));
    return std::move(deck_);
  }

 private:
  [[nodiscard]] bool is_used() const {
    constexpr std::array<std::string_view, 6> kUsed = {
        "INCLUDE", "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE"};
    return std::ranges::find(kUsed, keyword_.name) != kUsed.end();
  }

  void begin(const DeckPlace& at, const Keyword& keyword, const Pose& pose) {
    if (!element_.empty())
      at.fail("the element before it is not complete. Expected more nodes.");
    keyword_ = keyword;
    const std::string& name = keyword_.name;
    for (const char* key : {"ELSET", "NSET", "NAME"})
      if (keyword_.has(key))
        deck_.spelling.try_emplace(keyword_.get(key), keyword_.spelled[key]);
    if (name == "NODE" && keyword_.has("SYSTEM") &&
        keyword_.get("SYSTEM") != "R")
      refuse_generator(at);
    is_in_step_ = name == "STEP" || (is_in_step_ && name != "END STEP");
    switch (find_keyword_effect(name)) {
      case KeywordEffect::generator:
        refuse_generator(at);
      case KeywordEffect::on_body:
        count_in_deck(at, "*" + name, deck_.constraints);
        break;
      case KeywordEffect::unknown:
        if (!is_in_step_) count_in_deck(at, "*" + name, deck_.constraints);
        break;
      case KeywordEffect::outside:
        count_in_deck(at, "*" + name, deck_.unused);
        break;
      case KeywordEffect::law:
        count_in_deck(at, "*" + name, deck_.laws);
        break;
      case KeywordEffect::none:
        break;
    }
    begin_named(at);
    deck_.materials.begin(at, keyword_, pose);
    if (name == "SURFACE" && keyword_.has("TYPE") &&
        keyword_.get("TYPE") == "NODE")
      keyword_.name = "SURFACE OF NODES";
    if (name == "NSET" && keyword_.has("ELSET"))
      deck_.nodes_of.push_back(keyword_);
  }

  /// Of what others refer to.
  void begin_named(const DeckPlace& at) {
    const std::string& name = keyword_.name;
    const bool is_set = name == "NSET" || name == "ELSET";
    if (!is_set && name != "SURFACE" && name != "MATERIAL") return;
    const std::string key = is_set ? name : "NAME";
    require_name(at, keyword_, key);
    if (is_set) deck_.places.try_emplace(keyword_.get(key), at.text());
  }

  [[noreturn]] void refuse_generator(const DeckPlace& at) const {
    at.fail(fmt::format(
        "*{} makes or moves nodes. Expected all of them, in the global axes, "
        "under *NODE and *ELEMENT.",
        echo(keyword_.name)));
  }

  void add_data(const DeckPlace& at, std::string_view line) {
    const std::string& name = keyword_.name;
    if (name == "NODE") {
      add_node(at, line);
    } else if (name == "ELEMENT") {
      add_element(at, line);
    } else if (name == "NSET") {
      deck_.node_sets.add_line(at, keyword_, keyword_.get("NSET"), line);
    } else if (name == "ELSET") {
      deck_.element_sets.add_line(at, keyword_, keyword_.get("ELSET"), line);
    } else if (name == "SURFACE") {
      add_surface(at, line);
    } else if (!deck_.materials.add_data(at, keyword_, line)) {
      deck_.attachments.add_data(at, keyword_, line);
    }
  }

  void add_node(const DeckPlace& at, std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    const long number = read_deck_number(at, fields[0], "node");
    if (!deck_.nodes
             .emplace(static_cast<std::size_t>(number),
                      read_deck_point(at, fields))
             .second)
      at.fail(fmt::format("node {} is there twice. Expected each node once.",
                          number));
    deck_.node_sets.add(keyword_.get("NSET"), number);
  }

  /// Number, nodes; a line that ends in a comma goes on.
  void add_element(const DeckPlace& at, std::string_view line) {
    for (const std::string_view field : split_commas(line))
      if (!field.empty())
        element_.push_back(read_deck_number(at, field, "element or node"));
    if (line.ends_with(',') || element_.empty()) return;
    DeckElement element{.number = static_cast<std::size_t>(element_[0]),
                        .type = *deck_.types.insert(keyword_.get("TYPE")).first,
                        .solid = find_solid_type(keyword_.get("TYPE")),
                        .nodes = {element_.begin() + 1, element_.end()},
                        .file = find_file(at),
                        .line = at.number()};
    element_.clear();
    deck_.element_sets.add(keyword_.get("ELSET"),
                           static_cast<long>(element.number));
    if (!deck_.index.emplace(element.number, deck_.elements.size()).second)
      at.fail(fmt::format(
          "element {} is there twice. Expected a number of its own.",
          element.number));
    if (element.solid != nullptr) check_solid(at, element);
    deck_.elements.push_back(std::move(element));
  }

  static void check_solid(const DeckPlace& at, const DeckElement& element) {
    const auto wanted = static_cast<std::size_t>(element.solid->nodes);
    if (element.nodes.size() != wanted)
      at.fail(fmt::format("{} {} has {} nodes. Expected {}.", element.type,
                          element.number, element.nodes.size(), wanted));
    const std::set<std::size_t> different(element.nodes.begin(),
                                          element.nodes.end());
    if (different.size() != wanted)
      at.fail(fmt::format(
          "{} {} has a node twice. Expected different nodes; a collapsed "
          "element is a wedge, a pyramid or a tetrahedron.",
          element.type, element.number));
  }

  void add_surface(const DeckPlace& at, std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    long face = 0;
    const bool is_face = fields.size() > 1 && fields[1].size() == 2 &&
                         (fields[1][0] == 'S' || fields[1][0] == 's') &&
                         parse_whole(fields[1].substr(1), face);
    if (!is_face) {  // of shells, or the free faces of a set
      count_in_deck(at, "*SURFACE without faces S1, S2, ...", deck_.unused);
      return;
    }
    deck_.surfaces[keyword_.get("NAME")].push_back(
        {at.text(), to_upper(std::string(fields[0])), static_cast<int>(face)});
  }

  std::size_t find_file(const DeckPlace& at) {
    if (deck_.files.empty() || deck_.files.back() != at.file())
      deck_.files.push_back(at.file());
    return deck_.files.size() - 1;
  }

  DeckContent deck_;
  Keyword keyword_;
  bool is_in_step_ = false;
  std::vector<long> element_;  // numbers of one that goes on
};

}  // namespace

const DeckElement* DeckContent::find(long number) const {
  const auto found = index.find(static_cast<std::size_t>(number));
  return found == index.end() ? nullptr : &elements[found->second];
}

std::vector<long> DeckContent::find_elements(const std::string& name) const {
  long number = 0;
  if (parse_whole(name, number)) return {number};
  return element_sets.get(name);
}

std::string DeckContent::spell(const std::string& name) const {
  const auto found = spelling.find(name);
  return found == spelling.end() ? name : found->second;
}

std::string DeckContent::place_of(const DeckElement& element) const {
  return fmt::format("{}:{}", files[element.file].string(), element.line);
}

DeckContent read_deck_content(const std::filesystem::path& file) {
  return ContentReader().read(file);
}

}  // namespace limber::fem
