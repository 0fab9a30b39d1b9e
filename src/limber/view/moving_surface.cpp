// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/moving_surface.hpp"

#include <fmt/format.h>

#include <limits>

#include "limber/common/errors.hpp"
#include "limber/view/home.hpp"

namespace limber::view {
namespace {

using results::MovingSurface;
using results::SurfaceFrame;

const Surface& surface_of(const Recording& recording, std::size_t b) {
  return recording
      .surfaces[static_cast<std::size_t>(recording.bodies[b].surface)];
}

Matrix3 find_rotation(const Body& body, Eigen::Index i) {
  return Quaternion(body.quat_WB(i, 0), body.quat_WB(i, 1), body.quat_WB(i, 2),
                    body.quat_WB(i, 3))
      .normalized()
      .toRotationMatrix();
}

bool has_stress(const Body& body, const Surface& surface) {
  return body.Sigma_B.rows() > 0 || surface.Sigma_B.cols() > 0;
}

// In world axes.
Matrix6X find_stress(const Body& body, const Surface& surface, Eigen::Index i) {
  const Eigen::Index n = surface.x_B.cols();
  if (!has_stress(body, surface)) {
    return Matrix6X::Constant(6, n, std::numeric_limits<double>::quiet_NaN());
  }
  const VectorX all = body.Sigma_B.rows() > 0
                          ? body.Sigma_B * body.zeta.row(i).transpose()
                          : surface.Sigma_B * body.eta.row(i).transpose();
  return results::rotate_to_world(all.reshaped(6, n), find_rotation(body, i));
}

// @param nodes of all surfaces
SurfaceFrame find_frame(const Recording& recording, const Vector3& offset,
                        Eigen::Index nodes, Eigen::Index i) {
  SurfaceFrame frame{Matrix3X(3, nodes), Matrix3X(3, nodes), Matrix3X(3, nodes),
                     Matrix6X(6, nodes)};
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < recording.bodies.size(); ++b) {
    const Body& body = recording.bodies[b];
    if (body.surface < 0) continue;
    const Surface& surface = surface_of(recording, b);
    const Eigen::Index n = surface.x_B.cols();
    const int index = static_cast<int>(b);
    const Matrix3X now = calc_positions(recording, index, i, offset);
    frame.points.middleCols(first, n) = now;
    frame.displacement.middleCols(first, n) =
        now - calc_positions(recording, index, 0, offset);
    const VectorX u_B = surface.Phi_B * body.eta.row(i).transpose();
    frame.deformation.middleCols(first, n) =
        find_rotation(body, i) * u_B.reshaped(3, n);
    frame.stress.middleCols(first, n) = find_stress(body, surface, i);
    first += n;
  }
  return frame;
}

}  // namespace

MovingSurface gather_surfaces(const Recording& recording) {
  MovingSurface all;
  all.times.assign(recording.times.begin(), recording.times.end());
  for (std::size_t b = 0; b < recording.bodies.size(); ++b) {
    if (recording.bodies[b].surface < 0) continue;
    const Surface& surface = surface_of(recording, b);
    for (const std::int64_t corner : surface.corners) {
      all.corners.push_back(all.nodes + corner);
    }
    all.nodes += surface.x_B.cols();
    all.has_stress = all.has_stress || has_stress(recording.bodies[b], surface);
  }
  if (all.nodes == 0) {
    throw InputError(fmt::format(
        "'{}': it has no flexible link, whose surface could be written",
        recording.folder));
  }
  all.offset = find_home(recording).offset;
  all.find_frame = [&recording, offset = all.offset,
                    nodes = all.nodes](std::size_t output) {
    return find_frame(recording, offset, nodes,
                      static_cast<Eigen::Index>(output));
  };
  return all;
}

}  // namespace limber::view
