// SPDX-License-Identifier: BSD-3-Clause
#include "limber/verifier/stiffening_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "limber/results/charts/order_picture.hpp"

namespace limber::app {
namespace {

using reference::Agreement;
using reference::Magnitudes;
using reference::StiffnessTrend;
using reference::Verification;

double find_relative_motion(const Verification& result, const Agreement& run) {
  return reference::find_relative(run.largest, result.motion);
}

std::vector<double> list_relative(const StiffeningReport& report) {
  std::vector<double> all;
  for (const Verification& result : report.study.results) {
    all.push_back(find_relative_motion(result, result.runs.back()));
  }
  return all;
}

std::vector<double> list(const StiffeningReport& report,
                         double Magnitudes::*quantity) {
  std::vector<double> all;
  for (const Verification& result : report.study.results) {
    all.push_back(result.runs.back().largest.*quantity);
  }
  return all;
}

/// The factors that our runs completed.
std::vector<double> list_factors(const StiffeningReport& report) {
  std::vector<double> factors = report.factors;
  factors.resize(report.study.results.size());
  return factors;
}

StiffnessTrend find_trend(const StiffeningReport& report) {
  return reference::find_trend(list_factors(report), list_relative(report));
}

/// Reduction of the floor by the last halving of the step; 0 without one.
double find_step_fraction(const StiffeningReport& report, std::size_t floor) {
  const Verification& result = report.study.results[floor];
  if (result.runs.size() < 2) return 0.0;
  return find_relative_motion(result, result.runs[result.runs.size() - 2]) /
         find_relative_motion(result, result.runs.back());
}

/// Whether halving the step divides a difference by about 4, or by less.
constexpr double kFallsWithStep = 2.0;

std::string describe_floor(const StiffeningReport& report, std::size_t floor) {
  std::string text =
      fmt::format("floor {:.2g}, at {:g} times the stiffness: ",
                  list_relative(report)[floor], report.factors[floor]);
  const double fraction = find_step_fraction(report, floor);
  if (fraction == 0.0)
    return text + "--refine 1 shows whether it is due to the step\n";
  text += fmt::format("halving the step divides it by {:.2f}, so ", fraction);
  return text + (fraction > kFallsWithStep
                     ? "it is due to the step\n"
                     : "it is due to round-off or Simbody, not to the step\n");
}

std::string describe(const StiffeningReport& report) {
  const StiffnessTrend trend = find_trend(report);
  std::string text =
      trend.first_order
          ? fmt::format(
                "first order in 1 / stiffness, within {:g}, from {:g} to {:g} "
                "times the stiffness\n",
                reference::kOrderBand, report.factors[trend.first_order->first],
                report.factors[trend.first_order->last])
          : fmt::format("nowhere first order in 1 / stiffness, within {:g}\n",
                        reference::kOrderBand);
  text += trend.floor ? describe_floor(report, *trend.floor)
                      : std::string("no floor up to there\n");
  if (report.study.ended.empty()) return text;
  return text + fmt::format("{:g} times the stiffness is too much: {}\n",
                            report.factors[report.study.results.size()],
                            report.study.ended);
}

std::string stiffening_row(const std::string& name, const Magnitudes& m) {
  return fmt::format("{:>14} {:>12.3g} {:>12.3g} {:>14.3g} {:>12.3g}", name,
                     m.position, m.rotation, m.velocity, m.angular_velocity);
}

std::string table(const StiffeningReport& report) {
  std::string text =
      fmt::format("{:>14} {:>12} {:>12} {:>14} {:>12} {:>12} {:>6}\n",
                  "stiffness", "position [m]", "angle [rad]", "velocity [m/s]",
                  "spin [rad/s]", "relative", "order");
  const StiffnessTrend trend = find_trend(report);
  const std::vector<double> relative = list_relative(report);
  for (std::size_t i = 0; i < report.study.results.size(); ++i) {
    text += fmt::format(
        "{} {:>12.3g} {:>6}\n",
        stiffening_row(fmt::format("x {:g}", report.factors[i]),
                       report.study.results[i].runs.back().largest),
        relative[i], i == 0 ? "" : fmt::format("{:.3f}", trend.orders[i - 1]));
  }
  return text +
         stiffening_row("largest motion", report.study.results.front().motion) +
         "\n\n";
}

}  // namespace

Json to_json(const StiffeningReport& report) {
  const StiffnessTrend trend = find_trend(report);
  Json runs = Json::array();
  for (std::size_t i = 0; i < report.study.results.size(); ++i) {
    VerificationReport one = report.common;
    one.result = report.study.results[i];
    Json run{{"factor", report.factors[i]}, {"runs", to_json(one)["runs"]}};
    if (i > 0) run["order"] = trend.orders[i - 1];
    runs.push_back(run);
  }
  VerificationReport common = report.common;
  common.result = report.study.results.front();
  Json json = to_json(common);
  json.erase("runs");
  json["stiffened"] = runs;
  if (trend.first_order) {
    json["first_order"] = {report.factors[trend.first_order->first],
                           report.factors[trend.first_order->last]};
  }
  if (trend.floor) {
    json["floor"] = {{"factor", report.factors[*trend.floor]},
                     {"relative", list_relative(report)[*trend.floor]}};
    const double fraction = find_step_fraction(report, *trend.floor);
    if (fraction > 0.0) json["floor"]["divided_by_halving_the_step"] = fraction;
  }
  if (!report.study.ended.empty()) json["ended"] = report.study.ended;
  return json;
}

std::string to_text(const StiffeningReport& report) {
  VerificationReport common = report.common;
  common.result = report.study.results.front();
  return describe_runs(common) + table(report) + describe(report);
}

std::string draw(const StiffeningReport& report,
                 const std::filesystem::path& file) {
  const std::vector<std::pair<const char*, double Magnitudes::*>> quantities = {
      {"position [m]", &Magnitudes::position},
      {"angle [rad]", &Magnitudes::rotation},
      {"velocity [m/s]", &Magnitudes::velocity},
      {"spin [rad/s]", &Magnitudes::angular_velocity}};
  std::vector<results::OrderLine> lines;
  for (const auto& [name, quantity] : quantities) {
    lines.push_back({name, list_factors(report), list(report, quantity)});
  }
  return results::draw_order(
      file,
      std::filesystem::path(report.common.scenario).stem().string() +
          ": distance from ideal joints",
      "stiffness of joints / that of the scenario",
      "largest difference of any body", -1.0, lines);
}

}  // namespace limber::app
