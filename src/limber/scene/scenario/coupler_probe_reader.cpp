// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/coupler_probe_reader.hpp"

#include <fmt/format.h>

namespace limber::scene {
namespace {

const std::vector<std::pair<std::string, CouplerQuantity>> kCouplerQuantities =
    {{"coordinate", CouplerQuantity::coordinate},
     {"coordinate_rate", CouplerQuantity::coordinate_rate},
     {"effort", CouplerQuantity::effort},
     {"relative_position", CouplerQuantity::relative_position},
     {"relative_rotation", CouplerQuantity::relative_rotation},
     {"relative_velocity", CouplerQuantity::relative_velocity},
     {"relative_angular_velocity", CouplerQuantity::relative_angular_velocity},
     {"force", CouplerQuantity::force},
     {"moment", CouplerQuantity::moment},
     {"energy", CouplerQuantity::energy},
     {"dissipation", CouplerQuantity::dissipation},
     {"power", CouplerQuantity::power}};

}  // namespace

CouplerProbeSpec read_coupler_probe(TomlTable& table) {
  CouplerProbeSpec probe;
  // A joint is a coupler of its name.
  const std::string of = table.has("joint") ? "joint" : "coupler";
  probe.coupler = table.required_text(of);
  for (const char* other : {"link", "coupler"}) {
    if (other == of || !table.has(other)) continue;
    table.fail(fmt::format("has both '{}' and '{}'; keep one", other, of));
    table.skip(other);
  }
  probe.quantity = read_choice<CouplerQuantity>(
      table, "quantity", kCouplerQuantities, probe.quantity);
  probe.side = read_choice<ProbeSide>(
      table, "side", {{"F", ProbeSide::F}, {"M", ProbeSide::M}}, probe.side);
  probe.axes = read_choice<ProbeAxes>(
      table, "frame",
      {{"F", ProbeAxes::F}, {"M", ProbeAxes::M}, {"world", ProbeAxes::world}},
      probe.axes);
  if (table.has("side") && !has_side(probe.quantity)) {
    table.fail("side", "applies only to 'force' and 'moment'");
  }
  if (table.has("frame") && !is_vector(probe.quantity)) {
    table.fail("frame", "applies only to vectors; this quantity has no axes");
  }
  return probe;
}

}  // namespace limber::scene
