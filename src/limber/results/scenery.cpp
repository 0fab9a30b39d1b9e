// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/scenery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

#include "limber/common/files/hdf5_rows.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/results/motion_shapes.hpp"
#include "limber/results/offset.hpp"
#include "limber/results/path_step.hpp"
#include "limber/results/scenery_marks.hpp"
#include "limber/results/stress_field.hpp"
#include "limber/version.hpp"

namespace limber::results {
namespace {

using dynamics::BodyModel;
using dynamics::SystemModel;
using flexbody::ReducedBody;

/// The rows of a body that its surface's triangles use, in their order, and the
/// triangles in terms of these.
struct SurfaceRows {
  std::vector<Eigen::Index> rows;
  std::vector<std::int64_t> corners;  // three a triangle
};

SurfaceRows find_surface_rows(const ReducedBody& body) {
  std::vector<std::int64_t> place(body.rows.tags.size(), -1);
  for (const auto& triangle : body.triangles) {
    for (const std::size_t row : triangle) place[row] = 0;
  }
  SurfaceRows surface;
  for (std::size_t row = 0; row < place.size(); ++row) {
    if (place[row] < 0) continue;
    place[row] = std::ssize(surface.rows);
    surface.rows.push_back(static_cast<Eigen::Index>(row));
  }
  for (const auto& triangle : body.triangles) {
    for (const std::size_t row : triangle) {
      surface.corners.push_back(place[row]);
    }
  }
  return surface;
}

/// The rows' entries of a matrix of three rows a node.
MatrixX take_nodes(const MatrixX& all, const std::vector<Eigen::Index>& rows) {
  MatrixX taken(3 * std::ssize(rows), all.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    taken.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        all.middleRows<3>(3 * rows[i]);
  }
  return taken;
}

/// Stress per modal coordinate at the rows, 6n x m; at a border of materials
/// that of the first; zero where there is none, on beams without dimensions.
MatrixX take_stress(const flexbody::StressModes& modes,
                    const std::vector<Eigen::Index>& rows, Eigen::Index m) {
  MatrixX taken = MatrixX::Zero(6 * std::ssize(rows), m);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<std::size_t>(rows[i]);
    const auto point =
        std::lower_bound(modes.rows.begin(), modes.rows.end(), row) -
        modes.rows.begin();
    if (point == std::ssize(modes.rows) ||
        modes.rows[static_cast<std::size_t>(point)] != row) {
      continue;
    }
    taken.middleRows<6>(6 * static_cast<Eigen::Index>(i)) =
        modes.Sigma_B.middleRows<6>(6 * point).leftCols(m);
  }
  return taken;
}

void write_surface(Hdf5File& out, const std::string& at,
                   const ReducedBody& body, const SurfaceRows& surface,
                   const MatrixX& shapes) {
  std::vector<std::int64_t> tags;
  for (const Eigen::Index row : surface.rows) {
    tags.push_back(static_cast<std::int64_t>(
        body.rows.tags[static_cast<std::size_t>(row)]));
  }
  out.write(at + "body", body.name, "reduced body");
  out.write(at + "key", body.content_key, "content key of the reduced body");
  out.write(at + "tags", tags, "1", "Gmsh node tags");
  out.write(at + "x_B", Matrix3X(body.rows.x_B(Eigen::all, surface.rows)), "m",
            "undeformed positions from the centre of mass, 3 x n");
  out.write_single(at + "Phi_B", shapes, "kg^-1/2",
                   "shapes at the nodes, 3n x m");
  out.write(at + "triangles", surface.corners, "1",
            "indices of nodes, three a triangle, outward");
}

/// Surfaces, each written once for all bodies that share it.
class SurfaceWriter {
 public:
  SurfaceWriter(Hdf5File& out, const Scenery& scenery, const SystemModel& model,
                const History& history)
      : out_(out), scenery_(scenery), model_(model), history_(history) {}

  void add(std::size_t b) {
    const BodyModel& body = model_.bodies[b];
    if (!body.reduced) return;
    const std::string at = "scene/bodies/" + to_path_step(body.name) + "/";
    if (body.reduced->triangles.empty()) {
      out_.write(at + "surface", std::string("none"), kSurfaceMeaning);
      return;
    }
    out_.write(at + "surface",
               moves_linearly(body) ? find_shared(body) : write_motion(b, at),
               kSurfaceMeaning);
    if (moves_linearly(body) && has_modal_stress(body) &&
        body.maxwell.size() > 0) {
      write_relaxed_stress(body, at);
    }
  }

 private:
  static constexpr const char* kSurfaceMeaning =
      "its group in scene/surfaces, or none: its rows were not kept";

  std::string next_name() { return fmt::format("{:04}", count_++); }

  std::string find_shared(const BodyModel& body) {
    const bool relaxes = body.maxwell.size() > 0;
    const auto key = std::make_tuple(body.reduced.get(), body.modes, relaxes);
    const auto found = shared_.find(key);
    if (found != shared_.end()) return found->second;
    std::string name = next_name();
    const SurfaceRows surface = find_surface_rows(*body.reduced);
    write_surface(out_, "scene/surfaces/" + name + "/", *body.reduced, surface,
                  take_nodes(body.reduced->rows.Phi_B.leftCols(body.modes),
                             surface.rows));
    if (has_modal_stress(body) && !relaxes) {
      out_.write_single(
          "scene/surfaces/" + name + "/Sigma_B",
          take_stress(*body.reduced->stress, surface.rows, body.modes),
          "kg^1/2 m^-2 s^-2",
          "stress of the shapes, 6n x m: xx, yy, zz, xy, yz, xz");
    }
    shared_[key] = name;
    return name;
  }

  /// Shapes of the nodes' own motion, and their coordinates over time.
  std::string write_motion(std::size_t b, const std::string& at) {
    const BodyModel& body = model_.bodies[b];
    const SurfaceRows surface = find_surface_rows(*body.reduced);
    const Eigen::Index n = body.reduced->rows.x_B.cols();
    const auto deform = [&](std::size_t i) {
      MatrixX u_B(3 * n, 1);
      const dynamics::SystemState state = history_.states[i];
      calc_node_deformations(model_, static_cast<dynamics::BodyIndex>(b),
                             {&state, 1}, u_B);
      return VectorX(take_nodes(u_B, surface.rows));
    };
    const std::size_t count = history_.states.size();
    const MatrixX shapes = find_motion_shapes(deform, count);
    std::string name = next_name();
    write_surface(out_, "scene/surfaces/" + name + "/", *body.reduced, surface,
                  shapes);
    Hdf5Rows rows(out_, at + "eta", std::ssize(history_.states), shapes.cols(),
                  "kg^1/2 m", "coordinates of the shapes at each output time");
    const double error = find_coordinates(
        shapes, deform, count, [&](const VectorX& q) { rows.next() = q; });
    rows.close();
    out_.write(at + "truncation", MatrixX::Constant(1, 1, error), "m",
               "largest displacement that the shapes leave out");
    if (has_modal_stress(body) || wants_stress(body.name)) {
      write_stress(b, at, surface);
    }
    return name;
  }

  /// Of a body below level `nonlinear` with internal damping: by its modes, of
  /// which the Maxwell elements have coordinates of their own.
  void write_relaxed_stress(const BodyModel& body, const std::string& at) {
    const SurfaceRows surface = find_surface_rows(*body.reduced);
    out_.write_single(
        at + "Sigma_B",
        take_stress(*body.reduced->stress, surface.rows, body.modes),
        "kg^1/2 m^-2 s^-2",
        "stress of the modes at the nodes of the surface, "
        "6n x m: xx, yy, zz, xy, yz, xz");
    Hdf5Rows rows(out_, at + "zeta", std::ssize(history_.states), body.modes,
                  "kg^1/2 m", "coordinates of stress at each output time");
    VectorX coordinates;
    for (std::size_t i = 0; i < history_.states.size(); ++i) {
      calc_stress_coordinates(body, history_.states[i], coordinates);
      rows.next() = coordinates;
    }
    rows.close();
    out_.write(at + "stress_truncation", MatrixX::Zero(1, 1), "Pa",
               "largest von Mises stress that these shapes leave out");
  }

  bool wants_stress(const std::string& name) const {
    const auto& stressed = scenery_.stressed;
    return std::find(stressed.begin(), stressed.end(), name) != stressed.end();
  }

  /// At levels `full` and `nonlinear` stress is not linear in the coordinates
  /// of the shapes, and has shapes of its own.
  void write_stress(std::size_t b, const std::string& at,
                    const SurfaceRows& surface) {
    const BodyModel& body = model_.bodies[b];
    if (body.full < 0) {
      const int columns = count_coordinates(body);
      const MatrixX Sigma_B =
          take_stress(*body.reduced->stress, surface.rows, columns);
      VectorX coordinates;
      write_stress(at, [&](const dynamics::SystemState& state) -> VectorX {
        calc_stress_coordinates(body, state, coordinates);
        return Sigma_B * coordinates;
      });
      return;
    }
    const std::vector<int> nodes(surface.rows.begin(), surface.rows.end());
    const auto field = FullStressField::make(
        model_, static_cast<dynamics::BodyIndex>(b), nodes);
    if (field == nullptr) return;
    write_stress(at, [&](const dynamics::SystemState& state) -> VectorX {
      return field->calc_in_body(state).reshaped();
    });
  }

  /// @param stress_of 6 rows of each node of the surface
  void write_stress(
      const std::string& at,
      const std::function<VectorX(const dynamics::SystemState&)>& stress_of) {
    const auto column = [&](std::size_t i) {
      return stress_of(history_.states[i]);
    };
    const std::size_t count = history_.states.size();
    const MatrixX shapes = find_motion_shapes(column, count);
    out_.write_single(at + "Sigma_B", shapes, "1",
                      "shapes of the stress at the nodes of the surface, "
                      "6n x r: xx, yy, zz, xy, yz, xz");
    Hdf5Rows rows(out_, at + "zeta", std::ssize(history_.states), shapes.cols(),
                  "Pa", "coordinates of these shapes at each output time");
    const double error = find_coordinates(
        shapes, column, count, [&](const VectorX& q) { rows.next() = q; },
        find_largest_von_mises);
    rows.close();
    out_.write(at + "stress_truncation", MatrixX::Constant(1, 1, error), "Pa",
               "largest von Mises stress that these shapes leave out");
  }

  Hdf5File& out_;
  const Scenery& scenery_;
  const SystemModel& model_;
  const History& history_;
  int count_ = 0;
  std::map<std::tuple<const ReducedBody*, int, bool>, std::string> shared_;
};

void write_bodies(Hdf5File& out, const Scenery& scenery,
                  const SystemModel& model, const History& history) {
  SurfaceWriter surfaces(out, scenery, model, history);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const std::string at = "scene/bodies/" + to_path_step(body.name) + "/";
    out.write(at + "place", std::vector<std::int64_t>{std::int64_t(b)}, "1",
              "of the body in the system");
    out.write(at + "mass", MatrixX::Constant(1, 1, body.mass), "kg", "mass");
    out.write(at + "inertia", MatrixX(body.J0), "kg m^2",
              "about the centre of mass, body frame, undeformed");
    surfaces.add(b);
  }
}

// Takes into the place of its frame what a mesh is far from its own origin (of
// a map, say), since corners are stored in single precision.
SceneryShape centre_mesh(SceneryShape shape) {
  Bounds box;
  for (const auto& x : shape.form.x.colwise()) box.include(x);
  const Vector3 offset = choose_offset(box);
  shape.form.x.colwise() -= offset;
  shape.X_BS.p += shape.X_BS.R * offset;
  return shape;
}

void write_shapes(Hdf5File& out, const Scenery& scenery,
                  const SystemModel& model) {
  for (std::size_t i = 0; i < scenery.shapes.size(); ++i) {
    const SceneryShape shape = centre_mesh(scenery.shapes[i]);
    const std::string at = fmt::format("scene/shapes/{:04}/", i);
    const Quaternion quat(shape.X_BS.R);
    MatrixX rotation(1, 4);
    rotation << quat.w(), quat.x(), quat.y(), quat.z();
    out.write(at + "name", shape.name, "link or obstacle");
    out.write(at + "body", name_body(model, shape.body),
              "body that carries it; empty: the world");
    out.write(at + "kind", shape.form.kind,
              "box, sphere, cylinder, capsule, cone, ellipsoid, plane or mesh");
    out.write(at + "size", MatrixX(shape.form.size.transpose()), "m",
              "edges, radii, or radius and length");
    if (shape.form.kind == "mesh") {
      out.write_single(at + "x", shape.form.x, "m", "corners, 3 x n");
      out.write(at + "triangles",
                std::vector<std::int64_t>(shape.form.corners.begin(),
                                          shape.form.corners.end()),
                "1", "indices of corners, three a triangle, outward");
    }
    out.write(at + "p_BS", MatrixX(shape.X_BS.p.transpose()), "m",
              "middle, body frame");
    out.write(at + "quat_BS", rotation, "1", "shape to body, w x y z");
  }
}

}  // namespace

void write_scenery(Hdf5File& out, const Scenery& scenery,
                   const SystemModel& model, const History& history) {
  out.write("scene/version", std::vector<std::int64_t>{kSceneryVersion}, "1",
            "layout of this group");
  out.write("scene/limber", std::string(LIMBER_VERSION), "version of Limber");
  out.write("scene/name", scenery.name, "name of the scenario");
  out.write("scene/scenario", scenery.scenario, "text of the scenario");
  for (std::size_t i = 0; i < scenery.robots.size(); ++i) {
    const std::string at = fmt::format("scene/robots/{}/", i);
    out.write(at + "name", scenery.robots[i].name, "empty: the only one");
    out.write(at + "text", scenery.robots[i].text, "text of the robot");
  }
  out.write("scene/settings", scenery.settings,
            "options that changed the texts after reading");
  out.write("scene/gravity", MatrixX(model.gravity_W.transpose()), "m/s^2",
            "world frame");
  write_bodies(out, scenery, model, history);
  write_shapes(out, scenery, model);
  write_marks(out, model, history);
}

}  // namespace limber::results
