// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/results/gnuplot.hpp"
#include "limber/results/offset.hpp"
#include "limber/results/pictures.hpp"
#include "limber/results/scene_view.hpp"
#include "limber/results/solids.hpp"

namespace limber::results {
namespace {

using dynamics::BodyModel;
using dynamics::SystemModel;
using dynamics::SystemState;

// More triangles than this take gnuplot too long.
constexpr std::size_t kMostTriangles = 250000;
constexpr std::array<const char*, 4> kShotColours = {"#9a9a9a", "#0072B2",
                                                     "#D55E00", "#009E73"};

// A state drawn in one colour.
struct Shot {
  std::string name;
  std::vector<Surface> surfaces;
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

// The same with the deformation magnified.
Matrix3X find_magnified_rows(const SystemModel& model, std::size_t b,
                             const SystemState& state, double magnification) {
  Matrix3X rows = find_rows(model, b, state);
  if (magnification == 1.0) return rows;
  MatrixX u_B(rows.size(), 1);
  calc_node_deformations(model, static_cast<dynamics::BodyIndex>(b),
                         {&state, 1}, u_B);
  rows += (magnification - 1.0) * (state.bodies[b].quat_WB.toRotationMatrix() *
                                   u_B.reshaped(3, rows.cols()));
  return rows;
}

// A solid fixed to the frame of a body, or to the world (kWorld).
struct BodySolid {
  dynamics::BodyIndex body;
  Solid solid;  // frame of the body
};

// The shapes of rigid bodies and of the world, the latter from the offset, and
// left out of a scene that travels. A body without one is the ellipsoid of its
// inertia; planes have no end and are left out.
std::vector<BodySolid> find_solids(const SystemModel& model,
                                   const Scenery& scenery, const Home& home) {
  std::vector<BodySolid> solids;
  std::vector<bool> has_shape(model.bodies.size(), false);
  for (const SceneryShape& shape : scenery.shapes) {
    const bool is_fixed = shape.body == dynamics::kWorld;
    if (shape.form.kind == "plane" || (is_fixed && home.travels)) continue;
    solids.push_back(
        {shape.body, place_solid(make_solid(shape.form, 1.0), shape.X_BS)});
    if (is_fixed) {
      solids.back().solid.x.colwise() -= home.offset;
      continue;
    }
    has_shape[static_cast<std::size_t>(shape.body)] = true;
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    if (body.reduced || has_shape[b]) continue;
    solids.push_back({static_cast<dynamics::BodyIndex>(b),
                      make_ellipsoid(body.mass, body.J0)});
  }
  return solids;
}

Surface make_surface(const Solid& solid, const Matrix3X& points) {
  Surface surface{points, {}};
  for (std::size_t i = 0; i + 2 < solid.corners.size(); i += 3) {
    surface.triangles.push_back(
        {solid.corners[i], solid.corners[i + 1], solid.corners[i + 2]});
  }
  return surface;
}

Matrix3X find_points(const BodySolid& of, const SystemState& state) {
  if (of.body == dynamics::kWorld) return of.solid.x;
  const auto& body = state.bodies[static_cast<std::size_t>(of.body)];
  return (body.quat_WB.toRotationMatrix() * of.solid.x).colwise() + body.p_WB;
}

// @param rows positions of a flexible body's rows, and @param points of a
// solid, in the world
template <typename Rows, typename Points>
Shot take_shot(const std::string& name, const SystemModel& model,
               const std::vector<BodySolid>& solids, const Rows& rows,
               const Points& points) {
  Shot shot{name, {}};
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].reduced) continue;
    shot.surfaces.push_back({rows(b), model.bodies[b].reduced->triangles});
  }
  for (const BodySolid& of : solids) {
    shot.surfaces.push_back(make_surface(of.solid, points(of)));
  }
  return shot;
}

Shot take_magnified(const std::string& name, const SystemModel& model,
                    const std::vector<BodySolid>& solids,
                    const SystemState& state, double magnification) {
  return take_shot(
      name, model, solids,
      [&](std::size_t b) {
        return find_magnified_rows(model, b, state, magnification);
      },
      [&](const BodySolid& of) { return find_points(of, state); });
}

Shot take_displaced(const std::string& name, const SystemModel& model,
                    const std::vector<BodySolid>& solids,
                    const Displacement& moved) {
  return take_shot(
      name, model, solids,
      [&](std::size_t b) {
        return moved.place<Matrix3X>(find_rows(model, b, moved.from),
                                     find_rows(model, b, moved.to));
      },
      [&](const BodySolid& of) {
        return moved.place<Matrix3X>(find_points(of, moved.from),
                                     find_points(of, moved.to));
      });
}

// Some points of all surfaces, the same ones of every shot.
Matrix3X sample(const Shot& shot) {
  constexpr Eigen::Index kSampled = 300;  // of a surface
  std::vector<Vector3> points;
  for (const Surface& surface : shot.surfaces) {
    const Eigen::Index stride = 1 + surface.points.cols() / kSampled;
    for (Eigen::Index i = 0; i < surface.points.cols(); i += stride) {
      points.emplace_back(surface.points.col(i));
    }
  }
  Matrix3X all(3, std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) = points[i];
  }
  return all;
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

std::array<Vector3, 3> find_corners(const Surface& surface, std::size_t t) {
  const auto& [a, b, c] = surface.triangles[t];
  const auto at = [&](std::size_t corner) -> Vector3 {
    return surface.points.col(static_cast<Eigen::Index>(corner));
  };
  return {at(a), at(b), at(c)};
}

Vector3 find_area(const std::array<Vector3, 3>& corners) {
  return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

// Whether the surface is closed, so that its triangles are seen from outside.
bool is_closed(const Surface& surface) {
  constexpr double kNone = 1e-6;  // of its area [-]
  Vector3 sum = Vector3::Zero();
  double area = 0.0;
  double volume = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto corners = find_corners(surface, t);
    const Vector3 of = find_area(corners);
    sum += of;
    area += of.norm();
    volume += of.dot(corners[0]) / 3.0;
  }
  return sum.norm() < kNone * area && volume > 0.0;
}

// A block of the polygons of one shot, without those that face away from the
// eye and are hidden by others.
void add_block(GnuplotScript& script, const std::string& block,
               const Shot& shot, std::size_t stride, const Vector3& eye) {
  script.add(fmt::format("${} << EOD", block));
  for (const Surface& surface : shot.surfaces) {
    const bool hides = is_closed(surface);
    for (std::size_t t = 0; t < surface.triangles.size(); t += stride) {
      const auto corners = find_corners(surface, t);
      if (hides && find_area(corners).dot(eye) < 0.0) continue;
      std::string lines;
      for (const Vector3& p : corners) {
        fmt::format_to(std::back_inserter(lines), "{:.6g} {:.6g} {:.6g}\n",
                       p[0], p[1], p[2]);
      }
      script.add(lines);
    }
  }
  script.add("EOD");
}

Bounds find_bounds(const std::vector<Shot>& shots) {
  Bounds bounds;
  for (const Shot& shot : shots) {
    for (const Surface& surface : shot.surfaces) {
      for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        for (const Vector3& p : find_corners(surface, t)) bounds.include(p);
      }
    }
  }
  return bounds;
}

// Scale of gnuplot's cube that fits it and its labels into the height.
double find_scale(const Vector3& eye) {
  constexpr double kFits = 1.6;
  const double level = std::hypot(eye.x(), eye.y());
  const double wide = level > 0.0
                          ? (std::abs(eye.x()) + std::abs(eye.y())) / level
                          : std::numbers::sqrt2;
  return kFits / (eye.z() * wide + level);
}

// What axes count from; empty: the origin of the world.
std::string describe_origin(const Home& home) {
  if (home.travels) {
    return "axes from the mean of the bodies, which travel, at each moment";
  }
  const Vector3& o = home.offset;
  if (o.isZero(0.0)) return {};
  return fmt::format("axes from ({:.15g}, {:.15g}, {:.15g}) m", o[0], o[1],
                     o[2]);
}

void set_view(GnuplotScript& script, const Bounds& bounds, const Home& home,
              const ViewAngles& view, const Vector3& eye) {
  const Vector3 center = 0.5 * (bounds.lower + bounds.upper);
  const double half =
      std::max(0.55 * (bounds.upper - bounds.lower).maxCoeff(), 1e-6);
  const char axes[] = "xyz";
  for (int a = 0; a < 3; ++a) {
    script.add(fmt::format("set {}range [{:.9g}:{:.9g}]", axes[a],
                           center[a] - half, center[a] + half));
    script.add(fmt::format("set {}label '{} [m]'", axes[a], axes[a]));
  }
  script.add("set label " + quote(describe_origin(home)) +
             " at screen 0.03, screen 0.03");
  script.add("set pm3d border lc rgb '#404040' lw 0.05");
  script.add("set pm3d depthorder");
  script.add("set view equal xyz");
  script.add(fmt::format("set view {:.4g}, {:.4g}, {:.3g}", view.rot_x,
                         view.rot_z, find_scale(eye)));
  script.add("set xyplane at " + fmt::format("{:.9g}", center[2] - half));
  script.add("set border 4095 lc rgb '#cccccc' lw 0.6");
  script.add("set ticslevel 0");
  script.add("set tics textcolor rgb '#333333'");
  script.add("set key at screen 0.97,0.93 right");
}

// @param shots from `home`
std::string draw(const std::filesystem::path& file, const std::string& heading,
                 const std::vector<Shot>& shots, const Home& home) {
  std::vector<Matrix3X> samples;
  for (const Shot& shot : shots) samples.push_back(sample(shot));
  if (shots.empty() || samples.front().cols() == 0) {
    return "no picture: there is no surface to draw";
  }
  GnuplotScript script(file, 1200, 1000);
  const std::size_t total = count_triangles(shots);
  const std::size_t stride =
      std::max<std::size_t>(1, (total + kMostTriangles - 1) / kMostTriangles);
  const ViewAngles view = find_view(samples);
  const Vector3 eye = find_eye(view);
  std::string plot = "splot ";
  for (std::size_t s = 0; s < shots.size(); ++s) {
    const std::string block = fmt::format("s{}", s);
    const char* colour = kShotColours[s % kShotColours.size()];
    add_block(script, block, shots[s], stride, eye);
    plot += fmt::format(
        "{}${} with polygons fs transparent solid {} fc rgb '{}' notitle, "
        "NaN with lines lw 6 lc rgb '{}' title {}",
        s == 0 ? "" : ", ", block, s == 0 ? 0.25 : 0.8, colour, colour,
        quote(shots[s].name));
  }
  script.add("set title " + quote(heading) + " font 'sans,18'");
  set_view(script, find_bounds(shots), home, view, eye);
  script.add(plot);
  return script.run();
}

std::string head(const std::string& title, const char* what, double factor) {
  if (factor == 1.0) return title;
  return fmt::format("{} ({} x {:g})", title, what, factor);
}

double find_size(const std::vector<Shot>& shots) {
  Bounds bounds;
  for (const Shot& shot : shots) {
    const Matrix3X points = sample(shot);
    for (const auto& p : points.colwise()) bounds.include(p);
  }
  return bounds.size();
}

// Flexible bodies whose surface was not kept.
std::string name_missing(const SystemModel& model) {
  std::string names;
  for (const BodyModel& body : model.bodies) {
    if (!body.reduced || !body.reduced->triangles.empty()) continue;
    names += (names.empty() ? "" : ", ") + body.name;
  }
  return names.empty() ? "" : " (without " + names + ": surface not kept)";
}

}  // namespace

std::string draw_scene(const std::filesystem::path& file,
                       const std::string& title, const SystemModel& model,
                       const History& history, const Scenery& scenery) {
  if (history.states.empty()) return "no picture: there is no state to draw";
  const DeformationPeak peak = find_largest_deformation(model, history);
  const Home home = find_home(model, history.states);
  const std::vector<BodySolid> solids = find_solids(model, scenery, home);
  const std::size_t end = history.states.size() - 1;
  std::vector<std::pair<std::string, SystemState>> moments;
  const auto add = [&](const char* what, std::size_t output) {
    const SystemState& state = history.states[output];
    moments.emplace_back(
        fmt::format("{}, t = {:.9g} s", what, state.t),
        shift_bodies(
            state,
            home.offset + home.path.row(Eigen::Index(output)).transpose()));
  };
  add("start", 0);
  if (peak.output != 0 && peak.output != end) {
    add("largest deformation", peak.output);
  }
  if (end != 0) {
    add(peak.output == end && peak.deformation > 0.0
            ? "end and largest deformation"
            : "end",
        end);
  }
  const auto take = [&](double magnification) {
    std::vector<Shot> shots;
    for (const auto& [name, state] : moments) {
      shots.push_back(
          take_magnified(name, model, solids, state, magnification));
    }
    return shots;
  };
  std::vector<Shot> shots = take(1.0);
  const double magnification =
      find_magnification(peak.deformation, find_size(shots));
  if (magnification != 1.0) shots = take(magnification);
  return draw(file,
              head(title, "deformation", magnification) + name_missing(model),
              shots, home);
}

std::string draw_displacement(const std::filesystem::path& file,
                              const std::string& title,
                              const SystemModel& model,
                              const SystemState& start,
                              const SystemState& state, double exaggeration,
                              const Scenery& scenery) {
  const Home home = find_home(model, {&start, 1});
  const std::vector<BodySolid> solids = find_solids(model, scenery, home);
  const SystemState from = shift_bodies(start, home.offset);
  const SystemState to = shift_bodies(state, home.offset);
  return draw(
      file, head(title, "displacement", exaggeration) + name_missing(model),
      {take_displaced("start", model, solids, {from, from}),
       take_displaced("equilibrium", model, solids, {from, to, exaggeration})},
      home);
}

std::string draw_deformation(const std::filesystem::path& file,
                             const std::string& title, const Surface& surface,
                             const Matrix3X& u, double exaggeration) {
  Bounds bounds;
  for (const auto& p : surface.points.colwise()) bounds.include(p);
  const Home home{choose_offset(bounds), {}, false};
  const Surface undeformed{surface.points.colwise() - home.offset,
                           surface.triangles};
  const Surface deformed{undeformed.points + exaggeration * u,
                         surface.triangles};
  return draw(file, head(title, "displacement", exaggeration),
              {{"undeformed", {undeformed}}, {"deformed", {deformed}}}, home);
}

}  // namespace limber::results
