// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/mode_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "limber/app/options/validators.hpp"
#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"

namespace limber::app {
namespace {

int parse_count(const std::string& text) {
  int count = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc() || after != end || count < 0)
    throw InputError(fmt::format(
        "'{}' eigenmodes; expected a number, 0 or more, or auto", echo(text)));
  return count;
}

flexbody::AutomaticModes make_automatic(const ModeOptions& options) {
  flexbody::AutomaticModes automatic;
  automatic.threshold = options.threshold.value_or(automatic.threshold);
  automatic.candidates = options.candidates.value_or(automatic.candidates);
  if (options.measure) {
    automatic.measure = flexbody::parse_measure(*options.measure);
  }
  return automatic;
}

Json count_from_one(const std::vector<int>& modes) {
  Json json = Json::array();
  for (const int mode : modes) json.push_back(mode + 1);
  return json;
}

}  // namespace

void add_mode_options(CLI::App& command, const std::string& names,
                      ModeOptions& options) {
  command.add_option(names, options.count,
                     "Eigenmodes: a number (10), or auto: those that the load "
                     "cases need");
  command
      .add_option("--threshold", options.threshold,
                  "With auto: fraction of each load case to reach (0.9)")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--measure", options.measure,
                     "With auto: compliance (default), report or mass");
  command
      .add_option("--candidates", options.candidates,
                  "With auto: lowest eigenmodes to choose from (60)")
      ->check(make_positive());
}

void apply(const ModeOptions& options, flexbody::BasisOptions& basis) {
  if (options.count == "auto") {
    basis.automatic = make_automatic(options);
    return;
  }
  basis.eigenmodes = parse_count(options.count);
  if (options.threshold || options.measure || options.candidates) {
    throw InputError(
        "--threshold, --measure and --candidates choose modes; they go with "
        "'auto' in place of a number of eigenmodes");
  }
}

Json to_json(const flexbody::SelectionRecord& record) {
  Json cases = Json::array();
  for (const flexbody::SelectedCase& item : record.cases) {
    cases.push_back(Json{{"load", item.name},
                         {"modes", count_from_one(item.modes)},
                         {"reached", item.reached},
                         {"static_error_of_eigenmodes", item.eigenmode_error},
                         {"static_error_of_basis", item.basis_error}});
  }
  return Json{{"measure", std::string(to_string(record.measure))},
              {"threshold", record.threshold},
              {"candidates", record.candidates},
              {"eigenmodes", count_from_one(record.modes)},
              {"cases", cases}};
}

Json to_json(const flexbody::MeshLocking& locking) {
  return Json{{"frequency_hz", locking.frequency},
              {"refined_frequency_hz", locking.refined_frequency},
              {"error", locking.error()}};
}

Json to_json(const flexbody::PieceCheck& check) {
  Json json{{"count", check.count}, {"differences", Json::array()}};
  for (const flexbody::PieceDifference& one : check.differences) {
    json["differences"].push_back(Json{{"quantity", one.quantity},
                                       {"unit", one.unit},
                                       {"whole", one.whole},
                                       {"pieces", one.pieces},
                                       {"error", one.error()}});
  }
  if (!check.obstacle.empty()) json["obstacle"] = check.obstacle;
  return json;
}

}  // namespace limber::app
