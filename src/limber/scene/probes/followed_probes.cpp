// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/followed_probes.hpp"

#include <limits>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::scene {
namespace {

using dynamics::Course;

Course find_course(const PointProbe& /*probe*/) { return Course::motion; }

// Stress follows from the modal coordinates alone.
Course find_course(const StressProbe& /*probe*/) { return Course::motion; }

// A joint's coordinate follows from the bodies; forces of stiff couplers cannot
// be evaluated at an interpolated state.
Course find_course(const CouplerProbe& probe) {
  const CouplerQuantity quantity = probe.spec.quantity;
  const bool is_motion = quantity == CouplerQuantity::coordinate ||
                         quantity == CouplerQuantity::coordinate_rate;
  return is_motion ? Course::motion : Course::values;
}

// A parabola does not fit quantities that jump, such as places of contact.
Course find_course(const ContactProbe& probe) {
  switch (probe.spec.quantity) {
    case ContactQuantity::place:
    case ContactQuantity::depth:
    case ContactQuantity::touching:
    case ContactQuantity::slipping:
      return Course::motion;
    default:
      return Course::values;
  }
}

// It jumps at samples, which are ends of steps.
Course find_course(const ControllerProbe& /*probe*/) { return Course::values; }

void append(const Probe& probe, const dynamics::SystemModel& model,
            const dynamics::SystemState& state, std::vector<double>& values) {
  std::visit(Overloaded{[&](const PointProbe& point) {
                          const Vector3 value = evaluate(point, model, state);
                          values.insert(values.end(), value.data(),
                                        value.data() + 3);
                        },
                        [&](const auto& other) {
                          append_values(other, model, state, values);
                        }},
             probe.of);
}

}  // namespace

dynamics::Followed follow(const std::vector<Probe>& probes,
                          const dynamics::SystemModel& model) {
  dynamics::Followed followed;
  std::vector<std::size_t> ends;             // of each probe's columns
  std::vector<const StressProbe*> stresses;  // a column; null: another probe
  for (const Probe& probe : probes) {
    followed.courses.resize(
        followed.courses.size() + column_names(probe).size(),
        std::visit([](const auto& of) { return find_course(of); }, probe.of));
    ends.push_back(followed.courses.size());
    stresses.resize(ends.back(), std::get_if<StressProbe>(&probe.of));
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
  followed.find_place = [stresses](std::size_t scalar) {
    const StressProbe* stress = stresses[scalar];
    return stress == nullptr ? -1 : stress->scratch.place;
  };
  return followed;
}

}  // namespace limber::scene
