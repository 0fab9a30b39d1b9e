// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/node_motions.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <map>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"

namespace limber::fem {
namespace {

/// Motion at `arm` from a rigid body's point, by that of the point.
Matrix6 make_arm(const Vector3& arm) {
  Matrix6 S = Matrix6::Identity();
  S.topRightCorner<3, 3>() = -skew(arm);
  return S;
}

}  // namespace

NodeMotions::NodeMotions(const Structure& structure)
    : ties_(structure.tags.size()),
      is_hub_(structure.tags.size(), 0),
      tags_(structure.tags) {
  for (const StructureSpider& spider : structure.spiders)
    for (const int node : spider.nodes) {
      if (node == spider.reference) continue;
      const Vector3 arm =
          structure.x.col(node) - structure.x.col(spider.reference);
      add(node, {{{spider.reference, make_arm(arm)}}, spider.place});
      is_hub_[index(spider.reference)] = 1;
    }
  for (const StructureMean& mean : structure.means) add_mean(structure, mean);
  resolve();
}

void NodeMotions::add(int node, Tie tie) {
  Tie& own = ties_[index(node)];
  if (!own.contributions.empty())
    throw InputError(fmt::format(
        "{}: node {} moves with another rigid element already ({}). "
        "Expected it to depend on one.",
        tie.place, tags_[index(node)], own.place));
  own = std::move(tie);
}

/// Displacement and rotation of the rigid motion that fits those of the nodes
/// best, by weights.
///
/// Equation   u = u_c + theta x (x - c), u_c = sum w_i u_i / W, theta = J^-1
///            sum w_i r_i x u_i, r_i = x_i - c, J = sum w_i (r^2 I - r r^T)
void NodeMotions::add_mean(const Structure& structure,
                           const StructureMean& mean) {
  double W = 0.0;
  Vector3 c = Vector3::Zero();
  for (std::size_t i = 0; i < mean.nodes.size(); ++i) {
    W += mean.weights[i];
    c += mean.weights[i] * structure.x.col(mean.nodes[i]);
  }
  if (!(W > 0.0))
    throw InputError(fmt::format(
        "{}: its nodes have no weight. Expected a sum > 0.", mean.place));
  c /= W;
  Matrix3 J = Matrix3::Zero();
  for (std::size_t i = 0; i < mean.nodes.size(); ++i) {
    const Matrix3 r = skew(Vector3(structure.x.col(mean.nodes[i]) - c));
    J -= mean.weights[i] * r * r;
  }
  constexpr double kLine = 1e-9;  // of the largest moment
  const auto moments = dense::find_eigenpairs(J).values;
  if (!(moments.minCoeff() > kLine * moments.maxCoeff()))
    throw InputError(
        fmt::format("{}: its nodes lie on a line or in one point, so that node "
                    "{} could turn about it. Expected three others at least.",
                    mean.place, tags_[index(mean.node)]));
  const Matrix3 inverse = J.inverse();
  const Matrix3 arm = skew(Vector3(structure.x.col(mean.node) - c));
  Tie tie{{}, mean.place};
  for (std::size_t i = 0; i < mean.nodes.size(); ++i) {
    Matrix6 S = Matrix6::Zero();
    S.bottomLeftCorner<3, 3>() =
        mean.weights[i] * inverse *
        skew(Vector3(structure.x.col(mean.nodes[i]) - c));
    S.topLeftCorner<3, 3>() = mean.weights[i] / W * Matrix3::Identity() -
                              arm * S.bottomLeftCorner<3, 3>();
    tie.contributions.emplace_back(mean.nodes[i], S);
  }
  add(mean.node, std::move(tie));
}

/// In place of leaders that are led in turn those that lead them.
void NodeMotions::resolve(int node) {
  std::map<int, Matrix6> sum;
  for (const auto& [leader, S] : ties_[index(node)].contributions)
    for (const auto& [root, R] : find_contributions(leader)) {
      const Matrix6 part = S * R;
      const auto [entry, is_new] = sum.try_emplace(root, part);
      if (!is_new) entry->second += part;
    }
  ties_[index(node)].contributions = {sum.begin(), sum.end()};
}

/// Of all nodes, those that lead before those that they lead.
void NodeMotions::resolve() {
  enum class Mark : char { fresh, open, done };
  std::vector<Mark> marks(ties_.size(), Mark::fresh);
  std::vector<std::pair<int, std::size_t>> stack;  // nodes, leaders visited
  const auto visit = [&](int node) {
    stack.emplace_back(node, 0);
    marks[index(node)] = Mark::open;
  };
  for (int first = 0; first < static_cast<int>(ties_.size()); ++first) {
    if (marks[index(first)] == Mark::fresh) visit(first);
    while (!stack.empty()) {
      auto& [node, next] = stack.back();
      const Tie& tie = ties_[index(node)];
      if (next == tie.contributions.size()) {
        resolve(node);
        marks[index(node)] = Mark::done;
        stack.pop_back();
        continue;
      }
      const int leader = tie.contributions[next++].first;
      if (marks[index(leader)] == Mark::open)
        throw InputError(
            fmt::format("{}: node {} moves, by a chain of rigid elements, "
                        "with itself. Expected one node that leads.",
                        tie.place, tags_[index(node)]));
      if (marks[index(leader)] == Mark::fresh) visit(leader);
    }
  }
}

std::vector<NodeMotions::Contribution> NodeMotions::find_contributions(
    int node) const {
  if (!is_led(node)) return {{node, Matrix6::Identity()}};
  return ties_[index(node)].contributions;
}

}  // namespace limber::fem
