// SPDX-License-Identifier: BSD-3-Clause
// LIMBER_SIMD: the same bits by any instructions.
#include <gmock/gmock.h>

#include "cli/shell.hpp"
#include "places.hpp"

namespace limber::test::instructions_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

bool has_avx2(const Workspace& place) {
  return run_shell(place, "grep -qw avx2 /proc/cpuinfo").status == 0;
}

// Levels with and without coupling, joints, a strike, a spinning start.
TEST(Instructions, GiveTheSameBits) {
  const Workspace place;
  if (!has_avx2(place)) GTEST_SKIP() << "this processor has no AVX2";
  const std::string run =
      "limber run '" LIMBER_SOURCE_DIR
      "/examples/struck_finger.toml' --set output.pictures=false --set "
      "time.duration=0.35 --out ";
  ASSERT_EQ(run_shell(place, "LIMBER_SIMD=baseline " + run + "a").status, 0);
  ASSERT_EQ(run_shell(place, "LIMBER_SIMD=avx2 " + run + "b").status, 0);
  const std::string probes = read_text(place.folder() / "a/probes.csv");
  EXPECT_GT(probes.size(), 1000u);
  EXPECT_EQ(probes, read_text(place.folder() / "b/probes.csv"));
  EXPECT_EQ(read_text(place.folder() / "a/energy.csv"),
            read_text(place.folder() / "b/energy.csv"));
}

TEST(Instructions, AreToldByTheVersion) {
  const Workspace place;
  EXPECT_THAT(run_shell(place, "LIMBER_SIMD=baseline limber --version").out,
              HasSubstr("LIMBER_SIMD          baseline x86-64"));
  if (!has_avx2(place)) return;
  EXPECT_THAT(run_shell(place, "LIMBER_SIMD= limber --version").out,
              HasSubstr("LIMBER_SIMD          AVX2"));
}

TEST(Instructions, ThatAreNotKnownEndARunBeforeItsFirstStep) {
  const Workspace place;
  const CommandResult result =
      run_shell(place, "LIMBER_SIMD=sse9 limber run '" LIMBER_SOURCE_DIR
                       "/examples/pendulum_chain.toml' --out a");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("LIMBER_SIMD"), HasSubstr("sse9"),
                                   HasSubstr("expected 'baseline'")));
}

}  // namespace
}  // namespace limber::test::instructions_test
