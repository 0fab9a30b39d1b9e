// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/displacement_measure.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

/// Longest displacement of a node, u = 3n.
double find_largest(const VectorX& u) {
  if (u.size() == 0) return 0.0;
  return std::sqrt(
      u.reshaped(3, u.size() / 3).colwise().squaredNorm().maxCoeff());
}

/// The bodies and couplers as a graph.
class CouplerGraph {
 public:
  explicit CouplerGraph(const SystemModel& model)
      : model_(model),
        diameters_(model.bodies.size(), 0.0),
        ends_(model.bodies.size()) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const auto& reduced = model.bodies[b].reduced;
      if (reduced) diameters_[b] = reduced->size.norm();
    }
    for (const Attachment& a : model.attachments) {
      if (a.body == kWorld || model.bodies[index(a.body)].reduced) continue;
      double& diameter = diameters_[index(a.body)];
      diameter = std::max(diameter, 2.0 * a.p_BF.norm());
    }
    for (const Coupler& c : model.couplers) {
      add_end(c.frame_F, c.frame_M);
      add_end(c.frame_M, c.frame_F);
    }
  }

  /// Longest path from `body` over the coupler that ends at `other`; zero if
  /// what is beyond holds the body.
  [[nodiscard]] double find_reach(BodyIndex body, AttachmentIndex other) const {
    if (body == kWorld) return 0.0;
    std::vector<bool> visited(model_.bodies.size(), false);
    visited[index(body)] = true;
    Group beyond;
    include(other, visited, beyond);
    // What remains on the body's own side.
    Group own{model_.bodies[index(body)].mass,
              model_.bodies[index(body)].is_held()};
    for (const AttachmentIndex far : ends_[index(body)]) {
      include(far, visited, own);
    }
    if (beyond.is_grounded && !own.is_grounded) return 0.0;
    if (beyond.is_grounded == own.is_grounded && beyond.mass > own.mass) {
      return 0.0;
    }
    visited.assign(visited.size(), false);
    visited[index(body)] = true;
    return find_reach(other, visited);
  }

 private:
  /// Bodies that are joined to one another.
  struct Group {
    double mass = 0.0;         ///< [kg]
    bool is_grounded = false;  ///< held by the world
  };

  /// Adds the body of `other`, and all behind it that were not visited.
  void include(AttachmentIndex other, std::vector<bool>& visited,
               Group& group) const {
    const BodyIndex body = model_.attachments[index(other)].body;
    if (body == kWorld) {
      group.is_grounded = true;
      return;
    }
    if (visited[index(body)]) return;
    visited[index(body)] = true;
    group.mass += model_.bodies[index(body)].mass;
    group.is_grounded |= model_.bodies[index(body)].is_held();
    for (const AttachmentIndex far : ends_[index(body)]) {
      include(far, visited, group);
    }
  }

  void add_end(AttachmentIndex near, AttachmentIndex far) {
    const BodyIndex body = model_.attachments[index(near)].body;
    if (body != kWorld) ends_[index(body)].push_back(far);
  }

  double find_reach(AttachmentIndex other, std::vector<bool>& visited) const {
    const BodyIndex body = model_.attachments[index(other)].body;
    if (body == kWorld || visited[index(body)]) return 0.0;
    visited[index(body)] = true;
    double beyond = 0.0;
    for (const AttachmentIndex far : ends_[index(body)]) {
      beyond = std::max(beyond, find_reach(far, visited));
    }
    return diameters_[index(body)] + beyond;
  }

  const SystemModel& model_;
  std::vector<double> diameters_;                   ///< one per body [m]
  std::vector<std::vector<AttachmentIndex>> ends_;  ///< far ends, one per body
};

}  // namespace

std::vector<double> find_reaches(const SystemModel& model) {
  const CouplerGraph graph(model);
  std::vector<double> reaches(model.attachments.size(), 0.0);
  const auto include = [&](AttachmentIndex near, AttachmentIndex far) {
    double& reach = reaches[index(near)];
    reach = std::max(
        reach, graph.find_reach(model.attachments[index(near)].body, far));
  };
  for (const Coupler& c : model.couplers) {
    include(c.frame_F, c.frame_M);
    include(c.frame_M, c.frame_F);
  }
  return reaches;
}

const DisplacementTree& MovedNodes::tree() const {
  if (!tree_) tree_.emplace(reduced_->rows.x_B, reduced_->rows.Phi_B);
  return *tree_;
}

DisplacementMeasure::DisplacementMeasure(
    std::shared_ptr<const MovedNodes> nodes)
    : nodes_(std::move(nodes)) {
  find_mode_sizes();
}

DisplacementMeasure::DisplacementMeasure(
    std::shared_ptr<const MovedNodes> nodes, const SystemModel& model,
    BodyIndex body, const std::vector<double>& reaches)
    : nodes_(std::move(nodes)) {
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const Attachment& a = model.attachments[i];
    if (a.body != body || reaches[i] == 0.0) continue;
    carried_.push_back({a.Phi_B, a.Psi_B, reaches[i]});
  }
  find_mode_sizes();
}

void DisplacementMeasure::find_mode_sizes() {
  const flexbody::ReducedBody& reduced = nodes_->reduced();
  const Eigen::Index m = reduced.lambda.size();
  mode_sizes_.resize(m);
  node_sizes_.resize(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    node_sizes_[k] = find_largest(reduced.rows.Phi_B.col(k));
    mode_sizes_[k] = node_sizes_[k];
    for (const Carried& end : carried_) {
      mode_sizes_[k] =
          std::max(mode_sizes_[k], end.Phi_B.col(k).norm() +
                                       end.reach * end.Psi_B.col(k).norm());
    }
  }
}

double DisplacementMeasure::calc_displacement(const VectorX& eta,
                                              int& leaf) const {
  LIMBER_EXPECT(eta.size() == nodes_->reduced().lambda.size());
  if (eta.size() == 0) return 0.0;
  double largest = 0.0;
  for (const Carried& end : carried_) {
    largest = std::max(largest, (end.Phi_B * eta).norm() +
                                    end.reach * (end.Psi_B * eta).norm());
  }
  // Skips the many own nodes if they cannot be the largest.
  if (node_sizes_.dot(eta.cwiseAbs()) <= largest) return largest;
  return nodes_->tree().find_largest(eta, largest, leaf);
}

PeakDisplacement::PeakDisplacement(const DisplacementMeasure& measure)
    : measure_(&measure),
      eta_0_(VectorX::Zero(measure.mode_sizes().size())),
      eta_a_(eta_0_),
      eta_b_(eta_0_) {}

bool PeakDisplacement::is_record(const VectorX& eta, double t) {
  constexpr double kLow = 0.001;
  const double bound =
      u_0_ + measure_->mode_sizes().dot((eta - eta_0_).cwiseAbs());
  if (bound <= (1.0 + kLow) * peak_.value) return false;
  const double from_zero = measure_->mode_sizes().dot(eta.cwiseAbs());
  if (from_zero <= (1.0 + kLow) * peak_.value) return false;
  eta_0_ = eta;
  u_0_ = measure_->calc_displacement(eta, leaf_);
  const bool is_larger = u_0_ > peak_.value;
  peak_.include(u_0_, t);
  return is_larger;
}

void PeakDisplacement::include(const VectorX& eta, double t) {
  const Peak before = peak_;
  const bool is_larger = is_record(eta, t);
  if (was_record_ && !is_larger && count_ == 2) {
    const Peak a{measure_->calc_displacement(eta_a_, leaf_), t_a_};
    const Peak c{measure_->calc_displacement(eta, leaf_), t};
    peak_.include(c.value, c.time);
    const Peak top = find_top(a, before, c);
    peak_.include(top.value, top.time);
  }
  was_record_ = is_larger;
  eta_a_.swap(eta_b_);
  eta_b_ = eta;
  t_a_ = t_b_;
  t_b_ = t;
  count_ = std::min(count_ + 1, 2);
}

void PeakDisplacement::exchange_memory(Archive& archive) {
  archive(eta_0_, u_0_, leaf_, peak_, eta_a_, eta_b_, t_a_, t_b_, count_,
          was_record_);
}

}  // namespace limber::dynamics
