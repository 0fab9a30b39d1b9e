// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/read_nastran_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/nastran/card_counts.hpp"
#include "limber/fem/nastran/card_effect.hpp"
#include "limber/fem/nastran/grid_table.hpp"
#include "limber/fem/nastran/solid_card.hpp"
#include "limber/fem/structural/nastran_properties.hpp"
#include "limber/fem/structural/nastran_rigids.hpp"

namespace limber::fem {
namespace {

bool is_bar(std::string_view name) { return name == "CBAR" || name == "CBEAM"; }

std::size_t count_shell_nodes(std::string_view name) {
  if (name == "CQUAD4" || name == "CQUADR") return 4;
  if (name == "CTRIA3" || name == "CTRIAR") return 3;
  return 0;
}

bool is_solid(std::string_view name) {
  return std::ranges::any_of(
      kSolidCards, [&](const SolidCard& card) { return card.name == name; });
}

bool is_whole(std::string_view field) {  // an integer, no real number
  return !field.empty() &&
         field.find_first_not_of("+-0123456789") == std::string_view::npos;
}

constexpr std::string_view kAllComponents = "123456";

constexpr std::string_view kReadCards =
    "Expected CBAR, CBEAM, CQUAD4, CTRIA3, solids, CONM2, RBE2, RBE3 and RBAR; "
    "a body with others comes by its matrices";

/// Of the structure, as solids alone are read by read_bulk_data.
constexpr std::array<std::string_view, 12> kBesideSolids = {
    "CBAR",  "CBEAM", "CQUAD4", "CQUADR", "CTRIA3", "CTRIAR",
    "CONM2", "RBE2",  "RBE3",   "RBAR",   "SPC",    "SPC1"};

class StructureReader {
 public:
  StructureReader(const std::filesystem::path& file,
                  const std::set<std::string>& ignored)
      : deck_(read_deck(file)),
        problems_(deck_),
        grids_(problems_),
        properties_(problems_),
        nodes_(problems_),
        ignored_(ignored) {
    structure_.source = file.string();
  }

  Structure read() {
    CardReader reader(deck_, problems_);
    BulkCard card;
    while (reader.next(card)) add(card);
    const CardCounts left_out = extract_ignored(ignored_, refused_);
    refuse_cards(refused_, "is not read among beams and shells", kReadCards,
                 problems_);
    note_left_out(deck_, left_out, structure_.notices);
    number_nodes();
    for (const BulkCard& one : solids_) add_solid(one);
    for (const BulkCard& one : beams_) add_beam(one);
    for (const BulkCard& one : shells_) add_shell(one);
    for (const BulkCard& one : masses_) add_mass(one);
    find_turning();
    for (const BulkCard& one : rigids_) add_rigid(one);
    for (const BulkCard& one : supports_) add_support(one);
    problems_.check();
    for (auto& [name, nodes] : sets_)
      structure_.sets.push_back({name, {nodes.begin(), nodes.end()}});
    report();
    return std::move(structure_);
  }

 private:
  void add(const BulkCard& card) {
    if (ignored_.contains(std::string(card.name))) {
      count_card(card, refused_);
    } else if (is_bar(card.name)) {
      beams_.push_back(card);
    } else if (count_shell_nodes(card.name) > 0) {
      shells_.push_back(card);
    } else if (card.name == "CONM2") {
      masses_.push_back(card);
    } else if (card.name == "RBE2" || card.name == "RBAR" ||
               card.name == "RBE3") {
      rigids_.push_back(card);
    } else if (is_solid(card.name)) {
      solids_.push_back(card);
    } else if (card.name == "GRID" || card.name == "GRDSET") {
      add_point(card);
    } else if (is_coordinate_system(card.name)) {
      grids_.add_system(card);
    } else if (card.name == "SPC" || card.name == "SPC1") {
      supports_.push_back(card);
      count_card(card, unused_);
    } else if (card.name == "PARAM") {
      add_parameter(card);
    } else if (!properties_.add(card)) {
      add_other(card);
    }
  }

  void add_point(const BulkCard& card) {
    count_supports(card, unused_);
    if (card.name == "GRID") {
      grids_.add_grid(card);
    } else {
      grids_.add_default(card);
    }
  }

  void add_parameter(const BulkCard& card) {
    if (card.field(0) != "WTMASS") return;
    structure_.mass_factor = card.real(1, problems_).value_or(1.0);
    if (!(structure_.mass_factor > 0.0))
      problems_.add(*card.line, "WTMASS is not > 0. Expected a factor.");
  }

  void add_other(const BulkCard& card) {
    const CardEffect effect = find_card_effect(card.name);
    if (effect == CardEffect::outside) {
      count_card(card, unused_);
    } else if (effect != CardEffect::none) {
      count_card(card, refused_);
    }
  }

  void number_nodes() {
    std::vector<int> ids;
    for (const auto& [id, grid] : grids_.grids()) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    structure_.x.resize(3, std::ssize(ids));
    for (const int id : ids) {
      const auto n = static_cast<int>(structure_.tags.size());
      structure_.x.col(n) = grids_.find_position(grids_.grids().at(id));
      axes_.push_back(grids_.find_motion_axes(grids_.grids().at(id)));
      structure_.tags.push_back(static_cast<std::size_t>(id));
      nodes_.add(id, n);
    }
  }

  std::optional<Vector3> find_vector(const BulkCard& card, std::size_t field) {
    Vector3 v;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = card.real(field + i, problems_);
      if (!value) return std::nullopt;
      v[static_cast<Eigen::Index>(i)] = *value;
    }
    return v;
  }

  bool take_number(const BulkCard& card) {
    const std::optional<int> id = card.integer(0, std::nullopt, problems_);
    if (!id) return false;
    if (*id > 0 && elements_.insert(*id).second) return true;
    problems_.add(*card.line,
                  fmt::format("element {} is there twice, or below 1. Expected "
                              "a number of its own.",
                              *id));
    return false;
  }

  void refuse_given(const BulkCard& card, std::size_t first, std::size_t last,
                    const char* what) {
    for (std::size_t i = first; i <= last; ++i)
      if (!card.field(i).empty() && card.field(i) != "0")
        return problems_.add(
            *card.line, fmt::format("{} {}: {} is not read. Expected none.",
                                    card.name, echo(card.field(0)), what));
  }

  /// Position in a list of the property with this number, made on first use.
  template <typename Property, typename Find>
  std::optional<int> take_property(int id, std::map<int, int>& known,
                                   std::vector<Property>& list,
                                   const Find& find) {
    const auto found = known.find(id);
    if (found != known.end()) return found->second;
    const std::optional<Property> property = find();
    if (!property) return std::nullopt;
    known[id] = static_cast<int>(list.size());
    list.push_back(*property);
    return known[id];
  }

  void add_to_set(const std::string& name, const std::vector<int>& nodes) {
    sets_[name].insert(nodes.begin(), nodes.end());
  }

  /// Its matrices are of read_structure_solids.
  void add_solid(const BulkCard& card) {
    if (!take_number(card)) return;
    for (std::size_t field = 2; field < card.fields.size(); ++field)
      if (!card.field(field).empty() && card.field(field) != "0")
        if (const std::optional<int> node = nodes_.find(card, field))
          solid_nodes_.insert(*node);
  }

  void add_beam(const BulkCard& given) {
    const BulkCard card = properties_.fill_bar(given);
    if (!take_number(card)) return;
    const std::optional<int> number = card.integer(0, std::nullopt, problems_);
    const std::optional<int> id =
        card.integer(1, card.integer(0, std::nullopt, problems_), problems_);
    const std::optional<int> a = nodes_.find(card, 2);
    const std::optional<int> b = nodes_.find(card, 3);
    if (!card.field(7).empty() && card.field(7) != "GGG")
      problems_.add(
          *card.line,
          fmt::format("{} {}: OFFT is {}. Expected GGG, or blank.", card.name,
                      echo(card.field(0)), echo(card.field(7))));
    refuse_given(card, 8, 9, "a hinge (PA, PB)");
    if (card.name == "CBEAM")
      refuse_given(card, 16, 17, "a warping point (SA, SB)");
    const std::optional<Vector3> from_a = find_vector(card, 10);
    const std::optional<Vector3> from_b = find_vector(card, 13);
    if (!id || !a || !b || !from_a || !from_b) return;
    const std::optional<Vector3> up = find_up(card, *a);
    const std::optional<int> property =
        take_property(*id, beam_of_, structure_.beam_properties,
                      [&] { return properties_.find_beam(*id, *card.line); });
    if (!up || !property) return;
    structure_.beams.push_back(
        {{*a, *b},
         *property,
         *up,
         {axes_[index(*a)] * *from_a, axes_[index(*b)] * *from_b},
         deck_.place_of(*card.line),
         static_cast<std::size_t>(*number)});
    add_to_set(std::to_string(*id), {*a, *b});
  }

  /// X1, X2, X3 in the axes of the first node, or towards the point G0.
  std::optional<Vector3> find_up(const BulkCard& card, int a) {
    const bool is_point = is_whole(card.field(4)) && card.field(5).empty() &&
                          card.field(6).empty();
    if (!is_point) {
      const std::optional<Vector3> v = find_vector(card, 4);
      if (!v) return std::nullopt;
      return Vector3(axes_[index(a)] * *v);
    }
    const std::optional<int> point = nodes_.find(card, 4);
    if (!point) return std::nullopt;
    return Vector3(structure_.x.col(*point) - structure_.x.col(a));
  }

  void add_shell(const BulkCard& card) {
    if (!take_number(card)) return;
    const std::optional<int> id =
        card.integer(1, card.integer(0, std::nullopt, problems_), problems_);
    const std::size_t count = count_shell_nodes(card.name);
    StructureShell shell;
    for (std::size_t i = 0; i < count; ++i)
      if (const std::optional<int> node = nodes_.find(card, 2 + i))
        shell.nodes.push_back(*node);
    if (!id || shell.nodes.size() != count) return;
    const std::size_t angle = 2 + count;
    const std::optional<int> laminate =
        take_property(*id, shell_of_, structure_.laminates,
                      [&] { return properties_.find_shell(*id, *card.line); });
    if (!laminate || !set_axis(card, angle, shell)) return;
    shell.laminate = *laminate;
    shell.offset = card.real(angle + 1, problems_).value_or(0.0);
    refuse_given(card, 9, 9 + count, "a thickness of its own (TFLAG, Ti)");
    shell.place = deck_.place_of(*card.line);
    add_to_set(std::to_string(*id), shell.nodes);
    structure_.shells.push_back(std::move(shell));
  }

  /// THETA, or the x axis of a rectangular system (MCID).
  bool set_axis(const BulkCard& card, std::size_t field,
                StructureShell& shell) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    if (!is_whole(card.field(field))) {
      const std::optional<double> angle = card.real(field, problems_);
      shell.angle = kDegree * angle.value_or(0.0);
      return angle.has_value();
    }
    const std::optional<int> system =
        card.integer(field, std::nullopt, problems_);
    if (!system) return false;
    const std::optional<Matrix3> axes = grids_.find_axes(*system, *card.line);
    if (axes) shell.axis = axes->col(0);
    return axes.has_value();
  }

  void add_mass(const BulkCard& card) {
    if (!take_number(card)) return;
    const std::optional<int> node = nodes_.find(card, 1);
    const std::optional<int> system = card.integer(2, 0, problems_);
    const std::optional<double> mass = card.real(3, problems_);
    const std::optional<Vector3> offset = find_vector(card, 4);
    Vector6 I;
    for (int i = 0; i < 6; ++i)
      I[i] = card.real(8 + index(i), problems_).value_or(0.0);
    if (!node || !system || !mass || !offset) return;
    if (!(*mass >= 0.0))
      return problems_.add(*card.line,
                           fmt::format("CONM2 {}: M is {}. Expected M >= 0.",
                                       echo(card.field(0)), *mass));
    Matrix3 inertia;
    inertia << I[0], -I[1], -I[3], -I[1], I[2], -I[4], -I[3], -I[4], I[5];
    const std::optional<Matrix3> axes =
        grids_.find_axes(std::max(*system, 0), *card.line);
    if (!axes) return;
    // CID -1: the centre of mass itself, in the basic system.
    const Vector3 from_node = *system < 0
                                  ? Vector3(*offset - structure_.x.col(*node))
                                  : Vector3(*axes * *offset);
    structure_.masses.push_back({*node, *mass, from_node,
                                 *axes * inertia * axes->transpose(),
                                 deck_.place_of(*card.line)});
  }

  void add_rigid(const BulkCard& card) {
    if (!take_number(card)) return;
    add_nastran_rigid(card, deck_.place_of(*card.line), nodes_, turning_,
                      problems_, structure_);
  }

  /// Nodes of beams and shells, and those that lead or are led.
  void find_turning() {
    for (const StructureBeam& beam : structure_.beams)
      turning_.insert(beam.nodes.begin(), beam.nodes.end());
    for (const StructureShell& shell : structure_.shells)
      turning_.insert(shell.nodes.begin(), shell.nodes.end());
    for (const BulkCard& card : rigids_) {
      const std::size_t field = card.name == "RBE3" ? 2 : 1;
      if (const std::optional<int> node = nodes_.find(card, field))
        turning_.insert(*node);
    }
  }

  /// Nodes that are held in all the components that they have.
  void add_support(const BulkCard& card) {
    const std::string name = fmt::format("spc:{}", card.field(0));
    const auto hold = [&](std::string_view components,
                          const std::vector<int>& nodes) {
      for (const int node : nodes)
        if (components == kAllComponents ||
            (components == "123" && solid_nodes_.contains(node) &&
             !turning_.contains(node)))
          add_to_set(name, {node});
    };
    std::size_t field = 2;
    if (card.name == "SPC1") {
      hold(card.field(1), nodes_.read_list(card, field));
    } else {
      for (const std::size_t i : {std::size_t{1}, std::size_t{4}})
        if (!card.field(i).empty())
          if (const std::optional<int> node = nodes_.find(card, i))
            hold(card.field(i + 1), {*node});
    }
  }

  void report() {
    structure_.found.push_back(
        fmt::format("{}: {} beams, {} shells, {} solids, {} masses, {} rigid "
                    "elements",
                    deck_.files[0].filename().string(), structure_.beams.size(),
                    structure_.shells.size(), solids_.size(),
                    structure_.masses.size(), rigids_.size()));
    structure_.has_solids = !solids_.empty();
    structure_.beside_solids = {kBesideSolids.begin(), kBesideSolids.end()};
    for (const std::filesystem::path& file : deck_.files)
      structure_.files.push_back(file);
    if (!unused_.empty())
      structure_.notices.push_back(fmt::format(
          "{}: not used: {}. Supports and loads are those of the scene; nodes "
          "that SPC and SPC1 hold in all components are the sets spc:SID.",
          structure_.source, list_counts(deck_, unused_)));
    for (const std::string& notice : properties_.notices())
      structure_.notices.push_back(
          fmt::format("{}: {}.", structure_.source, notice));
    if (!deck_.has_end)
      structure_.notices.push_back(
          fmt::format("{}: it has no ENDDATA, so whether it is complete is not "
                      "known.",
                      structure_.source));
  }

  Deck deck_;
  DeckProblems problems_;
  GridTable grids_;
  NastranProperties properties_;
  Structure structure_;
  std::vector<BulkCard> solids_, beams_, shells_, masses_, rigids_, supports_;
  std::set<int> solid_nodes_;
  NastranNodes nodes_;
  std::set<int> turning_;  // nodes with rotations
  std::unordered_set<int> elements_;
  std::map<int, int> beam_of_, shell_of_;  // by number of a property
  std::map<std::string, std::set<int>> sets_;
  CardCounts unused_;
  CardCounts refused_;
  std::vector<Matrix3> axes_;  // of displacements (CD), beside the nodes
  const std::set<std::string>& ignored_;
};

}  // namespace

bool is_nastran_structure(const std::filesystem::path& file,
                          const std::set<std::string>& ignored) {
  const Deck deck = read_deck(file);
  DeckProblems problems(deck);
  CardReader reader(deck, problems);
  BulkCard card;
  bool has_elements = false;
  bool has_property = false;
  while (reader.next(card)) {
    if (ignored.contains(std::string(card.name))) continue;
    has_elements |= is_bar(card.name) || count_shell_nodes(card.name) > 0;
    has_property |= is_property(card.name) && card.name != "PSOLID";
  }
  return has_elements && has_property;
}

Structure read_nastran_structure(const std::filesystem::path& file,
                                 const std::set<std::string>& ignored) {
  return StructureReader(file, ignored).read();
}

}  // namespace limber::fem
