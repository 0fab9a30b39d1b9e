// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/pairs/pair_interaction.hpp"

#include <algorithm>

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

Vector3 combine(const Matrix3X& columns, const double* x) {
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    sum += columns.col(k) * x[k];
  }
  return sum;
}

}  // namespace

Vector3 find_arm(const PairBody& body, const PairPlace& place) {
  return place.x_B + combine(place.Phi_B, body.eta);
}

Vector3 find_position(const PairBody& body, const PairPlace& place) {
  return body.p_WB + body.R_WB * find_arm(body, place);
}

Vector3 find_velocity(const PairBody& body, const PairPlace& place) {
  return body.v_WB_W + body.R_WB * (body.w_WB_B.cross(find_arm(body, place)) +
                                    combine(place.Phi_B, body.etadot));
}

PairResponse::PairResponse(std::size_t most_points, int modes_A, int modes_B,
                           bool is_coupled)
    : all_(most_points),
      coupling_(is_coupled ? most_points * most_points : 0, Matrix3::Zero()),
      damping_coupling_(coupling_),
      parts_(is_coupled ? most_points : 0) {
  for (PairPoint& point : all_) {
    point.on_A.Phi_B = Matrix3X::Zero(3, modes_A);
    point.on_B.Phi_B = Matrix3X::Zero(3, modes_B);
  }
}

void PairResponse::clear() {
  count_ = part_count_ = 0;
  energy = dissipation = rubbed = slip_power = 0.0;
}

PairPoint& PairResponse::add() {
  if (count_ == all_.size()) {
    throw ContractError("PairResponse: more points than the law may have");
  }
  PairPoint& point = all_[count_++];
  for (PairPlace* place : {&point.on_A, &point.on_B}) {
    place->x_B.setZero();
    place->Phi_B.setZero();
  }
  point.force_W.setZero();
  point.stiffness.setZero();
  point.damping.setZero();
  if (is_coupled()) {
    for (std::size_t j = 0; j < count_; ++j) {
      coupling(count_ - 1, j).setZero();
      coupling(j, count_ - 1).setZero();
      damping_coupling(count_ - 1, j).setZero();
      damping_coupling(j, count_ - 1).setZero();
    }
  }
  return point;
}

void PairResponse::add_part(const PairPart& part) {
  if (part_count_ == parts_.size()) {
    throw ContractError("PairResponse: more parts than the law may have");
  }
  parts_[part_count_++] = part;
}

const PairPart* PairResponse::find_part(std::size_t index) const {
  const auto found = std::ranges::find(parts(), index, &PairPart::index);
  return found == parts().end() ? nullptr : &*found;
}

std::size_t PairResponse::check_coupling(std::size_t i, std::size_t j) const {
  if (coupling_.empty() || i >= count_ || j >= count_) {
    throw ContractError("PairResponse: points that are not coupled");
  }
  return i * all_.size() + j;
}

void PairResponse::uncouple() {
  std::fill(coupling_.begin(), coupling_.end(), Matrix3::Zero());
  std::fill(damping_coupling_.begin(), damping_coupling_.end(),
            Matrix3::Zero());
}

Matrix3 PairResponse::find_stiffness_bound(std::size_t i) const {
  Matrix3 bound = all_[i].stiffness;
  if (!is_coupled()) return bound;
  for (std::size_t j = 0; j < count_; ++j) {
    if (j == i) continue;
    bound.diagonal().array() += coupling(i, j).norm();
  }
  return bound;
}

void PairInteraction::evaluate_over_step(const PairStep& step,
                                         std::span<const double> memory,
                                         PairResponse& out) const {
  evaluate(step.middle, {step.times.middle(), Side::right}, memory, out);
}

void describe(Manifest& out, std::string_view name,
              const PairInteraction& law) {
  out.within(name, [&] {
    out.add("kind", law.kind());
    law.describe_parameters(out);
  });
}

}  // namespace limber::joints
