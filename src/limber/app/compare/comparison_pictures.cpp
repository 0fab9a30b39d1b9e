// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/compare/comparison_pictures.hpp"

#include <algorithm>

#include "limber/app/console/terminal.hpp"
#include "limber/app/reports/probe_pictures.hpp"
#include "limber/results/charts/trade_picture.hpp"
#include "limber/results/draw_all.hpp"
#include "limber/runs/compare/comparison_selection.hpp"

namespace limber::app {
namespace {

std::optional<double> drawn_error_of(const runs::ComparedRun& run) {
  if (!run.error) return std::nullopt;
  return find_error(run.error->error, runs::ErrorMeasure::both);
}

/// For each level the completed run with the smallest error.
std::vector<const runs::ComparedRun*> find_best(
    const runs::Comparison& comparison) {
  std::vector<const runs::ComparedRun*> best;
  for (const runs::ComparedRun& run : comparison.runs) {
    if (!run.error) continue;
    const auto same = std::find_if(
        best.begin(), best.end(), [&](const runs::ComparedRun* other) {
          return other->choice.level == run.choice.level;
        });
    if (same == best.end()) {
      best.push_back(&run);
    } else if (drawn_error_of(run) < drawn_error_of(**same)) {
      *same = &run;
    }
  }
  return best;
}

std::vector<results::TradePoint> list_points(
    const runs::Comparison& comparison) {
  std::vector<results::TradePoint> points;
  for (const runs::ComparedRun& run : comparison.runs) {
    if (!run.error) continue;
    const results::MotionError& error = run.error->error;
    // Rigid links only: use the error that exists.
    const auto total = error.displacement.relative();
    points.push_back({std::string(to_string(run.choice.level)),
                      make_label(run.choice), run.cost.online,
                      total ? total : error.rigid.relative(),
                      error.deformation.relative()});
  }
  return points;
}

}  // namespace

void draw_comparison(const runs::Comparison& comparison,
                     const std::filesystem::path& folder,
                     std::optional<double> tolerance) {
  const std::string why = results::draw_trade(
      folder / "trade.png", comparison.scenario.stem().string(),
      list_points(comparison), comparison.reference.cost.online, tolerance);
  if (!why.empty()) {
    print_warnings({why});
    return;  // the next would fail too
  }
  std::vector<NamedHistory> lines;
  for (const runs::ComparedRun* run : find_best(comparison)) {
    lines.push_back({std::string(to_string(run->choice.level)), &run->history});
  }
  lines.push_back({"reference", &comparison.reference.history});
  std::vector<results::Picture> pictures;
  results::add_charts(write_probe_charts(lines, folder), pictures);
  print_warnings(results::draw_all(pictures));
}

}  // namespace limber::app
