// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/coupler_probe.hpp"

#include <fmt/format.h>

#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/coupler_motion.hpp"

namespace limber::scene {
namespace {

using Kind = joints::AxisCoordinate::Kind;
using dynamics::CouplerReading;

bool is_along_coordinates(CouplerQuantity quantity) {
  return quantity == CouplerQuantity::coordinate ||
         quantity == CouplerQuantity::coordinate_rate ||
         quantity == CouplerQuantity::effort;
}

// A sum has the unit of its first joint's coordinate.
std::vector<Kind> kinds_of(const dynamics::SystemModel& model,
                           const dynamics::Transmission& transmission) {
  const auto* sum = std::get_if<dynamics::JointSum>(&transmission.coordinate);
  if (sum == nullptr || sum->terms.empty()) return {Kind::distance};
  const dynamics::JointSum::Term& first = sum->terms.front();
  const auto& law = model.couplers[index(first.coupler)].law;
  return {joints::coordinates_of(law)[index(first.coordinate)].kind};
}

std::string unit_along(CouplerQuantity quantity, Kind kind) {
  const bool is_angle = kind == Kind::angle;
  if (quantity == CouplerQuantity::coordinate) return is_angle ? "rad" : "m";
  if (quantity == CouplerQuantity::effort) return is_angle ? "N m" : "N";
  return is_angle ? "rad/s" : "m/s";
}

// Symbol and unit of quantities independent of the coordinate's kind.
ProbeColumnName describe_coupler(CouplerQuantity quantity) {
  switch (quantity) {
    case CouplerQuantity::coordinate:
      return {"q", ""};
    case CouplerQuantity::coordinate_rate:
      return {"qdot", ""};
    case CouplerQuantity::effort:
      return {"effort", ""};
    case CouplerQuantity::relative_position:
      return {"p", "m"};
    case CouplerQuantity::relative_rotation:
      return {"r", "rad"};
    case CouplerQuantity::relative_velocity:
      return {"v", "m/s"};
    case CouplerQuantity::relative_angular_velocity:
      return {"w", "rad/s"};
    case CouplerQuantity::force:
      return {"f", "N"};
    case CouplerQuantity::moment:
      return {"t", "N m"};
    case CouplerQuantity::energy:
      return {"energy", "J"};
    case CouplerQuantity::dissipation:
      return {"dissipation", "W"};
    case CouplerQuantity::power:
      return {"power", "W"};
  }
  return {};
}

// Expressed in F.
Vector3 find_vector(const CouplerProbeSpec& spec,
                    const CouplerReading& reading) {
  const joints::RelativeMotion& motion = reading.motion;
  const Vector3 force = reading.response.wrench.head<3>();
  const Vector3 moment = reading.response.wrench.tail<3>();
  const bool on_M = spec.side == ProbeSide::M;
  switch (spec.quantity) {
    case CouplerQuantity::relative_position:
      return motion.p_FM_F;
    case CouplerQuantity::relative_rotation:
      return log_rotation(motion.R_FM);
    case CouplerQuantity::relative_velocity:
      return motion.v_FM_F;
    case CouplerQuantity::relative_angular_velocity:
      return motion.w_FM_F;
    case CouplerQuantity::force:
      return on_M ? force : Vector3(-force);
    default:
      break;
  }
  return on_M ? moment : Vector3(-moment - motion.p_FM_F.cross(force));
}

Vector3 rotate(ProbeAxes axes, const CouplerReading& reading,
               const Vector3& vector_F) {
  if (axes == ProbeAxes::M) return reading.motion.R_FM.transpose() * vector_F;
  if (axes == ProbeAxes::world) return reading.R_WF * vector_F;
  return vector_F;
}

double pick(CouplerQuantity quantity,
            const dynamics::CoordinateReading& reading) {
  if (quantity == CouplerQuantity::coordinate) return reading.motion.z;
  if (quantity == CouplerQuantity::coordinate_rate) return reading.motion.rate;
  return reading.effort;
}

template <typename Response>
double pick(CouplerQuantity quantity, const Response& response) {
  if (quantity == CouplerQuantity::energy) return response.energy;
  if (quantity == CouplerQuantity::dissipation) return response.dissipation;
  return response.supplied;
}

void append_transmission(const CouplerProbe& probe,
                         const dynamics::SystemModel& model,
                         const dynamics::SystemState& state,
                         std::vector<double>& values) {
  const dynamics::CoordinateReading reading =
      dynamics::evaluate_transmission(model, state, probe.transmission);
  const CouplerQuantity quantity = probe.spec.quantity;
  values.push_back(is_along_coordinates(quantity)
                       ? pick(quantity, reading)
                       : pick(quantity, reading.response));
}

void append_coordinates(const CouplerProbe& probe,
                        const dynamics::SystemModel& model,
                        const dynamics::SystemState& state,
                        std::vector<double>& values) {
  const CouplerQuantity quantity = probe.spec.quantity;
  for (int i = 0; i < std::ssize(probe.coordinates); ++i) {
    values.push_back(pick(quantity, dynamics::evaluate_coordinate(
                                        model, state, probe.coupler, i)));
  }
}

}  // namespace

std::size_t check_coupler_probe(const CouplerProbeSpec& spec,
                                const std::vector<CouplerTraits>& known) {
  std::vector<std::string> names;
  for (const CouplerTraits& traits : known) names.push_back(traits.name);
  const std::size_t found = find_name("coupler", spec.coupler, names);
  const CouplerTraits& traits = known[found];
  if (!traits.why_none.empty()) {
    throw InputError(fmt::format("joint '{}' {}; there is nothing to follow",
                                 spec.coupler, traits.why_none));
  }
  if (!traits.has_frames && is_vector(spec.quantity)) {
    throw InputError(fmt::format(
        "coupler '{}' acts along one coordinate and joins no two frames; use "
        "'coordinate', 'coordinate_rate', 'effort', 'energy', 'dissipation' "
        "or 'power'",
        spec.coupler));
  }
  if (traits.coordinates == 0 && is_along_coordinates(spec.quantity)) {
    throw InputError(fmt::format(
        "coupler '{}' leaves no coordinate free; use 'relative_position', "
        "'relative_rotation', 'force', 'moment' or another of the two frames",
        spec.coupler));
  }
  return found;
}

CouplerProbe make_coupler_probe(const CouplerProbeSpec& spec,
                                const dynamics::SystemModel& model) {
  std::vector<CouplerTraits> known;
  std::vector<CouplerProbe> probes;
  const auto add = [&](const std::string& name, const CouplerProbe& probe) {
    known.push_back({name, probe.coupler >= 0,
                     static_cast<int>(probe.coordinates.size()), ""});
    probes.push_back(probe);
  };
  for (dynamics::CouplerIndex i(0); i < std::ssize(model.couplers); ++i) {
    const dynamics::Coupler& coupler = model.couplers[index(i)];
    add(coupler.name, {spec, i, {}, joints::reading_kinds(coupler.law)});
  }
  for (dynamics::TransmissionIndex i(0); i < std::ssize(model.transmissions);
       ++i) {
    const dynamics::Transmission& t = model.transmissions[index(i)];
    add(t.name, {spec, {}, i, kinds_of(model, t)});
  }
  return probes[check_coupler_probe(spec, known)];
}

std::vector<ProbeColumnName> column_names(const CouplerProbe& probe,
                                          const std::string& name) {
  const CouplerQuantity quantity = probe.spec.quantity;
  const auto [symbol, unit] = describe_coupler(quantity);
  const std::string start = name + "." + symbol;
  if (is_vector(quantity)) {
    return {{start + "x", unit}, {start + "y", unit}, {start + "z", unit}};
  }
  if (!is_along_coordinates(quantity)) return {{start, unit}};
  std::vector<ProbeColumnName> columns;
  const bool is_alone = probe.coordinates.size() == 1;
  for (const Kind kind : probe.coordinates) {
    columns.push_back(
        {is_alone ? start : fmt::format("{}{}", start, columns.size() + 1),
         unit_along(quantity, kind)});
  }
  return columns;
}

void append_values(const CouplerProbe& probe,
                   const dynamics::SystemModel& model,
                   const dynamics::SystemState& state,
                   std::vector<double>& values) {
  if (probe.transmission >= 0) {
    append_transmission(probe, model, state, values);
    return;
  }
  const CouplerQuantity quantity = probe.spec.quantity;
  if (is_along_coordinates(quantity)) {
    append_coordinates(probe, model, state, values);
    return;
  }
  const CouplerReading reading =
      dynamics::evaluate_coupler(model, state, probe.coupler);
  if (!is_vector(quantity)) {
    values.push_back(pick(quantity, reading.response));
    return;
  }
  const Vector3 value =
      rotate(probe.spec.axes, reading, find_vector(probe.spec, reading));
  values.insert(values.end(), value.data(), value.data() + 3);
}

}  // namespace limber::scene
