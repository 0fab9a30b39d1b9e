// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/page_arrays.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>

#include "limber/view/compress.hpp"

namespace limber::view::page_arrays_test {
namespace {

TEST(Quantise, IsWithinHalfAStepOfEveryValue) {
  VectorX values = VectorX::LinSpaced(1001, -0.3, 0.7);
  const Quantised result = quantise(values);
  EXPECT_DOUBLE_EQ(result.scale, 0.7 / 32767.0);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double back =
        result.scale * result.integers[static_cast<std::size_t>(i)];
    EXPECT_LE(std::abs(back - values[i]), 0.5000001 * result.scale);
  }
}

TEST(Quantise, OfZerosHasNoScale) {
  const Quantised result = quantise(VectorX::Zero(3));
  EXPECT_EQ(result.scale, 0.0);
  EXPECT_EQ(result.integers, (std::vector<std::int16_t>{0, 0, 0}));
  EXPECT_TRUE(quantise(VectorX()).integers.empty());
}

// The step between two integers would have no bits.
TEST(Quantise, OfNumbersBelowTheLeastNormalHasNoScale) {
  const Quantised none = quantise(VectorX::Constant(3, 1.6e-319));
  EXPECT_EQ(none.scale, 0.0);
  EXPECT_EQ(none.integers, std::vector<std::int16_t>(3, 0));
}

// RFC 4648, section 10.
TEST(Base64, HasTheVectorsOfItsStandard) {
  EXPECT_EQ(encode_base64(""), "");
  EXPECT_EQ(encode_base64("f"), "Zg==");
  EXPECT_EQ(encode_base64("fo"), "Zm8=");
  EXPECT_EQ(encode_base64("foo"), "Zm9v");
  EXPECT_EQ(encode_base64("foob"), "Zm9vYg==");
  EXPECT_EQ(encode_base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encode_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encode_base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(Compress, IsUndoneByZlib) {
  const std::string text = std::string(5000, 'a') + std::string("\0b", 2);
  const std::string packed = compress(text);
  EXPECT_LT(packed.size(), 100U);
  std::string back(text.size(), '?');
  uLongf size = back.size();
  ASSERT_EQ(
      uncompress(reinterpret_cast<Bytef*>(back.data()), &size,
                 reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
      Z_OK);
  EXPECT_EQ(back, text);
}

TEST(PageArrays, StorePlanesOfBytes) {
  PageArrays arrays;
  const std::vector<std::int16_t> values = {0x0102, 0x0304};
  const nlohmann::json first = arrays.add(values);
  EXPECT_EQ(arrays.bytes(), std::string("\x02\x04\x01\x03"));
  EXPECT_EQ(first, (nlohmann::json{{"at", 0}, {"count", 2}, {"type", "i16"}}));
  const nlohmann::json second = arrays.add(MatrixX::Constant(1, 1, 1.0));
  EXPECT_EQ(second["at"], 4);
  EXPECT_EQ(arrays.bytes().substr(4), std::string("\x00\x00\x80\x3f", 4));
}

}  // namespace
}  // namespace limber::view::page_arrays_test
