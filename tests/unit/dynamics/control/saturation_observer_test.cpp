// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/control/saturation_observer.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "limber/dynamics/control/pid_controller.hpp"

namespace limber::dynamics::saturation_observer_test {
namespace {

using ::testing::HasSubstr;

constexpr double kPeriod = 0.01;

/// A controller within [-2, 5] whose output is given.
class Saturation : public ::testing::Test {
 protected:
  void add(const std::string& name, PidParameters parameters = {}) {
    parameters.proportional = 1.0;
    parameters.period = kPeriod;
    parameters.lower = -2.0;
    parameters.upper = 5.0;
    model_.inputs.push_back({name});
    state_.inputs.emplace_back();
    state_.controllers.emplace_back();
    ControllerModel controller;
    controller.name = name;
    controller.period = kPeriod;
    controller.writes = {static_cast<int>(model_.controllers.size())};
    controller.law = std::make_shared<const PidController>(parameters);
    model_.controllers.push_back(controller);
  }

  /// @returns the number of samples until there is a warning; 0: none
  template <typename Value>
  int feed(SaturationObserver& observer, int count, const Value& value,
           std::size_t controller = 0) {
    for (int k = 0; k < count; ++k) {
      state_.t = kPeriod * k;
      ++state_.controllers[controller].next;
      state_.inputs[controller].value = value(k);
      observer.include(state_, step_, warnings_);
      observer.include(state_, step_,
                       warnings_);  // a later step without a sample
      if (!warnings_.empty()) return k + 1;
    }
    return 0;
  }

  SystemModel model_;
  SystemState state_;
  std::vector<std::string> warnings_;
  double step_ = 0.1 * kPeriod;
};

double alternate(int k, int half) { return k / half % 2 == 0 ? 5.0 : -2.0; }

TEST_F(Saturation, ThatAlternatesIsFoundAfterTwentySamplesAndEightChanges) {
  add("a");
  SaturationObserver fast(model_);
  EXPECT_EQ(feed(fast, 100, [](int k) { return alternate(k, 1); }), 21);
  EXPECT_THAT(warnings_[0], HasSubstr("controller 'a'"));
  EXPECT_THAT(warnings_[0], HasSubstr("period 0.01 s"));
  EXPECT_THAT(warnings_[0], HasSubstr("its limits, -2 and 5, at about 50 Hz"));
  EXPECT_THAT(warnings_[0], HasSubstr("a period of 0.001 s"));
  warnings_.clear();
  SaturationObserver slower(model_);
  EXPECT_EQ(feed(slower, 100, [](int k) { return alternate(k, 5); }), 41);
  EXPECT_THAT(warnings_[0], HasSubstr("at about 10 Hz"));
}

// As of a pole at -1.13: in 20 samples 11.5 times as far.
TEST_F(Saturation, IsFoundBeforeTheLimitsWhereEachSampleGoesFurther) {
  add("a");
  SaturationObserver observer(model_);
  const int found =
      feed(observer, 500, [](int k) { return 1e-9 * std::pow(-1.13, k); });
  // 2.13 x 1e-9 x 1.13^(k - 1) reaches 0.07, a hundredth of the range.
  EXPECT_EQ(found, 2 + static_cast<int>(std::ceil(std::log(0.07 / 2.13e-9) /
                                                  std::log(1.13))));
  EXPECT_THAT(warnings_[0], HasSubstr("from sample to sample, at 50 Hz"));
}

TEST_F(Saturation, ThatRingsIsNotFound) {
  add("a");
  SaturationObserver observer(model_);
  EXPECT_EQ(feed(observer, 500, [](int k) { return std::pow(-0.95, k % 100); }),
            0);
  EXPECT_EQ(feed(observer, 500, [](int k) { return k % 2 ? 1.0 : -1.0; }), 0);
}

TEST_F(Saturation, WithFewStepsToAPeriodAsksForShorterOnesFirst) {
  add("a");
  SaturationObserver fine(model_);
  ASSERT_GT(feed(fine, 100, [](int k) { return alternate(k, 1); }), 0);
  EXPECT_THAT(warnings_[0], HasSubstr("; try a period of 0.001 s or"));
  warnings_.clear();
  step_ = 0.5 * kPeriod;
  SaturationObserver coarse(model_);
  ASSERT_GT(feed(coarse, 100, [](int k) { return alternate(k, 1); }), 0);
  EXPECT_THAT(warnings_[0],
              HasSubstr("; try steps of 0.001 s, a period of 0.001 s or"));
}

TEST_F(Saturation, OfACascadeNamesTheControllerThatFollows) {
  add("outer");
  add("inner", {.reference = {joints::InputSignal{0}}});
  EXPECT_EQ(name_followers(model_, 0), "controller 'inner'");
  EXPECT_EQ(name_followers(model_, 1), "no follower");
}

TEST_F(Saturation, ThatContinuesIsReportedOnce) {
  add("a");
  SaturationObserver observer(model_);
  ASSERT_GT(feed(observer, 100, [](int k) { return alternate(k, 1); }), 0);
  warnings_.clear();
  EXPECT_EQ(feed(observer, 100, [](int k) { return alternate(k, 1); }), 0);
}

TEST_F(Saturation, IsFoundWhereSomeSamplesAreWithinTheLimits) {
  add("a");
  SaturationObserver observer(model_);
  EXPECT_GT(feed(observer, 100,
                 [](int k) { return k % 3 == 1 ? 0.5 : alternate(k, 3); }),
            20);
}

TEST_F(Saturation, AtOneLimitOrBetweenTheLimitsIsNotFound) {
  add("a");
  SaturationObserver observer(model_);
  EXPECT_EQ(feed(observer, 1000, [](int) { return 5.0; }), 0);
  EXPECT_EQ(feed(observer, 1000, [](int k) { return k % 2 ? 4.9 : -1.9; }), 0);
  EXPECT_EQ(feed(observer, 1000, [](int k) { return k % 2 ? 5.0 : -1.9; }), 0);
}

// A servo that brakes, overshoots and returns; a slow reference.
TEST_F(Saturation, WithFewOrSlowChangesIsNotFound) {
  add("a");
  SaturationObserver observer(model_);
  EXPECT_EQ(feed(observer, 35, [](int k) { return alternate(k, 5); }), 0);
  EXPECT_EQ(feed(observer, 500, [](int) { return 1.0; }), 0);
  EXPECT_EQ(feed(observer, 2000, [](int k) { return alternate(k, 11); }), 0);
}

TEST_F(Saturation, WithADelayOrAFilterAlternatesMoreSlowly) {
  add("delayed", {.delay = 2});
  add("filtered", {.filter_time = 2.0 * kPeriod});
  SaturationObserver observer(model_);
  EXPECT_GT(feed(observer, 2000, [](int k) { return alternate(k, 30); }), 0);
  warnings_.clear();
  EXPECT_GT(feed(
                observer, 2000, [](int k) { return alternate(k, 30); }, 1),
            0);
  EXPECT_THAT(warnings_[0], HasSubstr("'filtered'"));
  SaturationObserver other(model_);
  warnings_.clear();
  EXPECT_EQ(feed(other, 2000, [](int k) { return alternate(k, 31); }), 0);
}

TEST_F(Saturation, IsFoundAtTheSameSampleAfterACheckpoint) {
  add("a");
  SaturationObserver before(model_);
  EXPECT_EQ(feed(before, 10, [](int k) { return alternate(k, 1); }), 0);
  Archive saved;
  before.exchange_memory(saved);
  SaturationObserver after(model_);
  Archive restored(saved.numbers());
  after.exchange_memory(restored);
  EXPECT_EQ(feed(after, 100, [](int k) { return alternate(k, 1); }), 11);
}

}  // namespace
}  // namespace limber::dynamics::saturation_observer_test
