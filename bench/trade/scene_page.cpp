// SPDX-License-Identifier: BSD-3-Clause
#include "scene_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "limber/app/options/reducer.hpp"
#include "limber/results/charts/trade_picture.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::bench::trade {
namespace {

constexpr std::array kLevels = {Fidelity::rigid, Fidelity::uncoupled,
                                Fidelity::one_way, Fidelity::coupled};

std::string to_cell(const results::FieldError& error) {
  const auto relative = error.relative();
  return relative ? to_percent(*relative) : "-";
}

std::vector<std::string> make_row(const Outcome& outcome,
                                  const Outcome& yardstick) {
  std::vector<std::string> row = {
      outcome.choice.name,
      fmt::format("{}", outcome.run.built.model.modal_count)};
  if (!outcome.stopped.empty()) {
    row.insert(row.end(), {"stopped", "", "", "", "", "", "", ""});
    return row;
  }
  if (outcome.error) {
    const results::MotionError& error = outcome.error->error;
    row.insert(row.end(), {to_cell(error.displacement), to_cell(error.rigid),
                           to_cell(error.deformation)});
  } else {
    row.insert(row.end(), {"reference", "", ""});
  }
  row.push_back(outcome.drift ? fmt::format("{:.0e}", *outcome.drift) : "-");
  row.push_back(fmt::format("{:.3g}", outcome.online));
  row.push_back(fmt::format("{:.3g}", yardstick.online / outcome.online));
  row.push_back(
      fmt::format("{:.3g}", yardstick.with_nodes / outcome.with_nodes));
  row.push_back(outcome.offline > 0.0 ? fmt::format("{:.2g}", outcome.offline)
                                      : "known");
  return row;
}

/// First level with at most the neglected error.
std::optional<Fidelity> find_needed(const std::vector<double>& left_out,
                                    double neglected) {
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (left_out[i] <= neglected) return kLevels[i];
  }
  return std::nullopt;
}

std::string to_micrometres(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    text += fmt::format("{}{:.2g}", text.empty() ? "" : " / ", 1e6 * value);
  }
  return text;
}

}  // namespace

std::string to_percent(double fraction) {
  return 100.0 * fraction < 10.0 ? fmt::format("{:.2g}", 100.0 * fraction)
                                 : fmt::format("{:.3g}", 100.0 * fraction);
}

void write_choices(Page& page, const std::filesystem::path& folder,
                   const std::string& name, const std::string& title,
                   const Study& study, const Outcome& yardstick) {
  std::vector<std::vector<std::string>> rows;
  std::vector<results::TradePoint> points;
  for (const Outcome* outcome : study.list()) {
    rows.push_back(make_row(*outcome, yardstick));
    if (!outcome->error) continue;
    const Choice& choice = outcome->choice;
    const auto& error = outcome->error->error;
    points.push_back(
        {choice.links.empty() ? std::string(to_string(choice.level)) : "mixed",
         choice.label.empty() ? choice.name : choice.label, outcome->online,
         error.displacement.relative(), error.deformation.relative()});
  }
  rows.push_back(make_row(study.reference(), yardstick));
  page.table({"choice", "vectors", "displacement %", "rigid %", "deformation %",
              "energy drift", "online [s/s]", "times cheaper", "with all nodes",
              "offline [s]"},
             rows);
  for (const Outcome* outcome : study.list()) {
    if (outcome->stopped.empty()) continue;
    page.text(fmt::format("`{}` stopped: {}.", outcome->choice.name,
                          outcome->stopped));
  }
  const std::string trouble =
      results::draw_trade(folder / (name + ".png"), title, points,
                          study.reference().online, std::nullopt);
  page.text(fmt::format("![{}]({}.png)", title, name));
  if (!trouble.empty()) page.text(trouble);
}

bool Verdict::agrees() const {
  return std::all_of(links.begin(), links.end(), [](const LinkVerdict& link) {
    return link.advised == link.needed;
  });
}

bool Verdict::is_safe() const {
  return std::all_of(links.begin(), links.end(), [](const LinkVerdict& link) {
    return link.advised >= link.needed;
  });
}

bool Verdict::agrees_by_full() const {
  return std::all_of(links.begin(), links.end(), [](const LinkVerdict& link) {
    return link.needed_by_full.value_or(Fidelity::full) == link.advised;
  });
}

Verdict judge_advice(const Study& study, const Choice& base) {
  std::vector<Outcome> runs;
  for (const Fidelity level : kLevels) {
    Choice choice = base;
    choice.level = level;
    choice.exact_modes = false;  // the same steps for all
    choice.repeats = 1;
    runs.push_back(study.simulate(choice));
  }
  Verdict verdict;
  scene::Scene scene = scene::load_scene(study.file());
  if (base.change) base.change(scene);
  const auto& bodies = runs.back().run.built.model.bodies;
  for (const runs::BodyLevel& level :
       app::advise(scene, study.cache(), {}).levels) {
    LinkVerdict link{.link = level.name,
                     .neglected = level.limits.displacement,
                     .advised = level.advice.level,
                     .is_beyond_linear = level.advice.is_beyond_linear};
    const auto body = std::find_if(
        bodies.begin(), bodies.end(),
        [&](const dynamics::BodyModel& b) { return b.name == level.name; });
    const int b = static_cast<int>(body - bodies.begin());
    for (const Outcome& run : runs) {
      // A failed run counts as neglecting everything.
      const double all = std::numeric_limits<double>::infinity();
      const bool is_whole = run.stopped.empty() && runs.back().stopped.empty();
      link.from_coupled.push_back(
          is_whole ? find_largest_distance(run, runs.back(), b) : all);
      link.from_full.push_back(
          run.stopped.empty() ? find_largest_distance(run, study.reference(), b)
                              : all);
    }
    link.needed = find_needed(link.from_coupled, link.neglected)
                      .value_or(Fidelity::coupled);
    link.needed_by_full = find_needed(link.from_full, link.neglected);
    verdict.links.push_back(link);
  }
  return verdict;
}

void write_verdict(Page& page, const Verdict& verdict) {
  std::vector<std::vector<std::string>> rows;
  for (const LinkVerdict& link : verdict.links) {
    rows.push_back(
        {link.link, fmt::format("{:.2g}", 1e6 * link.neglected),
         fmt::format("{}{}", to_string(link.advised),
                     link.is_beyond_linear ? ", beyond linear" : ""),
         to_micrometres(link.from_coupled), std::string(to_string(link.needed)),
         to_micrometres(link.from_full),
         link.needed_by_full ? std::string(to_string(*link.needed_by_full))
                             : "none"});
  }
  page.text(
      "`limber advise`, and what the levels rigid / uncoupled / one-way / "
      "coupled neglect: the largest distance of any node from `coupled` in the "
      "same basis and steps (the effect of the level alone), and from `full`, "
      "in um.");
  page.table({"link", "neglected [um]", "advised", "from coupled", "sufficient",
              "from full", "sufficient"},
             rows);
}

}  // namespace limber::bench::trade
