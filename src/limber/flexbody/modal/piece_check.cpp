// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/piece_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"

namespace limber::flexbody {
namespace {

constexpr double kTolerable = 0.01;

bool is_smaller(const PieceDifference& a, const PieceDifference& b) {
  return std::abs(a.error()) < std::abs(b.error());
}

void add_largest(const std::vector<PieceDifference>& among,
                 std::vector<PieceDifference>& to) {
  if (among.empty()) return;
  to.push_back(*std::max_element(among.begin(), among.end(), is_smaller));
}

std::vector<PieceDifference> compare_frequencies(const PieceAssembly& whole,
                                                 const PieceAssembly& pieces) {
  const VectorX exact = whole.find_frequencies(kComparedFrequencies);
  const VectorX found = pieces.find_frequencies(kComparedFrequencies);
  std::vector<PieceDifference> all;
  for (Eigen::Index i = 0; i < std::min(exact.size(), found.size()); ++i) {
    all.push_back({fmt::format("elastic frequency {} of the {} link", i + 1,
                               whole.is_free() ? "free" : "clamped"),
                   "Hz", exact[i], found[i]});
  }
  return all;
}

/// "(0, 0.6, 0.8)", its largest component positive.
std::string describe_direction(const Vector3& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  const double sign = direction[largest] < 0.0 ? -1.0 : 1.0;
  std::vector<std::string> numbers;
  for (const double x : direction) {
    const double rounded = std::round(sign * x * 1000.0) / 1000.0;
    numbers.push_back(fmt::format("{:g}", rounded + 0.0));
  }
  return fmt::format("({})", fmt::join(numbers, ", "));
}

/// Along the principal directions of the whole.
std::vector<PieceDifference> compare_directions(const Matrix3& whole,
                                                const Matrix3& pieces,
                                                const std::string& kind,
                                                const std::string& place,
                                                const std::string& unit) {
  constexpr double kStiff = 1e-6;
  const dense::Eigenpairs3 principal = dense::find_eigenpairs(whole);
  std::vector<PieceDifference> all;
  for (int i = 0; i < 3; ++i) {
    const double exact = principal.values[i];
    if (!(exact > kStiff * principal.values[2])) continue;
    const Vector3 direction = principal.vectors.col(i);
    all.push_back({fmt::format("flexibility {} {} {}", kind,
                               describe_direction(direction), place),
                   unit, exact, direction.dot(pieces * direction)});
  }
  return all;
}

/// Name of the first interface that holds a free link; empty without one.
std::string find_held_interface(const ReducedBody& whole) {
  for (const InterfaceTable& table : whole.interfaces)
    if (table.rotation_rank() == 3) return table.name;
  return {};
}

void append(const std::vector<PieceDifference>& more,
            std::vector<PieceDifference>& to) {
  to.insert(to.end(), more.begin(), more.end());
}

/// Interfaces on the same nodes as the one that is held do not move: their
/// flexibility relative to it is round-off.
bool moves(const InterfaceTable& table, const Matrix6& held_flexibility) {
  constexpr double kRoundoff = 1e-8;
  return held_flexibility.topLeftCorner<3, 3>().trace() >
         kRoundoff * table.flexibility.topLeftCorner<3, 3>().trace();
}

}  // namespace

Recipe make_whole_recipe(const Recipe& of_pieces) {
  Recipe recipe;
  recipe.name = of_pieces.name;
  recipe.mesh = of_pieces.mesh;
  recipe.materials = of_pieces.materials;
  recipe.clamped_groups = of_pieces.clamped_groups;
  if (of_pieces.basis.interface_modes) {
    for (const InterfaceRequest& request : of_pieces.interfaces)
      if (request.static_modes) recipe.interfaces.push_back(request);
  }
  // The responses of two interfaces span the lowest modes.
  recipe.basis.eigenmodes =
      recipe.interfaces.size() < 2 ? kComparedFrequencies : 0;
  recipe.is_estimate = true;
  recipe.rows = parse_rows({"interfaces"});
  return recipe;
}

std::vector<PieceDifference> compare_pieces(
    const std::shared_ptr<const ReducedBody>& whole,
    const PieceAssembly::Bodies& pieces) {
  const PieceAssembly one({whole});
  const PieceAssembly several(pieces);
  std::vector<PieceDifference> largest;
  add_largest(compare_frequencies(one, several), largest);
  const std::string held =
      one.is_free() ? find_held_interface(*whole) : std::string();
  if (one.is_free() && held.empty()) return largest;
  std::vector<PieceDifference> along, about;
  for (const InterfaceTable& table : whole->interfaces) {
    if (table.name == held) continue;
    const Matrix6 exact = one.find_flexibility(table.name, held);
    if (!moves(table, exact)) continue;
    const Matrix6 found = several.find_flexibility(table.name, held);
    const std::string place =
        fmt::format("at '{}'{}", table.name,
                    held.empty() ? "" : fmt::format(" with '{}' held", held));
    append(
        compare_directions(exact.topLeftCorner<3, 3>(),
                           found.topLeftCorner<3, 3>(), "along", place, "m/N"),
        along);
    append(compare_directions(exact.bottomRightCorner<3, 3>(),
                              found.bottomRightCorner<3, 3>(), "about", place,
                              "rad/(N m)"),
           about);
  }
  add_largest(along, largest);
  add_largest(about, largest);
  return largest;
}

std::string describe_largest(const PieceCheck& check) {
  if (check.differences.empty())
    return "not compared with the whole link: " + check.obstacle;
  const PieceDifference& worst = *std::max_element(
      check.differences.begin(), check.differences.end(), is_smaller);
  return fmt::format("differ from the whole link by {:.2g} % at most, in {}",
                     100.0 * std::abs(worst.error()), worst.quantity);
}

std::optional<std::string> describe_excess(const PieceCheck& check) {
  if (check.differences.empty())
    return fmt::format("its {} pieces are {}", check.count,
                       describe_largest(check));
  std::vector<std::string> texts;
  bool is_stiff = false;
  for (const PieceDifference& one : check.differences) {
    if (std::abs(one.error()) <= kTolerable) continue;
    texts.push_back(fmt::format("{} is {:.4g} instead of {:.4g} {} ({:+.2g} %)",
                                one.quantity, one.pieces, one.whole, one.unit,
                                100.0 * one.error()));
    is_stiff |= (one.unit == "Hz") == (one.error() > 0.0);
  }
  if (texts.empty()) return std::nullopt;
  return fmt::format(
      "its {} pieces differ from the whole link: {}. {}", check.count,
      fmt::join(texts, "; "),
      is_stiff ? "They are too stiff: give them more eigenmodes"
               : "Sections can warp at cuts: give fewer pieces, a finer mesh, "
                 "or one that is swept in layers");
}

}  // namespace limber::flexbody
