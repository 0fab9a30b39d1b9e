// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/results/gnuplot.hpp"
#include "limber/results/pictures.hpp"

namespace limber::results {
namespace {

using dynamics::BodyModel;
using dynamics::SystemModel;
using dynamics::SystemState;

// More triangles than this take gnuplot too long.
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

// A state drawn in one colour.
struct Shot {
  std::string name;
  std::vector<Surface> surfaces;
  std::vector<Vector3> marks;
  std::vector<std::pair<Vector3, Vector3>> lines;
};

// Magnifies the displacement from one state to another.
struct Displacement {
  const SystemState& from;
  const SystemState& to;
  double exaggeration = 1.0;

  template <typename Points>
  [[nodiscard]] Points place(const Points& start, const Points& end) const {
    return start + exaggeration * (end - start);
  }
};

// Positions of a body's stored rows in the world, 3 x n.
Matrix3X find_rows(const SystemModel& model, std::size_t b,
                   const SystemState& state) {
  const Matrix3X& x_B = model.bodies[b].reduced->rows.x_B;
  MatrixX p_WP(x_B.size(), 1);
  calc_node_positions(model, static_cast<dynamics::BodyIndex>(b), {&state, 1},
                      p_WP);
  return p_WP.reshaped(3, x_B.cols());
}

// Rigid bodies have no shape: a mark at the centre of mass, lines to their
// coupler frames.
void add_rigid_bodies(const SystemModel& model, const Displacement& moved,
                      Shot& shot) {
  const auto center = [&](std::size_t b) {
    return moved.place<Vector3>(moved.from.bodies[b].p_WB,
                                moved.to.bodies[b].p_WB);
  };
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].reduced) shot.marks.push_back(center(b));
  }
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const dynamics::BodyIndex b = model.attachments[i].body;
    if (b == dynamics::kWorld ||
        model.bodies[static_cast<std::size_t>(b)].reduced) {
      continue;
    }
    const auto frame = [&](const SystemState& state) {
      return find_frame_motion(model, state, dynamics::AttachmentIndex(i))
          .X_WF.p;
    };
    shot.lines.emplace_back(
        center(static_cast<std::size_t>(b)),
        moved.place<Vector3>(frame(moved.from), frame(moved.to)));
  }
}

Shot take_shot(const std::string& name, const SystemModel& model,
               const Displacement& moved) {
  Shot shot{name, {}, {}, {}};
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].reduced) continue;
    shot.surfaces.push_back(
        {moved.place<Matrix3X>(find_rows(model, b, moved.from),
                               find_rows(model, b, moved.to)),
         model.bodies[b].reduced->triangles});
  }
  add_rigid_bodies(model, moved, shot);
  return shot;
}

Surface place(const BodySurface& shape, const SystemState& state) {
  if (shape.body == dynamics::kWorld) return shape.surface;
  const auto& body = state.bodies[static_cast<std::size_t>(shape.body)];
  const Matrix3 R_WB = body.quat_WB.toRotationMatrix();
  const Matrix3X points = (R_WB * shape.surface.points).colwise() + body.p_WB;
  return {points, shape.surface.triangles};
}

std::size_t count_triangles(const std::vector<Shot>& shots) {
  std::size_t count = 0;
  for (const Shot& shot : shots) {
    for (const Surface& surface : shot.surfaces) {
      count += surface.triangles.size();
    }
  }
  return count;
}

// Blocks of polygons, marks and lines of one shot.
void add_blocks(GnuplotScript& script, const std::string& block,
                const Shot& shot, std::size_t stride, Bounds& bounds) {
  const auto point = [&](const Vector3& p) {
    bounds.include(p);
    script.add(fmt::format("{:.6g} {:.6g} {:.6g}", p[0], p[1], p[2]));
  };
  script.add(fmt::format("${} << EOD", block));
  for (const Surface& surface : shot.surfaces) {
    for (std::size_t t = 0; t < surface.triangles.size(); t += stride) {
      for (const std::size_t corner : surface.triangles[t]) {
        point(surface.points.col(static_cast<Eigen::Index>(corner)));
      }
      script.add("");
    }
  }
  script.add("EOD");
  script.add(fmt::format("${}_marks << EOD", block));
  for (const Vector3& mark : shot.marks) point(mark);
  script.add("EOD");
  script.add(fmt::format("${}_lines << EOD", block));
  for (const auto& [from, to] : shot.lines) {
    point(from);
    point(to);
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
                 const std::vector<Shot>& shots) {
  if (shots.empty()) return "no picture: there is no state to draw";
  GnuplotScript script(file, 1200, 1000);
  const std::size_t total = count_triangles(shots);
  const std::size_t stride =
      std::max<std::size_t>(1, (total + kMostTriangles - 1) / kMostTriangles);
  Bounds bounds;
  std::string plot;
  for (std::size_t s = 0; s < shots.size(); ++s) {
    const std::string block = fmt::format("s{}", s);
    const char* colour = kColours[s % kColours.size()];
    const char* separator = s == 0 ? "splot " : ", ";
    add_blocks(script, block, shots[s], stride, bounds);
    if (total > 0) {
      plot += fmt::format(
          "{}${} with polygons fs transparent solid {} fc rgb '{}' notitle",
          separator, block, s == 0 ? 0.25 : 0.8, colour);
      separator = ", ";
    }
    plot += fmt::format(
        "{}${}_lines with lines lc rgb '{}' lw 2.5 notitle, ${}_marks with "
        "points pt 7 ps 1.6 lc rgb '{}' notitle, NaN with lines lw 6 lc rgb "
        "'{}' title {}",
        separator, block, colour, block, colour, colour, quote(shots[s].name));
  }
  script.add("set title " + quote(heading) + " font 'sans,18'");
  set_view(script, bounds);
  script.add(plot);
  return script.run();
}

std::string head(const std::string& title, double exaggeration) {
  if (exaggeration == 1.0) return title;
  return fmt::format("{} (displacement x {:g})", title, exaggeration);
}

}  // namespace

std::string draw_scene(const std::filesystem::path& file,
                       const std::string& title, const SystemModel& model,
                       const std::vector<SystemState>& states,
                       const std::vector<BodySurface>& shapes) {
  std::vector<Shot> shots;
  for (const SystemState& state : states) {
    shots.push_back(
        take_shot(fmt::format("t = {:g} s", state.t), model, {state, state}));
    for (const BodySurface& shape : shapes) {
      shots.back().surfaces.push_back(place(shape, state));
    }
  }
  return draw(file, title, shots);
}

std::string draw_displacement(const std::filesystem::path& file,
                              const std::string& title,
                              const SystemModel& model,
                              const SystemState& start,
                              const SystemState& state, double exaggeration) {
  return draw(file, head(title, exaggeration),
              {take_shot("start", model, {start, start}),
               take_shot("equilibrium", model, {start, state, exaggeration})});
}

std::string draw_deformation(const std::filesystem::path& file,
                             const std::string& title, const Surface& surface,
                             const Matrix3X& u, double exaggeration) {
  const Surface deformed{surface.points + exaggeration * u, surface.triangles};
  return draw(
      file, head(title, exaggeration),
      {{"undeformed", {surface}, {}, {}}, {"deformed", {deformed}, {}, {}}});
}

}  // namespace limber::results
