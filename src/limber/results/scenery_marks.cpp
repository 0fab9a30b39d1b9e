// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/scenery_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::results {
namespace {

using dynamics::AttachmentIndex;
using dynamics::SystemModel;

void write_anchor(Hdf5File& out, const std::string& at,
                  const SystemModel& model, AttachmentIndex where) {
  const dynamics::Attachment& anchor = model.attachments[index(where)];
  out.write(at + "body", name_body(model, anchor.body),
            "body that carries it; empty: the world");
  out.write(at + "p_B", MatrixX(anchor.p_BF.transpose()), "m",
            "undeformed, body frame");
  // Else the mark follows the body.
  const bool has_modes = anchor.body == dynamics::kWorld ||
                         moves_linearly(model.bodies[index(anchor.body)]);
  out.write(at + "Phi_B", has_modes ? MatrixX(anchor.Phi_B) : MatrixX(3, 0),
            "kg^-1/2", "translation by the modes, 3 x m");
}

std::string name_kind(const joints::CouplerLaw& law) {
  constexpr const char* kNames[] = {"bushing", "spring", "joint", "latch"};
  static_assert(std::variant_size_v<joints::CouplerLaw> == std::size(kNames));
  return kNames[law.index()];
}

void write_couplers(Hdf5File& out, const SystemModel& model) {
  for (std::size_t i = 0; i < model.couplers.size(); ++i) {
    const dynamics::Coupler& coupler = model.couplers[i];
    const std::string at = fmt::format("scene/couplers/{:04}/", i);
    out.write(at + "name", coupler.name, "coupler");
    out.write(at + "kind", name_kind(coupler.law),
              "bushing, spring, joint or latch");
    write_anchor(out, at + "F/", model, coupler.frame_F);
    write_anchor(out, at + "M/", model, coupler.frame_M);
  }
}

void write_lines(Hdf5File& out, const SystemModel& model) {
  int count = 0;
  for (const dynamics::Transmission& line : model.transmissions) {
    const auto* path = std::get_if<dynamics::PathCoordinate>(&line.coordinate);
    if (path == nullptr) continue;
    const std::string at = fmt::format("scene/lines/{:04}/", count++);
    out.write(at + "name", line.name, "tendon");
    for (std::size_t p = 0; p < path->points.size(); ++p) {
      write_anchor(out, at + fmt::format("points/{:04}/", p), model,
                   path->points[p]);
    }
  }
}

/// A function of time at the outputs, on both sides of its jumps and between
/// these.
struct Course {
  std::vector<double> times;
  std::vector<double> values;
};

constexpr int kBetweenJumps = 16;
constexpr std::size_t kMostJumps = 1000;

Course find_course(const dynamics::TimeFunction& function,
                   const History& history) {
  Course course;
  if (history.times.empty()) return course;
  if (std::holds_alternative<dynamics::InputFunction>(function)) {
    for (const dynamics::SystemState& state : history.states) {
      course.times.push_back(state.t);
      course.values.push_back(evaluate(function, dynamics::now_of(state)));
    }
    return course;
  }
  std::vector<std::pair<double, Side>> places;
  for (const double t : history.times) places.emplace_back(t, Side::right);
  std::vector<double> jumps = break_times(function);
  std::erase_if(jumps, [&](double t) {
    return !(t >= history.times.front() && t <= history.times.back());
  });
  jumps.resize(std::min(jumps.size(), kMostJumps));
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    places.emplace_back(jumps[i], Side::left);
    places.emplace_back(jumps[i], Side::right);
    if (i + 1 == jumps.size()) break;
    for (int k = 1; k < kBetweenJumps; ++k) {
      places.emplace_back(
          jumps[i] + (jumps[i + 1] - jumps[i]) * k / kBetweenJumps,
          Side::right);
    }
  }
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    return a.second == Side::left && b.second == Side::right;
  });
  for (const auto& [t, side] : places) {
    course.times.push_back(t);
    course.values.push_back(evaluate(function, t, side));
  }
  return course;
}

void write_loads(Hdf5File& out, const SystemModel& model,
                 const History& history) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const dynamics::Load& load = model.loads[i];
    const std::string at = fmt::format("scene/loads/{:04}/", i);
    const Course course = find_course(load.function, history);
    const auto rows = std::ssize(course.times);
    MatrixX values(rows, 2);
    for (Eigen::Index r = 0; r < rows; ++r) {
      const auto k = static_cast<std::size_t>(r);
      values.row(r) << course.times[k], course.values[k];
    }
    out.write(at + "name", load.name, "load");
    out.write(at + "frame", std::string(load.in_world ? "world" : "body"),
              "frame of force and moment");
    out.write(at + "force", MatrixX(load.force.transpose()), "N", "force");
    out.write(at + "moment", MatrixX(load.moment.transpose()), "N m", "moment");
    out.write(at + "course", values, "s, 1",
              "time and factor, linear between; a time twice: a jump");
    write_anchor(out, at, model, load.where);
  }
}

// Two half axes of the ellipse whose uniform pressure has the second moments of
// the touch's, in its plane [m].
Eigen::Matrix<double, 3, 2> find_axes(const joints::TouchReading& touch) {
  const Vector3 u = touch.normal_W.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> plane;
  plane << u, touch.normal_W.cross(u);
  const Eigen::Matrix2d S = plane.transpose() * touch.spread_W * plane;
  // The principal directions of a symmetric 2 x 2 matrix.
  const double angle = 0.5 * std::atan2(2.0 * S(0, 1), S(0, 0) - S(1, 1));
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Eigen::Matrix2d rotation;
  rotation << c, -s, s, c;
  for (int i = 0; i < 2; ++i) {
    const double square = rotation.col(i).dot(S * rotation.col(i));
    rotation.col(i) *= 2.0 * std::sqrt(std::max(square, 0.0));
  }
  return plane * rotation;
}

constexpr Eigen::Index kTouchNumbers = 6;
constexpr Eigen::Index kPatchNumbers = 10;

struct TouchCourse {
  MatrixX touch;  // place and force on B, T x 6; zero while apart
  MatrixX patch;  // half axes, friction on B, whether it slips, T x 10
};

TouchCourse read_touches(const SystemModel& model, const dynamics::Pair& pair,
                         const History& history) {
  joints::PairResponse scratch = dynamics::make_response(model, pair);
  const Eigen::Index rows = std::ssize(history.states);
  TouchCourse course{MatrixX::Zero(rows, kTouchNumbers),
                     MatrixX::Zero(rows, kPatchNumbers)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const dynamics::SystemState& state =
        history.states[static_cast<std::size_t>(i)];
    const dynamics::PairMotion motion = find_pair_motion(model, pair, state);
    try {
      const joints::TouchReading reading =
          pair.law->touching()->read(motion.bodies(), dynamics::now_of(state),
                                     memory_of(pair, state), scratch);
      if (reading.points == 0) continue;
      const Eigen::Matrix<double, 3, 2> axes = find_axes(reading);
      course.touch.row(i) << reading.p_W.transpose(),
          reading.force_W.transpose();
      course.patch.row(i) << axes.col(0).transpose(), axes.col(1).transpose(),
          reading.friction_W.transpose(), reading.slips ? 1.0 : 0.0;
    } catch (const NumericalError&) {
      const double gap = std::numeric_limits<double>::quiet_NaN();
      course.touch.row(i).setConstant(gap);
      course.patch.row(i).setConstant(gap);
    }
  }
  return course;
}

void write_contacts(Hdf5File& out, const SystemModel& model,
                    const History& history) {
  int count = 0;
  for (const dynamics::Pair& pair : model.pairs) {
    if (pair.law->touching() == nullptr) continue;
    const std::string at = fmt::format("scene/contacts/{:04}/", count++);
    out.write(at + "name", pair.name, "contact");
    out.write(at + "A", name_body(model, pair.body_A), "empty: the world");
    out.write(at + "B", name_body(model, pair.body_B), "empty: the world");
    const TouchCourse course = read_touches(model, pair, history);
    out.write(at + "touch", course.touch, "m, N",
              "place and force on B at each output, world; zero while apart, "
              "NaN where it cannot be computed");
    out.write(at + "patch", course.patch, "m, m, N, 1",
              "two half axes of the ellipse of uniform pressure with the "
              "touch's second moments, friction on B, 1 where it slips, world; "
              "zero while apart, NaN where it cannot be computed");
  }
}

}  // namespace

bool moves_linearly(const dynamics::BodyModel& body) {
  return body.full < 0 && body.fidelity != dynamics::Fidelity::nonlinear;
}

std::string name_body(const SystemModel& model, dynamics::BodyIndex body) {
  return body == dynamics::kWorld ? "" : model.bodies[index(body)].name;
}

void write_marks(Hdf5File& out, const SystemModel& model,
                 const History& history) {
  write_couplers(out, model);
  write_lines(out, model);
  write_loads(out, model, history);
  write_contacts(out, model, history);
}

}  // namespace limber::results
