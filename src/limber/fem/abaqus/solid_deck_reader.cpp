// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/solid_deck_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/abaqus/deck_content.hpp"

namespace limber::fem {
namespace {

/// A face of shells or of plane elements, which may mark a surface.
std::optional<std::pair<int, int>> find_mark(std::string_view type) {
  constexpr std::array<std::string_view, 6> kStarts = {"CPS", "CPE",  "CAX",
                                                       "M3D", "STRI", "S"};
  const auto is_start = [&](std::string_view start) {
    return type.starts_with(start) && type.size() > start.size() &&
           type[start.size()] >= '3' && type[start.size()] <= '8';
  };
  const auto start = std::ranges::find_if(kStarts, is_start);
  if (start == kStarts.end()) return std::nullopt;
  switch (type[start->size()]) {
    case '3':
      return std::pair{2, 3};
    case '4':
      return std::pair{3, 4};
    case '6':
      return std::pair{9, 6};
    case '8':
      return std::pair{16, 8};
    default:
      return std::nullopt;
  }
}

/// As a set of the file would be; DeckContent::spell() has it in lower case.
constexpr const char* kHeldNodes = "boundary";

bool is_edge(std::string_view type) {
  return type.starts_with("T3D") || type.starts_with("B3") ||
         type.starts_with("T2D");
}

class SolidDeckReader {
 public:
  SolidDeckReader(const std::filesystem::path& file,
                  const std::vector<std::string>& ignored)
      : file_(file), content_(read_deck_content(file)) {
    for (const std::string& name : ignored) {
      const std::string upper = to_upper(name);
      ignored_.insert(upper.starts_with('*') ? upper : "elements " + upper);
      ignored_.insert("*" + upper);
    }
  }

  SolidDeck read() {
    refuse_others();
    set_nodes();
    set_solids();
    set_masses();
    set_groups();
    report();
    return std::move(deck_);
  }

 private:
  [[nodiscard]] std::set<long> find_described() const {
    std::set<long> described;
    for (const auto& section : content_.materials.sections())
      for (const long number : content_.find_elements(section.elset))
        described.insert(number);
    return described;
  }

  /// A solid that the user does not leave out.
  [[nodiscard]] bool is_read(const DeckElement& element) const {
    return element.solid != nullptr &&
           !ignored_.contains(fmt::format("elements {}", element.type));
  }

  void refuse_others() {
    const std::set<long> described = find_described();
    for (const DeckMass& point : content_.attachments.masses())
      for (const long number : content_.find_elements(point.elset))
        weighed_.insert(number);
    for (const DeckElement& element : content_.elements) {
      if (is_read(element)) continue;
      const auto number = static_cast<long>(element.number);
      const bool is_described = described.contains(number);
      if (find_mark(element.type) && !is_described) continue;
      if (is_point_mass(number) && !ignored_.contains("elements MASS"))
        continue;
      DeckCounts& counts =
          is_edge(element.type) && !is_described ? edges_ : refused_;
      DeckCount& entry = counts[fmt::format("elements {}", element.type)];
      if (entry.count++ == 0) entry.first = content_.place_of(element);
    }
    refused_.insert(content_.constraints.begin(), content_.constraints.end());
    for (const std::string& name : ignored_)
      if (auto entry = refused_.extract(name))
        left_out_.insert(std::move(entry));
    refuse_in_deck(
        refused_,
        "Expected solid elements (C3D4, C3D10, C3D8, C3D20, C3D6, C3D15, C3D5) "
        "and *MASS; beams, shells, rigid bodies and couplings make it a body "
        "of another kind. Leave it out and model it in the scene by links and "
        "joints, "
        "bring the body by its matrices");
  }

  void set_nodes() {
    deck_.x.resize(3, static_cast<Eigen::Index>(content_.nodes.size()));
    for (const auto& [number, x] : content_.nodes) {
      deck_.x.col(static_cast<Eigen::Index>(deck_.nodes.size())) = x;
      deck_.nodes.push_back(number);
    }
  }

  [[noreturn]] void refuse_member(const std::string& set, const char* what,
                                  long number) const {
    const auto place = content_.places.find(set);
    throw InputError(fmt::format(
        "{}: the set {} has {} {}, which is missing. Expected it under *NODE "
        "or *ELEMENT.",
        place == content_.places.end() ? file_.string() : place->second,
        echo(content_.spell(set)), what, number));
  }

  /// Elements of the same sets are a region.
  void set_solids() {
    std::unordered_map<std::size_t, std::vector<std::string>> sets;
    for (const auto& [name, numbers] : content_.element_sets.all())
      for (const long number : std::set<long>(numbers.begin(), numbers.end())) {
        if (content_.find(number) == nullptr)
          refuse_member(name, "element", number);
        sets[static_cast<std::size_t>(number)].push_back(content_.spell(name));
      }
    const SectionOf section_of = find_sections();
    std::map<std::vector<std::string>, int> regions;
    for (const DeckElement& element : content_.elements) {
      if (!is_read(element)) continue;
      check_nodes(element);
      const std::vector<std::string>& names = sets[element.number];
      const auto [region, is_new] =
          regions.try_emplace(names, static_cast<int>(regions.size()));
      if (is_new) {
        deck_.region_groups.push_back(names);
        const auto found = section_of.find(element.number);
        deck_.materials.push_back(
            found == section_of.end()
                ? RegionMaterial{}
                : content_.materials.find(*found->second, content_.spelling));
      }
      append(element.solid->gmsh_type, element.solid->order, element,
             region->second, deck_.solids);
      used_.insert(element.nodes.begin(), element.nodes.end());
    }
  }

  /// Elements of one region have the same section, as it is of a set.
  using SectionOf =
      std::unordered_map<std::size_t, const DeckMaterials::Section*>;
  [[nodiscard]] SectionOf find_sections() const {
    SectionOf sections;
    for (const auto& section : content_.materials.sections()) {
      for (const long number : content_.find_elements(section.elset)) {
        const auto [entry, is_new] =
            sections.emplace(static_cast<std::size_t>(number), &section);
        const DeckMaterials::Section& other = *entry->second;
        if (is_new || (other.elset == section.elset &&
                       other.material == section.material &&
                       other.orientation == section.orientation))
          continue;
        throw InputError(fmt::format(
            "{}: element {} has two sections, of the sets {} and {}. Expected "
            "one.",
            section.place, number, echo(other.elset), echo(section.elset)));
      }
    }
    return sections;
  }

  [[nodiscard]] bool is_point_mass(long number) const {
    const DeckElement* const element = content_.find(number);
    return element != nullptr && element->type == "MASS" &&
           weighed_.contains(number);
  }

  void set_masses() {
    if (ignored_.contains("elements MASS")) return;
    std::set<long> with_mass;
    for (const DeckMass& point : content_.attachments.masses()) {
      const std::vector<long> numbers = content_.find_elements(point.elset);
      if (numbers.empty())
        throw InputError(fmt::format(
            "{}: *MASS has the set {}, which is missing or empty. Expected "
            "one of elements MASS.",
            point.place, echo(point.elset)));
      for (const long number : numbers) {
        if (!is_point_mass(number))
          throw InputError(fmt::format(
              "{}: *MASS has element {}, which is no MASS. Expected a set of "
              "elements MASS.",
              point.place, number));
        const DeckElement& element = *content_.find(number);
        if (element.nodes.size() != 1 || !used_.contains(element.nodes[0]))
          throw InputError(fmt::format(
              "{}: the mass {} is not at one node of a solid. Expected one; a "
              "mass on arms is a link of the scene.",
              content_.place_of(element), number));
        if (!with_mass.insert(number).second)
          throw InputError(
              fmt::format("{}: element {} has a *MASS already. Expected one.",
                          point.place, number));
        deck_.masses[element.nodes[0]] += point.mass;
      }
    }
  }

  void check_nodes(const DeckElement& element) const {
    for (const std::size_t node : element.nodes)
      if (!content_.nodes.contains(node))
        throw InputError(fmt::format(
            "{}: element {} has node {}, which is missing. Expected it under "
            "*NODE.",
            content_.place_of(element), element.number, node));
  }

  static void append(int type, const std::vector<int>& places,
                     const DeckElement& element, int region, RawBlocks& out) {
    RawBlock& block = out[type];
    block.type = type;
    block.nodes_each = static_cast<int>(places.size());
    block.elements.push_back(element.number);
    block.regions.push_back(region);
    for (const int place : places)
      block.nodes.push_back(element.nodes[static_cast<std::size_t>(place)]);
  }

  void set_groups() {
    for (const auto& [name, parts] : content_.surfaces) {
      DeckGroup group{content_.spell(name), 2, {}};
      for (const DeckSurfacePart& part : parts) add_faces(part, group);
      add_group(std::move(group));
    }
    for (const auto& [name, numbers] : content_.element_sets.all()) {
      DeckGroup group{content_.spell(name), 2, {}};
      for (const long number : numbers) add_mark(number, group);
      add_group(std::move(group));
    }
    for (const Keyword& keyword : content_.nodes_of)
      for (const long number : content_.element_sets.get(keyword.get("ELSET")))
        if (const DeckElement* element = content_.find(number))
          for (const std::size_t node : element->nodes)
            content_.node_sets.add(keyword.get("NSET"),
                                   static_cast<long>(node));
    for (const long node : content_.attachments.find_held(content_.node_sets))
      if (used_.contains(static_cast<std::size_t>(node)))
        content_.node_sets.add(kHeldNodes, node);
    for (const auto& [name, numbers] : content_.node_sets.all()) {
      constexpr int kPoint = 15;
      DeckGroup group{content_.spell(name), 0, {}};
      for (const long number : std::set<long>(numbers.begin(), numbers.end())) {
        const auto node = static_cast<std::size_t>(number);
        if (!content_.nodes.contains(node)) refuse_member(name, "node", number);
        append(kPoint, {0}, {.number = node, .nodes = {node}}, 0,
               group.elements);
      }
      add_group(std::move(group));
    }
  }

  /// Under its name, or one that no group has.
  void add_group(DeckGroup group) {
    if (group.elements.empty()) return;
    const auto is_taken = [&] {
      const auto has_name = [&](const DeckGroup& other) {
        return other.name == group.name;
      };
      const auto is_of = [&](const std::vector<std::string>& names) {
        return std::ranges::count(names, group.name) > 0;
      };
      return std::ranges::any_of(deck_.groups, has_name) ||
             std::ranges::any_of(deck_.region_groups, is_of);
    };
    const std::string name = group.name;
    if (is_taken()) group.name += group.dimension == 0 ? ".nodes" : ".faces";
    if (group.name != name)
      deck_.notices.push_back(fmt::format(
          "{}: {} names several sets; that of {} is called {} here.",
          file_.string(), name, group.dimension == 0 ? "nodes" : "faces",
          group.name));
    deck_.groups.push_back(std::move(group));
  }

  void add_faces(const DeckSurfacePart& part, DeckGroup& group) const {
    const std::vector<long> numbers = content_.find_elements(part.of);
    if (numbers.empty())
      throw InputError(
          fmt::format("{}: the surface {} has the set {}, which is missing or "
                      "empty. Expected a set of elements.",
                      part.place, group.name, echo(part.of)));
    for (const long number : numbers) {
      const DeckElement* element = content_.find(number);
      if (element == nullptr || !is_read(*element)) continue;
      const auto& faces = element->solid->faces;
      const auto face = static_cast<std::size_t>(part.face) - 1;
      if (face >= faces.size())
        throw InputError(fmt::format(
            "{}: {} {} has no face S{}. Expected S1 to S{}.", part.place,
            element->type, number, part.face, faces.size()));
      append(faces[face].type, faces[face].places, *element, 0, group.elements);
    }
  }

  void add_mark(long number, DeckGroup& group) const {
    const DeckElement* element = content_.find(number);
    if (element == nullptr || element->solid != nullptr) return;
    const auto mark = find_mark(element->type);
    const auto wanted =
        mark ? static_cast<std::size_t>(mark->second) : std::size_t{0};
    if (!mark || element->nodes.size() != wanted) return;
    std::vector<int> places(wanted);
    for (std::size_t i = 0; i < wanted; ++i) places[i] = static_cast<int>(i);
    append(mark->first, places, *element, 0, group.elements);
  }

  // ---- notices
  void report() {
    deck_.notices.insert(deck_.notices.end(), content_.notices.begin(),
                         content_.notices.end());
    report_unused_nodes();
    report_types();
    const auto tell = [this](const DeckCounts& counts, const char* why) {
      note_in_deck(counts, file_.string(), why, deck_.notices);
    };
    tell(left_out_, "left out as you ask, so that the body lacks them");
    tell(edges_, "left out as edges, as no section describes them");
    tell(content_.laws, "not used, as materials here are linear elastic");
    tell(content_.unused,
         "not used, as supports and loads are those of the scene; nodes of "
         "solids that *BOUNDARY holds in 1, 2 and 3 are the set boundary");
  }

  void report_unused_nodes() {
    constexpr std::size_t kListed = 5;
    Tags unused;
    std::ranges::copy_if(
        deck_.nodes, std::back_inserter(unused),
        [&](std::size_t number) { return !used_.contains(number); });
    if (unused.empty()) return;
    const std::size_t count = unused.size();
    unused.resize(std::min(count, kListed));
    deck_.notices.push_back(fmt::format(
        "{}: {} of {} nodes belong to no solid element and are left out: "
        "{}{}.",
        file_.string(), count, deck_.nodes.size(), fmt::join(unused, ", "),
        count > kListed ? " ..." : ""));
  }

  void report_types() {
    std::set<std::string> others;
    for (const DeckElement& element : content_.elements)
      if (element.solid != nullptr && element.type != element.solid->name)
        others.insert(
            fmt::format("{} as {}", element.type, element.solid->name));
    if (!others.empty())
      deck_.notices.push_back(
          fmt::format("{}: read with the integration of this program: {}.",
                      file_.string(), fmt::join(others, ", ")));
  }

  std::filesystem::path file_;
  DeckContent content_;
  SolidDeck deck_;
  std::set<std::size_t> used_;  // nodes
  DeckCounts refused_;
  std::set<long> weighed_;  // elements of *MASS
  DeckCounts edges_;
  DeckCounts left_out_;
  std::set<std::string> ignored_;
};

}  // namespace

SolidDeck read_solid_deck(const std::filesystem::path& file,
                          const std::vector<std::string>& ignored) {
  return SolidDeckReader(file, ignored).read();
}

}  // namespace limber::fem
