// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/home.hpp"

#include <algorithm>

#include "limber/results/offset.hpp"

namespace limber::view {
namespace {

using results::Bounds;

constexpr double kLong = 1000.0;  // of the size of the scene

double find_radius(const Recording& recording, const Body& body) {
  if (body.surface < 0)
    return results::estimate_radius(body.mass, body.inertia);
  const Surface& surface = recording.surfaces[std::size_t(body.surface)];
  return surface.x_B.colwise().norm().maxCoeff();
}

MatrixX find_mean(const Recording& recording) {
  MatrixX mean = MatrixX::Zero(recording.times.size(), 3);
  for (const Body& body : recording.bodies) mean += body.p_WB;
  return mean / std::max(1.0, double(recording.bodies.size()));
}

// Largest size of the scene at an output.
double find_size(const Recording& recording) {
  double size = 0.0;
  for (Eigen::Index i = 0; i < recording.times.size(); ++i) {
    Bounds box;
    for (const Body& body : recording.bodies) {
      box.include(body.p_WB.row(i), find_radius(recording, body));
    }
    size = std::max(size, box.size());
  }
  return size;
}

Bounds find_box(const MatrixX& path) {
  Bounds box;
  for (const auto& p : path.rowwise()) box.include(p);
  return box;
}

}  // namespace

Home find_home(const Recording& recording) {
  Bounds all;
  for (const Body& body : recording.bodies) {
    const double radius = find_radius(recording, body);
    for (const auto& p : body.p_WB.rowwise()) all.include(p, radius);
  }
  Home home{results::choose_offset(all),
            MatrixX::Zero(recording.times.size(), 3), false};
  const MatrixX mean = find_mean(recording);
  home.travels = !recording.bodies.empty() &&
                 find_box(mean).size() > kLong * find_size(recording);
  if (home.travels) home.path = mean.rowwise() - home.offset.transpose();
  return home;
}

}  // namespace limber::view
