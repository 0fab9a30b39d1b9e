// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/followed_probes.hpp"

#include <limits>

#include "limber/common/errors.hpp"

namespace limber::scene {
namespace {

// A joint's coordinate follows from the bodies; forces of stiff couplers cannot
// be evaluated at an interpolated state.
dynamics::Course find_course(const Probe& probe) {
  const auto* coupler = std::get_if<CouplerProbe>(&probe.of);
  const bool is_motion =
      coupler == nullptr ||
      coupler->spec.quantity == CouplerQuantity::coordinate ||
      coupler->spec.quantity == CouplerQuantity::coordinate_rate;
  return is_motion ? dynamics::Course::motion : dynamics::Course::values;
}

void append(const Probe& probe, const dynamics::SystemModel& model,
            const dynamics::SystemState& state, std::vector<double>& values) {
  if (const auto* point = std::get_if<PointProbe>(&probe.of)) {
    const Vector3 value = evaluate(*point, model, state);
    values.insert(values.end(), value.data(), value.data() + 3);
  } else {
    append_values(std::get<CouplerProbe>(probe.of), model, state, values);
  }
}

}  // namespace

dynamics::Followed follow(const std::vector<Probe>& probes,
                          const dynamics::SystemModel& model) {
  dynamics::Followed followed;
  std::vector<std::size_t> ends;  // of each probe's columns
  for (const Probe& probe : probes) {
    followed.courses.resize(
        followed.courses.size() + column_names(probe).size(),
        find_course(probe));
    ends.push_back(followed.courses.size());
  }
  followed.evaluate = [&probes, &model, ends](
                          const dynamics::SystemState& state,
                          std::vector<double>& values) {
    values.clear();
    for (std::size_t i = 0; i < probes.size(); ++i) {
      try {
        append(probes[i], model, state, values);
      } catch (const NumericalError&) {
        values.resize(ends[i], std::numeric_limits<double>::quiet_NaN());
      }
    }
  };
  return followed;
}

}  // namespace limber::scene
