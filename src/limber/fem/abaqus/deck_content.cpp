// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/deck_content.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>
#include <set>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

/// Of a body; they would be lost.
constexpr std::array<std::string_view, 14> kConstraints = {
    "EQUATION",
    "MPC",
    "TIE",
    "RIGID BODY",
    "COUPLING",
    "KINEMATIC COUPLING",
    "DISTRIBUTING COUPLING",
    "EMBEDDED ELEMENT",
    "SHELL TO SOLID COUPLING",
    "CYCLIC SYMMETRY MODEL",
    "CONTACT PAIR",
    "CONTACT",
    "PRE-TENSION SECTION",
    "SUBSTRUCTURE PROPERTY"};

/// They make or move nodes and elements.
constexpr std::array<std::string_view, 7> kGenerators = {
    "SYSTEM", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"};

/// Of the scene.
constexpr std::array<std::string_view, 12> kOutside = {
    "BOUNDARY",    "CLOAD",       "DLOAD",
    "DSLOAD",      "TEMPERATURE", "INITIAL CONDITIONS",
    "BASE MOTION", "FILM",        "RADIATE",
    "CFLUX",       "DFLUX",       "MODEL CHANGE"};

/// Of materials, beside linear elasticity.
constexpr std::array<std::string_view, 6> kLaws = {
    "PLASTIC",   "CREEP",   "VISCOELASTIC",
    "EXPANSION", "DAMPING", "CYCLIC HARDENING"};

template <typename List>
bool has_keyword(const List& list, std::string_view name) {
  return std::ranges::find(list, name) != list.end();
}

std::string find_place(const TextScanner& at) {
  return fmt::format("{}:{}", at.file().string(), at.number());
}

void count(const TextScanner& at, const std::string& what, DeckCounts& counts) {
  DeckCount& entry = counts[what];
  if (entry.count++ == 0) entry.first = find_place(at);
}

class ContentReader {
 public:
  DeckContent read(const std::filesystem::path& file) {
    read_keyword_deck(file,
                      {[this](const TextScanner& at, const Keyword& keyword) {
                         begin(at, keyword);
                         return is_used();
                       },
                       [this](const TextScanner& at, std::string_view line) {
                         add_data(at, line);
                       }});
    if (is_in_part_ || !moves_.empty())
      throw InputError(
          fmt::format("{}: the file ends within *{}. Expected *END "
                      "{} before.",
                      file.string(), is_in_part_ ? "PART" : "INSTANCE",
                      is_in_part_ ? "PART" : "INSTANCE"));
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
    return has_keyword(kUsed, keyword_.name);
  }

  void begin(const TextScanner& at, const Keyword& keyword) {
    if (!element_.empty())
      at.fail("the element before it is not complete. Expected more nodes.");
    keyword_ = keyword;
    const std::string& name = keyword_.name;
    for (const char* key : {"ELSET", "NSET", "NAME"})
      if (keyword_.has(key))
        deck_.spelling.try_emplace(keyword_.get(key), keyword_.spelled[key]);
    if (has_keyword(kGenerators, name) ||
        (name == "NODE" && keyword_.has("SYSTEM") &&
         keyword_.get("SYSTEM") != "R"))
      at.fail(fmt::format(
          "*{} makes or moves nodes. Expected all of them, in the global axes, "
          "under *NODE and *ELEMENT.",
          echo(name)));
    if (begin_part(at, name)) return;
    if (has_keyword(kConstraints, name))
      count(at, "*" + name, deck_.constraints);
    if (has_keyword(kOutside, name)) count(at, "*" + name, deck_.unused);
    if (has_keyword(kLaws, name)) count(at, "*" + name, deck_.laws);
    deck_.materials.begin(at, keyword_);
    if (name == "SURFACE" && keyword_.has("TYPE") &&
        keyword_.get("TYPE") == "NODE")
      keyword_.name = "SURFACE OF NODES";
    if (name == "NSET" && keyword_.has("ELSET"))
      deck_.nodes_of.push_back(keyword_);
  }

  /// *PART, *INSTANCE and their ends. A part's content is its instance's.
  bool begin_part(const TextScanner& at, const std::string& name) {
    if (name == "PART") {
      if (is_in_part_) at.fail("*PART within a *PART. Expected *END PART.");
      is_in_part_ = true;
      part_ = keyword_.get("NAME");
      std::swap(deck_, outer_);
    } else if (name == "END PART") {
      if (!is_in_part_) at.fail("*END PART without *PART.");
      is_in_part_ = false;
      std::swap(deck_, outer_);
      parts_[part_] = std::exchange(outer_, {});
    } else if (name == "INSTANCE") {
      if (!instance_.empty())
        at.fail(
            "a second *INSTANCE. Expected one part of one instance: several "
            "are not one body.");
      instance_ = keyword_.get("NAME");
      part_ = keyword_.get("PART");
      if (!parts_.contains(part_))
        at.fail(
            fmt::format("*INSTANCE has the part {}, which is missing. "
                        "Expected its *PART before.",
                        echo(part_)));
      moves_ = {{}};
    } else if (name == "END INSTANCE") {
      if (moves_.empty()) at.fail("*END INSTANCE without *INSTANCE.");
      deck_.take(std::exchange(parts_[part_], {}), find_pose(at));
      moves_.clear();
    } else {
      return false;
    }
    return true;
  }

  /// A line of translation, and one of two points and an angle [degrees] about
  /// the axis through them, in that order.
  Pose find_pose(const TextScanner& at) const {
    Pose pose;
    const std::size_t lines = moves_.size() - 1;  // the first is empty
    if (lines > 0) pose.p = {moves_[1].at(0), moves_[1].at(1), moves_[1].at(2)};
    if (lines < 2) return pose;
    const std::vector<double>& turn = moves_[2];
    const Vector3 a(turn.at(0), turn.at(1), turn.at(2));
    const Vector3 b(turn.at(3), turn.at(4), turn.at(5));
    if (!((b - a).norm() > 0.0))
      at.fail("*INSTANCE turns about an axis without length.");
    Pose turned;
    turned.R = Eigen::AngleAxisd(turn.at(6) * std::numbers::pi / 180.0,
                                 (b - a).normalized())
                   .matrix();
    turned.p = a - turned.R * a;
    return turned * pose;
  }

  void add_move(const TextScanner& at, std::string_view line) {
    constexpr std::array<std::size_t, 2> kCounts = {3, 7};
    const std::size_t number = moves_.size();  // from 1
    const std::vector<std::string_view> fields = split_commas(line);
    std::vector<double>& move = moves_.emplace_back(7, 0.0);
    if (number > kCounts.size() || fields.size() > kCounts[number - 1])
      at.fail(
          "*INSTANCE has a line too many or too long. Expected a translation "
          "of three numbers, and two points and an angle.");
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (!fields[i].empty() && !parse_real(fields[i], move[i]))
        at.fail(fmt::format("'{}' is no finite number. Expected one.",
                            echo(fields[i])));
  }

  /// Without the instance's name before those of its sets.
  [[nodiscard]] std::string strip_instance(std::string_view line) const {
    std::string text(line);
    if (instance_.empty()) return text;
    const std::string prefix = instance_ + ".";
    for (std::size_t at = 0;
         (at = to_upper(text).find(prefix, at)) != std::string::npos;) {
      const bool is_start =
          at == 0 || text[at - 1] == ',' || text[at - 1] == ' ';
      if (is_start) text.erase(at, prefix.size());
      at += is_start ? 0 : prefix.size();
    }
    return text;
  }

  void add_data(const TextScanner& at, std::string_view given) {
    const std::string& name = keyword_.name;
    const bool is_set = name == "NSET" || name == "ELSET" ||
                        name == "SURFACE" || name == "BOUNDARY" ||
                        name == "MASS";
    const std::string stripped = is_set ? strip_instance(given) : std::string();
    const std::string_view line = is_set ? stripped : given;
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
    } else if (deck_.materials.add_data(at, keyword_, line) ||
               deck_.attachments.add_data(at, keyword_, line)) {
      return;
    } else if (name == "INSTANCE") {
      add_move(at, line);
    }
  }

  void add_node(const TextScanner& at, std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    const long number = read_deck_number(at, fields[0], "node");
    Vector3 x = Vector3::Zero();
    for (std::size_t i = 1; i < std::min<std::size_t>(fields.size(), 4); ++i) {
      double value = 0.0;
      if (!fields[i].empty() && !parse_real(fields[i], value))
        at.fail(fmt::format("'{}' is no finite number. Expected one.",
                            echo(fields[i])));
      x[static_cast<Eigen::Index>(i) - 1] = value;
    }
    if (!deck_.nodes.emplace(static_cast<std::size_t>(number), x).second)
      at.fail(fmt::format("node {} is there twice. Expected each node once.",
                          number));
    deck_.node_sets.add(keyword_.get("NSET"), number);
  }

  /// Number, nodes; a line that ends in a comma goes on.
  void add_element(const TextScanner& at, std::string_view line) {
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

  static void check_solid(const TextScanner& at, const DeckElement& element) {
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

  void add_surface(const TextScanner& at, std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    long face = 0;
    const bool is_face = fields.size() > 1 && fields[1].size() == 2 &&
                         (fields[1][0] == 'S' || fields[1][0] == 's') &&
                         parse_whole(fields[1].substr(1), face);
    if (!is_face) {  // of shells, or the free faces of a set
      count(at, "*SURFACE without faces S1, S2, ...", deck_.unused);
      return;
    }
    deck_.surfaces[keyword_.get("NAME")].push_back(
        {find_place(at), to_upper(std::string(fields[0])),
         static_cast<int>(face)});
  }

  std::size_t find_file(const TextScanner& at) {
    if (deck_.files.empty() || deck_.files.back() != at.file())
      deck_.files.push_back(at.file());
    return deck_.files.size() - 1;
  }

  DeckContent deck_;
  Keyword keyword_;
  std::vector<long> element_;  // numbers of one that goes on
  DeckContent outer_;          // of the file, while in a part
  std::map<std::string, DeckContent> parts_;
  bool is_in_part_ = false;
  std::string part_;                        // last named
  std::string instance_;                    // empty: none yet
  std::vector<std::vector<double>> moves_;  // lines of an open instance
};

}  // namespace

void DeckContent::take(DeckContent part, const Pose& pose) {
  const std::size_t first_file = files.size();
  files.insert(files.end(), part.files.begin(), part.files.end());
  for (const auto& [number, x] : part.nodes) nodes[number] = pose * x;
  for (DeckElement& element : part.elements) {
    element.file += first_file;
    element.type = *types.insert(std::string(element.type)).first;
    index[element.number] = elements.size();
    elements.push_back(std::move(element));
  }
  node_sets.merge(part.node_sets);
  element_sets.merge(part.element_sets);
  nodes_of.insert(nodes_of.end(), part.nodes_of.begin(), part.nodes_of.end());
  surfaces.merge(part.surfaces);
  materials.take(std::move(part.materials), pose);
  attachments.take(std::move(part.attachments));
  spelling.merge(part.spelling);
  constraints.merge(part.constraints);
  unused.merge(part.unused);
  laws.merge(part.laws);
}

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
