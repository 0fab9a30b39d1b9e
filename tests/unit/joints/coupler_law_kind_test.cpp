// SPDX-License-Identifier: BSD-3-Clause
// A law that forgets one of its answers does not compile. Each of the laws
// below is whole except for one, and so is no law.
#include "limber/joints/coupler_law_kind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/joints/coupler_law.hpp"

namespace limber::joints::coupler_law_kind_test {
namespace {

struct Nothing {
  double nothing = 0.0;
};

[[maybe_unused]] constexpr auto fields_of(const Nothing*) {
  return list_fields("nothing", "nothing");
}

struct Nameless {
  double nothing = 0.0;
};

class WholeLaw : public WithoutSwitches,
                 public WithoutCoordinates,
                 public WithoutCommands,
                 public WithoutConstraint,
                 public WithoutReadings {
 public:
  [[nodiscard]] static Nothing parameters() { return {}; }
  [[nodiscard]] static CouplerResponse evaluate(const RelativeMotion& /*at*/,
                                                const CouplerMemory& /*memory*/,
                                                const EvaluationTime& /*now*/) {
    return {};
  }
  [[nodiscard]] static CouplerResponse evaluate_over_step(
      const MotionStep& /*motion*/, const CouplerMemory& /*memory*/,
      const StepTimes& /*times*/) {
    return {};
  }
  [[nodiscard]] static RequiredSides find_required_rotations() { return {}; }
};
static_assert(CouplerLawKind<WholeLaw>);

// A name in here hides that of the whole law.
#define LIMBER_LAW_WITHOUT(name)                  \
  class CouplerWithout_##name : public WholeLaw { \
    void name() const {}                          \
  };                                              \
  static_assert(!CouplerLawKind<CouplerWithout_##name>)

LIMBER_LAW_WITHOUT(evaluate);
LIMBER_LAW_WITHOUT(evaluate_over_step);
LIMBER_LAW_WITHOUT(find_required_rotations);
LIMBER_LAW_WITHOUT(switch_count);
LIMBER_LAW_WITHOUT(find_switch);
LIMBER_LAW_WITHOUT(find_event);
LIMBER_LAW_WITHOUT(has_triggers);
LIMBER_LAW_WITHOUT(update);
LIMBER_LAW_WITHOUT(coordinates);
LIMBER_LAW_WITHOUT(elements);
LIMBER_LAW_WITHOUT(break_times);
LIMBER_LAW_WITHOUT(find_target_velocity);
LIMBER_LAW_WITHOUT(find_constraint_stiffness);
LIMBER_LAW_WITHOUT(find_deflection);
LIMBER_LAW_WITHOUT(reading_kinds);
LIMBER_LAW_WITHOUT(read);
LIMBER_LAW_WITHOUT(parameters);
#undef LIMBER_LAW_WITHOUT

class UndescribedLaw : public WholeLaw {
 public:
  [[nodiscard]] static Nameless parameters() { return {}; }
};
static_assert(!CouplerLawKind<UndescribedLaw>);

// Bases and answers of the law along a coordinate.
class WholeScalarLaw : public WithoutScalarSwitches,
                       public WithoutCommand,
                       public WithoutBounds {
 public:
  [[nodiscard]] static Nothing parameters() { return {}; }
  [[nodiscard]] static ScalarResponse evaluate(const ScalarMotion& /*motion*/,
                                               const EvaluationTime& /*now*/,
                                               const SwitchModes& /*modes*/) {
    return {};
  }
  [[nodiscard]] static ScalarResponse evaluate_over_step(
      const CoordinateStep& /*coordinate*/, const StepTimes& /*times*/,
      const SwitchModes& /*modes*/) {
    return {};
  }
};
static_assert(ScalarLawKind<WholeScalarLaw>);

#define LIMBER_LAW_WITHOUT(name)                       \
  class ScalarWithout_##name : public WholeScalarLaw { \
    void name() const {}                               \
  };                                                   \
  static_assert(!ScalarLawKind<ScalarWithout_##name>)

LIMBER_LAW_WITHOUT(evaluate);
LIMBER_LAW_WITHOUT(evaluate_over_step);
LIMBER_LAW_WITHOUT(switch_count);
LIMBER_LAW_WITHOUT(find_switch);
LIMBER_LAW_WITHOUT(find_event);
LIMBER_LAW_WITHOUT(break_times);
LIMBER_LAW_WITHOUT(find_target_rate);
LIMBER_LAW_WITHOUT(max_effort);
LIMBER_LAW_WITHOUT(find_load);
LIMBER_LAW_WITHOUT(find_beyond_bound);
LIMBER_LAW_WITHOUT(parameters);
#undef LIMBER_LAW_WITHOUT

class UndescribedScalarLaw : public WholeScalarLaw {
 public:
  [[nodiscard]] static Nameless parameters() { return {}; }
};
static_assert(!ScalarLawKind<UndescribedScalarLaw>);

// A law of one kind is none of the other.
static_assert(!CouplerLawKind<ScalarSpring> && !ScalarLawKind<Bushing>);

TEST(LawKinds, WhatALawDoesNotHaveIsEmpty) {
  const WholeLaw law;
  EXPECT_EQ(law.switch_count(), 0);
  EXPECT_EQ(law.find_event(0, true, {}), std::nullopt);
  EXPECT_FALSE(law.has_triggers());
  EXPECT_TRUE(law.coordinates().empty());
  EXPECT_TRUE(law.elements().empty());
  EXPECT_TRUE(law.break_times().empty());
  EXPECT_EQ(law.find_target_velocity({}, {}, {}), Vector6::Zero());
  EXPECT_EQ(law.find_constraint_stiffness(), std::nullopt);
  EXPECT_TRUE(law.reading_kinds().empty());
  const WholeScalarLaw scalar;
  EXPECT_EQ(scalar.switch_count(), 0);
  EXPECT_TRUE(scalar.break_times().empty());
  EXPECT_EQ(scalar.find_target_rate({}), 0.0);
  EXPECT_TRUE(std::isinf(scalar.max_effort()));
  EXPECT_EQ(scalar.find_beyond_bound({}), std::nullopt);
}

TEST(LawKinds, ToAskForItIsACallersDefect) {
  EXPECT_THROW(static_cast<void>(WholeLaw::read(0, {}, {}, {})), ContractError);
  EXPECT_THROW(static_cast<void>(WholeScalarLaw::find_event(true)),
               ContractError);
}

}  // namespace
}  // namespace limber::joints::coupler_law_kind_test
