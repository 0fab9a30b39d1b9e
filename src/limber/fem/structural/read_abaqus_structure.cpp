// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/read_abaqus_structure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/abaqus/deck_attachments.hpp"
#include "limber/fem/abaqus/deck_counts.hpp"
#include "limber/fem/abaqus/keyword_effect.hpp"
#include "limber/fem/structural/abaqus_sections.hpp"
#include "limber/fem/structural/abaqus_ties.hpp"
#include "limber/fem/text/flat_deck.hpp"

namespace limber::fem {
namespace {

enum class LineKind { none, node, element, nset, elset, mass, section, tie };

bool is_shell_type(std::string_view type, std::string_view name) {
  return type == name || (type.size() == name.size() + 1 &&
                          type.starts_with(name) && type.back() == 'R');
}

/// Nodes of an element type; 0: it is not read.
std::size_t count_type_nodes(std::string_view type) {
  if (type == "MASS") return 1;
  if (type == "B31" || type == "B31R") return 2;
  if (is_shell_type(type, "S3")) return 3;
  if (is_shell_type(type, "S4")) return 4;
  return 0;
}

constexpr const char* kReadKeywords =
    "Expected *NODE, *ELEMENT of B31, S3, S4 (or S4R), solids (C3D4, C3D10, "
    "C3D8, C3D20, C3D6, C3D15, C3D5) and MASS, sections, *MASS, *RIGID BODY, "
    "*COUPLING and *MPC";

class StructureDeckReader {
 public:
  StructureDeckReader(const std::filesystem::path& file,
                      const std::set<std::string>& ignored)
      : ignored_(ignored) {
    structure_.source = file.string();
    structure_.files.push_back(file);
  }

  Structure read() {
    structure_.notices = read_flat_deck(
        structure_.files[0],
        {[this](const DeckPlace& at, const Keyword& keyword, const Pose& pose) {
           note_file(at);
           return begin(at, keyword, pose);
         },
         [this](const DeckPlace& at, std::string_view line) {
           note_file(at);
           add_data(at, line);
         }});
    if (!element_.empty())
      throw InputError(fmt::format(
          "{}: the last element is not complete. Expected more nodes.",
          structure_.source));
    refuse_in_deck(refused_, kReadKeywords);
    number_nodes();
    for (const AbaqusSection& section : sections_.sections()) assign(section);
    add_masses();
    check_described();
    ties_.add_to(mesh_, find_turning(), structure_);
    add_sets();
    report();
    return std::move(structure_);
  }

 private:
  void note_file(const DeckPlace& at) {
    if (std::ranges::find(structure_.files, at.file()) ==
        structure_.files.end())
      structure_.files.push_back(at.file());
  }

  /// @returns whether its data are read from another file, too
  bool begin(const DeckPlace& at, const Keyword& keyword, const Pose& pose) {
    if (!element_.empty())
      at.fail("the element before it is not complete. Expected more nodes.");
    keyword_ = keyword;
    const std::string& name = keyword.name;
    for (const char* key : {"NSET", "ELSET"})
      if (keyword.has(key))
        spelling_.try_emplace(keyword.get(key), keyword_.spelled[key]);
    if (name == "NSET" || name == "ELSET") require_name(at, keyword, name);
    if (keyword.has("NSET"))
      places_.try_emplace(keyword.get("NSET"), at.text());
    is_in_step_ = name == "STEP" || (is_in_step_ && name != "END STEP");
    kind_ = LineKind::none;
    if (is_ignored(name)) {
      count_in_deck(at, "*" + name, left_out_);
    } else if (ties_.begin(at, keyword)) {
      kind_ = LineKind::tie;
    } else if (sections_.begin(at, keyword, pose)) {
      kind_ = LineKind::section;
    } else if (name == "NODE") {
      if (keyword.has("SYSTEM") && keyword.get("SYSTEM") != "R")
        at.fail("*NODE in other coordinates. Expected global ones.");
      kind_ = LineKind::node;
    } else if (name == "ELEMENT") {
      begin_elements(at);
    } else if (name == "NSET") {
      kind_ = LineKind::nset;
      if (keyword.has("ELSET"))
        at.fail("*NSET with ELSET is not read. Expected numbers of nodes.");
    } else if (name == "ELSET") {
      kind_ = LineKind::elset;
    } else if (name == "MASS") {
      begin_mass(at);
    } else {
      begin_other(at);
    }
    return name == "NODE" || name == "ELEMENT" || name == "NSET" ||
           name == "ELSET" || name == "INCLUDE" || name == "SURFACE";
  }

  /// *KINEMATIC and *DISTRIBUTING go with the *COUPLING before them.
  [[nodiscard]] bool is_ignored(const std::string& name) const {
    return ignored_.contains(name) ||
           ((name == "KINEMATIC" || name == "DISTRIBUTING") &&
            ignored_.contains("COUPLING"));
  }

  void begin_elements(const DeckPlace& at) {
    const std::string type = keyword_.get("TYPE");
    solid_ = find_solid_type(type);
    if (ignored_.contains(type))
      return count_in_deck(at, "elements " + type, left_out_);
    if (solid_ == nullptr && count_type_nodes(type) == 0)
      return count_in_deck(at, "elements " + type, refused_);
    kind_ = LineKind::element;
    structure_.has_solids |= solid_ != nullptr;
    if (solid_ == nullptr)
      beside_.insert(type);
    else if (type != solid_->name)
      integrated_.insert(fmt::format("{} as {}", type, solid_->name));
  }

  void begin_mass(const DeckPlace& at) {
    kind_ = LineKind::mass;
    require_isotropic_mass(at, keyword_);
    masses_.push_back({at.text(), keyword_.get("ELSET"), -1.0});
  }

  void begin_other(const DeckPlace& at) {
    const std::string what = "*" + keyword_.name;
    const KeywordEffect effect = find_keyword_effect(keyword_.name);
    if (effect == KeywordEffect::outside || effect == KeywordEffect::law) {
      count_in_deck(at, what, unused_);
    } else if (effect == KeywordEffect::none) {
      if (keyword_.name.ends_with("SECTION"))
        solid_sections_.emplace_back(keyword_.get("ELSET"), at.text());
    } else if (effect != KeywordEffect::unknown || !is_in_step_) {
      count_in_deck(at, what, refused_);
    }
  }

  void add_data(const DeckPlace& at, std::string_view line) {
    switch (kind_) {
      case LineKind::node:
        return add_node(at, line);
      case LineKind::element:
        return add_element(at, line);
      case LineKind::nset:
        return mesh_.node_sets.add_line(at, keyword_, keyword_.get("NSET"),
                                        line);
      case LineKind::elset:
        return mesh_.element_sets.add_line(at, keyword_, keyword_.get("ELSET"),
                                           line);
      case LineKind::mass:
        return add_mass(at, line);
      case LineKind::section:
        return sections_.add_data(at, line);
      case LineKind::tie:
        return ties_.add_data(at, line);
      case LineKind::none:
        return;
    }
  }

  void add_node(const DeckPlace& at, std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    const long number = read_deck_number(at, fields[0], "node");
    if (!points_.emplace(number, read_deck_point(at, fields)).second)
      at.fail(fmt::format("node {} is there twice. Expected each node once.",
                          number));
    mesh_.node_sets.add(keyword_.get("NSET"), number);
  }

  /// Number, nodes; a line that ends in a comma goes on.
  void add_element(const DeckPlace& at, std::string_view line) {
    for (const std::string_view field : split_commas(line))
      if (!field.empty())
        element_.push_back(read_deck_number(at, field, "element or node"));
    if (line.ends_with(',') || element_.empty()) return;
    const long number = element_[0];
    InputElement element{keyword_.get("TYPE"),
                         solid_,
                         {element_.begin() + 1, element_.end()},
                         at.text()};
    element_.clear();
    // B31 may have a third node for the direction of its section.
    const std::size_t wanted = solid_ != nullptr
                                   ? static_cast<std::size_t>(solid_->nodes)
                                   : count_type_nodes(element.type);
    if (element.nodes.size() != wanted)
      at.fail(fmt::format("{} {} has {} nodes. Expected {}.", element.type,
                          number, element.nodes.size(), wanted));
    if (std::set<int>(element.nodes.begin(), element.nodes.end()).size() !=
        wanted)
      at.fail(fmt::format("{} {} has a node twice. Expected different nodes.",
                          element.type, number));
    mesh_.element_sets.add(keyword_.get("ELSET"), number);
    if (!mesh_.elements.emplace(number, std::move(element)).second)
      at.fail(fmt::format(
          "element {} is there twice. Expected a number of its own.", number));
  }

  void add_mass(const DeckPlace& at, std::string_view line) {
    DeckMass& point = masses_.back();
    if (point.mass >= 0.0) at.fail("*MASS has a second line. Expected one.");
    point.mass = read_deck_real(at, split_commas(line)[0]);
    if (!(point.mass >= 0.0)) at.fail("*MASS is below 0. Expected a mass.");
  }

  void number_nodes() {
    structure_.x.resize(3, std::ssize(points_));
    for (const auto& [number, x] : points_) {
      const auto n = static_cast<int>(structure_.tags.size());
      structure_.x.col(n) = x;
      structure_.tags.push_back(static_cast<std::size_t>(number));
      mesh_.nodes[number] = n;
    }
    for (auto& [number, element] : mesh_.elements)
      for (int& node : element.nodes)
        node = mesh_.find_node(node, element.place);
    mesh_.x = structure_.x;
  }

  void assign(const AbaqusSection& section) {
    const std::set<long> numbers =
        mesh_.list_elements(section.elset, section.place);
    const int property = make_property(section);
    const std::optional<Vector3> axis = sections_.find_shell_axis(section);
    for (const long number : numbers) {
      const InputElement& element = mesh_.elements.at(number);
      const bool is_beam = element.type.starts_with('B');
      if (element.type == "MASS" || element.solid != nullptr ||
          is_beam != section.is_beam)
        throw InputError(fmt::format(
            "{}: element {} is a {}. Expected a section of its own kind.",
            section.place, number, element.type));
      if (!described_.insert(number).second)
        throw InputError(fmt::format(
            "{}: element {} has another section already. Expected one.",
            section.place, number));
      if (is_beam) {
        structure_.beams.push_back({{element.nodes[0], element.nodes[1]},
                                    property,
                                    AbaqusSections::find_beam_axis(section),
                                    {Vector3::Zero(), Vector3::Zero()},
                                    element.place,
                                    static_cast<std::size_t>(number)});
      } else {
        StructureShell shell;
        shell.nodes = element.nodes;
        shell.laminate = property;
        shell.axis = axis.value_or(mesh_.find_default_axis(element));
        shell.place = element.place;
        structure_.shells.push_back(std::move(shell));
      }
    }
  }

  int make_property(const AbaqusSection& section) {
    if (section.is_beam) {
      structure_.beam_properties.push_back(sections_.make_beam(section));
      return static_cast<int>(structure_.beam_properties.size()) - 1;
    }
    structure_.laminates.push_back(sections_.make_shell(section));
    return static_cast<int>(structure_.laminates.size()) - 1;
  }

  void add_masses() {
    if (ignored_.contains("MASS")) return;
    for (const DeckMass& point : masses_) {
      if (!(point.mass >= 0.0))
        throw InputError(
            fmt::format("{}: *MASS has no mass. Expected one.", point.place));
      for (const long number : mesh_.list_elements(point.elset, point.place)) {
        const InputElement& element = mesh_.elements.at(number);
        if (element.type != "MASS" || !described_.insert(number).second)
          throw InputError(fmt::format(
              "{}: element {} of *MASS is a {}{}. Expected a MASS, once.",
              point.place, number, element.type,
              element.type == "MASS" ? " that has a mass already" : ""));
        StructureMass body;
        body.node = element.nodes[0];
        body.mass = point.mass;
        body.place = element.place;
        structure_.masses.push_back(std::move(body));
      }
    }
  }

  void check_described() const {
    for (const auto& [elset, place] : solid_sections_)
      mesh_.require_solids(elset, place);
    for (const auto& [number, element] : mesh_.elements)
      if (element.solid == nullptr && !described_.contains(number))
        throw InputError(fmt::format(
            "{}: {} {} has no section. Expected a *BEAM SECTION, *SHELL "
            "SECTION or *MASS of a set with it.",
            element.place, element.type, number));
  }

  [[nodiscard]] std::set<int> find_turning() const {
    std::set<int> turning;
    for (const StructureBeam& beam : structure_.beams)
      turning.insert(beam.nodes.begin(), beam.nodes.end());
    for (const StructureShell& shell : structure_.shells)
      turning.insert(shell.nodes.begin(), shell.nodes.end());
    return turning;
  }

  void add_set(const std::string& name, const std::set<int>& nodes) {
    const auto spelled = spelling_.find(name);
    const std::string own = spelled == spelling_.end() ? name : spelled->second;
    const bool is_there = std::ranges::any_of(
        structure_.sets,
        [&](const MatrixNodeSet& other) { return other.name == own; });
    if (!is_there && !nodes.empty())
      structure_.sets.push_back({own, {nodes.begin(), nodes.end()}});
  }

  void add_sets() {
    for (const auto& [name, numbers] : mesh_.node_sets.all()) {
      std::set<int> nodes;
      for (const long number : numbers)
        nodes.insert(mesh_.find_node(number, places_.at(name)));
      add_set(name, nodes);
    }
    for (const auto& [name, numbers] : mesh_.element_sets.all()) {
      std::set<int> nodes;
      for (const long number : numbers) {
        const auto found = mesh_.elements.find(number);
        if (found != mesh_.elements.end())
          nodes.insert(found->second.nodes.begin(), found->second.nodes.end());
      }
      add_set(name, nodes);
    }
  }

  void report() {
    structure_.found.push_back(fmt::format(
        "{}: {} beams, {} shells, {} solids, {} masses, {} rigid "
        "bodies and couplings",
        structure_.files[0].filename().string(), structure_.beams.size(),
        structure_.shells.size(),
        std::ranges::count_if(
            mesh_.elements,
            [](const auto& one) { return one.second.solid != nullptr; }),
        structure_.masses.size(), ties_.size()));
    structure_.beside_solids = {"*RIGID BODY", "*COUPLING", "*MPC"};
    structure_.beside_solids.insert(structure_.beside_solids.end(),
                                    beside_.begin(), beside_.end());
    if (!integrated_.empty())
      structure_.notices.push_back(
          fmt::format("{}: read with the integration of this program: {}.",
                      structure_.source, fmt::join(integrated_, ", ")));
    const auto tell = [this](const DeckCounts& counts, const char* why) {
      note_in_deck(counts, structure_.source, why, structure_.notices);
    };
    tell(left_out_, "left out as you ask, so that the body lacks them");
    tell(unused_,
         "not used, as supports and loads are those of the scene and materials "
         "are linear elastic");
  }

  Structure structure_;
  AbaqusSections sections_;
  Keyword keyword_;
  LineKind kind_ = LineKind::none;
  std::map<long, Vector3> points_;
  AbaqusMesh mesh_;
  AbaqusTies ties_;
  const SolidType* solid_ = nullptr;  // of the elements that come
  std::set<std::string> beside_;      // types of elements that are no solids
  std::set<std::string> integrated_;  // solids with another integration
  std::vector<long> element_;         // numbers of one that goes on
  std::set<long> described_;
  std::vector<std::pair<std::string, std::string>> solid_sections_;  // places
  std::vector<DeckMass> masses_;
  std::map<std::string, std::string> spelling_;
  std::map<std::string, std::string> places_;  // of sets of nodes
  DeckCounts unused_;
  DeckCounts refused_;
  DeckCounts left_out_;
  const std::set<std::string>& ignored_;
  bool is_in_step_ = false;
};

}  // namespace

bool is_abaqus_structure(const std::filesystem::path& file,
                         const std::set<std::string>& ignored) {
  bool has_structural = false;
  bool has_section = false;
  bool has_solid = false;
  bool has_tie = false;
  read_keyword_deck(file, {[&](const TextScanner&, const Keyword& keyword) {
                             const std::string& name = keyword.name;
                             const std::string type = keyword.get("TYPE");
                             if (ignored.contains(name)) return false;
                             if (name == "ELEMENT" && !ignored.contains(type)) {
                               has_solid |= find_solid_type(type) != nullptr;
                               has_structural |= count_type_nodes(type) > 1;
                             }
                             has_section |= name == "BEAM SECTION" ||
                                            name == "SHELL SECTION";
                             has_tie |= name == "RIGID BODY" ||
                                        name == "COUPLING" || name == "MPC";
                             return name == "INCLUDE";
                           },
                           [](const TextScanner&, std::string_view) {}});
  return (has_structural && has_section) || (has_solid && has_tie);
}

Structure read_abaqus_structure(const std::filesystem::path& file,
                                const std::set<std::string>& ignored) {
  return StructureDeckReader(file, ignored).read();
}

}  // namespace limber::fem
