// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamics/node_motion.hpp"
#include "results/gnuplot.hpp"
#include "results/pictures.hpp"

namespace limber::results {
namespace {

using dynamics::BodyModel;
using dynamics::SystemModel;
using dynamics::SystemState;

// More triangles than this take gnuplot longer than a look is worth.
constexpr std::size_t kMostTriangles = 250000;
constexpr std::array<const char*, 4> kColours = {"#9a9a9a", "#0072B2",
                                                 "#D55E00", "#009E73"};

struct Bounds {
  Vector3 lower = Vector3::Constant(1e300);
  Vector3 upper = Vector3::Constant(-1e300);
  void include(const Vector3& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
};

// A state to draw: what is displaced from `base` is drawn so many times.
struct Pose3d {
  std::string name;
  const SystemState& state;
  const SystemState& base;
  double exaggeration = 1.0;

  template <typename Points>
  [[nodiscard]] Points place(const Points& from, const Points& to) const {
    return from + exaggeration * (to - from);
  }
};

// Positions of a body's kept rows in the world, 3 x n.
Matrix3X find_rows(const SystemModel& model, std::size_t b,
                   const SystemState& state) {
  const Matrix3X& x_B = model.bodies[b].reduced->rows.x_B;
  MatrixX p_WP(x_B.size(), 1);
  calc_node_positions(model, static_cast<dynamics::BodyIndex>(b), {&state, 1},
                      p_WP);
  return p_WP.reshaped(3, x_B.cols());
}

Matrix3X place_rows(const SystemModel& model, std::size_t b,
                    const Pose3d& pose) {
  return pose.place<Matrix3X>(find_rows(model, b, pose.base),
                              find_rows(model, b, pose.state));
}

std::size_t count_triangles(const SystemModel& model) {
  std::size_t count = 0;
  for (const BodyModel& body : model.bodies) {
    if (body.reduced) count += body.reduced->triangles.size();
  }
  return count;
}

// One polygon block for all surfaces at one state.
void add_surfaces(GnuplotScript& script, const std::string& block,
                  const SystemModel& model, const Pose3d& pose,
                  std::size_t stride, Bounds& bounds) {
  script.add(fmt::format("${} << EOD", block));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    if (!body.reduced) continue;
    const Matrix3X points = place_rows(model, b, pose);
    const auto& triangles = body.reduced->triangles;
    for (std::size_t t = 0; t < triangles.size(); t += stride) {
      for (const std::size_t corner : triangles[t]) {
        const Vector3 p = points.col(static_cast<Eigen::Index>(corner));
        bounds.include(p);
        script.add(fmt::format("{:.6g} {:.6g} {:.6g}", p[0], p[1], p[2]));
      }
      script.add("");
    }
  }
  script.add("EOD");
}

// Rigid bodies have no shape: a mark at the centre of mass, lines to what
// their couplers hold.
void add_rigid_bodies(GnuplotScript& script, const std::string& block,
                      const SystemModel& model, const Pose3d& pose,
                      Bounds& bounds) {
  const auto center = [&](std::size_t b) {
    return pose.place<Vector3>(pose.base.bodies[b].p_WB,
                               pose.state.bodies[b].p_WB);
  };
  const auto line = [&](const Vector3& p) {
    bounds.include(p);
    script.add(fmt::format("{:.6g} {:.6g} {:.6g}", p[0], p[1], p[2]));
  };
  script.add(fmt::format("${}_marks << EOD", block));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].reduced) line(center(b));
  }
  script.add("EOD");
  script.add(fmt::format("${}_lines << EOD", block));
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const int b = model.attachments[i].body;
    if (b == dynamics::kWorld ||
        model.bodies[static_cast<std::size_t>(b)].reduced) {
      continue;
    }
    line(center(static_cast<std::size_t>(b)));
    const auto frame = [&](const SystemState& state) {
      return find_frame_motion(model, state, static_cast<int>(i)).X_WF.p;
    };
    line(pose.place<Vector3>(frame(pose.base), frame(pose.state)));
    script.add("");
    script.add("");
  }
  script.add("EOD");
}

void set_view(GnuplotScript& script, const Bounds& bounds) {
  const Vector3 center = 0.5 * (bounds.lower + bounds.upper);
  const double half =
      std::max(0.55 * (bounds.upper - bounds.lower).maxCoeff(), 1e-6);
  const char axes[] = "xyz";
  for (int a = 0; a < 3; ++a) {
    script.add(fmt::format("set {}range [{:g}:{:g}]", axes[a], center[a] - half,
                           center[a] + half));
    script.add(fmt::format("set {}label '{} [m]'", axes[a], axes[a]));
  }
  script.add("set pm3d border lc rgb '#404040' lw 0.05");
  script.add("set pm3d depthorder");
  script.add("set view equal xyz");
  script.add("set view 68, 35, 1.25");
  script.add("set xyplane at " + fmt::format("{:g}", center[2] - half));
  script.add("set border 4095 lc rgb '#cccccc' lw 0.6");
  script.add("set ticslevel 0");
  script.add("set tics textcolor rgb '#333333'");
  script.add("set key at screen 0.97,0.93 right");
}

std::string draw(const std::filesystem::path& file, const std::string& heading,
                 const SystemModel& model, const std::vector<Pose3d>& poses) {
  if (poses.empty()) return "no picture: there is no state to draw";
  GnuplotScript script(file, 1200, 1000);
  const std::size_t total = count_triangles(model) * poses.size();
  const std::size_t stride =
      std::max<std::size_t>(1, (total + kMostTriangles - 1) / kMostTriangles);
  Bounds bounds;
  std::string plot;
  for (std::size_t s = 0; s < poses.size(); ++s) {
    const std::string block = fmt::format("s{}", s);
    const char* colour = kColours[s % kColours.size()];
    const char* separator = s == 0 ? "splot " : ", ";
    if (total > 0) {
      add_surfaces(script, block, model, poses[s], stride, bounds);
      plot += fmt::format(
          "{}${} with polygons fs transparent solid {} fc rgb '{}' notitle",
          separator, block, s == 0 ? 0.25 : 0.8, colour);
      separator = ", ";
    }
    add_rigid_bodies(script, block, model, poses[s], bounds);
    plot += fmt::format(
        "{}${}_lines with lines lc rgb '{}' lw 2.5 notitle, ${}_marks with "
        "points pt 7 ps 1.6 lc rgb '{}' notitle, NaN with lines lw 6 lc rgb "
        "'{}' title {}",
        separator, block, colour, block, colour, colour, quote(poses[s].name));
  }
  script.add("set title " + quote(heading) + " font 'sans,18'");
  set_view(script, bounds);
  script.add(plot);
  return script.run();
}

}  // namespace

std::string draw_scene(const std::filesystem::path& file,
                       const std::string& title, const SystemModel& model,
                       const std::vector<SystemState>& states) {
  std::vector<Pose3d> poses;
  for (const SystemState& state : states) {
    poses.push_back({fmt::format("t = {:g} s", state.t), state, state});
  }
  return draw(file, title, model, poses);
}

std::string draw_displacement(const std::filesystem::path& file,
                              const std::string& title,
                              const SystemModel& model,
                              const SystemState& start,
                              const SystemState& state, double exaggeration) {
  std::string heading = title;
  if (exaggeration != 1.0) {
    heading += fmt::format(" (displacement x {:g})", exaggeration);
  }
  return draw(
      file, heading, model,
      {{"start", start, start}, {"equilibrium", state, start, exaggeration}});
}

}  // namespace limber::results
