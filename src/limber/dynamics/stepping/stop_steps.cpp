// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/stepping/stop_steps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/coordinate_acceleration.hpp"
#include "limber/dynamics/equations/coupler_forces.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

constexpr double kLongest = 6.0;      // contact in half periods [-]
constexpr double kPartGrowth = 1.25;  // of a step to the next (ImpactSteps) [-]
constexpr double kBounce = 0.5;       // steps away, below which it rests [-]
constexpr double kHeight = 0.01;      // of the tolerance, likewise [-]

}  // namespace

StopSteps::StopSteps(const SystemModel& model, double steps, double tolerance)
    : model_(model), steps_(steps), tolerance_(tolerance) {
  if (model.nodal_count > 0) return;
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const auto* joint = std::get_if<joints::Joint>(&model.couplers[c].law);
    if (joint == nullptr) continue;
    std::size_t place = 0;
    for (const joints::JointElement& element : joint->elements()) {
      if (const auto* stop = std::get_if<joints::EndStop>(&element.law)) {
        const joints::EndStop::Parameters& p = stop->parameters();
        for (std::size_t side : {0U, 1U}) {
          End end;
          end.coupler = c;
          end.coordinate = static_cast<std::size_t>(element.coordinate);
          end.place = place + side;
          end.stiffness = p.stiffness;
          end.damping = p.damping;
          end.outwards = side == 0 ? 1.0 : -1.0;
          if (std::isfinite(side == 0 ? p.upper : p.lower)) {
            ends_.push_back(end);
          }
        }
      }
      place += static_cast<std::size_t>(joints::switch_count(element.law));
    }
  }
  if (ends_.empty()) return;
  terms_ = make_terms(model);
  matrix_ = NewtonMatrix(model);
  no_gaps_.assign(model.couplers.size() + model.transmissions.size(),
                  Vector6::Zero());
  no_motion_ = residual_ = increments_ = make_unknowns(model);
}

double StopSteps::limit(double h, const SystemState& state) {
  if (ends_.empty()) return h;
  double most = std::numeric_limits<double>::infinity();
  for (End& end : ends_) {
    update(end, h, state);
    if (!end.counts) continue;
    most = std::min(most, std::numbers::pi / (steps_ * end.frequency));
  }
  longest_ = std::min(kPartGrowth * longest_, most);
  if (!(longest_ < h)) {
    longest_ = std::numeric_limits<double>::infinity();
    return h;
  }
  return h < 2.0 * longest_ ? 0.5 * h : longest_;  // no short rest
}

void StopSteps::update(End& end, double h, const SystemState& state) {
  const joints::CouplerMemory& memory = state.memory[end.coupler];
  const bool was_on = end.is_on;
  end.is_on = memory.switches[end.place] == joints::SwitchMode::on;
  if (end.is_on && !was_on) {
    end.reached = state.t;
    begin(end, h, state);
  }
  const double halves =
      (state.t - end.reached) * end.frequency / std::numbers::pi;
  end.counts = end.counts && end.is_on && halves < kLongest;
}

void StopSteps::begin(End& end, double h, const SystemState& state) {
  constexpr int kMostRepeats = 8;
  constexpr double kNear = 0.1;  // relative change [-]
  apart_ = state;
  for (const End& other : ends_) {
    apart_.memory[other.coupler].switches[other.place] =
        joints::SwitchMode::off;
  }
  calc_terms(model_, apart_, Side::left, terms_);
  for (joints::PairResponse& response : terms_.pairs.responses) {
    response.clear();
  }
  const Coupler& coupler = model_.couplers[end.coupler];
  const joints::RelativeMotion& motion = terms_.couplers[end.coupler].motion;
  const joints::CoordinateValue value =
      joints::evaluate(joints::coordinates_of(coupler.law)[end.coordinate],
                       motion, state.memory[end.coupler].near[end.coordinate]);
  const double rate = std::abs(value.rate);
  const double against =
      end.outwards * find_coordinate_acceleration(
                         model_, apart_, terms_, CouplerIndex(end.coupler),
                         end.coordinate, increments_, moving_);
  end.counts = !(2.0 * rate < kBounce * h * against) &&
               !(rate * rate < 2.0 * against * kHeight * tolerance_);
  if (!end.counts) return;
  clear_forces(model_, terms_);
  add_coupler_wrench(model_, coupler, value.gradient, motion.p_FM_F, terms_);
  calc_residual(model_, no_motion_, terms_, residual_);
  const double stiffness = end.stiffness * (1.0 + end.damping * rate);
  double omega = std::numbers::pi / (steps_ * h);
  for (int i = 0; i < kMostRepeats; ++i) {
    matrix_.factor(model_, apart_, terms_, no_motion_, {omega * omega, omega},
                   true);
    matrix_.solve(model_, terms_, residual_, no_gaps_, increments_);
    const double mobility = -omega * omega * residual_.dot(increments_);
    const double last = omega;
    omega = std::sqrt(std::max(stiffness * mobility, 0.0));
    if (!(std::abs(omega - last) > kNear * last)) break;
  }
  end.frequency = omega;
}

void StopSteps::exchange_memory(Archive& archive) {
  archive(longest_);
  for (End& end : ends_) {
    archive(end.is_on, end.counts, end.frequency, end.reached);
  }
}

}  // namespace limber::dynamics
