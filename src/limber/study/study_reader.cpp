// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/study_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <sstream>

#include "limber/common/echo.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/scene/text/key_depth.hpp"
#include "limber/scene/text/toml_table.hpp"
#include "limber/study/design.hpp"

namespace limber::study {
namespace {

using scene::Problems;
using scene::TomlTable;

constexpr InputKind kStudy = {"study file", std::uint64_t{1} << 26};
constexpr int kVersion = 1;

/// A value on one line.
std::string to_line(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) {
    return fmt::format("{}", *number);
  }
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> values;
    for (const toml::node& value : *array) values.push_back(to_line(value));
    return fmt::format("[{}]", fmt::join(values, ", "));
  }
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

/// For --set: a text without its quotes.
std::string to_toml(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  return to_line(node);
}

Listed read_list(const toml::table& factor, const char* key, TomlTable& table) {
  Listed listed;
  table.skip(key);
  const toml::array* values = factor[key].as_array();
  if (values == nullptr || values->empty()) {
    table.fail(key, "expected an array with one value or more");
    return listed;
  }
  for (const toml::node& value : *values) {
    if (value.is_table()) table.fail(key, "expected numbers, texts or arrays");
    listed.values.push_back(to_toml(value));
  }
  return listed;
}

std::optional<std::pair<double, double>> read_two(TomlTable& table,
                                                  const char* key) {
  const auto numbers = table.numbers(key);
  if (!numbers) return std::nullopt;
  if (numbers->size() == 2) return std::pair((*numbers)[0], (*numbers)[1]);
  table.fail(key, fmt::format("expected two numbers, got {}", numbers->size()));
  return std::nullopt;
}

Spread read_spread(TomlTable& table, const char* key, bool is_logarithmic) {
  Spread spread;
  spread.is_logarithmic = is_logarithmic;
  spread.count = table.integer("count", 2, kMostRuns);
  const auto ends = read_two(table, key);
  if (!ends) return spread;
  spread.from = ends->first;
  spread.to = ends->second;
  if (!(spread.from < spread.to)) {
    table.fail(key, "its first number is not less than its second");
  } else if (is_logarithmic && !(spread.from * spread.to > 0.0)) {
    table.fail(key, "has no logarithms: both of a sign, and not 0");
  }
  return spread;
}

Normal read_normal(TomlTable& table) {
  Normal normal;
  const auto numbers = read_two(table, "normal");
  if (!numbers) return normal;
  normal = {numbers->first, numbers->second};
  if (!(normal.deviation > 0.0)) {
    table.fail("normal", "its deviation, the second number, is not > 0");
  }
  return normal;
}

void read_values(const toml::table& source, TomlTable& table, Factor& factor) {
  constexpr std::array<const char*, 6> kKinds = {
      "values", "choice", "range", "log_range", "uniform", "normal"};
  const auto count = std::count_if(kKinds.begin(), kKinds.end(),
                                   [&](auto k) { return table.has(k); });
  if (count != 1) {
    table.fail(
        fmt::format("factor '{}' has {} of 'values', 'choice', 'range', "
                    "'log_range', 'uniform', 'normal'; give one",
                    echo(factor.name), count));
    for (const char* key : kKinds) table.skip(key);
    table.skip("count");
    return;
  }
  if (table.has("values")) factor.values = read_list(source, "values", table);
  if (table.has("choice")) factor.values = read_list(source, "choice", table);
  if (table.has("range")) factor.values = read_spread(table, "range", false);
  if (table.has("log_range")) {
    factor.values = read_spread(table, "log_range", true);
  }
  if (table.has("uniform")) {
    factor.values = read_spread(table, "uniform", false);
  }
  if (table.has("normal")) factor.values = read_normal(table);
}

Factor read_factor(const toml::table& source, TomlTable& table) {
  Factor factor;
  factor.name = table.required_text("name");
  const auto path = table.text("path");
  const auto paths = table.texts("paths");
  if (path.has_value() == paths.has_value()) {
    table.fail(
        fmt::format("factor '{}' needs 'path' or 'paths'", echo(factor.name)));
  }
  if (path) factor.paths = {*path};
  if (paths) factor.paths = *paths;
  if (factor.paths.empty()) table.fail("'paths' is empty");
  for (const std::string& one : factor.paths) {
    try {
      (void)scene::split_path(one);
    } catch (const InputError& error) {
      table.fail(error.what());
    }
  }
  read_values(source, table, factor);
  return factor;
}

Measure read_measure(TomlTable& table) {
  return read_choice<Measure>(table, "measure",
                              {{"peak", Measure::peak},
                               {"time", Measure::time},
                               {"final", Measure::final},
                               {"rms", Measure::rms},
                               {"overshoot", Measure::overshoot},
                               {"settling_time", Measure::settling_time},
                               {"frequency", Measure::frequency},
                               {"acceleration", Measure::acceleration},
                               {"difference", Measure::difference}},
                              Measure::peak);
}

ContactResponse read_contact(TomlTable& table) {
  ContactResponse contact;
  const auto names = table.texts("contact");
  if (names && names->size() == 2) {
    contact.first = names->front();
    contact.second = names->back();
  } else if (names) {
    table.fail("contact", "expected the names of two bodies");
  }
  contact.is_impulse = read_choice<bool>(
      table, "measure", {{"impulse", true}, {"peak", false}}, true);
  return contact;
}

void read_level(TomlTable& table, Response& response) {
  if (const auto level = table.text("level")) {
    if (table.has("expression")) {
      table.fail("level", "a formula uses responses, which have levels");
    }
    try {
      response.level = dynamics::parse_fidelity(*level);
    } catch (const InputError& error) {
      table.fail("level", error.what());
    }
  }
  const auto* probe = std::get_if<ProbeResponse>(&response.source);
  if (probe && probe->measure == Measure::difference && !response.level) {
    table.fail("measure",
               "a difference is that of another 'level' from the run");
  }
}

Response read_response(TomlTable& table) {
  Response response;
  response.name = table.required_text("name");
  const std::array<const char*, 4> kinds = {"probe", "contact", "summary",
                                            "expression"};
  const auto count = std::count_if(kinds.begin(), kinds.end(),
                                   [&](auto k) { return table.has(k); });
  if (count != 1) {
    table.fail(
        fmt::format("response '{}' has {} of 'probe', 'contact', "
                    "'summary', 'expression'; give one",
                    echo(response.name), count));
  }
  if (const auto column = table.text("probe")) {
    response.source = ProbeResponse{*column, read_measure(table)};
  }
  if (table.has("contact")) response.source = read_contact(table);
  if (const auto path = table.text("summary")) {
    response.source = SummaryResponse{*path};
  }
  if (const auto formula = table.text("expression")) {
    response.source = ExpressionResponse{*formula};
  }
  read_level(table, response);
  return response;
}

DesignSpec read_design(TomlTable& table) {
  DesignSpec design;
  design.kind =
      read_choice<DesignKind>(table, "kind",
                              {{"grid", DesignKind::grid},
                               {"list", DesignKind::list},
                               {"latin-hypercube", DesignKind::latin_hypercube},
                               {"sobol", DesignKind::sobol},
                               {"monte-carlo", DesignKind::monte_carlo}},
                              DesignKind::grid);
  const bool is_sampled =
      design.kind != DesignKind::grid && design.kind != DesignKind::list;
  if (is_sampled) {
    design.samples = table.integer("samples", 1, kMostRuns).value_or(0);
    if (!table.has("samples")) {
      table.fail(
          fmt::format("a {} design needs 'samples'", to_string(design.kind)));
    }
    design.seed = static_cast<std::uint64_t>(
        table.integer("seed", 0, 2147483647).value_or(0));
  } else if (table.has("samples") || table.has("seed")) {
    table.fail(fmt::format(
        "'samples' and 'seed' apply only to sampled designs; this is a {}",
        to_string(design.kind)));
    table.skip("samples");
    table.skip("seed");
  }
  return design;
}

/// Columns of the table of runs, whose names SQL compares without case.
void check_names(const Study& study, TomlTable& root) {
  std::set<std::string> taken = {"run", "error", "warnings", "digest"};
  const auto take = [&](const std::string& kind, const std::string& name) {
    const auto is_letter = [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_';
    };
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ||
        !std::all_of(name.begin(), name.end(), is_letter)) {
      root.fail(fmt::format(
          "{} '{}': a name has only letters, digits and _, and does not begin "
          "with a digit, so that formulas can use it",
          kind, echo(name)));
    }
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (taken.insert(lower).second) return;
    root.fail(fmt::format("{} '{}': this name is taken", kind, echo(name)));
  };
  for (const Factor& factor : study.factors) take("factor", factor.name);
  for (const Response& one : study.responses) take("response", one.name);
}

void check_paths(const Study& study, TomlTable& root) {
  std::set<std::string> taken;
  for (const Factor& factor : study.factors) {
    for (const std::string& path : factor.paths) {
      if (taken.insert(path).second) continue;
      root.fail(
          fmt::format("factor '{}': another factor also has the path '{}'",
                      echo(factor.name), echo(path)));
    }
  }
}

void read_settings(TomlTable& root, Study& study) {
  for (const std::string& path :
       root.texts("unset").value_or(std::vector<std::string>{})) {
    study.settings.push_back({path, std::nullopt});
  }
  for (const std::string& text :
       root.texts("set").value_or(std::vector<std::string>{})) {
    try {
      study.settings.push_back(scene::parse_setting(text));
    } catch (const InputError& error) {
      root.fail("set", error.what());
    }
  }
}

void read_root(TomlTable& root, Study& study) {
  const int version = root.integer("version", 0, 1'000'000).value_or(kVersion);
  if (version != kVersion) {
    root.fail("version",
              fmt::format("is {}; this Limber reads studies of version {}",
                          version, kVersion));
  }
  study.scenario = (study.file.parent_path() / root.required_text("scenario"))
                       .lexically_normal();
  read_settings(root, study);
  if (const toml::table* table = root.table("design")) {
    TomlTable design(*table, "design", root.problems());
    study.design = read_design(design);
    design.finish();
  } else {
    root.fail("needs [design] with 'kind'");
  }
  for (const toml::table* table : root.tables("factor")) {
    TomlTable factor(*table, fmt::format("factor {}", study.factors.size() + 1),
                     root.problems());
    study.factors.push_back(read_factor(*table, factor));
    factor.finish();
  }
  for (const toml::table* table : root.tables("response")) {
    TomlTable response(*table,
                       fmt::format("response {}", study.responses.size() + 1),
                       root.problems());
    study.responses.push_back(read_response(response));
    response.finish();
  }
  if (study.factors.empty()) root.fail("needs a [[factor]]");
  if (study.responses.empty()) root.fail("needs a [[response]]");
  check_names(study, root);
  check_paths(study, root);
  root.finish();
}

toml::table parse(const std::string& text, const std::filesystem::path& file) {
  if (const auto line = scene::find_overlong_key(text)) {
    throw InputError(fmt::format("{}:{}: a key of more than {} parts",
                                 file.string(), *line, scene::kMostKeyParts));
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", file.string(),
                                 error.source().begin.line,
                                 echo(error.description())));
  }
}

}  // namespace

const char* to_string(DesignKind kind) {
  constexpr std::array<const char*, 5> kNames = {
      "grid", "list", "latin-hypercube", "sobol", "monte-carlo"};
  return kNames.at(static_cast<std::size_t>(kind));
}

Study read_study(const std::filesystem::path& file) {
  return read_study(read_input(file, kStudy), file);
}

Study read_study(const std::string& text, const std::filesystem::path& file) {
  Problems problems(file.string());
  const toml::table table = parse(text, file);
  Study study;
  study.text = text;
  study.name = file.stem().string();
  study.file = std::filesystem::absolute(file).lexically_normal();
  TomlTable root(table, "", problems);
  read_root(root, study);
  problems.raise();
  return study;
}

}  // namespace limber::study
