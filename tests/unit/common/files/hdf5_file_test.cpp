// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/hdf5_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "limber/common/errors.hpp"

namespace limber::hdf5_file_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Hdf5FileTest : public ::testing::Test {
 protected:
  ~Hdf5FileTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(file_, ignored);
  }
  [[nodiscard]] std::string read_bytes() const {
    std::ifstream stream(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write_bytes(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary) << bytes;
  }
  // Changes the one place where these eight-byte numbers follow each other.
  void replace_numbers(const std::vector<std::uint64_t>& old,
                       const std::vector<std::uint64_t>& fresh) const {
    std::string bytes = read_bytes();
    const std::size_t at = bytes.find(as_bytes(old));
    ASSERT_NE(at, std::string::npos);
    ASSERT_EQ(bytes.find(as_bytes(old), at + 1), std::string::npos);
    bytes.replace(at, 8 * old.size(), as_bytes(fresh));
    write_bytes(bytes);
  }
  [[nodiscard]] std::filesystem::path file() const { return file_; }

  static std::string as_bytes(const std::vector<std::uint64_t>& numbers) {
    std::string bytes;
    for (const std::uint64_t n : numbers) {
      for (int i = 0; i < 8; ++i) {
        bytes += static_cast<char>(n >> (8 * i) & 0xffU);
      }
    }
    return bytes;
  }

 private:
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() /
      ("limber-hdf5-" + std::to_string(getpid()) + ".h5");
};

template <typename Work>
std::string find_input_error(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(Hdf5FileTest, ReturnsMatricesIntegersAndTexts) {
  const MatrixX matrix{{1.0 / 3.0, -0.0, 1e-310}, {1e308, 5.0, 6.0}};
  const std::vector<std::int64_t> integers = {
      std::numeric_limits<std::int64_t>::min(), -1,
      std::numeric_limits<std::int64_t>::max()};
  Hdf5File out = Hdf5File::create(file());
  out.write("a/b/matrix", matrix, "m", "numbers");
  out.write("a/integers", integers, "1", "numbers");
  out.write("a/text", "Träger", "a word");
  out.close();
  const Hdf5File in = Hdf5File::open(file());
  const MatrixX read = in.read_matrix("a/b/matrix");
  EXPECT_EQ(read, matrix);
  EXPECT_TRUE(std::signbit(read(0, 1)));
  EXPECT_EQ(in.read_integers("a/integers"), integers);
  EXPECT_EQ(in.read_text("a/text"), "Träger");
}

TEST_F(Hdf5FileTest, ReturnsEmptyOnesWithTheirShape) {
  Hdf5File out = Hdf5File::create(file());
  out.write("tall", MatrixX(3, 0), "m", "nothing");
  out.write("wide", MatrixX(0, 4), "m", "nothing");
  out.write("integers", std::vector<std::int64_t>(), "1", "nothing");
  out.write("text", "", "nothing");
  out.close();
  const Hdf5File in = Hdf5File::open(file());
  EXPECT_EQ(in.read_matrix("tall").rows(), 3);
  EXPECT_EQ(in.read_matrix("tall").cols(), 0);
  EXPECT_EQ(in.read_matrix("wide").cols(), 4);
  EXPECT_THAT(in.read_integers("integers"), IsEmpty());
  EXPECT_EQ(in.read_text("text"), "");
}

TEST_F(Hdf5FileTest, ReturnsATextWithZerosInside) {
  const std::string text("one\0two\0", 8);
  Hdf5File out = Hdf5File::create(file());
  out.write("text", text, "two words");
  out.close();
  EXPECT_EQ(Hdf5File::open(file()).read_text("text"), text);
}

TEST_F(Hdf5FileTest, StoresAnArrayRowByRow) {
  Hdf5File out = Hdf5File::create(file());
  out.write_array("array", std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0},
                  {2, 3}, "m", "rows");
  out.close();
  const MatrixX rows{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  EXPECT_EQ(Hdf5File::open(file()).read_matrix("array"), rows);
}

TEST_F(Hdf5FileTest, StoresIntegersOfAnyShape) {
  const std::vector<std::int64_t> values = {3, -1, 2};
  Hdf5File out = Hdf5File::create(file());
  out.write_array("list", values, {3}, "1", "numbers");
  out.write_array("rows", values, {3, 1}, "1", "numbers");
  EXPECT_THROW(out.write_array("few", values, {2}, "1", ""), ContractError);
  out.close();
  const Hdf5File in = Hdf5File::open(file());
  EXPECT_EQ(in.read_integers("list"), values);
  EXPECT_THROW((void)in.read_integers("rows"), InputError);
  EXPECT_THROW((void)in.read_matrix("rows"), InputError);
}

TEST_F(Hdf5FileTest, ExpectsAsManyValuesAsAnArraysShapeHas) {
  Hdf5File out = Hdf5File::create(file());
  EXPECT_THROW(
      out.write_array("array", std::vector<double>{1.0}, {2, 3}, "m", ""),
      ContractError);
}

TEST_F(Hdf5FileTest, ListsTheNamesInAGroupSorted) {
  Hdf5File out = Hdf5File::create(file());
  for (const char* name : {"group/b", "group/c/d", "group/a"}) {
    out.write(name, "text", "");
  }
  out.close();
  const Hdf5File in = Hdf5File::open(file());
  EXPECT_THAT(in.list("group"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(in.list("missing"), IsEmpty());
  EXPECT_TRUE(in.has("group/c/d"));
  EXPECT_FALSE(in.has("group/c/e"));
  EXPECT_FALSE(in.has("missing/c/e"));
  EXPECT_THAT(find_input_error([&] { (void)in.list("group/a"); }),
              HasSubstr(file().string()));
}

TEST_F(Hdf5FileTest, LeavesTheUserBlockToTheCaller) {
  Hdf5File out = Hdf5File::create(file(), 512);
  out.write("text", "a word", "");
  out.close();
  std::string bytes = read_bytes();
  std::fill_n(bytes.begin(), 512, 'x');
  write_bytes(bytes);
  EXPECT_EQ(Hdf5File::open(file()).read_text("text"), "a word");
  EXPECT_THROW((void)Hdf5File::create(file(), 100), ContractError);
}

TEST_F(Hdf5FileTest, NamesTheFileAndWhatIsMissingOrOfAnotherKind) {
  Hdf5File out = Hdf5File::create(file());
  out.write("matrix", MatrixX(MatrixX::Ones(2, 2)), "m", "");
  out.write_array("cube", std::vector<double>(8), {2, 2, 2}, "m", "");
  out.write("text", "a word", "");
  out.close();
  const Hdf5File in = Hdf5File::open(file());
  const auto expect_error = [&](const auto& read, const char* text) {
    const std::string error = find_input_error(read);
    EXPECT_THAT(error, HasSubstr(file().string()));
    EXPECT_THAT(error, HasSubstr(text));
  };
  expect_error([&] { (void)in.read_matrix("mass"); }, "no 'mass'");
  expect_error([&] { (void)in.read_matrix("text"); }, "'text' is not");
  expect_error([&] { (void)in.read_matrix("cube"); }, "'cube' is not");
  expect_error([&] { (void)in.read_integers("matrix"); }, "'matrix' is not");
  expect_error([&] { (void)in.read_text("matrix"); }, "'matrix' is not");
}

TEST_F(Hdf5FileTest, RefusesASecondDatasetOfOneName) {
  Hdf5File out = Hdf5File::create(file());
  out.write("text", "a word", "");
  EXPECT_THAT(find_input_error([&] { out.write("text", "another", ""); }),
              HasSubstr("'text' cannot be written"));
}

TEST_F(Hdf5FileTest, FindsAFlippedByteInItsNumbers) {
  const std::uint64_t one = 0x3ff0000000000000;  // 1.0
  Hdf5File out = Hdf5File::create(file());
  out.write("matrix", MatrixX(MatrixX::Ones(3, 1)), "m", "");
  out.close();
  replace_numbers({one, one, one}, {one, one, one + 1});
  EXPECT_THAT(find_input_error(
                  [&] { (void)Hdf5File::open(file()).read_matrix("matrix"); }),
              HasSubstr("checksum"));
}

// The shape stands in the file as the numbers 37, 41; a chunk's as 4 bytes.
TEST_F(Hdf5FileTest, RefusesAShapeLargerThanItsStorageBeforeTakingMemory) {
  const std::uint64_t huge = std::uint64_t{1} << 40;
  const std::uint64_t most = std::numeric_limits<std::uint64_t>::max() - 1;
  for (const std::vector<std::uint64_t>& shape :
       {std::vector<std::uint64_t>{37, 41000},
        {huge, 41},
        {huge, huge},
        {std::uint64_t{1} << 63, 2},
        {most, 41},
        {most, 0}}) {
    Hdf5File out = Hdf5File::create(file());
    out.write("matrix", MatrixX(MatrixX::Ones(37, 41)), "m", "");
    out.close();
    // An extent and its largest allowed one stand side by side.
    replace_numbers({37, 41, 37, 41}, {shape[0], shape[1], shape[0], shape[1]});
    EXPECT_THAT(find_input_error([&] {
                  (void)Hdf5File::open(file()).read_matrix("matrix");
                }),
                HasSubstr("'matrix'"))
        << shape[0] << " x " << shape[1];
  }
}

TEST_F(Hdf5FileTest, ThatIsNoHdf5FileIsAnInputErrorThatNamesIt) {
  const auto open = [&] { (void)Hdf5File::open(file()); };
  EXPECT_THAT(find_input_error(open), HasSubstr(file().string()));
  for (const std::string bytes : {"", "text", "\x89HDF\r\n\x1a\n"}) {
    write_bytes(bytes);
    EXPECT_THAT(find_input_error(open), HasSubstr(file().string()));
  }
  std::filesystem::remove(file());
  std::filesystem::create_directory(file());
  EXPECT_THAT(find_input_error(open), HasSubstr(file().string()));
  EXPECT_THROW((void)Hdf5File::create(file()), InputError);
}

}  // namespace
}  // namespace limber::hdf5_file_test
