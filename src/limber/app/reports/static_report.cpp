// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/static_report.hpp"

#include <fmt/format.h>

namespace limber::app {

Json to_json(const runs::StaticReport& report) {
  Json json = Json::object();
  json["bodies"] = Json::array();
  for (const runs::StaticBody& body : report.bodies) {
    Json item{
        {"name", body.name}, {"moved", body.moved}, {"turned", body.turned}};
    if (body.size > 0.0) {
      item["deformation"] = body.deformation;
      item["size"] = body.size;
      item["strain_energy"] = body.strain_energy;
      item["static_stiffness"] = body.static_stiffness;
    }
    json["bodies"].push_back(item);
  }
  json["couplers"] = Json::array();
  for (const runs::StaticCoupler& coupler : report.couplers) {
    json["couplers"].push_back(Json{{"name", coupler.name},
                                    {"force", coupler.force},
                                    {"moment", coupler.moment}});
  }
  json["coupler_energy"] = report.coupler_energy;
  if (report.lowest_frequency) {
    json["lowest_frequency"] = *report.lowest_frequency;
  }
  return json;
}

std::string to_text(const runs::StaticReport& report) {
  std::string text = fmt::format("{:<20} {:>11} {:>11} {:>13} {:>9} {:>13}\n",
                                 "body", "moved [m]", "turned [rad]",
                                 "deforms [m]", "of size", "energy [J]");
  for (const runs::StaticBody& b : report.bodies) {
    text +=
        fmt::format("{:<20} {:>11.4g} {:>11.4g}", b.name, b.moved, b.turned);
    if (b.size > 0.0) {
      text += fmt::format(" {:>13.6g} {:>8.2g}% {:>13.6g}", b.deformation,
                          100.0 * b.deformation / b.size, b.strain_energy);
    }
    text += "\n";
  }
  for (const runs::StaticBody& b : report.bodies) {
    if (b.static_stiffness == 1.0) continue;
    text += fmt::format(
        "{}: static stiffness {:.4g} of the material's, which it has at the "
        "scene's lowest frequency: it has a loss factor\n",
        b.name, b.static_stiffness);
  }
  if (!report.couplers.empty()) {
    text += fmt::format("{:<20} {:>11} {:>11}\n", "coupler", "force [N]",
                        "moment [N m]");
  }
  for (const runs::StaticCoupler& c : report.couplers) {
    text +=
        fmt::format("{:<20} {:>11.4g} {:>11.4g}\n", c.name, c.force, c.moment);
  }
  return text;
}

}  // namespace limber::app
