// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/stress_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/percent.hpp"

namespace limber::app {
namespace {

// "12", "12 top".
std::string name_node(const runs::StressPeak& peak) {
  return peak.layer.empty() ? std::to_string(peak.node)
                            : fmt::format("{} {}", peak.node, peak.layer);
}

}  // namespace

Json to_json(const std::vector<runs::StressPeak>& peaks) {
  Json json = Json::array();
  for (const runs::StressPeak& peak : peaks) {
    json.push_back(
        Json{{"link", peak.link},
             {"von_mises", peak.von_mises},
             {"time", peak.time},
             {"node", peak.node},
             {"layer", peak.layer.empty() ? Json(nullptr) : Json(peak.layer)},
             {"place", {peak.p_L.x(), peak.p_L.y(), peak.p_L.z()}},
             {"averaging_error", or_null(peak.averaging_error)},
             {"correction_share", or_null(peak.correction_fraction)}});
  }
  return json;
}

std::string to_text(const std::vector<runs::StressPeak>& peaks) {
  if (peaks.empty()) return "";
  std::size_t width = 8;
  for (const runs::StressPeak& peak : peaks)
    width = std::max(width, name_node(peak).size());
  std::string text =
      fmt::format("{:<20} {:>14} {:>{}} {:>30} {:>11} {:>10} {:>10}\n",
                  "von Mises stress", "largest [Pa]", "node", width, "at [m]",
                  "time [s]", "averaging", "static");
  for (const runs::StressPeak& peak : peaks) {
    text +=
        fmt::format("{:<20} {:>14.6g} {:>{}} {:>30} {:>11.6g} {:>10} {:>10}\n",
                    peak.link, peak.von_mises, name_node(peak), width,
                    fmt::format("({:.4g}, {:.4g}, {:.4g})", peak.p_L.x(),
                                peak.p_L.y(), peak.p_L.z()),
                    peak.time, to_percent(peak.averaging_error),
                    to_percent(peak.correction_fraction));
  }
  return text;
}

}  // namespace limber::app
