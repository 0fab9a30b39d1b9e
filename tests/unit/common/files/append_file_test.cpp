// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/append_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/common/files/sealed_file.hpp"

namespace limber::append_file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

class Place : public ::testing::Test {
 protected:
  Place() { fs::create_directory(folder_); }
  ~Place() override { fs::remove_all(folder_); }

  fs::path folder_ =
      fs::temp_directory_path() / ("limber_append_" + std::to_string(getpid()));
  fs::path file_ = folder_ / "file";
};
using AppendFiles = Place;
using SealedFiles = Place;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::vector<std::string> read_blocks(const fs::path& file,
                                     const FilePart& part) {
  std::vector<std::string> blocks;
  visit_blocks(file, part,
               [&](std::string block) { blocks.push_back(std::move(block)); });
  return blocks;
}

TEST_F(AppendFiles, GiveBackTheirBlocksAndGoOnAfterAPart) {
  FilePart part;
  {
    AppendFile log(file_);
    log.append("one");
    log.append("");
    part = log.part();
    log.append("cut off");
  }
  EXPECT_THAT(read_blocks(file_, part), ElementsAre("one", ""));
  AppendFile log(file_, part);
  log.append("three");
  EXPECT_THAT(read_blocks(file_, log.part()), ElementsAre("one", "", "three"));
  EXPECT_EQ(fs::file_size(file_), log.part().length);
}

TEST_F(AppendFiles, RefuseEveryChangedByteOfTheirPart) {
  AppendFile log(file_);
  log.append("a block");
  log.append("another");
  const std::string bytes = read(file_);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    write(file_, damaged);
    EXPECT_THROW((void)read_blocks(file_, log.part()), InputError) << i;
    write(file_, bytes.substr(0, i));
    EXPECT_THROW((void)read_blocks(file_, log.part()), InputError) << i;
  }
}

// The limit of a file's size stands for the disk's.
TEST_F(AppendFiles, AreAsBeforeWhenTheDiskIsFull) {
  AppendFile log(file_);
  log.append("one");
  const FilePart before = log.part();
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  rlimit limit = old;
  limit.rlim_cur = 100;
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_THROW(log.append(std::string(1000, 'x')), InputError);
  std::vector<std::string> left = {std::string(1000, 'x'), "fits"};
  EXPECT_THROW(log.append([&]() -> std::optional<std::string> {
    if (left.empty()) return std::nullopt;
    std::string next = left.back();
    left.pop_back();
    return next;
  }),
               InputError);
  EXPECT_TRUE(left.empty());
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(fs::file_size(file_), before.length);
  log.append("two");
  EXPECT_THAT(read_blocks(file_, log.part()), ElementsAre("one", "two"));
}

TEST_F(SealedFiles, RefuseEveryFlippedBitAndEveryCut) {
  const Seal seal = {"limber test", 3};
  std::string content = "some content";
  content += '\0';
  write_sealed(file_, seal, content);
  EXPECT_TRUE(has_seal(file_, "limber test"));
  EXPECT_EQ(read_sealed(file_, seal), content);
  const std::string bytes = read(file_);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      write(file_, damaged);
      EXPECT_THROW((void)read_sealed(file_, seal), InputError) << i;
    }
    write(file_, bytes.substr(0, i));
    EXPECT_THROW((void)read_sealed(file_, seal), InputError) << i;
  }
  write(file_, bytes + "x");
  EXPECT_THROW((void)read_sealed(file_, seal), InputError);
}

// No memory has room for it, nor is it all read.
TEST_F(SealedFiles, OfAnotherKindAreRefusedAtOnceHoweverLarge) {
  write(file_, "");
  fs::resize_file(file_, std::uintmax_t{1} << 37);
  EXPECT_THROW((void)read_sealed(file_, {"limber test", 3}), InputError);
}

TEST_F(SealedFiles, AreOfOneKindAndLayout) {
  write_sealed(file_, {"limber test", 3}, "content");
  EXPECT_FALSE(has_seal(file_, "limber tes"));
  EXPECT_THROW((void)read_sealed(file_, {"limber text", 3}), InputError);
  EXPECT_THROW((void)read_sealed(file_, {"limber test", 4}), InputError);
  EXPECT_FALSE(has_seal(folder_, "limber test"));
  EXPECT_FALSE(has_seal(folder_ / "none", "limber test"));
}

}  // namespace
}  // namespace limber::append_file_test
