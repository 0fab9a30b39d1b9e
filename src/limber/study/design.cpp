// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/study/sobol_sequence.hpp"

namespace limber::study {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Doubles in (0, 1), the same with every standard library.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double draw() {
    return (static_cast<double>(engine_() >> 12U) + 0.5) * 0x1p-52;
  }
  std::uint32_t draw_bits() {
    return static_cast<std::uint32_t>(engine_() >> 32U);
  }

 private:
  std::mt19937_64 engine_;
};

double interpolate(const Spread& spread, double u) {
  if (u <= 0.0) return spread.from;
  if (u >= 1.0) return spread.to;
  if (!spread.is_logarithmic) {
    return spread.from + u * (spread.to - spread.from);
  }
  return spread.from * std::pow(spread.to / spread.from, u);
}

std::string to_text(double value) { return fmt::format("{}", value); }

/// The values of a factor one by one, for a design that needs a list.
std::vector<std::string> list_values(const Factor& factor, DesignKind kind) {
  if (const auto* listed = std::get_if<Listed>(&factor.values)) {
    return listed->values;
  }
  const auto* spread = std::get_if<Spread>(&factor.values);
  if (spread == nullptr || !spread->count) {
    throw InputError(fmt::format(
        "factor '{}': a {} needs a list of its values: 'values', or a 'range' "
        "or 'log_range' with 'count'",
        factor.name, to_string(kind)));
  }
  std::vector<std::string> values;
  for (int i = 0; i < *spread->count; ++i) {
    values.push_back(to_text(
        interpolate(*spread, static_cast<double>(i) / (*spread->count - 1))));
  }
  return values;
}

void check_count(std::size_t count) {
  if (count <= std::size_t{kMostRuns}) return;
  throw InputError(
      fmt::format("the design has {} runs, more than {}", count, kMostRuns));
}

Design make_grid(const std::vector<std::vector<std::string>>& values) {
  std::size_t count = 1;
  for (const auto& list : values) {
    count *= list.size();
    check_count(count);
  }
  Design design(count);
  for (std::size_t run = 0; run < count; ++run) {
    std::size_t rest = run;
    design[run].resize(values.size());
    for (std::size_t f = values.size(); f-- > 0;) {
      design[run][f] = values[f][rest % values[f].size()];
      rest /= values[f].size();
    }
  }
  return design;
}

Design make_list(const Study& study,
                 const std::vector<std::vector<std::string>>& values) {
  const std::size_t count = values.front().size();
  for (std::size_t f = 0; f < values.size(); ++f) {
    if (values[f].size() == count) continue;
    throw InputError(fmt::format(
        "factor '{}' has {} values and '{}' has {}; a list needs as many of "
        "each",
        study.factors[0].name, count, study.factors[f].name, values[f].size()));
  }
  Design design(count);
  for (std::size_t run = 0; run < count; ++run) {
    for (const auto& list : values) design[run].push_back(list[run]);
  }
  return design;
}

Matrix sample_hypercube(std::size_t samples, std::size_t factors,
                        Uniform& uniform) {
  Matrix points(samples, std::vector<double>(factors));
  std::vector<std::size_t> order(samples);
  for (std::size_t f = 0; f < factors; ++f) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = samples; i-- > 1;) {
      const double fraction = uniform.draw() * static_cast<double>(i + 1);
      std::swap(order[i], order[static_cast<std::size_t>(fraction)]);
    }
    for (std::size_t i = 0; i < samples; ++i) {
      points[i][f] = (static_cast<double>(order[i]) + uniform.draw()) /
                     static_cast<double>(samples);
    }
  }
  return points;
}

Matrix sample_freely(std::size_t samples, std::size_t factors,
                     Uniform& uniform) {
  Matrix points(samples, std::vector<double>(factors));
  for (auto& point : points) {
    for (double& u : point) u = uniform.draw();
  }
  return points;
}

/// The sequence, shifted by the seed in its binary digits.
Matrix sample_sobol(const Study& study, Uniform& uniform) {
  const std::size_t d = study.factors.size();
  if (2 * d > static_cast<std::size_t>(SobolSequence::kMostDimensions)) {
    throw InputError(
        fmt::format("a sobol design has {} factors at most, not {}",
                    SobolSequence::kMostDimensions / 2, d));
  }
  const auto samples = static_cast<std::size_t>(study.design.samples);
  check_count(samples * (d + 2));
  const SobolSequence sequence(static_cast<int>(2 * d));
  std::vector<std::uint32_t> shift(2 * d);
  for (std::uint32_t& bits : shift) bits = uniform.draw_bits();
  Matrix points;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto x = sequence.point(static_cast<std::uint32_t>(i));
    std::vector<double> u(2 * d);
    for (std::size_t k = 0; k < 2 * d; ++k) {
      u[k] = (static_cast<double>(x[k] ^ shift[k]) + 0.5) * 0x1p-32;
    }
    const auto middle = u.begin() + static_cast<std::ptrdiff_t>(d);
    const std::vector<double> A(u.begin(), middle);
    const std::vector<double> B(middle, u.end());
    points.push_back(A);
    points.push_back(B);
    for (std::size_t k = 0; k < d; ++k) {
      points.push_back(A);
      points.back()[k] = B[k];
    }
  }
  return points;
}

Matrix sample(const Study& study) {
  Uniform uniform(study.design.seed);
  const auto samples = static_cast<std::size_t>(study.design.samples);
  const std::size_t factors = study.factors.size();
  switch (study.design.kind) {
    case DesignKind::latin_hypercube:
      return sample_hypercube(samples, factors, uniform);
    case DesignKind::sobol:
      return sample_sobol(study, uniform);
    default:
      return sample_freely(samples, factors, uniform);
  }
}

double calc_ratio(const std::array<double, 8>& above,
                  const std::array<double, 8>& below, double r) {
  double num = 0.0;
  double den = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    num = num * r + above.at(i);
    den = den * r + below.at(i);
  }
  return num / den;
}

}  // namespace

double find_normal_quantile(double u) {
  const double q = u - 0.5;
  if (std::abs(q) <= 0.425) {
    return q * calc_ratio({2.5090809287301226727e+3, 3.3430575583588128105e+4,
                           6.7265770927008700853e+4, 4.5921953931549871457e+4,
                           1.3731693765509461125e+4, 1.9715909503065514427e+3,
                           1.3314166789178437745e+2, 3.3871328727963666080e+0},
                          {5.2264952788528545610e+3, 2.8729085735721942674e+4,
                           3.9307895800092710610e+4, 2.1213794301586595867e+4,
                           5.3941960214247511077e+3, 6.8718700749205790830e+2,
                           4.2313330701600911252e+1, 1.0},
                          0.180625 - q * q);
  }
  const double r = std::sqrt(-std::log(q <= 0.0 ? u : 1.0 - u));
  const double x =
      r <= 5.0
          ? calc_ratio({7.74545014278341407640e-4, 2.27238449892691845833e-2,
                        2.41780725177450611770e-1, 1.27045825245236838258e+0,
                        3.64784832476320460504e+0, 5.76949722146069140550e+0,
                        4.63033784615654529590e+0, 1.42343711074968357734e+0},
                       {1.05075007164441684324e-9, 5.47593808499534494600e-4,
                        1.51986665636164571966e-2, 1.48103976427480074590e-1,
                        6.89767334985100004550e-1, 1.67638483018380384940e+0,
                        2.05319162663775882187e+0, 1.0},
                       r - 1.6)
          : calc_ratio({2.01033439929228813265e-7, 2.71155556874348757815e-5,
                        1.24266094738807843860e-3, 2.65321895265761230930e-2,
                        2.96560571828504891230e-1, 1.78482653991729133580e+0,
                        5.46378491116411436990e+0, 6.65790464350110377720e+0},
                       {2.04426310338993978564e-15, 1.42151175831644588870e-7,
                        1.84631831751005468180e-5, 7.86869131145613259100e-4,
                        1.48753612908506148525e-2, 1.36929880922735805310e-1,
                        5.99832206555887937690e-1, 1.0},
                       r - 5.0);
  return q < 0.0 ? -x : x;
}

std::string find_value(const Factor& factor, double u) {
  if (const auto* listed = std::get_if<Listed>(&factor.values)) {
    const std::size_t count = listed->values.size();
    const auto index = static_cast<std::size_t>(u * static_cast<double>(count));
    return listed->values[std::min(index, count - 1)];
  }
  if (const auto* spread = std::get_if<Spread>(&factor.values)) {
    return to_text(interpolate(*spread, u));
  }
  const Normal& normal = std::get<Normal>(factor.values);
  return to_text(normal.mean + normal.deviation * find_normal_quantile(u));
}

std::optional<double> find_number(const std::string& text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

Design make_design(const Study& study) {
  const DesignKind kind = study.design.kind;
  if (kind == DesignKind::grid || kind == DesignKind::list) {
    std::vector<std::vector<std::string>> values;
    for (const Factor& factor : study.factors) {
      values.push_back(list_values(factor, kind));
    }
    return kind == DesignKind::grid ? make_grid(values)
                                    : make_list(study, values);
  }
  Design design;
  for (const auto& point : sample(study)) {
    std::vector<std::string> values;
    for (std::size_t f = 0; f < point.size(); ++f) {
      values.push_back(find_value(study.factors[f], point[f]));
    }
    design.push_back(std::move(values));
  }
  return design;
}

scene::Overrides to_overrides(const Study& study,
                              const std::vector<std::string>& values) {
  scene::Overrides overrides;
  overrides.settings = study.settings;
  for (std::size_t f = 0; f < study.factors.size(); ++f) {
    for (const std::string& path : study.factors[f].paths) {
      if (path == "fidelity") {
        overrides.fidelity = dynamics::parse_fidelity(values[f]);
      } else {
        overrides.settings.push_back({path, values[f]});
      }
    }
  }
  return overrides;
}

}  // namespace limber::study
