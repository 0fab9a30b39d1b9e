// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/home.hpp"

#include <vector>

namespace limber::view {
namespace {

double find_radius(const Recording& recording, const Body& body) {
  if (body.surface < 0)
    return results::estimate_radius(body.mass, body.inertia);
  const Surface& surface = recording.surfaces[std::size_t(body.surface)];
  return surface.x_B.colwise().norm().maxCoeff();
}

}  // namespace

results::Home find_home(const Recording& recording) {
  std::vector<results::Course> courses;
  for (const Body& body : recording.bodies) {
    courses.push_back({find_radius(recording, body), body.p_WB});
  }
  return results::find_home(courses);
}

}  // namespace limber::view
