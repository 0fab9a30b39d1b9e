// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "limber/dynamics/system/fidelity.hpp"
#include "limber/scene/text/setting.hpp"

/// Contents of a study file, plain values. Manual: docs/reference/studies.md.
namespace limber::study {

/// Values one by one, each as TOML.
struct Listed {
  std::vector<std::string> values;
};
/// Numbers from `from` to `to`, even or with even logarithms [its unit];
/// `count` of them where a design needs a list.
struct Spread {
  double from = 0.0;
  double to = 1.0;
  bool is_logarithmic = false;
  std::optional<int> count = {};
};
struct Normal {
  double mean = 0.0;       ///< [its unit]
  double deviation = 1.0;  ///< > 0 [its unit]
};

/// A quantity that differs between the runs.
struct Factor {
  std::string name;
  /// Keys of scenario and robot, all with the same value; "fidelity" is the
  /// level of every flexible link.
  std::vector<std::string> paths;
  std::variant<Listed, Spread, Normal> values;
};

enum class DesignKind { grid, list, latin_hypercube, sobol, monte_carlo };
[[nodiscard]] const char* to_string(DesignKind kind);

struct DesignSpec {
  DesignKind kind = DesignKind::grid;
  int samples = 0;  ///< of a sampled design
  std::uint64_t seed = 0;
};

enum class Measure {
  peak,
  time,  ///< of the peak
  final,
  rms,
  // Of curve_measures.hpp:
  overshoot,
  settling_time,
  frequency,
  acceleration,  ///< of columns of places and velocities
  difference,    ///< largest at an output from the run, of another level
};
/// A column of a probe, as "tip.x".
struct ProbeResponse {
  std::string column;
  Measure measure = Measure::peak;
};
/// All impacts of two bodies: the sum of their impulses [N s], or the largest
/// force [N]; 0 without impacts.
struct ContactResponse {
  std::string first;
  std::string second;
  bool is_impulse = true;
};
/// A number in summary.json, by its dotted path.
struct SummaryResponse {
  std::string path;
};
/// A formula of factors and of responses before it.
struct ExpressionResponse {
  std::string formula;
};

/// One number that is stored for each run.
struct Response {
  std::string name;
  std::variant<ProbeResponse, ContactResponse, SummaryResponse,
               ExpressionResponse>
      source;
  /// Of the same run with every flexible link at this level; no formula's.
  std::optional<dynamics::Fidelity> level = {};
};

struct Study {
  std::string name;            ///< stem of its file
  std::filesystem::path file;  ///< absolute
  std::filesystem::path scenario;
  std::vector<scene::Setting> settings;  ///< of every run
  DesignSpec design;
  std::vector<Factor> factors;
  std::vector<Response> responses;
  std::string text;  ///< the file's
};

}  // namespace limber::study
