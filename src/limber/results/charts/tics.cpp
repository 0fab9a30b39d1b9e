// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/tics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace limber::results {
namespace {

constexpr double kRoundoff = 1e-9;
constexpr std::size_t kMostPowers = 8;

/// The factors times powers of ten that lie within.
std::vector<double> list_multiples(double least, double most,
                                   const std::vector<double>& factors) {
  std::vector<double> places;
  const int first = static_cast<int>(std::floor(std::log10(least))) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(most)));
  for (int power = first; power <= last; ++power) {
    for (const double factor : factors) {
      const double place = factor * std::pow(10.0, power);
      if (place >= least * (1.0 - kRoundoff) &&
          place <= most * (1.0 + kRoundoff)) {
        places.push_back(place);
      }
    }
  }
  return places;
}

/// Every second, third, ... so that their labels have room.
std::vector<double> thin_out(const std::vector<double>& places) {
  const std::size_t stride = (places.size() + kMostPowers - 1) / kMostPowers;
  std::vector<double> kept;
  for (std::size_t i = 0; i < places.size(); i += stride) {
    kept.push_back(places[i]);
  }
  return kept;
}

}  // namespace

std::vector<double> list_even_tics(double least, double most) {
  const double range = most - least;
  const double power = std::pow(10.0, std::floor(std::log10(range)));
  double step = 0.0;
  for (const double factor : {0.5, 1.0, 2.0, 2.5, 5.0}) {
    step = factor * power;
    if (range / step <= 4.0) break;
  }
  std::vector<double> places;
  const double first = std::ceil(least / step - kRoundoff);
  const double last = std::floor(most / step + kRoundoff);
  for (double k = first; k <= last; ++k) places.push_back(k * step);
  return places;
}

std::vector<double> list_logarithmic_tics(double least, double most) {
  const std::vector<double> powers = list_multiples(least, most, {1.0});
  if (powers.size() >= 3) return thin_out(powers);
  for (const std::vector<double>& factors :
       {std::vector<double>{1, 2, 5},
        std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}}) {
    std::vector<double> places = list_multiples(least, most, factors);
    if (places.size() >= 3) return places;
  }
  return list_even_tics(least, most);
}

std::string to_tics(const std::vector<double>& places) {
  std::vector<std::string> texts;
  texts.reserve(places.size());
  for (const double place : places)
    texts.push_back(fmt::format("{:.9g}", place));
  return fmt::format("({})", fmt::join(texts, ", "));
}

}  // namespace limber::results
