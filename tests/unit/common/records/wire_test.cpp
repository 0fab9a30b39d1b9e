// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/records/wire.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace limber::wire_test {
namespace {

struct Values {
  int number = 0;
  double real = 0.0;
  bool flag = false;
  std::string text;
  std::vector<double> reals;
  std::vector<std::vector<std::string>> lists;
  MatrixX matrix;
  Matrix3X points;
};

void exchange(Wire& wire, Values& v) {
  wire(v.number, v.real, v.flag, v.text, v.reals, v.lists, v.matrix, v.points);
}

Values make_values() {
  Values v{-7,          std::numeric_limits<double>::denorm_min(),
           true,        std::string("a\0b", 3),
           {1.0, -0.0}, {{"x", ""}, {}},
           {},          {}};
  v.matrix = MatrixX::Random(2, 5);
  v.points = Matrix3X::Random(3, 4);
  return v;
}

std::string pack(Values values) {
  Wire wire;
  wire(values);
  return wire.bytes();
}

Values unpack(const std::string& bytes) {
  Wire wire(bytes);
  Values values;
  wire(values);
  wire.finish();
  return values;
}

TEST(Wire, GivesBackWhatWasWrittenToTheBit) {
  const Values sent = make_values();
  const Values found = unpack(pack(sent));
  EXPECT_EQ(found.number, sent.number);
  EXPECT_EQ(found.real, sent.real);
  EXPECT_EQ(found.flag, sent.flag);
  EXPECT_EQ(found.text, sent.text);
  EXPECT_EQ(found.lists, sent.lists);
  EXPECT_EQ(found.matrix, sent.matrix);
  EXPECT_EQ(found.points, sent.points);
  EXPECT_EQ(pack(found), pack(sent));
}

TEST(Wire, RefusesEveryMessageThatIsCutOrContinued) {
  const std::string bytes = pack(make_values());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(unpack(bytes.substr(0, size)), InputError) << size;
  }
  EXPECT_THROW(unpack(bytes + 'x'), InputError);
}

// A length of 2^64 - 1 must not be believed.
TEST(Wire, TakesNoMemoryForWhatIsNotThere) {
  const std::string bytes = pack(make_values());
  for (std::size_t at = 0; at + 8 <= bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged.replace(at, 8, std::string(8, '\xff'));
    try {
      (void)unpack(damaged);
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace limber::wire_test
