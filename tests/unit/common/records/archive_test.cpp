// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/records/archive.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "limber/common/records/digest.hpp"

namespace limber::archive_test {
namespace {

enum class Colour { red, green };

struct Things {
  double number = 0.0;
  long count = 0;
  bool is_so = false;
  Colour colour = Colour::red;
  std::string text;
  VectorX vector;
  MatrixX matrix;
  Matrix3 fixed = Matrix3::Zero();
  Quaternion q = Quaternion::Identity();
  std::vector<std::string> texts;
};

void exchange(Archive& archive, Things& t) {
  archive(t.number, t.count, t.is_so, t.colour, t.text, t.vector, t.matrix,
          t.fixed, t.q, t.texts);
}

Things make_things() {
  Things t;
  t.number = -0.1 + 1e-300;
  t.count = (1L << 53) - 1;
  t.is_so = true;
  t.colour = Colour::green;
  t.text = "Wo zum \xc3\xa4hnlichen\n";
  t.vector = VectorX::LinSpaced(5, -1.0, 1.0);
  t.matrix = MatrixX::Random(2, 3);
  t.fixed = Matrix3::Random();
  t.q = Quaternion::UnitRandom();
  t.texts = {"", "a", "bc"};
  return t;
}

TEST(Archive, GivesBackToTheBitWhatItWasGiven) {
  Things given = make_things();
  Archive out;
  out(given);
  Archive in(out.numbers());
  Things got;
  in(got);
  EXPECT_EQ(got.number, given.number);
  EXPECT_EQ(got.count, given.count);
  EXPECT_EQ(got.is_so, given.is_so);
  EXPECT_EQ(got.colour, given.colour);
  EXPECT_EQ(got.text, given.text);
  EXPECT_EQ(got.vector, given.vector);
  EXPECT_EQ(got.matrix, given.matrix);
  EXPECT_EQ(got.fixed, given.fixed);
  EXPECT_EQ(got.q.coeffs(), given.q.coeffs());
  EXPECT_EQ(got.texts, given.texts);
}

TEST(Archive, RefusesARecordThatEndsEarlyWhereverItEnds) {
  Things given = make_things();
  Archive out;
  out(given);
  for (std::size_t n = 0; n < out.numbers().size(); ++n) {
    Archive in(std::vector<double>(
        out.numbers().begin(),
        out.numbers().begin() + static_cast<std::ptrdiff_t>(n)));
    Things got;
    EXPECT_THROW(in(got), InputError) << n;
  }
}

TEST(Archive, RefusesSizesThatTheRecordCannotHold) {
  for (const double size :
       {-1.0, 3.0, 1e18, std::numeric_limits<double>::quiet_NaN()}) {
    Archive in({size, 1.0, 2.0});
    std::vector<double> got;
    EXPECT_THROW(in(got), InputError) << size;
  }
}

// Of an empty text: the hash's own published value for no bytes, seed 0.
TEST(Digest, IsThePublishedHash) {
  EXPECT_EQ(Digest().text(), "99aa06d3014798d86001c324468d497f");
}

TEST(Digest, TellsListsApartThatJoinAlike) {
  Digest a;
  a.add(std::string("ab"));
  a.add(std::string("c"));
  Digest b;
  b.add(std::string("a"));
  b.add(std::string("bc"));
  EXPECT_NE(a.text(), b.text());
}

}  // namespace
}  // namespace limber::archive_test
