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
#include "limber/fem/structural/abaqus_keywords.hpp"
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

class StructureDeckReader {
 public:
  explicit StructureDeckReader(const std::filesystem::path& file) {
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
    if (loses_motion(name))
      at.fail(
          fmt::format("*{} is not read among beams and shells and would be "
                      "lost. Expected *NODE, *ELEMENT, sections, *MASS, "
                      "*RIGID BODY, *COUPLING and *MPC.",
                      name));
    for (const char* key : {"NSET", "ELSET"})
      if (keyword.has(key))
        spelling_.try_emplace(keyword.get(key), keyword_.spelled[key]);
    kind_ = LineKind::none;
    if (ties_.begin(at, keyword)) {
      kind_ = LineKind::tie;
    } else if (sections_.begin(at, keyword, pose)) {
      kind_ = LineKind::section;
    } else if (name == "NODE") {
      if (keyword.has("SYSTEM") && keyword.get("SYSTEM") != "R")
        at.fail("*NODE in other coordinates. Expected global ones.");
      kind_ = LineKind::node;
    } else if (name == "ELEMENT") {
      kind_ = LineKind::element;
      solid_ = find_solid_type(keyword.get("TYPE"));
      structure_.has_solids |= solid_ != nullptr;
      if (solid_ == nullptr && count_type_nodes(keyword.get("TYPE")) == 0)
        at.fail(fmt::format(
            "elements {} are not read among beams and shells. Expected B31, "
            "S3, S4 (or S4R), solids (C3D4, C3D10, C3D8, C3D20, C3D6, C3D15, "
            "C3D5) and MASS.",
            echo(keyword.get("TYPE"))));
      if (solid_ == nullptr)
        beside_.insert(keyword.get("TYPE"));
      else if (keyword.get("TYPE") != solid_->name)
        integrated_.insert(
            fmt::format("{} as {}", keyword.get("TYPE"), solid_->name));
    } else if (name == "NSET") {
      kind_ = LineKind::nset;
      if (keyword.has("ELSET"))
        at.fail("*NSET with ELSET is not read. Expected numbers of nodes.");
    } else if (name == "ELSET") {
      kind_ = LineKind::elset;
    } else if (name == "MASS") {
      kind_ = LineKind::mass;
    } else if (!is_of_analysis(name)) {
      ++unused_[name];
    }
    return kind_ == LineKind::node || kind_ == LineKind::element ||
           kind_ == LineKind::nset || kind_ == LineKind::elset ||
           name == "INCLUDE" || name == "SURFACE";
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
    const double mass = read_deck_real(at, split_commas(line)[0]);
    if (!(mass >= 0.0)) at.fail("*MASS is below 0. Expected a mass.");
    masses_[keyword_.get("ELSET")] = mass;
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
    const std::vector<long> numbers = mesh_.element_sets.get(section.elset);
    if (numbers.empty())
      throw InputError(fmt::format(
          "{}: its set of elements {} is missing or empty. Expected one.",
          section.place, echo(section.elset)));
    const int property = make_property(section);
    const std::optional<Vector3> axis = sections_.find_shell_axis(section);
    for (const long number : numbers) {
      const auto found = mesh_.elements.find(number);
      if (found == mesh_.elements.end())
        throw InputError(fmt::format(
            "{}: its set {} has element {}, which is missing. Expected it "
            "under *ELEMENT.",
            section.place, section.elset, number));
      const InputElement& element = found->second;
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
        shell.axis = axis.value_or(find_default_axis(element));
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

  /// x, or z where x is within 0.1 degrees of the normal (Abaqus' convention).
  [[nodiscard]] Vector3 find_default_axis(const InputElement& element) const {
    constexpr double kAlong = 0.9999984769132877;  // cos 0.1 degrees
    const auto at = [&](std::size_t i) {
      return Vector3(structure_.x.col(element.nodes[i]));
    };
    const std::size_t last = element.nodes.size() - 1;
    const Vector3 n = (at(2) - at(0)).cross(at(last) - at(1)).normalized();
    return std::abs(n.x()) > kAlong ? Vector3::UnitZ() : Vector3::UnitX();
  }

  void add_masses() {
    for (const auto& [elset, mass] : masses_)
      for (const long number : mesh_.element_sets.get(elset)) {
        const auto found = mesh_.elements.find(number);
        if (found == mesh_.elements.end() || found->second.type != "MASS")
          continue;
        described_.insert(number);
        StructureMass body;
        body.node = found->second.nodes[0];
        body.mass = mass;
        body.place = found->second.place;
        structure_.masses.push_back(std::move(body));
      }
  }

  void check_described() const {
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
        nodes.insert(mesh_.find_node(number, structure_.source));
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
    std::vector<std::string> unused;
    for (const auto& [name, count] : unused_)
      unused.push_back(fmt::format("{} *{}", count, name));
    if (!unused.empty())
      structure_.notices.push_back(fmt::format(
          "{}: not used: {}. Supports and loads are those of the scene.",
          structure_.source, fmt::join(unused, ", ")));
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
  std::map<std::string, double> masses_;  // by set of elements
  std::map<std::string, std::string> spelling_;
  std::map<std::string, int> unused_;
};

}  // namespace

bool is_abaqus_structure(const std::filesystem::path& file, bool with_solids) {
  bool has_structural = false;
  bool has_section = false;
  bool has_solid = false;
  bool has_tie = false;
  read_keyword_deck(file, {[&](const TextScanner&, const Keyword& keyword) {
                             const std::string& name = keyword.name;
                             const std::string type = keyword.get("TYPE");
                             if (name == "ELEMENT") {
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
  if (has_solid && !with_solids) return false;
  return (has_structural && has_section) || (has_solid && has_tie);
}

Structure read_abaqus_structure(const std::filesystem::path& file) {
  return StructureDeckReader(file).read();
}

}  // namespace limber::fem
