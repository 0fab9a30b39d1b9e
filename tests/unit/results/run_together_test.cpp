// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "limber/results/gnuplot.hpp"
#include "png_pixels.hpp"
#include "temporary_folder.hpp"

namespace limber::results::run_together_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ChartsOfOneProcess : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
      GTEST_SKIP() << "gnuplot is not installed";
    }
  }
  [[nodiscard]] GnuplotScript write(const std::string& name,
                                    const std::string& plot) const {
    GnuplotScript script(folder_.path() / name, 600, 400);
    script.add(plot);
    return script;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    return test::read_bytes(folder_.path() / name);
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(ChartsOfOneProcess, AreThoseOfTheirOwn) {
  const std::string plain = "plot sin(x)";
  ASSERT_EQ(write("alone.png", plain).run(), "");
  EXPECT_EQ(
      run_together(
          {write("first.png",
                 "set xrange [0:1]; set multiplot layout 2,1; set key off\n"
                 "$d << EOD\n1 2\n2 3\nEOD\nplot $d\nplot x\n"
                 "unset multiplot"),
           write("second.png", plain), write("third.png", plain)}),
      "");
  EXPECT_GT(read("first.png").size(), 1000u);
  EXPECT_EQ(read("second.png"), read("alone.png"));
  EXPECT_EQ(read("third.png"), read("alone.png"));
}

TEST_F(ChartsOfOneProcess, AreDrawnWhenOneOfThemFails) {
  EXPECT_THAT(run_together({write("first.png", "plot sin(x)"),
                            write("bad.png", "plot no_such_thing"),
                            write("last.png", "plot cos(x)")}),
              AllOf(HasSubstr("'bad.png'"), Not(HasSubstr("last.png"))));
  EXPECT_GT(read("first.png").size(), 1000u);
  EXPECT_GT(read("last.png").size(), 1000u);
  EXPECT_EQ(read("bad.png"), "");
}

}  // namespace
}  // namespace limber::results::run_together_test
