// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/pairs/point_springs.hpp"

#include <fmt/format.h>

#include <utility>

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

// From the place on A to that on B, along the axes of the world.
RelativeMotion find_line(const PairBodies& bodies,
                         const PointSprings::Line& line) {
  RelativeMotion motion;
  motion.p_FM_F =
      find_position(bodies.B, line.on_B) - find_position(bodies.A, line.on_A);
  motion.v_FM_F =
      find_velocity(bodies.B, line.on_B) - find_velocity(bodies.A, line.on_A);
  return motion;
}

void add_line(const PointSprings::Line& line, const CouplerResponse& response,
              PairResponse& out) {
  out.energy += response.energy;
  out.dissipation += response.dissipation;
  if (response.wrench.isZero(0.0) && response.stiffness.isZero(0.0) &&
      response.damping.isZero(0.0)) {
    return;
  }
  PairPoint& point = out.add();
  point.on_A = line.on_A;
  point.on_B = line.on_B;
  point.force_W = response.wrench.head<3>();
  point.stiffness = response.stiffness.topLeftCorner<3, 3>();
  point.damping = response.damping.topLeftCorner<3, 3>();
}

void check_place(const PairPlace& place, int modes, std::size_t line,
                 const char* body) {
  if (place.Phi_B.cols() == modes) return;
  throw InputError(fmt::format(
      "line {} has {} modes of body {}, which has {}; expected as many",
      line + 1, place.Phi_B.cols(), body, modes));
}

}  // namespace

PointSprings::PointSprings(std::vector<Line> lines) : lines_(std::move(lines)) {
  if (lines_.empty()) {
    throw InputError("point springs: no lines; expected one or more");
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    for (const PairPlace* place : {&lines_[i].on_A, &lines_[i].on_B}) {
      if (place->x_B.allFinite() && place->Phi_B.allFinite()) continue;
      throw InputError(fmt::format(
          "point springs: line {} ends at a place that is not finite", i + 1));
    }
  }
}

void PointSprings::describe_parameters(Manifest& out) const {
  describe(out, "lines", lines_);
}

void PointSprings::check(int modes_A, int modes_B) const {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    check_place(lines_[i].on_A, modes_A, i, "A");
    check_place(lines_[i].on_B, modes_B, i, "B");
  }
}

void PointSprings::evaluate(const PairBodies& bodies,
                            const EvaluationTime& /*now*/,
                            std::span<const double> /*memory*/,
                            PairResponse& out) const {
  for (const Line& line : lines_) {
    add_line(line, line.spring.evaluate(find_line(bodies, line)), out);
  }
}

void PointSprings::evaluate_over_step(const PairStep& step,
                                      std::span<const double> /*memory*/,
                                      PairResponse& out) const {
  const CouplerMemory none;
  for (const Line& line : lines_) {
    const RelativeMotion begin = find_line(step.begin, line);
    const RelativeMotion end = find_line(step.end, line);
    RelativeMotion mean;
    mean.p_FM_F = 0.5 * (begin.p_FM_F + end.p_FM_F);
    mean.v_FM_F = (end.p_FM_F - begin.p_FM_F) / step.times.h;
    add_line(
        line,
        line.spring.evaluate_over_step({begin, end, mean}, none, step.times),
        out);
  }
}

}  // namespace limber::joints
