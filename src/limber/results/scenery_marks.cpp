// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/scenery_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_rows.hpp"
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

constexpr int kBetweenJumps = 16;
constexpr std::size_t kMostJumps = 1000;

using Place = std::pair<double, Side>;

bool is_before(const Place& a, const Place& b) {
  if (a.first != b.first) return a.first < b.first;
  return a.second == Side::left && b.second == Side::right;
}

/// Both sides of the jumps that a function has between the outputs, and times
/// between these jumps.
std::vector<Place> list_places(const dynamics::TimeFunction& function,
                               const std::vector<double>& outputs) {
  std::vector<double> jumps = break_times(function);
  std::erase_if(jumps, [&](double t) {
    return outputs.empty() || !(t >= outputs.front() && t <= outputs.back());
  });
  jumps.resize(std::min(jumps.size(), kMostJumps));
  std::vector<Place> places;
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
  std::sort(places.begin(), places.end(), is_before);
  return places;
}

/// A function of time at the outputs and at `places`.
void write_course(Hdf5File& out, const std::string& name,
                  const dynamics::TimeFunction& function,
                  const History& history) {
  const bool is_input =
      std::holds_alternative<dynamics::InputFunction>(function);
  const std::vector<Place> places =
      is_input ? std::vector<Place>() : list_places(function, history.times);
  Hdf5Rows rows(out, name, std::ssize(history.times) + std::ssize(places), 2,
                "s, 1",
                "time and factor, linear between; a time twice: a jump");
  auto place = places.begin();
  const auto pass_places = [&](const Place& until) {
    for (; place != places.end() && is_before(*place, until); ++place) {
      rows.next() << place->first,
          evaluate(function, place->first, place->second);
    }
  };
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    const double t = history.times[i];
    pass_places({t, Side::right});
    rows.next() << t,
        is_input ? evaluate(function, dynamics::now_of(history.states[i]))
                 : evaluate(function, t, Side::right);
  }
  constexpr double kEver = std::numeric_limits<double>::infinity();
  pass_places({kEver, Side::right});
  rows.close();
}

void write_loads(Hdf5File& out, const SystemModel& model,
                 const History& history) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const dynamics::Load& load = model.loads[i];
    const std::string at = fmt::format("scene/loads/{:04}/", i);
    out.write(at + "name", load.name, "load");
    out.write(at + "frame", std::string(load.in_world ? "world" : "body"),
              "frame of force and moment");
    out.write(at + "force", MatrixX(load.force.transpose()), "N", "force");
    out.write(at + "moment", MatrixX(load.moment.transpose()), "N m", "moment");
    write_course(out, at + "course", load.function, history);
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

/// Where and how a pair touches at each output.
class TouchWriter {
 public:
  TouchWriter(Hdf5File& out, const std::string& at, const SystemModel& model,
              const dynamics::Pair& pair, Eigen::Index outputs)
      : model_(model),
        pair_(pair),
        scratch_(dynamics::make_response(model, pair)),
        touch_(out, at + "touch", outputs, kTouchNumbers, "m, N",
               "place and force on B at each output, world; zero while apart, "
               "NaN where it cannot be computed"),
        patch_(out, at + "patch", outputs, kPatchNumbers, "m, m, N, 1",
               "two half axes of the ellipse of uniform pressure with the "
               "touch's second moments, friction on B, 1 where it slips, "
               "world; zero while apart, NaN where it cannot be computed") {}

  void add(const dynamics::SystemState& state) {
    auto touch = touch_.next();
    auto patch = patch_.next();
    touch.setZero();
    patch.setZero();
    const dynamics::PairMotion motion = find_pair_motion(model_, pair_, state);
    try {
      const joints::TouchReading reading =
          pair_.law->touching()->read(motion.bodies(), dynamics::now_of(state),
                                      memory_of(pair_, state), scratch_);
      if (reading.points == 0) return;
      const Eigen::Matrix<double, 3, 2> axes = find_axes(reading);
      touch << reading.p_W.transpose(), reading.force_W.transpose();
      patch << axes.col(0).transpose(), axes.col(1).transpose(),
          reading.friction_W.transpose(), reading.slips ? 1.0 : 0.0;
    } catch (const NumericalError&) {
      const double gap = std::numeric_limits<double>::quiet_NaN();
      touch.setConstant(gap);
      patch.setConstant(gap);
    }
  }

  void close() {
    touch_.close();
    patch_.close();
  }

 private:
  const SystemModel& model_;
  const dynamics::Pair& pair_;
  joints::PairResponse scratch_;
  Hdf5Rows touch_;  // place and force on B; zero while apart
  Hdf5Rows patch_;  // half axes, friction on B, whether it slips
};

void write_contacts(Hdf5File& out, const SystemModel& model,
                    const History& history) {
  std::vector<TouchWriter> writers;
  for (const dynamics::Pair& pair : model.pairs) {
    if (pair.law->touching() == nullptr) continue;
    const std::string at = fmt::format("scene/contacts/{:04}/", writers.size());
    out.write(at + "name", pair.name, "contact");
    out.write(at + "A", name_body(model, pair.body_A), "empty: the world");
    out.write(at + "B", name_body(model, pair.body_B), "empty: the world");
    writers.emplace_back(out, at, model, pair, std::ssize(history.states));
  }
  if (writers.empty()) return;
  for (const dynamics::SystemState& state : history.states) {
    for (TouchWriter& writer : writers) writer.add(state);
  }
  for (TouchWriter& writer : writers) writer.close();
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
