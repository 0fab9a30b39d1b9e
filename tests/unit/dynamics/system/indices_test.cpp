// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/indices.hpp"

#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/pose.hpp"
#include "limber/dynamics/system/system_builder.hpp"

namespace limber::dynamics::indices_test {
namespace {

// What must not compile, as the compiler sees it.
template <typename To, typename From>
constexpr bool is_taken_for = std::is_convertible_v<From, To>;

static_assert(is_taken_for<BodyIndex, BodyIndex>);
static_assert(!is_taken_for<BodyIndex, AttachmentIndex>);
static_assert(!is_taken_for<AttachmentIndex, BodyIndex>);
static_assert(!is_taken_for<CouplerIndex, AttachmentIndex>);
static_assert(!is_taken_for<TransmissionIndex, CouplerIndex>);
static_assert(!is_taken_for<LoadIndex, AttachmentIndex>);
static_assert(!is_taken_for<BodyIndex, int>);
static_assert(!is_taken_for<BodyIndex, double>);

// Not even where a conversion is asked for.
static_assert(!std::is_constructible_v<BodyIndex, AttachmentIndex>);
static_assert(!std::is_assignable_v<BodyIndex&, AttachmentIndex>);
static_assert(!std::is_assignable_v<BodyIndex&, int>);
static_assert(!std::is_constructible_v<BodyIndex, double>);

template <typename A, typename B>
constexpr bool is_comparable = requires(A a, B b) {
  a == b;
};
template <typename A, typename B>
constexpr bool is_ordered = requires(A a, B b) {
  a < b;
};
static_assert(is_comparable<BodyIndex, BodyIndex>);
static_assert(is_comparable<BodyIndex, int>);
static_assert(!is_comparable<BodyIndex, AttachmentIndex>);
static_assert(is_ordered<BodyIndex, BodyIndex>);
static_assert(!is_ordered<CouplerIndex, TransmissionIndex>);

template <typename... Arguments>
constexpr bool can_attach = requires(SystemBuilder builder,
                                     Arguments... arguments) {
  builder.attach_frame("f", arguments..., Pose{});
};
static_assert(can_attach<BodyIndex>);
static_assert(!can_attach<AttachmentIndex>);
static_assert(!can_attach<int>);

template <typename F, typename M>
constexpr bool can_couple = requires(SystemBuilder builder,
                                     joints::CouplerLaw law, F f, M m) {
  builder.add_coupler("c", law, f, m);
};
static_assert(can_couple<AttachmentIndex, AttachmentIndex>);
static_assert(!can_couple<BodyIndex, AttachmentIndex>);
static_assert(!can_couple<AttachmentIndex, CouplerIndex>);

static_assert(std::is_same_v<decltype(kWorld), const BodyIndex>);
static_assert(sizeof(BodyIndex) == sizeof(int));
static_assert(std::is_trivially_copyable_v<BodyIndex>);

TEST(Indices, ReadAsNumbersAndCountUp) {
  const std::vector<double> values = {1.0, 2.0, 4.0};
  double sum = 0.0;
  for (BodyIndex b(0); b < std::ssize(values); ++b) {
    sum += values[static_cast<std::size_t>(b)];
  }
  EXPECT_DOUBLE_EQ(sum, 7.0);
  EXPECT_EQ(BodyIndex(values.size()), 3);
  EXPECT_EQ(CouplerIndex(2), CouplerIndex(2));
  EXPECT_NE(CouplerIndex(2), CouplerIndex(3));
}

TEST(Indices, WithoutAValueAreRefused) {
  SystemBuilder builder;
  builder.add_rigid_body("b", {1.0, Matrix3::Identity()});
  EXPECT_THROW(builder.attach_frame("f", {}, {}), ContractError);
  EXPECT_THROW(builder.add_coupler("c", joints::Bushing({}), {}, {}),
               ContractError);
}

}  // namespace
}  // namespace limber::dynamics::indices_test
