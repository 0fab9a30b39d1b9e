// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/stress_probe.hpp"

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/equations/mean_frame.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/flexbody/model/stress_modes.hpp"

namespace limber::scene {
namespace {

constexpr double kRoundOff = 1e-9;  // of a bound

// The largest principal stress is at most the mean plus 2/3 of von Mises'.
// @param all stress at all points, 6p
void append_principal(const StressProbe& probe, const VectorX& all,
                      std::vector<double>& values) {
  double largest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(probe.tags.size()); ++i) {
    const Vector6 s = all.segment<6>(6 * Eigen::Index{i});
    const double mises = flexbody::calc_von_mises(s);
    const double bound = (s[0] + s[1] + s[2]) / 3.0 + mises * 2.0 / 3.0;
    if (bound + kRoundOff * mises < largest) continue;
    const double value = flexbody::calc_max_principal(s);
    if (value > largest) {
      largest = value;
      probe.scratch.place = i;
    }
  }
  values.push_back(largest);
}

// Stress at all points, in the present axes of the link.
void calc_full(const StressProbe& probe, const dynamics::SystemModel& model,
               const dynamics::BodyModel& body,
               const dynamics::SystemState& state) {
  const dynamics::FullModel& full = model.full_bodies[index(body.full)];
  Matrix6X& whole = probe.scratch.whole;
  whole.resize(6, std::ssize(probe.tags));
  probe.full->calc_stress(nodes_of(full, state.u_H), whole);
  dynamics::MeanFrame frame;
  calc_mean_frame(model, full, state, frame);
  const Matrix3 R_HL = frame.R_HB * probe.R_BL;
  VectorX& all = probe.scratch.stress;
  all.resize(whole.size());
  for (Eigen::Index i = 0; i < whole.cols(); ++i) {
    all.segment<6>(6 * i) = flexbody::turn_stress(whole.col(i), R_HL);
  }
}

void append_largest(const StressProbe& probe,
                    const StressClusters::Largest& largest,
                    std::vector<double>& values) {
  probe.scratch.place = largest.point;
  if (probe.quantity == StressQuantity::von_mises) {
    values.push_back(largest.von_mises);
  } else {
    values.insert(values.end(), largest.stress.begin(), largest.stress.end());
  }
}

// Of the probe's scratch.
StressClusters::Largest find_largest(const StressProbe& probe) {
  StressClusters::Largest largest;
  for (int i = 0; i < static_cast<int>(probe.tags.size()); ++i) {
    const Vector6 s = probe.scratch.stress.segment<6>(6 * Eigen::Index{i});
    const double mises = flexbody::calc_von_mises(s);
    if (mises > largest.von_mises) largest = {i, mises, s};
  }
  return largest;
}

}  // namespace

std::vector<ProbeColumnName> column_names(const StressProbe& probe,
                                          const std::string& name) {
  if (probe.quantity == StressQuantity::von_mises) {
    return {{name + ".von_mises", "Pa"}};
  }
  if (probe.quantity == StressQuantity::max_principal) {
    return {{name + ".max_principal", "Pa"}};
  }
  std::vector<ProbeColumnName> columns;
  for (const char* component : {"xx", "yy", "zz", "xy", "yz", "xz"}) {
    columns.push_back({name + ".s" + component, "Pa"});
  }
  return columns;
}

void append_values(const StressProbe& probe, const dynamics::SystemModel& model,
                   const dynamics::SystemState& state,
                   std::vector<double>& values) {
  const dynamics::BodyModel& body = model.bodies[index(probe.body)];
  const bool is_principal = probe.quantity == StressQuantity::max_principal;
  VectorX& all = probe.scratch.stress;
  if (probe.full) {
    LIMBER_EXPECT(body.full >= 0);
    calc_full(probe, model, body, state);
    if (!is_principal) append_largest(probe, find_largest(probe), values);
  } else {
    VectorX& at = probe.scratch.coordinates;
    calc_stress_coordinates(body, state, at);
    LIMBER_EXPECT(at.size() == probe.Sigma_L.cols());
    if (is_principal) {
      all.resize(probe.Sigma_L.rows());
      all.noalias() = probe.Sigma_L * at;
    } else {
      append_largest(probe, probe.clusters.find(probe.Sigma_L, at), values);
    }
  }
  if (is_principal) append_principal(probe, all, values);
}

}  // namespace limber::scene
