// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/stress_probe.hpp"

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/flexbody/model/stress_modes.hpp"

namespace limber::scene {
namespace {

constexpr double kRoundOff = 1e-9;  // of a bound

// The largest principal stress is at most the mean plus 2/3 of von Mises'.
void append_principal(const StressProbe& probe,
                      const Eigen::Ref<const VectorX>& eta,
                      std::vector<double>& values) {
  VectorX& all = probe.scratch.stress;
  all.resize(probe.Sigma_L.rows());
  all.noalias() = probe.Sigma_L * eta;
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
  LIMBER_EXPECT(body.modes == probe.Sigma_L.cols());
  const auto eta = state.eta.segment(body.offset, body.modes);
  if (probe.quantity == StressQuantity::max_principal) {
    append_principal(probe, eta, values);
    return;
  }
  const auto largest = probe.clusters.find(probe.Sigma_L, eta);
  probe.scratch.place = largest.point;
  if (probe.quantity == StressQuantity::von_mises) {
    values.push_back(largest.von_mises);
  } else {
    values.insert(values.end(), largest.stress.begin(), largest.stress.end());
  }
}

}  // namespace limber::scene
