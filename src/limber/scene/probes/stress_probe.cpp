// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/stress_probe.hpp"

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"
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

// @param all stress at all points, in their axes, 6p
void append_index(const StressProbe& probe, const VectorX& all,
                  std::vector<double>& values) {
  double largest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(probe.tags.size()); ++i) {
    const Vector6 s = all.segment<6>(6 * Eigen::Index{i});
    const Vector6 strengths = probe.strengths.col(i);
    const double value = probe.quantity == StressQuantity::tsai_wu
                             ? flexbody::calc_tsai_wu(s, strengths)
                             : flexbody::calc_maximum_stress(s, strengths);
    if (value > largest) {
      largest = value;
      probe.scratch.place = i;
    }
  }
  values.push_back(largest);
}

// Of several ends each component of the largest magnitude.
void append_section_forces(const VectorX& all, std::vector<double>& values) {
  for (Eigen::Index k = 0; k < 6; ++k) {
    double largest = all[k];
    for (Eigen::Index i = k; i < all.size(); i += 6) {
      if (std::abs(all[i]) > std::abs(largest)) largest = all[i];
    }
    values.push_back(largest);
  }
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
    all.segment<6>(6 * i) = flexbody::rotate_stress(whole.col(i), R_HL);
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
  if (probe.quantity == StressQuantity::tsai_wu) {
    return {{name + ".tsai_wu", "1"}};
  }
  if (probe.quantity == StressQuantity::maximum_stress) {
    return {{name + ".maximum_stress", "1"}};
  }
  std::vector<ProbeColumnName> columns;
  if (probe.quantity == StressQuantity::section_force) {
    for (const char* force : {"N", "Vy", "Vz"}) {
      columns.push_back({name + "." + force, "N"});
    }
    for (const char* moment : {"T", "My", "Mz"}) {
      columns.push_back({name + "." + moment, "N m"});
    }
    return columns;
  }
  if (probe.has_own_axes) {
    for (const char* component : {"11", "22", "33", "12", "23", "13"}) {
      columns.push_back({name + ".s" + component, "Pa"});
    }
    return columns;
  }
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
  const bool needs_all = is_principal || is_index(probe.quantity) ||
                         probe.quantity == StressQuantity::section_force;
  VectorX& all = probe.scratch.stress;
  if (probe.full) {
    LIMBER_EXPECT(body.full >= 0);
    calc_full(probe, model, body, state);
    if (!is_principal) append_largest(probe, find_largest(probe), values);
  } else {
    VectorX& at = probe.scratch.coordinates;
    calc_stress_coordinates(body, state, at);
    LIMBER_EXPECT(at.size() == probe.Sigma_L.cols());
    if (needs_all) {
      all.resize(probe.Sigma_L.rows());
      all.noalias() = probe.Sigma_L * at;
    } else {
      append_largest(probe, probe.clusters.find(probe.Sigma_L, at), values);
    }
  }
  if (is_principal) append_principal(probe, all, values);
  if (is_index(probe.quantity)) append_index(probe, all, values);
  if (probe.quantity == StressQuantity::section_force) {
    append_section_forces(all, values);
  }
}

}  // namespace limber::scene
