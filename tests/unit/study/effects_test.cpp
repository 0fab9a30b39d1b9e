// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/effects.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "limber/study/correlation.hpp"
#include "limber/study/study_reader.hpp"

namespace limber::study::effects_test {
namespace {

using ::testing::HasSubstr;
using Values = std::vector<double>;
using Function = std::function<double(const Values&)>;

struct Done {
  Study study;
  std::vector<StudyRow> rows;
};

/// Makes every run of a study of a function of its factors a, b, ..., whose
/// values are `values`.
Done make_study(const std::string& design, std::size_t factors,
                const std::string& values, const Function& function) {
  std::string text = "scenario = 's.toml'\n[design]\n" + design + "\n";
  for (std::size_t f = 0; f < factors; ++f) {
    const std::string name(1, static_cast<char>('a' + f));
    text += "[[factor]]\nname = '" + name + "'\npath = 'p." + name + "'\n" +
            values + "\n";
  }
  text += "[[response]]\nname = 'y'\nsummary = 'steps'\n";
  Done done{read_study(text, "study.toml"), {}};
  const Design all = make_design(done.study);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Values x;
    for (const std::string& value : all[i]) x.push_back(*find_number(value));
    done.rows.push_back({i, all[i], {function(x)}, "", ""});
  }
  return done;
}

std::string sobol(int samples, int seed) {
  return "kind = 'sobol'\nsamples = " + std::to_string(samples) +
         "\nseed = " + std::to_string(seed);
}

Effects find(const Done& done) {
  return find_effects(done.study, done.rows.size(), done.rows);
}

const char* const kCircle = "uniform = [-3.141592653589793, 3.141592653589793]";

/// Ishigami, Homma (1990): y = sin a + 7 sin^2 b + 0.1 c^4 sin a.
double calc_ishigami(const Values& x) {
  return std::sin(x[0]) + 7.0 * std::sin(x[1]) * std::sin(x[1]) +
         0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}
constexpr double kMain[] = {0.31390519, 0.44241114, 0.0};
constexpr double kTotal[] = {0.55758886, 0.44241114, 0.24368366};

TEST(Effects, OfASobolDesignAreThoseInClosedFormOfIshigamisFunction) {
  const Effects effects =
      find(make_study(sobol(4096, 1), 3, kCircle, calc_ishigami));
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_NEAR(effects[f][0]->main, kMain[f], 0.01) << f;
    EXPECT_NEAR(effects[f][0]->total, kTotal[f], 0.01) << f;
    EXPECT_FALSE(effects[f][0]->samples_needed) << f;
    EXPECT_LT(effects[f][0]->main_interval->half_width(), 0.05) << f;
  }
}

// Fractions of the variance do not know of a constant; without its mean the
// response is the same to roundoff, 1e-16 of 1e6.
TEST(Effects, AreTheSameOfAResponseFarFromZero) {
  const Effects near =
      find(make_study(sobol(128, 3), 3, kCircle, calc_ishigami));
  const Effects far =
      find(make_study(sobol(128, 3), 3, kCircle,
                      [](const Values& x) { return 1e6 + calc_ishigami(x); }));
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_NEAR(near[f][0]->main, far[f][0]->main, 1e-8) << f;
    EXPECT_NEAR(near[f][0]->total, far[f][0]->total, 1e-8) << f;
    EXPECT_NEAR(near[f][0]->main_interval->low, far[f][0]->main_interval->low,
                1e-8);
  }
}

// 60 studies by 6 indices. Sobol's points are closer than independent ones, so
// that the intervals may only be too wide.
TEST(Effects, LieInTheirIntervals) {
  int inside = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const Effects effects =
        find(make_study(sobol(64, seed), 3, kCircle, calc_ishigami));
    for (std::size_t f = 0; f < 3; ++f) {
      const auto holds = [](const Interval& interval, double value) {
        return interval.low <= value && value <= interval.high;
      };
      inside += holds(*effects[f][0]->main_interval, kMain[f]) ? 1 : 0;
      inside += holds(*effects[f][0]->total_interval, kTotal[f]) ? 1 : 0;
    }
  }
  EXPECT_GE(inside / 360.0, 0.9);
}

TEST(Effects, AreNotToldOfTooFewSamples) {
  for (const int samples : {1, 2, 12, 31}) {
    const Done done = make_study(sobol(samples, 7), 3, kCircle, calc_ishigami);
    const Effects effects = find(done);
    for (std::size_t f = 0; f < 3; ++f) {
      if (!effects[f][0]) continue;
      EXPECT_THAT(describe_doubt(done.study, *effects[f][0]),
                  HasSubstr("not significant with " + std::to_string(samples) +
                            " samples"))
          << f;
      EXPECT_GE(*effects[f][0]->samples_needed, 32U);
    }
  }
}

TEST(Effects, OfResponsesThatLackOrDoNotVaryAreAbsentWithTheReason) {
  Done done =
      make_study(sobol(64, 1), 2, kCircle, [](const Values&) { return 0.1; });
  EXPECT_FALSE(find(done)[0][0]);
  EXPECT_EQ(find_missing_effects(done.study, done.rows.size(), done.rows, 0),
            "it does not vary");
  done = make_study(sobol(64, 1), 2, kCircle,
                    [](const Values& x) { return x[0]; });
  done.rows[5].responses[0].reset();
  EXPECT_FALSE(find(done)[0][0]);
  EXPECT_EQ(find_missing_effects(done.study, done.rows.size(), done.rows, 0),
            "1 of 256 runs have no value");
}

TEST(Effects, OfAGridAreSharesOfTheVariance) {
  Done done =
      make_study("kind = 'grid'", 2, "values = [-1, 1]", [](const Values& x) {
        return 3.0 * x[0] + 1.0 * x[1] + 2.0 * x[0] * x[1];
      });
  // Variances 9 of a, 1 of b, 4 of both together.
  const Effects effects = find(done);
  EXPECT_NEAR(effects[0][0]->main, 9.0 / 14.0, 1e-14);
  EXPECT_NEAR(effects[0][0]->total, 13.0 / 14.0, 1e-14);
  EXPECT_NEAR(effects[1][0]->main, 1.0 / 14.0, 1e-14);
  EXPECT_NEAR(effects[1][0]->total, 5.0 / 14.0, 1e-14);
  EXPECT_FALSE(effects[0][0]->main_interval);
  done.rows.pop_back();
  EXPECT_FALSE(find_effects(done.study, 4, done.rows)[0][0].has_value());
}

// y = a + b of normal factors: r = 1 / sqrt 2; of ranks 6 / pi asin(r / 2), as
// (Kruskal, 1958) of two normal quantities.
TEST(Correlations, OfNormalQuantitiesHaveTheirClosedForms) {
  const double r = std::sqrt(0.5);
  const double rank = 6.0 / M_PI * std::asin(r / 2.0);
  int inside = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Done done = make_study(
        "kind = 'monte-carlo'\nsamples = 50\nseed = " + std::to_string(seed), 2,
        "normal = [3, 2]", [](const Values& x) { return x[0] + x[1]; });
    const auto found = find_correlations(done.study, done.rows);
    for (const auto& one : found) {
      const Interval& a = one[0]->linear_interval;
      const Interval& b = one[0]->rank_interval;
      inside += a.low <= r && r <= a.high ? 1 : 0;
      inside += b.low <= rank && rank <= b.high ? 1 : 0;
    }
  }
  EXPECT_NEAR(inside / 800.0, 0.95, 0.025);  // deviation of a fraction: 0.8 %
}

TEST(Correlations, OfRanksAreOneForAnyMonotonicLaw) {
  const auto correlate = [](const Function& function) {
    const Done done = make_study("kind = 'latin-hypercube'\nsamples = 200", 1,
                                 "uniform = [-3, 3]", function);
    return *find_correlations(done.study, done.rows)[0][0];
  };
  const auto rising = correlate([](const Values& x) { return std::exp(x[0]); });
  EXPECT_DOUBLE_EQ(rising.rank, 1.0);
  EXPECT_LT(rising.linear, 0.9);
  EXPECT_TRUE(rising.is_significant());
  EXPECT_DOUBLE_EQ(
      correlate([](const Values& x) { return -x[0] * x[0] * x[0]; }).rank,
      -1.0);
  const auto even = correlate([](const Values& x) { return x[0] * x[0]; });
  EXPECT_FALSE(even.is_significant());
}

// Ranks 0, 1.5, 1.5, 3 and 0.5, 0.5, 2, 3: covariance 3.75, variances 4.5 each.
TEST(Correlations, OfEqualValuesHaveTheirMeanRank) {
  Done done = make_study("kind = 'monte-carlo'\nsamples = 4", 1,
                         "uniform = [0, 1]", [](const Values&) { return 0.0; });
  const char* const x[] = {"1", "2", "2", "5"};
  const double y[] = {4.0, 4.0, 6.0, 9.0};
  for (std::size_t i = 0; i < 4; ++i) {
    done.rows[i].factors[0] = x[i];
    done.rows[i].responses[0] = y[i];
  }
  EXPECT_NEAR(find_correlations(done.study, done.rows)[0][0]->rank, 3.75 / 4.5,
              1e-14);
  done.rows[3].factors[0] = "rigid";
  EXPECT_FALSE(find_correlations(done.study, done.rows)[0][0]);
}

}  // namespace
}  // namespace limber::study::effects_test
