// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/newton_failure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "limber/common/index.hpp"
#include "limber/dynamics/newton/link_rows.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Largest resolved rotation of a body in a step [rad].
constexpr double kFastRotation = 0.5;
// Recommended rotation in a step [rad].
constexpr double kGoodRotation = 0.1;

std::string describe_rotation(const NewtonFailure& f) {
  double fastest = 0.0;
  std::size_t body = 0;
  for (std::size_t b = 0; b < f.model.bodies.size(); ++b) {
    const double rotation = f.step * f.start.bodies[b].w_WB_B.norm();
    if (rotation > fastest) {
      fastest = rotation;
      body = b;
    }
  }
  if (!(fastest > kFastRotation)) return {};
  return fmt::format(
      "body '{}' rotates by {:.2g} rad in the step of {:.3g} s; a step of "
      "{:.1g} s would resolve it",
      f.model.bodies[body].name, fastest, f.step,
      f.step * kGoodRotation / fastest);
}

std::string describe_mode(const NewtonFailure& f) {
  if (!(f.correction.modal > f.correction.rigid)) return {};
  const BodyModel& body = f.model.bodies[f.correction.body];
  if (body.modes == 0) return {};
  Eigen::Index mode = 0;
  f.increments.segment(body.row + 6, body.modes).cwiseAbs().maxCoeff(&mode);
  return fmt::format(
      "mode {} of it, of {:.3g} Hz, moves most; a smaller step, or damping of "
      "that mode, may help",
      mode + 1,
      std::sqrt(flexbody::rest_stiffness(body.elasticity)[mode]) /
          (2.0 * std::numbers::pi));
}

std::size_t count_links(const SystemModel& model) {
  return model.couplers.size() + model.transmissions.size();
}

const std::string& name_link(const SystemModel& model, std::size_t link) {
  const std::size_t couplers = model.couplers.size();
  return link < couplers ? model.couplers[link].name
                         : model.transmissions[link - couplers].name;
}

// A force that is not finite makes every correction NaN, also those of other
// bodies, so it is reported in place of a body.
std::string describe_broken_link(const NewtonFailure& f, const char* what) {
  if (std::isfinite(f.correction.value)) return {};
  for (std::size_t i = 0; i < count_links(f.model); ++i) {
    // The square of a large number may overflow.
    if (std::isfinite(NewtonMatrix::find_gap(f.terms, i).norm())) continue;
    return fmt::format(
        "coupler '{}' at t = {:.9g} s: its force is NaN or too large, and {}; "
        "a "
        "smaller step, or more damping in it, may help",
        name_link(f.model, i), f.end, what);
  }
  return {};
}

std::string describe_coupler(const NewtonFailure& f) {
  const std::size_t links = count_links(f.model);
  double largest = 0.0;
  std::size_t link = links;
  for (std::size_t i = 0; i < links; ++i) {
    if (find_constraint(f.terms, i) != nullptr) continue;  // no force
    const double gap = NewtonMatrix::find_gap(f.terms, i).norm();
    if (gap > largest) {
      largest = gap;
      link = i;
    }
  }
  if (link == links) return "a smaller step may help";
  return fmt::format(
      "the force of coupler '{}' changes most between iterations, by {:.2g} N "
      "or "
      "N m; a smaller step, or more damping in it, may help",
      name_link(f.model, link), largest);
}

}  // namespace

std::string describe(const NewtonFailure& failure, const char* what) {
  const std::string link = describe_broken_link(failure, what);
  if (!link.empty()) return link;
  std::string cause = describe_rotation(failure);
  if (cause.empty()) cause = describe_mode(failure);
  if (cause.empty()) cause = describe_coupler(failure);
  return fmt::format(
      "body '{}' at t = {:.9g} s: {} (last correction {:.3g} m, tolerance "
      "{:.3g} m): {}",
      failure.model.bodies[failure.correction.body].name, failure.end, what,
      failure.correction.value, failure.limit, cause);
}

}  // namespace limber::dynamics
