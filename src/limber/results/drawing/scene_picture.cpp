// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/results/drawing/scene_drawing.hpp"
#include "limber/results/offset.hpp"
#include "limber/results/pictures.hpp"
#include "limber/results/scene_view.hpp"
#include "limber/results/solids.hpp"

namespace limber::results {
namespace {

using dynamics::BodyModel;
using dynamics::SystemModel;
using dynamics::SystemState;

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

// A solid fixed to the frame of a body.
struct BodySolid {
  dynamics::BodyIndex body;
  Solid solid;  // frame of the body
};

Surface make_surface(const Solid& solid, const Matrix3X& points) {
  Surface surface{points, {}};
  for (std::size_t i = 0; i + 2 < solid.corners.size(); i += 3) {
    surface.triangles.push_back(
        {solid.corners[i], solid.corners[i + 1], solid.corners[i + 2]});
  }
  return surface;
}

// What does not move, from the home; nothing of it in a scene that travels.
struct World {
  std::vector<Surface> surfaces;
  std::vector<EndlessPlane> planes;
};

World find_world(const Scenery& scenery, const Home& home) {
  World world;
  if (home.travels) return world;
  for (const SceneryShape& shape : scenery.shapes) {
    if (shape.body != dynamics::kWorld) continue;
    if (shape.form.kind == "plane") {
      world.planes.push_back({shape.X_BS.p - home.offset, shape.X_BS.R.col(2)});
      continue;
    }
    const Solid solid = place_solid(make_solid(shape.form, 1.0), shape.X_BS);
    world.surfaces.push_back(
        make_surface(solid, solid.x.colwise() - home.offset));
  }
  return world;
}

// The shapes of rigid bodies. A body without one is the ellipsoid of its
// inertia; planes have no end and are left out.
std::vector<BodySolid> find_solids(const SystemModel& model,
                                   const Scenery& scenery) {
  std::vector<BodySolid> solids;
  std::vector<bool> has_shape(model.bodies.size(), false);
  for (const SceneryShape& shape : scenery.shapes) {
    if (shape.body == dynamics::kWorld || shape.form.kind == "plane") continue;
    solids.push_back(
        {shape.body, place_solid(make_solid(shape.form, 1.0), shape.X_BS)});
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

Matrix3X find_points(const BodySolid& of, const SystemState& state) {
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

// Where the picture is; empty: near the origin of the world.
std::string describe_origin(const Home& home) {
  if (home.travels) {
    return "relative to the mean position of the bodies, which travel, at each "
           "time";
  }
  const Vector3& o = home.offset;
  if (o.isZero(0.0)) return {};
  return fmt::format("near ({:.15g}, {:.15g}, {:.15g}) m", o[0], o[1], o[2]);
}

// @param shots from `home`
std::string draw(const std::filesystem::path& file, const std::string& heading,
                 std::vector<Shot> shots, World world, const Home& home) {
  std::vector<Matrix3X> samples;
  for (const Shot& shot : shots) samples.push_back(sample(shot));
  if (shots.empty() || samples.front().cols() == 0) {
    return "no picture: there is no surface to draw";
  }
  const DrawnScene scene{heading,
                         describe_origin(home),
                         std::move(shots),
                         std::move(world.surfaces),
                         std::move(world.planes),
                         find_view(samples)};
  try {
    write_scene(file, scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
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
  const std::vector<BodySolid> solids = find_solids(model, scenery);
  const std::size_t end = history.states.size() - 1;
  std::vector<std::pair<std::string, SystemState>> moments;
  const auto add = [&](const char* what, std::size_t output) {
    const SystemState state = history.states[output];
    Vector3 origin = home.offset;
    if (home.travels) origin += home.path.row(Eigen::Index(output)).transpose();
    moments.emplace_back(fmt::format("{}, t = {:.9g} s", what, state.t),
                         shift_bodies(state, origin));
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
              std::move(shots), find_world(scenery, home), home);
}

std::string draw_displacement(const std::filesystem::path& file,
                              const std::string& title,
                              const SystemModel& model,
                              const SystemState& start,
                              const SystemState& state, double exaggeration,
                              const Scenery& scenery) {
  const Home home = find_home(model, {start});
  const std::vector<BodySolid> solids = find_solids(model, scenery);
  const SystemState from = shift_bodies(start, home.offset);
  const SystemState to = shift_bodies(state, home.offset);
  return draw(
      file, head(title, "displacement", exaggeration) + name_missing(model),
      {take_displaced("start", model, solids, {from, from}),
       take_displaced("equilibrium", model, solids, {from, to, exaggeration})},
      find_world(scenery, home), home);
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
              {{"undeformed", {undeformed}}, {"deformed", {deformed}}}, {},
              home);
}

}  // namespace limber::results
