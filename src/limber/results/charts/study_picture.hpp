// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Pictures of many runs. Each function returns an empty string, or why there
/// is no picture.
namespace limber::results {

/// One factor or response, with a value for each run.
struct StudyColumn {
  std::string name;
  /// NaN: none; of texts their number from 0 [its unit].
  std::vector<double> values;
  std::vector<std::string> texts = {};  ///< empty: they are numbers
  bool is_logarithmic = false;
};

/// A response over each factor, one panel per factor and one point per run.
[[nodiscard]] std::string draw_response(
    const std::filesystem::path& file, const std::string& title,
    const StudyColumn& response, const std::vector<StudyColumn>& factors);

/// A response as the colour of points over each pair of factors.
[[nodiscard]] std::string draw_maps(const std::filesystem::path& file,
                                    const std::string& title,
                                    const StudyColumn& response,
                                    const std::vector<StudyColumn>& factors);

/// The first eight columns over each other.
[[nodiscard]] std::string draw_matrix(const std::filesystem::path& file,
                                      const std::string& title,
                                      const std::vector<StudyColumn>& columns);

/// Distribution of one response.
struct DistributionCurve {
  std::string response;
  std::vector<double> values;  ///< of the samples, ascending [its unit]
  double mean = 0.0;           ///< [its unit]
  double mean_error = 0.0;     ///< half the width of its interval [its unit]
  double band = 0.0;           ///< the same of the distribution function [-]
};
/// The fraction of samples below each value with its band, and the mean with
/// its interval; a panel each.
[[nodiscard]] std::string draw_distributions(
    const std::filesystem::path& file, const std::string& title,
    const std::vector<DistributionCurve>& responses);

/// A number with its interval [-].
struct Bar {
  double value = 0.0;  ///< NaN: not known, only its interval is drawn
  double low = 0.0;
  double high = 0.0;
};
/// Two numbers of every factor for one response, as main and total effect.
struct FactorBars {
  std::string response;
  std::vector<std::string> factors;
  std::vector<Bar> first;
  std::vector<Bar> second;
};
/// What the bars are.
struct BarLabels {
  std::string first;
  std::string second;
  std::string axis;
  std::string range;  ///< of the axis, as gnuplot writes it: "[0:1]"
};
[[nodiscard]] std::string draw_bars(const std::filesystem::path& file,
                                    const std::string& title,
                                    const BarLabels& labels,
                                    const std::vector<FactorBars>& responses);

}  // namespace limber::results
