// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/contact_probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/joints/pairs/touching.hpp"
#include "limber/scene/text/glob.hpp"

namespace limber::scene {
namespace {

using joints::TouchReading;

constexpr std::size_t kMostListed = 10;

std::string list_contacts(const std::vector<TouchingPair>& touching,
                          const Robot& robot, const Scenario& scenario) {
  std::string list;
  for (std::size_t i = 0; i < touching.size(); ++i) {
    if (i == kMostListed) return list + ", ...";
    list += fmt::format("{}'{}' and '{}'", i == 0 ? "" : ", ",
                        name_of(touching[i].A, robot, scenario),
                        name_of(touching[i].B, robot, scenario));
  }
  return list;
}

void check_name(const std::string& name, const Robot& robot,
                const Scenario& scenario) {
  std::vector<std::string> known;
  for (const Link& link : robot.links) known.push_back(link.name);
  for (const ObstacleSpec& obstacle : scenario.obstacles) {
    known.push_back(obstacle.name);
  }
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError(describe_unknown("body", name, known) +
                   (is_pattern(name) ? "; a probe takes no patterns" : ""));
}

/// Symbol and unit.
ProbeColumnName describe_contact(ContactQuantity quantity) {
  switch (quantity) {
    case ContactQuantity::force:
      return {"f", "N"};
    case ContactQuantity::normal_force:
      return {"normal_force", "N"};
    case ContactQuantity::friction_force:
      return {"friction_force", "N"};
    case ContactQuantity::place:
      return {"p", "m"};
    case ContactQuantity::depth:
      return {"depth", "m"};
    case ContactQuantity::area:
      return {"area", "m^2"};
    case ContactQuantity::energy:
      return {"energy", "J"};
    case ContactQuantity::touching:
      return {"touching", "-"};
    case ContactQuantity::slipping:
      return {"slipping", "-"};
  }
  return {};
}

/// Calls `work(law, bodies, pair, scratch)` for each pair of shapes.
template <typename Work>
void for_each_part(const ContactProbe& probe,
                   const dynamics::SystemModel& model,
                   const dynamics::SystemState& state, const Work& work) {
  for (const ContactProbe::Part& part : probe.parts) {
    const dynamics::Pair& pair = model.pairs[index(part.pair)];
    const dynamics::PairMotion motion =
        dynamics::find_pair_motion(model, pair, state);
    work(*pair.law->touching(), motion.bodies(), pair, part.scratch);
  }
}

double find_depth(const ContactProbe& probe, const dynamics::SystemModel& model,
                  const dynamics::SystemState& state) {
  double depth = -std::numeric_limits<double>::infinity();
  for_each_part(probe, model, state,
                [&](const joints::Touching& law, const auto& bodies,
                    const dynamics::Pair&, joints::PairResponse& scratch) {
                  depth =
                      std::max(depth, law.find_touch(bodies, scratch).depth);
                });
  return depth;
}

/// Sums over all pairs of shapes; the place is that of the largest force.
TouchReading read(const ContactProbe& probe, const dynamics::SystemModel& model,
                  const dynamics::SystemState& state) {
  TouchReading sum;
  double largest = 0.0;
  for_each_part(probe, model, state,
                [&](const joints::Touching& law, const auto& bodies,
                    const dynamics::Pair& pair, joints::PairResponse& scratch) {
                  const TouchReading own =
                      law.read(bodies, dynamics::now_of(state),
                               dynamics::memory_of(pair, state), scratch);
                  if (own.points == 0) return;
                  if (sum.points == 0 || own.normal_force > largest) {
                    largest = own.normal_force;
                    sum.p_W = own.p_W;
                  }
                  sum.points += own.points;
                  sum.normal_force += own.normal_force;
                  sum.force_W += own.force_W;
                  sum.friction_W += own.friction_W;
                  sum.area += own.area;
                  sum.energy += own.energy;
                  sum.slips = sum.slips || own.slips;
                });
  return sum;
}

double pick_touch(ContactQuantity quantity, const TouchReading& reading) {
  switch (quantity) {
    case ContactQuantity::normal_force:
      return reading.normal_force;
    case ContactQuantity::friction_force:
      return reading.friction_W.norm();
    case ContactQuantity::area:
      return reading.area;
    case ContactQuantity::energy:
      return reading.energy;
    case ContactQuantity::slipping:
      return reading.slips ? 1.0 : 0.0;
    default:
      break;
  }
  return reading.points > 0 ? 1.0 : 0.0;
}

}  // namespace

ProbedContact check_contact_probe(const ContactProbeSpec& spec,
                                  const std::vector<TouchingPair>& touching,
                                  const Robot& robot,
                                  const Scenario& scenario) {
  const auto& [first, second] = spec.bodies;
  check_name(first, robot, scenario);
  check_name(second, robot, scenario);
  if (first == second) {
    throw InputError(
        fmt::format("'contact' names '{}' twice; name two bodies", first));
  }
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const std::string& A = name_of(touching[i].A, robot, scenario);
    const std::string& B = name_of(touching[i].B, robot, scenario);
    if (A == first && B == second) return {i, false};
    if (A == second && B == first) return {i, true};
  }
  throw InputError(fmt::format(
      "no [[contact]] allows contact of '{}' and '{}'; {}", first, second,
      touching.empty()
          ? "there is none"
          : "those that may are " + list_contacts(touching, robot, scenario)));
}

ContactProbe make_contact_probe(const ContactProbeSpec& spec, bool is_turned,
                                const std::vector<dynamics::PairIndex>& pairs,
                                const dynamics::SystemModel& model) {
  LIMBER_EXPECT(!pairs.empty());
  ContactProbe probe{spec, is_turned, {}};
  for (const dynamics::PairIndex i : pairs) {
    const dynamics::Pair& pair = model.pairs.at(index(i));
    LIMBER_EXPECT(pair.law->touching() != nullptr);
    probe.parts.push_back({i, dynamics::make_response(model, pair)});
  }
  return probe;
}

std::vector<ProbeColumnName> column_names(const ContactProbe& probe,
                                          const std::string& name) {
  const auto [symbol, unit] = describe_contact(probe.spec.quantity);
  const std::string start = name + "." + symbol;
  if (!is_vector(probe.spec.quantity)) return {{start, unit}};
  return {{start + "x", unit}, {start + "y", unit}, {start + "z", unit}};
}

void append_values(const ContactProbe& probe,
                   const dynamics::SystemModel& model,
                   const dynamics::SystemState& state,
                   std::vector<double>& values) {
  const ContactQuantity quantity = probe.spec.quantity;
  if (quantity == ContactQuantity::depth) {
    values.push_back(find_depth(probe, model, state));
    return;
  }
  const TouchReading reading = read(probe, model, state);
  if (!is_vector(quantity)) {
    values.push_back(pick_touch(quantity, reading));
    return;
  }
  Vector3 value = reading.p_W;
  if (quantity == ContactQuantity::force) {
    value = probe.is_turned ? Vector3(-reading.force_W) : reading.force_W;
  }
  values.insert(values.end(), value.data(), value.data() + 3);
}

}  // namespace limber::scene
