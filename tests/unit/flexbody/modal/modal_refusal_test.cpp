// SPDX-License-Identifier: BSD-3-Clause
// What a modal response refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "limber/common/errors.hpp"
#include "unit/flexbody/modal/modal_cases.hpp"

namespace limber::flexbody::test::modal_refusal_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string find_refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing refused";
}

class ModalResponseRefuses : public ::testing::Test {
 protected:
  [[nodiscard]] std::string refusal() const {
    return find_refusal(
        [&] { ModalResponse(lambda, damping, loads, initial); });
  }
  VectorX lambda = make_vector({1.0, 2.0});
  VectorX damping = make_vector({0.0, 0.1});
  ModalLoads loads{{{0.0, 1.0}, MatrixX::Ones(2, 2)},
                   {{.omega = 1.0,
                     .cosine = make_vector({1.0, 1.0}),
                     .sine = make_vector({1.0, 1.0})}}};
  ModalState initial;
};

TEST_F(ModalResponseRefuses, NothingWhenAllIsWell) {
  EXPECT_EQ(refusal(), "nothing refused");
}

TEST_F(ModalResponseRefuses, CoefficientsThatAreNegativeOrNotFinite) {
  lambda[1] = -1e-9;
  damping[0] = kNan;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("lambda of mode 1 is -1e-09 rad^2/s^2"));
  EXPECT_THAT(text, HasSubstr("damping of mode 0 is nan 1/s"));
}

TEST_F(ModalResponseRefuses, NoCoefficientForBeingSmall) {
  lambda[1] = 1e-6;
  damping[0] = 1e-6;
  EXPECT_EQ(refusal(), "nothing refused");
}

TEST_F(ModalResponseRefuses, AsManyDampingsAsAreNotEigenvalues) {
  damping = make_vector({0.1});
  EXPECT_THAT(refusal(), HasSubstr("2 eigenvalues but 1 damping"));
}

TEST_F(ModalResponseRefuses, InitialStatesOfOtherSizeOrNotFinite) {
  initial.eta = make_vector({1.0});
  initial.etadot = make_vector({1.0, kNan});
  initial.time = kNan;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("initial eta has 1 entries"));
  EXPECT_THAT(text, HasSubstr("initial etadot is not finite"));
  EXPECT_THAT(text, HasSubstr("initial time is not finite"));
}

TEST_F(ModalResponseRefuses, StepTimesThatDoNotIncrease) {
  loads.steps.times[1] = 0.0;
  EXPECT_THAT(refusal(), HasSubstr("time 1 is 0 s after 0 s"));
}

TEST_F(ModalResponseRefuses, StepsThatAreNotFinite) {
  loads.steps.times[0] = kNan;
  loads.steps.values(1, 1) = kNan;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("step load: time 0 is not finite"));
  EXPECT_THAT(text, HasSubstr("a value at time 1 is not finite"));
}

TEST_F(ModalResponseRefuses, StepsOfOtherSize) {
  loads.steps.values = MatrixX::Ones(3, 2);
  EXPECT_THAT(refusal(), HasSubstr("values are 3 x 2"));
  loads.steps.values = MatrixX::Ones(2, 3);
  EXPECT_THAT(refusal(), HasSubstr("values are 2 x 3"));
}

TEST_F(ModalResponseRefuses, SinusoidsWithoutAFrequencyOrATime) {
  loads.sinusoids[0].omega = -1.0;
  loads.sinusoids[0].until = 0.0;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("sinusoid 0: frequency is -1 rad/s"));
  EXPECT_THAT(text, HasSubstr("from 0 s until 0 s"));
}

TEST_F(ModalResponseRefuses, SinusoidsOfOtherSizeOrNotFinite) {
  loads.sinusoids[0].sine = make_vector({1.0});
  loads.sinusoids[0].cosine[1] = kNan;
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("2 cosine and 1 sine amplitudes"));
  EXPECT_THAT(text, HasSubstr("an amplitude is not finite"));
}

TEST_F(ModalResponseRefuses, TimesBeforeTheStartOrNotFinite) {
  const ModalResponse response(lambda, damping, loads, initial);
  for (const double t : {-0.1, kNan}) {
    EXPECT_THROW((void)response.evaluate({0.0, t}), InputError);
    EXPECT_THROW((void)response.evaluate_energies({t}), InputError);
    EXPECT_THROW((void)response.evaluate_step_work({t}), InputError);
  }
  EXPECT_THAT(find_refusal([&] {
                (void)response.evaluate({0.0, -0.5});
              }),
              HasSubstr("time 1 is -0.5 s; expected a time from 0 s on"));
}

}  // namespace
}  // namespace limber::flexbody::test::modal_refusal_test
