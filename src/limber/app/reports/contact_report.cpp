// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/contact_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

namespace limber::app {
namespace {

using dynamics::ContactRecord;

constexpr std::size_t kMostContactLines = 20;

Json describe_energy(const dynamics::ImpactEnergy& energy) {
  return Json{{"in", energy.in},           {"returned", energy.returned},
              {"stored", energy.stored},   {"damping", energy.damped},
              {"friction", energy.rubbed}, {"error", energy.error}};
}

Json describe_contact(const ContactRecord& record) {
  const std::optional<double> restitution = record.restitution();
  return Json{{"between", split_pair(record.pair)},
              {"time", record.time},
              {"touches", record.touches},
              {"impulse", record.impulse},
              {"peak_force", record.peak_force},
              {"peak_time", record.peak_time},
              {"peak_depth", record.peak_depth},
              {"peak_depth_over_radius", record.peak_depth_over_radius},
              {"duration", record.duration},
              {"touch_speed", record.touch_speed},
              {"restitution", restitution ? Json(*restitution) : Json(nullptr)},
              {"energy", describe_energy(record.energy)}};
}

std::string to_line(const ContactRecord& record) {
  const std::optional<double> e = record.restitution();
  const dynamics::ImpactEnergy& energy = record.energy;
  return fmt::format(
      "{:<24} {:11.6g} {:11.4g} {:7} {:11.4g} {:11.4g} {:>6} {:10.4g} {:10.3g} "
      "{:10.2g}\n",
      record.pair, record.time, record.duration, record.touches, record.impulse,
      record.peak_force, e ? fmt::format("{:.3f}", *e) : "-", energy.in,
      energy.damped + energy.rubbed, energy.error);
}

// Impulse of the kMostContactLines-th largest.
double find_least_shown(const std::vector<ContactRecord>& records) {
  if (records.size() <= kMostContactLines) return 0.0;
  std::vector<double> impulses;
  for (const ContactRecord& record : records) {
    impulses.push_back(record.impulse);
  }
  const auto nth =
      impulses.begin() + static_cast<std::ptrdiff_t>(kMostContactLines - 1);
  std::nth_element(impulses.begin(), nth, impulses.end(), std::greater<>());
  return *nth;
}

}  // namespace

Json split_pair(const std::string& pair) {
  const std::size_t slash = pair.find('/');
  if (slash == std::string::npos) return Json::array({pair});
  return Json::array({pair.substr(0, slash), pair.substr(slash + 1)});
}

Json to_json(const std::vector<ContactRecord>& records) {
  Json list = Json::array();
  for (const ContactRecord& record : records)
    list.push_back(describe_contact(record));
  return list;
}

std::string to_text(const std::vector<ContactRecord>& records) {
  if (records.empty()) return "";
  std::string text = fmt::format(
      "{:<24} {:>11} {:>11} {:>7} {:>11} {:>11} {:>6} {:>10} "
      "{:>10} {:>10}\n",
      "contact", "time [s]", "lasts [s]", "touches", "[N s]", "peak [N]", "e",
      "in [J]", "lost [J]", "error [J]");
  const double least = find_least_shown(records);
  std::size_t shown = 0;
  for (const ContactRecord& record : records) {
    if (record.impulse < least || shown == kMostContactLines) continue;
    text += to_line(record);
    ++shown;
  }
  if (shown < records.size()) {
    text +=
        fmt::format("and {} with smaller impulses\n", records.size() - shown);
  }
  return text;
}

}  // namespace limber::app
