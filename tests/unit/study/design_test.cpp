// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/design.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "limber/common/errors.hpp"
#include "limber/study/sobol_sequence.hpp"
#include "limber/study/study_reader.hpp"

namespace limber::study::design_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Study read(const std::string& design, const std::string& factors) {
  return read_study("scenario = 's.toml'\n[design]\n" + design + "\n" +
                        factors +
                        "[[response]]\nname = 'y'\nsummary = 'steps'\n",
                    "study.toml");
}

std::string factor(const std::string& name, const std::string& values) {
  return "[[factor]]\nname = '" + name + "'\npath = 'a." + name + "'\n" +
         values + "\n";
}

double to_double(const std::string& text) { return std::stod(text); }

TEST(SobolSequence, HasThePublishedFirstPoints) {
  // Bratley, Fox (1988), table of the first dimensions.
  const SobolSequence sequence(3);
  const double half = 0x1p-32;
  const std::vector<std::vector<double>> expected = {{0, 0, 0},
                                                     {0.5, 0.5, 0.5},
                                                     {0.75, 0.25, 0.25},
                                                     {0.25, 0.75, 0.75},
                                                     {0.375, 0.375, 0.625}};
  for (std::uint32_t i = 0; i < expected.size(); ++i) {
    const auto point = sequence.point(i);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_EQ(point[d] * half, expected[i][d]) << i << " " << d;
    }
  }
}

TEST(SobolSequence, FillsEveryIntervalOfEveryDimensionOnce) {
  const SobolSequence sequence(SobolSequence::kMostDimensions);
  for (std::uint32_t bits = 1; bits <= 10; ++bits) {
    const std::uint32_t count = std::uint32_t{1} << bits;
    std::vector<std::set<std::uint32_t>> seen(SobolSequence::kMostDimensions);
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto point = sequence.point(i);
      for (std::size_t d = 0; d < point.size(); ++d) {
        seen[d].insert(point[d] >> (32 - bits));
      }
    }
    for (const auto& one : seen) EXPECT_EQ(one.size(), count);
  }
}

TEST(SobolSequence, HasNoTwoEqualDimensions) {
  const SobolSequence sequence(SobolSequence::kMostDimensions);
  std::vector<std::vector<std::uint32_t>> columns(
      SobolSequence::kMostDimensions);
  for (std::uint32_t i = 0; i < 512; ++i) {
    const auto point = sequence.point(i);
    for (std::size_t d = 0; d < point.size(); ++d) {
      columns[d].push_back(point[d]);
    }
  }
  std::sort(columns.begin(), columns.end());
  EXPECT_EQ(std::adjacent_find(columns.begin(), columns.end()), columns.end());
}

TEST(NormalQuantile, InvertsTheErrorFunction) {
  for (const double u : {1e-300, 1e-20, 1e-6, 0.01, 0.07, 0.3, 0.5, 0.77}) {
    const double x = find_normal_quantile(u);
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)), u, 1e-12 * u) << u;
  }
  EXPECT_NEAR(find_normal_quantile(0.975), 1.959963984540054, 1e-15);
  EXPECT_EQ(find_normal_quantile(0.25), -find_normal_quantile(0.75));
}

TEST(Design, GridHasAllCombinations) {
  const Design design =
      make_design(read("kind = 'grid'", factor("f", "values = [1, 2.5]") +
                                            factor("g",
                                                   "range = [0, 1]\ncount "
                                                   "= 3")));
  EXPECT_THAT(design,
              ElementsAre(ElementsAre("1", "0"), ElementsAre("1", "0.5"),
                          ElementsAre("1", "1"), ElementsAre("2.5", "0"),
                          ElementsAre("2.5", "0.5"), ElementsAre("2.5", "1")));
}

TEST(Design, LogRangeHasEvenRatios) {
  const Design design = make_design(
      read("kind = 'list'", factor("f", "log_range = [1, 100]\ncount = 3")));
  EXPECT_EQ(to_double(design[1][0]), 10.0);
  EXPECT_EQ(to_double(design[2][0]), 100.0);
}

TEST(Design, HypercubeMeetsEveryIntervalOfEveryFactorOnce) {
  const std::size_t samples = 50;
  const Design design = make_design(read(
      "kind = 'latin-hypercube'\nsamples = 50\nseed = 3",
      factor("f", "uniform = [0, 50]") + factor("g", "uniform = [0, 50]")));
  for (std::size_t f = 0; f < 2; ++f) {
    std::set<int> seen;
    for (const auto& row : design) {
      seen.insert(static_cast<int>(to_double(row[f])));
    }
    EXPECT_EQ(seen.size(), samples);
  }
  EXPECT_NE(design[0][0], design[0][1]);
}

TEST(Design, DependsOnTheSeedAlone) {
  for (const char* kind : {"latin-hypercube", "sobol", "monte-carlo"}) {
    const auto make = [&](int seed) {
      return make_design(read(
          "kind = '" + std::string(kind) +
              "'\nsamples = 8\nseed = " + std::to_string(seed),
          factor("f", "normal = [0, 1]") + factor("g", "choice = ['a', 'b']")));
    };
    EXPECT_EQ(make(4), make(4)) << kind;
    EXPECT_NE(make(4), make(5)) << kind;
  }
}

TEST(Design, SampledNormalFactorsHaveTheirMeanAndDeviation) {
  const Design design =
      make_design(read("kind = 'latin-hypercube'\nsamples = 2000",
                       factor("f", "normal = [3, 0.5]")));
  double mean = 0.0;
  double square = 0.0;
  for (const auto& row : design) {
    mean += to_double(row[0]) / 2000.0;
    square += std::pow(to_double(row[0]) - 3.0, 2) / 2000.0;
  }
  // Stratified, so the error is far below 1/sqrt(2000).
  EXPECT_NEAR(mean, 3.0, 1e-3);
  EXPECT_NEAR(std::sqrt(square), 0.5, 2e-3);
}

struct WrongStudy {
  const char* name;
  const char* design;
  std::string factors;
  const char* words;
};

class StudyIsRefused : public ::testing::TestWithParam<WrongStudy> {};

TEST_P(StudyIsRefused, WithTheReason) {
  try {
    (void)make_design(read(GetParam().design, GetParam().factors));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().words));
  }
}

INSTANTIATE_TEST_SUITE_P(
    , StudyIsRefused,
    ::testing::Values(
        WrongStudy{"NoFactor", "kind = 'grid'", "", "needs a [[factor]]"},
        WrongStudy{"NoValues", "kind = 'grid'", factor("f", ""), "give one"},
        WrongStudy{"TwoKinds", "kind = 'grid'",
                   factor("f", "values = [1]\nchoice = [2]"), "give one"},
        WrongStudy{"EmptyValues", "kind = 'grid'", factor("f", "values = []"),
                   "one value or more"},
        WrongStudy{"NoList", "kind = 'grid'", factor("f", "normal = [0, 1]"),
                   "needs a list of its values"},
        WrongStudy{"NoCount", "kind = 'list'", factor("f", "range = [0, 1]"),
                   "with 'count'"},
        WrongStudy{"Lengths", "kind = 'list'",
                   factor("f", "values = [1, 2]") + factor("g", "values = [1]"),
                   "as many of each"},
        WrongStudy{"NoSamples", "kind = 'sobol'",
                   factor("f", "uniform = [0, 1]"), "needs 'samples'"},
        WrongStudy{"SeedOfAGrid", "kind = 'grid'\nseed = 2",
                   factor("f", "values = [1]"), "sampled designs"},
        WrongStudy{"Reversed", "kind = 'monte-carlo'\nsamples = 2",
                   factor("f", "uniform = [1, 0]"), "not less"},
        WrongStudy{"NoLogarithm", "kind = 'monte-carlo'\nsamples = 2",
                   factor("f", "log_range = [-1, 1]"), "no logarithms"},
        WrongStudy{"NoDeviation", "kind = 'monte-carlo'\nsamples = 2",
                   factor("f", "normal = [1, 0]"), "deviation"},
        WrongStudy{"SameName", "kind = 'grid'", factor("Y", "values = [1]"),
                   "name is taken"},
        WrongStudy{"Digit", "kind = 'grid'", factor("1f", "values = [1]"),
                   "does not begin with a digit"},
        WrongStudy{"SamePath", "kind = 'grid'",
                   factor("f", "values = [1]") +
                       "[[factor]]\nname = 'g'\npath = 'a.f'\nvalues = [1]\n",
                   "has the path"},
        WrongStudy{"Version", "kind = 'grid'\n[x]", factor("f", "values = [1]"),
                   "unknown key 'x'"},
        WrongStudy{"TooMany", "kind = 'sobol'\nsamples = 9000000",
                   factor("f", "uniform = [0, 1]"), "more than 10000000"}),
    [](const auto& one) { return one.param.name; });

TEST(Study, OfAnotherVersionIsRefused) {
  try {
    (void)read_study(
        "version = 2\nscenario = 's'\n[design]\n[[factor]]\nname "
        "= 'f'\npath = 'p'\nvalues = [1]\n[[response]]\nname = "
        "'y'\nsummary = 'steps'\n",
        "study.toml");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("reads studies of version 1"));
  }
}

}  // namespace
}  // namespace limber::study::design_test
