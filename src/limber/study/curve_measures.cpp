// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/curve_measures.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "limber/dynamics/equations/refined_peak.hpp"

namespace limber::study {
namespace {

constexpr double kBand = 0.02;       // of a settled curve [-]
constexpr double kWatched = 0.1;     // last fraction of the time [-]
constexpr double kEven = 1e-6;       // of an interval [-]
constexpr double kRoundoff = 1e-12;  // of an amplitude [-]
constexpr std::size_t kFewest = 16;  // samples of a spectrum
constexpr double kTau = 2.0 * std::numbers::pi;

bool is_even(std::span<const double> times) {
  const double h =
      (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (std::abs(times[i] - times[i - 1] - h) > kEven * h) return false;
  }
  return h > 0.0;
}

/// Without its linear trend, in Hann's window.
std::vector<double> window(std::span<const double> values) {
  const auto last = static_cast<double>(values.size() - 1);
  double mean = 0.0;
  double slope = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double s = static_cast<double>(i) - 0.5 * last;
    mean += values[i] / (last + 1.0);
    slope += s * values[i];
    square += s * s;
  }
  slope /= square;
  std::vector<double> shaped;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto at = static_cast<double>(i);
    const double weight = 0.5 - 0.5 * std::cos(kTau * at / last);
    shaped.push_back(weight * (values[i] - mean - slope * (at - 0.5 * last)));
  }
  return shaped;
}

/// Amplitude of a curve at a frequency [1/sample].
double find_amplitude(const std::vector<double>& values, double frequency) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += std::polar(values[i], -kTau * frequency * static_cast<double>(i));
  }
  return std::abs(sum);
}

/// Top of the amplitude between two frequencies, by golden sections.
double find_crest(const std::vector<double>& values, double low, double high) {
  constexpr int kSections = 40;
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < kSections; ++i) {
    const double a = high - kGolden * (high - low);
    const double b = low + kGolden * (high - low);
    if (find_amplitude(values, a) > find_amplitude(values, b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<double> find_overshoot(std::span<const double> times,
                                     std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  const double change = values.back() - values.front();
  if (!(std::abs(change) > 0.0)) return std::nullopt;
  dynamics::RefinedPeak peak;
  for (std::size_t i = 0; i < values.size(); ++i) {
    peak.include((values[i] - values.front()) / change, times[i]);
  }
  return std::max(peak.peak().value - 1.0, 0.0);
}

std::optional<double> find_settling_time(std::span<const double> times,
                                         std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  const double band = kBand * std::abs(values.back() - values.front());
  if (!(band > 0.0)) return std::nullopt;
  const auto off = [&](std::size_t i) {
    return std::abs(values[i] - values.back());
  };
  std::size_t i = values.size() - 1;
  while (off(i) <= band) --i;  // the first one is 50 bands off
  const double fraction = (off(i) - band) / (off(i) - off(i + 1));
  const double time =
      times[i] + fraction * (times[i + 1] - times[i]) - times.front();
  const double duration = times.back() - times.front();
  if (time > (1.0 - kWatched) * duration) return std::nullopt;
  return time;
}

std::optional<double> find_dominant_frequency(std::span<const double> times,
                                              std::span<const double> values) {
  if (values.size() < kFewest || !is_even(times)) return std::nullopt;
  std::vector<double> shaped = window(values);
  const std::vector<double> alone = shaped;
  const std::size_t size = 2 * std::bit_ceil(values.size());
  shaped.resize(size, 0.0);
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, shaped);
  // From one and a half periods in the whole time on.
  const auto least = static_cast<std::size_t>(std::ceil(
      1.5 * static_cast<double>(size) / static_cast<double>(values.size())));
  std::size_t top = least;
  for (std::size_t k = least; k <= size / 2; ++k) {
    if (std::norm(spectrum[k]) > std::norm(spectrum[top])) top = k;
  }
  const auto is_smaller = [](double a, double b) {
    return std::abs(a) < std::abs(b);
  };
  const double largest =
      std::abs(*std::max_element(values.begin(), values.end(), is_smaller));
  const double roundoff =
      kRoundoff * largest * static_cast<double>(values.size());
  if (top == least || std::abs(spectrum[top]) <= roundoff) return std::nullopt;
  const auto bins = static_cast<double>(size);
  const double frequency =
      find_crest(alone, static_cast<double>(top - 1) / bins,
                 static_cast<double>(top + 1) / bins);
  return frequency * static_cast<double>(values.size() - 1) /
         (times.back() - times.front());
}

std::optional<double> find_largest_derivative(std::span<const double> times,
                                              std::span<const double> values,
                                              int order) {
  if (values.size() < 3 || !is_even(times)) return std::nullopt;
  const double h =
      (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const double before = values[i] - values[i - 1];
    const double after = values[i + 1] - values[i];
    const double derivative =
        order == 1 ? 0.5 * (after + before) / h : (after - before) / (h * h);
    largest = std::max(largest, std::abs(derivative));
  }
  return largest;
}

}  // namespace limber::study
