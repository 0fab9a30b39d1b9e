// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/deflection_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/linked_groups.hpp"

namespace limber::dynamics {
namespace {

double find_largest(const Matrix3& stiffness) {
  return dense::find_eigenvalues(stiffness).maxCoeff();
}

// Size of an attachment's body, measured from the attachment [m].
double find_size(const SystemModel& model, AttachmentIndex from) {
  const Attachment& a = model.attachments[static_cast<std::size_t>(from)];
  if (a.body == kWorld) return std::numeric_limits<double>::infinity();
  const BodyModel& body = model.bodies[static_cast<std::size_t>(a.body)];
  double size = std::sqrt(find_largest(body.J0) / body.mass);
  for (const Attachment& other : model.attachments) {
    if (other.body == a.body) {
      size = std::max(size, (other.p_BF - a.p_BF).norm());
    }
  }
  return size;
}

}  // namespace

DeflectionObserver::DeflectionObserver(const SystemModel& model)
    : model_(model),
      groups_(find_linked_groups(model)),
      elastic_(groups_.size()) {
  std::vector<std::size_t> group_of(model.bodies.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (const BodyIndex b : groups_[g]) {
      group_of[static_cast<std::size_t>(b)] = g;
    }
  }
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const Coupler& coupler = model.couplers[c];
    const auto stiffness = joints::find_constraint_stiffness(coupler.law);
    if (!stiffness) continue;
    Constraint constraint;
    constraint.coupler = c;
    constraint.stiffness = *stiffness;
    const double size_F = find_size(model, coupler.frame_F);
    const double size_M = find_size(model, coupler.frame_M);
    constraint.size = std::min(size_F, size_M);
    const AttachmentIndex frame =
        size_F < size_M ? coupler.frame_F : coupler.frame_M;
    const BodyIndex body =
        model.attachments[static_cast<std::size_t>(frame)].body;
    if (body == kWorld || !(constraint.size > 0.0)) continue;
    constraint.body = static_cast<std::size_t>(body);
    constraint.group = group_of[constraint.body];
    constraints_.push_back(constraint);
  }
}

double DeflectionObserver::find_elastic(std::size_t group,
                                        const SystemState& state,
                                        const SystemTerms& terms) {
  if (elastic_[group]) return *elastic_[group];
  double sum = 0.0;
  for (const BodyIndex b : groups_[group]) {
    sum += find_elastic_energy(model_, index(b), state, terms);
  }
  elastic_[group] = sum;
  return sum;
}

void DeflectionObserver::include(const SystemState& state,
                                 const SystemTerms& terms) {
  std::fill(elastic_.begin(), elastic_.end(), std::nullopt);
  for (Constraint& constraint : constraints_) {
    const joints::ConstraintDeflection deflection = joints::find_deflection(
        model_.couplers[constraint.coupler].law, constraint.stiffness,
        terms.couplers[constraint.coupler].motion);
    if (deflection.distance > constraint.deflection) {
      constraint.deflection = deflection.distance;
      constraint.deflection_time = state.t;
    }
    if (deflection.rotation > constraint.rotation) {
      constraint.rotation = deflection.rotation;
      constraint.rotation_time = state.t;
    }
    const double energy = 0.5 * constraint.stiffness.translational *
                              deflection.distance * deflection.distance +
                          0.5 * constraint.stiffness.rotational *
                              deflection.rotation * deflection.rotation;
    if (energy > constraint.energy) {
      constraint.energy = energy;
      constraint.elastic = find_elastic(constraint.group, state, terms);
      constraint.energy_time = state.t;
    }
  }
}

std::string DeflectionObserver::describe(const Constraint& constraint) const {
  const std::string& joint = model_.couplers[constraint.coupler].name;
  const std::string& body = model_.bodies[constraint.body].name;
  if (constraint.deflection / constraint.size >= constraint.rotation) {
    const double fraction = constraint.deflection / constraint.size;
    return fmt::format(
        "joint '{}' deflects by {:.3g} m at t = {:.6g} s in constrained "
        "directions, {:.3g} % of the size of body '{}' ({:.3g} m); a "
        "translational stiffness of {:.2g} N/m in place of {:.2g} N/m would "
        "limit it to 0.1 %",
        joint, constraint.deflection, constraint.deflection_time,
        100.0 * fraction, body, constraint.size,
        constraint.stiffness.translational * fraction / kLargest,
        constraint.stiffness.translational);
  }
  return fmt::format(
      "joint '{}' deflects by {:.3g} rad at t = {:.6g} s about constrained "
      "directions, which moves body '{}' ({:.3g} m) by {:.3g} m; a rotational "
      "stiffness of {:.2g} N m/rad in place of {:.2g} N m/rad would limit this "
      "to 0.1 % of the body's size",
      joint, constraint.rotation, constraint.rotation_time, body,
      constraint.size, constraint.rotation * constraint.size,
      constraint.stiffness.rotational * constraint.rotation / kLargest,
      constraint.stiffness.rotational);
}

std::string DeflectionObserver::describe_fraction(
    const Constraint& constraint) const {
  return fmt::format(
      "joint '{}' is soft relative to the bodies: at t = {:.6g} s it stores "
      "{:.3g} J in its constrained directions, {:.3g} % of the elastic energy "
      "of the bodies connected to it; {:.2g} times its stiffness would keep it "
      "at {:g} %",
      model_.couplers[constraint.coupler].name, constraint.energy_time,
      constraint.energy, 100.0 * constraint.fraction(),
      constraint.fraction() / kLargestFraction, 100.0 * kLargestFraction);
}

std::string DeflectionObserver::describe_fractions(
    std::vector<const Constraint*> soft) const {
  constexpr std::size_t kMost = 4;
  std::stable_sort(soft.begin(), soft.end(),
                   [](const Constraint* a, const Constraint* b) {
                     return a->fraction() > b->fraction();
                   });
  std::string text = describe_fraction(*soft.front());
  for (std::size_t i = 1; i < std::min(kMost, soft.size()); ++i) {
    text += fmt::format("{} '{}'", i == 1 ? "; also soft:" : ",",
                        model_.couplers[soft[i]->coupler].name);
  }
  if (soft.size() > kMost)
    text += fmt::format(" and {} more", soft.size() - kMost);
  return text;
}

std::vector<std::string> DeflectionObserver::find_warnings() const {
  std::vector<std::string> warnings;
  std::vector<const Constraint*> soft;
  for (const Constraint& constraint : constraints_) {
    if (constraint.largest() > kLargest) {
      warnings.push_back(describe(constraint));
    } else if (constraint.largest() > kNegligible &&
               constraint.fraction() > kLargestFraction) {
      soft.push_back(&constraint);
    }
  }
  if (!soft.empty()) warnings.push_back(describe_fractions(std::move(soft)));
  return warnings;
}

void DeflectionObserver::add_negligible_energies(
    Eigen::Ref<VectorX> losses) const {
  constexpr double kTimes = 10.0;
  for (const Constraint& constraint : constraints_) {
    if (constraint.largest() > kNegligible) continue;
    losses[static_cast<Eigen::Index>(constraint.coupler)] +=
        kTimes * constraint.energy;
  }
}

std::optional<std::string> DeflectionObserver::find_overpowered() const {
  const auto worst =
      std::max_element(constraints_.begin(), constraints_.end(),
                       [](const Constraint& a, const Constraint& b) {
                         return a.largest() < b.largest();
                       });
  if (worst == constraints_.end() || worst->largest() <= kOverpowered) {
    return std::nullopt;
  }
  return describe(*worst) + ": the loads are stronger than this joint";
}

void DeflectionObserver::exchange_memory(Archive& archive) {
  for (Constraint& constraint : constraints_) {
    archive(constraint.deflection, constraint.rotation,
            constraint.deflection_time, constraint.rotation_time,
            constraint.energy, constraint.elastic, constraint.energy_time);
  }
}

std::vector<std::string> find_constraint_warnings(const SystemModel& model,
                                                  const SystemState& state) {
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  DeflectionObserver observer(model);
  observer.include(state, terms);
  return observer.find_warnings();
}

}  // namespace limber::dynamics
