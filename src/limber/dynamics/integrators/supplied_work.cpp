// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/supplied_work.hpp"

#include <cmath>
#include <limits>

#include "limber/common/rotation_path.hpp"

namespace limber::dynamics {
namespace {

constexpr double kWorkRoundoff = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace

SuppliedWork::SuppliedWork(const SystemModel& model)
    : model_(model), drives_(find_drives(model)) {
  list_loads();
  if (!model.gravity_W.isZero(0.0)) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (model.bodies[b].has_rigid_motion()) bodies_.push_back(b);
    }
  }
  list_rows();
  now_.resize(row_of_.size());
  before_ = now_;
  turned_.resize(moments_.size());
  turned_before_ = turned_;
}

void SuppliedWork::list_loads() {
  for (std::size_t i = 0; i < model_.loads.size(); ++i) {
    const Load& load = model_.loads[i];
    const auto at = static_cast<std::size_t>(load.where);
    const BodyIndex b = model_.attachments[at].body;
    if (b == kWorld) continue;
    const BodyModel& body = model_.bodies[static_cast<std::size_t>(b)];
    const bool is_undeformed =
        body.modes > 0 && body.fidelity < Fidelity::coupled;
    if (is_undeformed || model_.attachments[at].nodal) continue;
    if (load.in_world && !load.force.isZero(0.0)) loads_.push_back(i);
    if (load.moment.isZero(0.0)) continue;
    if (load.in_world || body.modes == 0) moments_.push_back(i);
  }
}

void SuppliedWork::list_rows() {
  const EnergyRows rows(model_);
  for (const PlacedDrive& drive : drives_) {
    row_of_.push_back(
        (drive.is_transmission ? rows.transmissions : rows.couplers) +
        static_cast<Eigen::Index>(drive.index));
  }
  const auto add_load = [&](std::size_t i) {
    const auto at = static_cast<std::size_t>(model_.loads[i].where);
    row_of_.push_back(model_.attachments[at].body);
  };
  for (const std::size_t i : loads_) add_load(i);
  for (const std::size_t b : bodies_) {
    row_of_.push_back(static_cast<Eigen::Index>(b));
  }
  for (const std::size_t i : moments_) add_load(i);
}

void SuppliedWork::read(const SystemState& state, const SystemTerms& terms,
                        Side side) {
  const EvaluationTime now = now_of(state, side);
  std::size_t n = 0;
  for (const PlacedDrive& drive : drives_) {
    const auto supply = joints::find_supply(
        *drive.law, find_motion(model_, state, terms, drive), now);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    now_[n++] = supply ? Path{supply->force, supply->place, supply->rate,
                              std::abs(supply->place)}
                       : Path{0.0, unknown, 0.0, 0.0};
  }
  for (const std::size_t i : loads_) {
    const Load& load = model_.loads[i];
    const AttachmentMotion& at =
        terms.attachments[static_cast<std::size_t>(load.where)];
    now_[n++] = {evaluate(load.function, now), load.force.dot(at.p_WF),
                 load.force.dot(at.v_WF_W), load.force.norm() * at.p_WF.norm()};
  }
  for (const std::size_t b : bodies_) {
    const Vector3 weight = model_.bodies[b].mass * model_.gravity_W;
    const BodyState& body = state.bodies[b];
    now_[n++] = {1.0, weight.dot(body.p_WB), weight.dot(body.v_WB_W),
                 weight.norm() * body.p_WB.norm()};
  }
  read_moments(terms, now);
}

// All but the places, which are those of a step.
void SuppliedWork::read_moments(const SystemTerms& terms,
                                const EvaluationTime& now) {
  const std::size_t first = now_.size() - moments_.size();
  for (std::size_t m = 0; m < moments_.size(); ++m) {
    const Load& load = model_.loads[moments_[m]];
    const AttachmentMotion& at =
        terms.attachments[static_cast<std::size_t>(load.where)];
    turned_[m] = load.in_world
                     ? Turned{at.R_WF, at.w_WF_W}
                     : Turned{at.R_WB, at.R_WB.transpose() * at.w_WF_W};
    now_[first + m] = {evaluate(load.function, now), 0.0,
                       load.moment.dot(turned_[m].w), load.moment.norm()};
  }
}

void SuppliedWork::set_moment_paths(double h) {
  const std::size_t first = now_.size() - moments_.size();
  for (std::size_t m = 0; m < moments_.size(); ++m) {
    const Load& load = model_.loads[moments_[m]];
    const Turned& from = turned_before_[m];
    const Turned& to = turned_[m];
    before_[first + m].place = 0.0;
    const Matrix3 R = load.in_world ? Matrix3(to.R_WF * from.R_WF.transpose())
                                    : Matrix3(from.R_WF.transpose() * to.R_WF);
    const Vector3 path = integrate_rotation(
        R, from.w, to.w, h,
        load.in_world ? RotationAxes::fixed : RotationAxes::rotating);
    now_[first + m].place = load.moment.dot(path);
  }
}

void SuppliedWork::start(const SystemState& state, const SystemTerms& terms) {
  read(state, terms, Side::right);
}

double SuppliedWork::find_correction(const Path& first, const Path& last,
                                     double h) {
  const double mean = 0.5 * (first.force + last.force);
  const double path =
      mean * (last.place - first.place) +
      (last.force - first.force) * (last.rate - first.rate) * h / 12.0;
  const double power =
      0.5 * h * (first.force * first.rate + last.force * last.rate);
  const double noise =
      kWorkRoundoff * std::abs(mean) * (first.size + last.size);
  const double correction = path - power;
  return std::abs(correction) > noise ? correction : 0.0;  // 0 if unknown
}

void SuppliedWork::advance(const SystemState& to, const SystemTerms& terms,
                           double h, VectorX& work) {
  now_.swap(before_);
  turned_.swap(turned_before_);
  read(to, terms, Side::left);
  set_moment_paths(h);
  for (std::size_t i = 0; i < now_.size(); ++i) {
    work[row_of_[i]] += find_correction(before_[i], now_[i], h);
  }
}

}  // namespace limber::dynamics
