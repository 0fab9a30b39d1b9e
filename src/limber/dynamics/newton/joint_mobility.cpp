// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/joint_mobility.hpp"

#include <algorithm>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/relative_energy.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

std::vector<char> find_joined(const SystemModel& model) {
  std::vector<char> is_joined(model.pairs.size(), 0);
  if (model.nodal_count > 0) return is_joined;
  std::vector<char> has_joint(model.bodies.size(), 0);
  const auto mark = [&](BodyIndex b) {
    if (b != kWorld) has_joint[index(b)] = 1;
  };
  for (const Coupler& coupler : model.couplers) {
    mark(model.attachments[index(coupler.frame_F)].body);
    mark(model.attachments[index(coupler.frame_M)].body);
  }
  for (const Transmission& transmission : model.transmissions) {
    for (const BodyIndex b : find_joined_bodies(model, transmission)) mark(b);
  }
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    for (const BodyIndex b : {model.pairs[i].body_A, model.pairs[i].body_B}) {
      if (b != kWorld && has_joint[index(b)] != 0) is_joined[i] = 1;
    }
  }
  return is_joined;
}

// Of increments of a body in its own axes.
Vector6 find_motion(const SystemModel& model, const SystemTerms& terms,
                    BodyIndex b, const VectorX& increments) {
  const Eigen::Index row = model.bodies[index(b)].row;
  Vector6 motion = increments.segment<6>(row);
  motion.head<3>() =
      terms.bodies[index(b)].R_WB.transpose() * increments.segment<3>(row);
  return motion;
}

}  // namespace

JointMobility::JointMobility(const SystemModel& model)
    : is_joined_(find_joined(model)) {
  if (std::count(is_joined_.begin(), is_joined_.end(), 1) == 0) return;
  terms_ = make_terms(model);
  matrix_ = NewtonMatrix(model);
  no_gaps_.assign(model.couplers.size() + model.transmissions.size(),
                  Vector6::Zero());
  no_motion_ = residual_ = increments_ = make_unknowns(model);
}

joints::PairMobility JointMobility::find(const SystemModel& model,
                                         const SystemState& state,
                                         std::size_t pair, double frequency) {
  calc_terms(model, state, Side::left, terms_);
  for (joints::PairResponse& response : terms_.pairs.responses) {
    response.clear();
  }
  const double square = frequency * frequency;
  matrix_.factor(model, state, terms_, no_motion_, {square, frequency});
  const BodyIndex bodies[] = {model.pairs[pair].body_A,
                              model.pairs[pair].body_B};
  joints::PairMobility Y = joints::PairMobility::Zero();
  for (int i = 0; i < 12; ++i) {
    const BodyIndex b = bodies[i / 6];
    if (b == kWorld) continue;
    Vector6 load = Vector6::Unit(i % 6);
    load.head<3>() = terms_.bodies[index(b)].R_WB * load.head<3>().eval();
    residual_.setZero();
    residual_.segment<6>(model.bodies[index(b)].row) = -load;
    matrix_.solve(model, terms_, residual_, no_gaps_, increments_);
    for (int k = 0; k < 2; ++k) {
      if (bodies[k] == kWorld) continue;
      Y.block<6, 1>(6 * k, i) =
          square * find_motion(model, terms_, bodies[k], increments_);
    }
  }
  return 0.5 * (Y + Y.transpose());
}

}  // namespace limber::dynamics
