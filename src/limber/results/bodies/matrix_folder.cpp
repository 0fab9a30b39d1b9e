// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/bodies/matrix_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/results/bodies/body_coordinates.hpp"

namespace limber::results {
namespace {

/// A displacement of a node: index of the node, component from 0.
struct NodeRow {
  std::size_t node = 0;
  Eigen::Index component = 0;

  bool operator<(const NodeRow& other) const {
    return std::pair(node, component) < std::pair(other.node, other.component);
  }
};

/// Independent rows, each the farthest from the span of those before it.
class RowChoice {
 public:
  explicit RowChoice(MatrixX candidates)
      : rest_(std::move(candidates)),
        least_(kDependent * rest_.rowwise().norm().maxCoeff()) {}

  /// The farthest row, which is taken; -1 if all depend on those taken.
  Eigen::Index choose() {
    Eigen::Index best = -1;
    if (!(rest_.rowwise().norm().maxCoeff(&best) > least_)) return -1;
    direction_ = rest_.row(best).transpose().normalized();
    take(direction_);
    return best;
  }

  /// Without the part along a unit vector.
  void take(const VectorX& unit) {
    rest_ -= (rest_ * unit).eval() * unit.transpose();
  }

  /// Of the row taken last, across those before it.
  [[nodiscard]] const VectorX& direction() const { return direction_; }

 private:
  static constexpr double kDependent = 1e-6;
  MatrixX rest_;
  double least_;
  VectorX direction_;
};

struct ChosenRows {
  std::vector<NodeRow> own;    // sorted
  std::vector<NodeRow> other;  // recovered, sorted
  MatrixX coordinates;         // rows of q in z: own, then modal ones
};

ChosenRows choose_coordinates(const flexbody::ReducedBody& body,
                              const std::vector<BodyNode>& nodes) {
  const VectorX scales = find_scales(body);
  const Eigen::Index n = scales.size();
  std::vector<NodeRow> all;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (Eigen::Index c = 0; c < nodes[i].rows.rows(); ++c)
      all.push_back({i, c});
  MatrixX candidates(std::ssize(all), n);
  const double radius = 1.0 / scales[3];
  for (std::size_t i = 0; i < all.size(); ++i)
    candidates.row(static_cast<Eigen::Index>(i)) =
        (all[i].component < 3 ? 1.0 : radius) *
        nodes[all[i].node].rows.row(all[i].component) * scales.asDiagonal();
  RowChoice choice(std::move(candidates));
  RowChoice modal(MatrixX::Identity(n, n));
  ChosenRows chosen;
  std::vector<char> is_own(all.size(), 0);
  while (std::ssize(chosen.own) < n) {
    const Eigen::Index best = choice.choose();
    if (best < 0) break;
    modal.take(choice.direction());
    is_own[static_cast<std::size_t>(best)] = 1;
    chosen.own.push_back(all[static_cast<std::size_t>(best)]);
  }
  std::sort(chosen.own.begin(), chosen.own.end());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!is_own[i]) chosen.other.push_back(all[i]);
  chosen.coordinates = MatrixX::Zero(n, n);
  Eigen::Index row = 0;
  for (const NodeRow& own : chosen.own)
    chosen.coordinates.row(row++) = nodes[own.node].rows.row(own.component);
  for (; row < n; ++row) {
    const Eigen::Index coordinate = modal.choose();
    LIMBER_EXPECT(coordinate >= 0);
    chosen.coordinates(row, coordinate) = 1.0;
  }
  return chosen;
}

void add_values(const MatrixX& A, std::string& text) {
  for (const double value : A.reshaped())
    fmt::format_to(std::back_inserter(text), "{:.17g}\n", value);
}

std::string to_market(const MatrixX& A) {
  std::string text = fmt::format(
      "%%MatrixMarket matrix array real general\n{} {}\n", A.rows(), A.cols());
  add_values(A, text);
  return text;
}

std::string list_positions(const flexbody::ReducedBody& body,
                           const std::vector<BodyNode>& nodes) {
  std::string text =
      fmt::format("# {}, {:.17g} kg, SI units\n", body.name, body.mass);
  for (const BodyNode& node : nodes)
    if (!node.interface.empty())
      text +=
          fmt::format("# node {}: interface {}\n", node.tag, node.interface);
  text += "node,x,y,z\n";
  for (const BodyNode& node : nodes) {
    const Vector3 x = node.x_B + body.p_MoBcm_M;
    text +=
        fmt::format("{},{:.17g},{:.17g},{:.17g}\n", node.tag, x[0], x[1], x[2]);
  }
  return text;
}

std::string list_rows(const std::vector<BodyNode>& nodes,
                      const std::vector<NodeRow>& rows, Eigen::Index count) {
  std::string text = "row,node,component\n";
  Eigen::Index i = 0;
  for (const NodeRow& row : rows)
    text +=
        fmt::format("{},{},{}\n", ++i, nodes[row.node].tag, row.component + 1);
  while (i < count) text += fmt::format("{},0,0\n", ++i);
  return text;
}

}  // namespace

void write_matrix_folder(const std::filesystem::path& folder,
                         const flexbody::ReducedBody& body) {
  require_free(body);
  if (!body.inertia_record.gap.empty())
    throw InputError(fmt::format(
        "body '{}' has no second moments of its mass, which the matrices would "
        "have: {}",
        body.name, body.inertia_record.gap));
  const std::vector<BodyNode> nodes = list_nodes(body);
  ChosenRows chosen = choose_coordinates(body, nodes);
  const BodyMatrices made = transform(body, chosen.coordinates, 0.0);
  const Eigen::Index n = made.K.rows();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("{}: this folder cannot be made: {}",
                                 folder.string(), error.message()));
  write_whole(folder / "K.mtx", to_market(made.K));
  write_whole(folder / "M.mtx", to_market(made.M));
  constexpr std::array<const char*, 6> kNames = {"xx", "yy", "zz",
                                                 "xy", "xz", "yz"};
  for (std::size_t p = 0; p < kNames.size(); ++p)
    write_whole(folder / fmt::format("S_{}.mtx", kNames[p]),
                to_market(made.S[p]));
  write_whole(folder / "nodes.csv", list_positions(body, nodes));
  write_whole(folder / "rows.csv", list_rows(nodes, chosen.own, n));
  if (chosen.other.empty()) return;
  // A square matrix, and tables of one size, would be taken for the model's.
  if (std::ssize(chosen.other) == n) chosen.other.push_back(chosen.own.front());
  MatrixX recovery(std::ssize(chosen.other), n);
  for (std::size_t i = 0; i < chosen.other.size(); ++i)
    recovery.row(static_cast<Eigen::Index>(i)) =
        nodes[chosen.other[i].node].rows.row(chosen.other[i].component) *
        made.T;
  write_whole(folder / "otm.mtx", to_market(recovery));
  write_whole(folder / "otm_rows.csv", list_rows(nodes, chosen.other, 0));
}

}  // namespace limber::results
