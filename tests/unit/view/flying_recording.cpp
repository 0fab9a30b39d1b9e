// SPDX-License-Identifier: BSD-3-Clause
#include "flying_recording.hpp"

#include <cmath>
#include <string>

namespace limber::view::test {
namespace {

Surface make_tetrahedron() {
  Surface surface;
  surface.body = "arm";
  surface.tags = {1, 2, 3, 4};
  surface.x_B.resize(3, 4);
  surface.x_B << 0.3, -0.1, -0.1, -0.1,  //
      0.0, 0.2, -0.1, -0.1,              //
      0.0, 0.0, 0.15, -0.15;
  surface.Phi_B.resize(12, 1);
  surface.Phi_B << 0.0, 0.7, 0.3, 0.1, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.1;
  surface.corners = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  return surface;
}

Body make_body(const std::string& name, const VectorX& times,
               const Flight& flight, double phase) {
  const Eigen::Index T = times.size();
  Body body;
  body.name = name;
  body.level = "rigid";
  body.mass = 1.0;
  body.inertia = 0.045 * Matrix3::Identity();
  body.p_WB.resize(T, 3);
  body.quat_WB.resize(T, 4);
  body.v_WB_W = MatrixX::Zero(T, 3);
  body.w_WB_B = MatrixX::Zero(T, 3);
  body.eta.resize(T, 0);
  for (Eigen::Index i = 0; i < T; ++i) {
    const double s = double(i) / double(T - 1);
    const Vector3 own(0.1 * std::sin(3.0 * s + phase), 0.2 * phase,
                      0.05 * std::cos(2.0 * s));
    body.p_WB.row(i) =
        flight.place + flight.velocity * (times[i] - times[0]) + own;
    const Quaternion q(Eigen::AngleAxisd(s + phase, Vector3::UnitZ()));
    body.quat_WB.row(i) << q.w(), q.x(), q.y(), q.z();
    body.v_WB_W.row(i) = flight.velocity;
  }
  return body;
}

}  // namespace

Recording make_flight(const Flight& flight) {
  Recording recording;
  recording.name = "flight";
  recording.times = VectorX::LinSpaced(kFlightOutputs, 0, kFlightOutputs - 1);
  recording.times = recording.times.array() * flight.interval + flight.start;
  recording.surfaces = {make_tetrahedron()};
  Body arm = make_body("arm", recording.times, flight, 0.0);
  arm.level = "coupled";
  arm.surface = 0;
  arm.eta = 0.02 * arm.p_WB.rowwise().sum().array().cos().matrix();
  arm.etadot = MatrixX::Zero(kFlightOutputs, 1);
  recording.bodies = {arm, make_body("hub", recording.times, flight, 1.0)};
  recording.shapes = {
      {"post",
       -1,
       {"box", Vector3(0.1, 0.2, 0.3), {}, {}},
       {Matrix3::Identity(), flight.place + Vector3(0.5, 0.0, 0.25)}}};
  return recording;
}

void add_stranger(Recording& recording, const Vector3& place) {
  recording.bodies.push_back(
      make_body("stranger", recording.times, {.place = place}, 0.0));
  recording.bodies.back().p_WB.rowwise() = place.transpose();
}

}  // namespace limber::view::test
