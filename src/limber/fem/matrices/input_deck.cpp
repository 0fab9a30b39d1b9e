// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/input_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/text/deck_sets.hpp"
#include "limber/fem/text/keyword_deck.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

using DeckShape = ModelElement::Shape;

/// By the beginning of its name; none: it is not drawn.
std::optional<DeckShape> find_deck_shape(const std::string& type) {
  constexpr std::array<std::pair<std::string_view, DeckShape>, 20> kTypes = {{
      {"C3D4", DeckShape::tetra},   {"C3D10", DeckShape::tetra},
      {"C3D5", DeckShape::pyramid}, {"C3D6", DeckShape::wedge},
      {"C3D15", DeckShape::wedge},  {"C3D8", DeckShape::hexa},
      {"C3D20", DeckShape::hexa},   {"SC6", DeckShape::wedge},
      {"SC8", DeckShape::hexa},     {"STRI", DeckShape::triangle},
      {"S3", DeckShape::triangle},  {"S6", DeckShape::triangle},
      {"S4", DeckShape::quad},      {"S8", DeckShape::quad},
      {"S9", DeckShape::quad},      {"M3D3", DeckShape::triangle},
      {"M3D4", DeckShape::quad},    {"B3", DeckShape::line},
      {"T3D", DeckShape::line},     {"PIPE3", DeckShape::line},
  }};
  for (const auto& [name, shape] : kTypes)
    if (type.starts_with(name)) return shape;
  return std::nullopt;
}

class InputDeckReader {
 public:
  InputDeck read(const std::filesystem::path& file) {
    deck_.model.file = file;
    deck_.model.format = "input file";
    read_keyword_deck(file,
                      {[this](const TextScanner& at, const Keyword& keyword) {
                         scanner_ = &at;
                         begin(keyword);
                         return is_used();
                       },
                       [this](const TextScanner& at, std::string_view line) {
                         scanner_ = &at;
                         add_data(line);
                       }});
    finish_coupling();
    for (auto& [name, nodes] : sets_) {
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      deck_.model.sets.push_back({name, nodes});
    }
    return std::move(deck_);
  }

 private:
  [[nodiscard]] bool is_used() const {
    return keyword_.name == "INCLUDE" || keyword_.name == "NODE" ||
           keyword_.name == "ELEMENT" || keyword_.name == "NSET" ||
           keyword_.name == "BOUNDARY" || keyword_.name == "EQUATION";
  }

  [[noreturn]] void refuse(const std::string& what) const {
    scanner_->fail("*" + echo(keyword_.name) + " " + what);
  }

  void begin(Keyword keyword) {
    if (continued_)
      refuse("has a line that ends in a comma. Expected more data after it.");
    finish_equation();
    keyword_ = std::move(keyword);
    const std::string& name = keyword_.name;
    if (name != "KINEMATIC" && name != "DISTRIBUTING") finish_coupling();
    if (name == "STEP") in_step_ = true;
    if (name == "INSTANCE" && ++instances_ > 1)
      refuse(
          "a second time. Expected one instance: its nodes have other "
          "numbers in the matrices; write a flat input file.");
    if (name == "SYSTEM" || name == "NGEN" || name == "NFILL" ||
        name == "NCOPY" || name == "NMAP")
      refuse(
          "generates or moves nodes. Expected their coordinates in the "
          "global axes, under *NODE.");
    if (name == "NODE" && keyword_.has("SYSTEM") &&
        keyword_.get("SYSTEM") != "R")
      refuse("with SYSTEM. Expected coordinates in the global axes.");
    if (name == "TRANSFORM") deck_.has_transform = true;
    if (name == "RIGID BODY") begin_rigid();
    if (name == "COUPLING") begin_coupling();
    if (name == "KINEMATIC" && coupling_) coupling_->translations = {};
    if (name == "DISTRIBUTING" || name == "DISTRIBUTING COUPLING" ||
        name == "MPC" || name == "TIE" || name == "KINEMATIC COUPLING")
      deck_.has_other_constraints = true;
    if (name == "DISTRIBUTING") coupling_.reset();
    is_elset_ = name == "ELSET";
    if (name == "NSET" && keyword_.has("ELSET"))
      add_nodes_of(keyword_.get("ELSET"), sets_[keyword_.get("NSET")]);
  }

  void add_data(std::string_view line) {
    const std::string& name = keyword_.name;
    if (name == "NODE") {
      add_node(line);
    } else if (name == "ELEMENT") {
      add_element(line);
    } else if (name == "NSET") {
      add_to_set(line, keyword_.get("NSET"));
    } else if (name == "ELSET") {
      add_to_set(line, keyword_.get("ELSET"));
    } else if (name == "BOUNDARY" && !in_step_) {
      add_boundary(line);
    } else if (name == "EQUATION" && !in_step_) {
      add_equation(line);
    } else if (name == "KINEMATIC" && coupling_) {
      add_kinematic(line);
    } else if (name == "SURFACE" && keyword_.get("TYPE") == "NODE") {
      const std::vector<std::string_view> fields = split_commas(line);
      add_nodes_of_field(fields[0], surfaces_[keyword_.get("NAME")]);
    } else if (name == "INSTANCE") {
      refuse(
          "moves its part. Expected one instance that is not moved: write "
          "a flat input file.");
    }
  }

  long read_number(std::string_view field, const char* what) const {
    return read_deck_number(*scanner_, field, what);
  }

  double read_real(std::string_view field) const {
    double value = 0.0;
    if (!field.empty() && !parse_real(field, value))
      scanner_->fail(fmt::format("'{}' is not a finite number. Expected one.",
                                 echo(field)));
    return value;
  }

  void add_node(std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    const long node = read_number(fields[0], "node");
    const auto [found, is_new] = lines_.try_emplace(node, scanner_->number());
    if (!is_new)
      scanner_->fail(fmt::format(
          "node {} is given twice, first on line {}. Expected each node once.",
          node, found->second));
    Vector3 x = Vector3::Zero();
    for (std::size_t i = 0; i < 3 && i + 1 < fields.size(); ++i)
      x[static_cast<Eigen::Index>(i)] = read_real(fields[i + 1]);
    deck_.model.tags.push_back(node);
    deck_.model.x.push_back(x);
    if (keyword_.has("NSET")) sets_[keyword_.get("NSET")].push_back(node);
  }

  /// Number, nodes; a line that ends in a comma continues.
  void add_element(std::string_view line) {
    if (!continued_) element_.clear();
    for (const std::string_view field : split_commas(line))
      if (!field.empty())
        element_.push_back(read_number(field, "element or node"));
    continued_ = line.ends_with(',');
    if (continued_ || element_.empty()) return;
    const std::vector<long> nodes(element_.begin() + 1, element_.end());
    if (keyword_.has("ELSET")) {
      std::vector<long>& set = element_nodes_[keyword_.get("ELSET")];
      set.insert(set.end(), nodes.begin(), nodes.end());
    }
    nodes_of_element_[element_[0]] = nodes;
    const auto shape = find_deck_shape(keyword_.get("TYPE"));
    if (!shape) return;
    std::size_t corners = count_corners(*shape);
    ModelElement element{*shape, nodes};
    if (nodes.size() < corners) return;
    // Three nodes of a quadratic beam; of others the third gives a direction.
    const bool is_quadratic = keyword_.get("TYPE").find("32") == 1 ||
                              keyword_.get("TYPE").find("32") == 4;
    if (*shape == DeckShape::line && is_quadratic && nodes.size() > 2)
      element.corners = {nodes[0], nodes[2]};
    element.corners.resize(corners);
    deck_.model.elements.push_back(std::move(element));
  }

  void add_to_set(std::string_view line, const std::string& name) {
    std::map<std::string, std::vector<long>>& all =
        is_elset_ ? element_nodes_ : sets_;
    std::vector<long>& set = all[name];
    const auto append = [&set](std::vector<long> nodes) {
      set.insert(set.end(), nodes.begin(), nodes.end());
    };
    read_set_line(*scanner_, keyword_, line,
                  {[&](long number) {
                     if (!is_elset_) return set.push_back(number);
                     const auto found = nodes_of_element_.find(number);
                     if (found != nodes_of_element_.end())
                       append(found->second);
                   },
                   [&](const std::string& other) {
                     const auto found = all.find(other);
                     if (found == all.end()) return false;
                     append(found->second);
                     return true;
                   }});
  }

  void add_nodes_of(const std::string& element_set, std::vector<long>& set) {
    const auto found = element_nodes_.find(element_set);
    if (found != element_nodes_.end())
      set.insert(set.end(), found->second.begin(), found->second.end());
  }

  /// A node, or those of a set.
  void add_nodes_of_field(std::string_view field, std::vector<long>& nodes) {
    long node = 0;
    if (parse_whole(field, node)) {
      nodes.push_back(node);
      return;
    }
    const auto found = sets_.find(to_upper(std::string(field)));
    if (found != sets_.end())
      nodes.insert(nodes.end(), found->second.begin(), found->second.end());
  }

  void add_boundary(std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    std::vector<long> nodes;
    add_nodes_of_field(fields[0], nodes);
    long first = 1;
    long last = 6;
    if (fields.size() > 1 && !parse_whole(fields[1], first)) {
      if (begins_with_word(fields[1], "PINNED")) last = 3;
    } else if (fields.size() > 1) {
      last = first;
      if (fields.size() > 2 && !fields[2].empty())
        last = read_number(fields[2], "degree of freedom");
    }
    for (const long node : nodes)
      for (long dof = first; dof <= std::min(last, 6L); ++dof)
        deck_.fixed.push_back({node, static_cast<int>(dof)});
  }

  /// Number of terms; then node, dof, factor, several a line.
  void add_equation(std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    if (terms_ == 0) {
      terms_ = static_cast<std::size_t>(read_number(fields[0], "count"));
      equation_ = {
          fmt::format("{}:{}", scanner_->file().string(), scanner_->number()),
          {}};
      return;
    }
    for (std::size_t i = 0; i + 2 < fields.size(); i += 3) {
      const long dof = read_number(fields[i + 1], "degree of freedom");
      std::vector<long> nodes;
      add_nodes_of_field(fields[i], nodes);
      if (nodes.size() != 1 || dof > 6) {
        deck_.has_other_constraints = true;  // between sets
        nodes.resize(1, 0);
      }
      equation_.terms.push_back(
          {{nodes[0], static_cast<int>(std::min(dof, 7L))},
           read_real(fields[i + 2])});
    }
    if (equation_.terms.size() >= terms_) finish_equation();
  }

  void finish_equation() {
    if (terms_ != 0 && equation_.terms.size() != terms_)
      throw InputError(fmt::format(
          "{}: {} terms of an equation that states {}. Expected as many.",
          equation_.place, equation_.terms.size(), terms_));
    if (terms_ != 0) deck_.equations.push_back(std::move(equation_));
    terms_ = 0;
  }

  void begin_rigid() {
    DeckRigid rigid;
    rigid.place =
        fmt::format("{}:{}", scanner_->file().string(), scanner_->number());
    if (!parse_whole(keyword_.get("REF NODE"), rigid.reference) ||
        (keyword_.has("ROT NODE") &&
         !parse_whole(keyword_.get("ROT NODE"), rigid.rotation))) {
      deck_.has_other_constraints = true;
      return;
    }
    if (keyword_.has("NSET"))
      add_nodes_of_field(keyword_.get("NSET"), rigid.nodes);
    add_nodes_of(keyword_.get("ELSET"), rigid.nodes);
    deck_.rigids.push_back(std::move(rigid));
  }

  void begin_coupling() {
    DeckRigid rigid;
    rigid.place =
        fmt::format("{}:{}", scanner_->file().string(), scanner_->number());
    const auto surface = surfaces_.find(keyword_.get("SURFACE"));
    if (surface == surfaces_.end() || keyword_.has("ORIENTATION") ||
        !parse_whole(keyword_.get("REF NODE"), rigid.reference)) {
      deck_.has_other_constraints = true;
      return;
    }
    rigid.nodes = surface->second;
    coupling_ = std::move(rigid);
  }

  /// Directions that follow the reference node.
  void add_kinematic(std::string_view line) {
    const std::vector<std::string_view> fields = split_commas(line);
    const long first = read_number(fields[0], "degree of freedom");
    const long last = fields.size() > 1 && !fields[1].empty()
                          ? read_number(fields[1], "degree of freedom")
                          : first;
    for (long dof = first; dof <= std::min(last, 3L); ++dof)
      coupling_->translations[static_cast<std::size_t>(dof) - 1] = true;
  }

  void finish_coupling() {
    if (coupling_) deck_.rigids.push_back(std::move(*coupling_));
    coupling_.reset();
  }

  InputDeck deck_;
  const TextScanner* scanner_ = nullptr;
  Keyword keyword_;
  bool in_step_ = false;
  bool is_elset_ = false;
  bool continued_ = false;
  int instances_ = 0;
  std::vector<long> element_;
  std::size_t terms_ = 0;
  DeckEquation equation_;
  std::optional<DeckRigid> coupling_;
  std::map<std::string, std::vector<long>> sets_;
  std::map<std::string, std::vector<long>> surfaces_;
  std::map<std::string, std::vector<long>> element_nodes_;  // of an ELSET
  std::unordered_map<long, std::vector<long>> nodes_of_element_;
  std::unordered_map<long, std::size_t> lines_;
};

}  // namespace

InputDeck read_input_deck(const std::filesystem::path& file) {
  return InputDeckReader().read(file);
}

}  // namespace limber::fem
