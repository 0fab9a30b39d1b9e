// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/body_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "limber/common/files/hdf5_exit.hpp"
#include "support/foreign_hdf5.hpp"
#include "unit/flexbody/files.hpp"
#include "unit/flexbody/small_body.hpp"

// The leak sanitizer's, where it is linked.
// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" void __lsan_disable() __attribute__((weak));

namespace limber::flexbody::test::body_file_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t kSealSize = 512;  // HDF5's user block

class BodyFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::string reading_error() const {
    return find_input_error([&] { (void)read_body(file()); });
  }
  // Writes, has `change` edit the bytes, and seals them again, as a tool
  // would that changes a body on purpose.
  void write_edited(const std::function<void(std::string&)>& change) const {
    write_body(make_small_body(1), file());
    std::string bytes = read_bytes(file());
    change(bytes);
    write_bytes(file(), bytes);
    seal_body_file(file());
  }
  [[nodiscard]] std::filesystem::path file() const {
    return folder_.path() / "body.h5";
  }
  TemporaryFolder folder_;
};

// HDF5 may leave stale copies of a name behind, so all are replaced.
void replace_all(std::string& bytes, const std::string& old,
                 const std::string& fresh) {
  ASSERT_EQ(old.size(), fresh.size());
  ASSERT_NE(bytes.find(old), std::string::npos) << old;
  for (std::size_t at = bytes.find(old); at != std::string::npos;
       at = bytes.find(old, at + 1)) {
    bytes.replace(at, old.size(), fresh);
  }
}

TEST_F(BodyFile, ReturnsEveryFieldBitForBit) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const ReducedBody body = make_small_body(seed);
    write_body(body, file());
    EXPECT_EQ(find_difference(read_body(file()), body), "");
  }
}

TEST_F(BodyFile, ReturnsExtremeNumbersBitForBit) {
  using Limits = std::numeric_limits<double>;
  ReducedBody body = make_small_body(1);
  body.mass = -0.0;
  body.size = Vector3(Limits::denorm_min(), Limits::max(), Limits::lowest());
  body.mesh_nodes =
      static_cast<std::size_t>(std::numeric_limits<std::int64_t>::max());
  write_body(body, file());
  EXPECT_EQ(find_difference(read_body(file()), body), "");
}

TEST_F(BodyFile, ReturnsABodyWithoutModesRowsGroupsAndInterfaces) {
  ReducedBody body;
  body.rows.x_B.resize(3, 0);
  body.rows.Phi_B.resize(0, 0);
  write_body(body, file());
  EXPECT_EQ(find_difference(read_body(file()), body), "");
}

TEST_F(BodyFile, ReturnsMoreGroupsThanFourDigitsCountInTheirOrder) {
  ReducedBody body;
  for (int i = 0; i < 10002; ++i) {
    body.groups.push_back({std::to_string(i), 0, {}, VectorX(0)});
  }
  write_body(body, file());
  EXPECT_EQ(find_difference(read_body(file()), body), "");
}

TEST_F(BodyFile, ReplacesAnOlderBody) {
  write_body(make_small_body(1), file());
  write_body(make_small_body(2), file());
  EXPECT_EQ(find_difference(read_body(file()), make_small_body(2)), "");
  EXPECT_EQ(folder_.count_files(), 1);
}

TEST_F(BodyFile, TruncatedAnywhereIsAnInputErrorThatNamesTheFile) {
  write_body(make_small_body(1), file());
  const std::string bytes = read_bytes(file());
  const std::size_t step = std::max<std::size_t>(1, bytes.size() / 300);
  ASSERT_GT(bytes.size(), kSealSize);
  for (std::size_t size = 0; size < bytes.size(); size += step) {
    write_bytes(file(), bytes.substr(0, size));
    EXPECT_THAT(reading_error(), HasSubstr(file().string())) << size;
  }
  write_bytes(file(), bytes.substr(0, bytes.size() - 1));
  EXPECT_THAT(reading_error(), HasSubstr("is damaged"));
}

TEST_F(BodyFile, AnyFlippedBitIsAnInputErrorThatNamesTheFile) {
  write_body(make_small_body(1), file());
  std::string bytes = read_bytes(file());
  // Odd, so that all positions in a word and all bits of a byte are covered.
  const std::size_t step = bytes.size() / 600 | 1U;
  std::size_t count = 0;
  for (std::size_t at = 0; at < bytes.size(); at += at < kSealSize ? 1 : step) {
    const char sound = bytes[at];
    bytes[at] = static_cast<char>(sound ^ (1 << (count++ % 8)));
    write_bytes(file(), bytes);
    EXPECT_THAT(reading_error(), HasSubstr(file().string())) << at;
    bytes[at] = sound;
  }
  EXPECT_GT(count, 1000U);
  write_bytes(file(), bytes);
  EXPECT_EQ(reading_error(), "");
}

TEST_F(BodyFile, WithBytesAppendedIsDamaged) {
  write_body(make_small_body(1), file());
  write_bytes(file(), read_bytes(file()) + '\0');
  EXPECT_THAT(reading_error(), HasSubstr("is damaged"));
}

TEST_F(BodyFile, OfAnotherVersionNamesBothVersions) {
  write_body(make_small_body(1), file());
  std::string bytes = read_bytes(file());
  replace_all(bytes, "\nlayout " + std::to_string(kBodyFileVersion) + "\n",
              "\nlayout 6\n");
  write_bytes(file(), bytes);
  EXPECT_THAT(reading_error(), HasSubstr("version 6"));
  EXPECT_THAT(reading_error(),
              HasSubstr("reads " + std::to_string(kBodyFileVersion)));
}

// So that older programs read what they can, and say of the rest that they
// cannot.
TEST_F(BodyFile, HasTheOldLayoutUnlessThereAreContactSurfaces) {
  ReducedBody body = make_small_body(2);
  const auto has_layout = [&](int version) {
    write_body(body, file());
    return read_bytes(file()).find(fmt::format("\nlayout {}\n", version)) <
           kSealSize;
  };
  EXPECT_TRUE(has_layout(kContactBodyFileVersion));
  seal_body_file(file());
  EXPECT_EQ(find_difference(read_body(file()), body), "");
  body.contact_surfaces.clear();
  EXPECT_TRUE(has_layout(kBodyFileVersion));
  EXPECT_THAT(read_bytes(file()), Not(HasSubstr("contact")));
  EXPECT_EQ(find_difference(read_body(file()), body), "");
}

TEST_F(BodyFile, ThatKeepsValuesInAnotherFileIsRefused) {
  const std::filesystem::path other = folder_.path() / "other.h5";
  write_body(make_small_body(1), other);
  for (const char* name : {"name", "lambda", "integrals"}) {
    write_body(make_small_body(1), file());
    limber::test::ForeignHdf5(file()).link_outside(name, other, name);
    seal_body_file(file());
    EXPECT_THAT(reading_error(), HasSubstr("is a link to another file"));
  }
  write_body(make_small_body(1), file());
  limber::test::ForeignHdf5(file()).store_outside("lambda", other);
  seal_body_file(file());
  EXPECT_THAT(reading_error(), HasSubstr("'lambda' keeps its values in"));
}

TEST_F(BodyFile, WithAContactSurfaceThatDoesNotFitNamesTheDataset) {
  const std::vector<
      std::pair<std::string, std::function<void(ContactSurface&)>>>
      damages = {
          {"'contact/0001/faces' names a node that does not exist",
           [](ContactSurface& s) { s.faces[0][1] = 3; }},
          {"'contact/0001/faces' names a node that does not exist",
           [](ContactSurface& s) { s.faces[0][1] = -2; }},
          {"'contact/0001/faces' has a face without a node",
           [](ContactSurface& s) { s.faces[0][1] = -1; }},
          {"'contact/0001/faces' has a face without a node",
           [](ContactSurface& s) { s.faces[0][4] = 1; }},
          {"'contact/0001/x_B'",
           [](ContactSurface& s) { s.tags.push_back(1); }},
          {"'contact/0001/Phi_B'",
           [](ContactSurface& s) { s.Phi_B = MatrixX::Zero(9, 3); }},
          {"'contact/0001/residual' is not finite",
           [](ContactSurface& s) {
             s.residual[0] = std::numeric_limits<double>::infinity();
           }},
          {"'contact/0001/patch_radius'",
           [](ContactSurface& s) { s.patch_radius = VectorX::Ones(2); }},
          {"'contact/0001/slices/1/heights' is 3 x 1; expected 2 x 1",
           [](ContactSurface& s) { s.slices[0].heights = VectorX::Ones(3); }},
          {"'contact/0001/material' is not finite",
           [](ContactSurface& s) {
             s.youngs_modulus = std::numeric_limits<double>::quiet_NaN();
           }},
      };
  for (const auto& [name, damage] : damages) {
    ReducedBody body = make_small_body(2);
    damage(body.contact_surfaces[1]);
    write_body(body, file());
    EXPECT_THAT(reading_error(), HasSubstr(name));
  }
}

TEST_F(BodyFile, ThatIsSomethingElseIsSaidToBeNoBody) {
  for (const std::string& bytes :
       {std::string(), std::string("<robot/>"), std::string(4096, 'x'),
        std::string("\x89HDF\r\n\x1a\n") + std::string(4096, '\0')}) {
    write_bytes(file(), bytes);
    EXPECT_THAT(reading_error(), HasSubstr("is not a reduced body"));
  }
}

TEST_F(BodyFile, WithASealButNoHdf5BehindIsAnInputError) {
  write_edited([](std::string& bytes) {
    std::fill(bytes.begin() + kSealSize, bytes.end(), 'x');
  });
  EXPECT_THAT(reading_error(), HasSubstr("not an HDF5 file"));
}

TEST_F(BodyFile, ThatDoesNotExistIsAnInputError) {
  EXPECT_THAT(reading_error(), HasSubstr("No such file"));
}

TEST_F(BodyFile, ThatIsAFolderIsAnInputError) {
  std::filesystem::create_directory(file());
  EXPECT_THAT(reading_error(), HasSubstr(file().string()));
  EXPECT_THROW(write_body(make_small_body(1), file()), InputError);
  EXPECT_EQ(folder_.count_files(), 1);
}

TEST_F(BodyFile, EditedAndSealedAgainIsRead) {
  write_edited([](std::string& bytes) {
    replace_all(bytes, "small body 1", "small body 2");
  });
  EXPECT_EQ(read_body(file()).name, "small body 2");
}

TEST_F(BodyFile, WithoutADatasetNamesIt) {
  write_edited([](std::string& bytes) {
    replace_all(bytes, std::string("lambda\0", 7), std::string("lambdb\0", 7));
  });
  EXPECT_THAT(reading_error(), HasSubstr("'lambda'"));
}

TEST_F(BodyFile, ThatLostAGroupNamesIt) {
  write_edited([](std::string& bytes) {
    replace_all(bytes, std::string("\0000001\0", 6),
                std::string("\0000009\0", 6));
  });
  EXPECT_THAT(reading_error(), HasSubstr("groups/0001"));
}

TEST_F(BodyFile, ThatLostAllInterfacesNamesTheFirst) {
  write_edited([](std::string& bytes) {
    replace_all(bytes, std::string("interfaces\0", 11),
                std::string("interfacex\0", 11));
  });
  EXPECT_THAT(reading_error(), HasSubstr("interfaces/0000"));
}

TEST_F(BodyFile, WithANumberThatIsNotFiniteNamesItsDataset) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<std::string, std::function<void(ReducedBody&)>>>
      damages = {
          {"'mass'", [&](ReducedBody& b) { b.mass = nan; }},
          {"'size'", [&](ReducedBody& b) { b.size[1] = infinity; }},
          {"'lambda'", [&](ReducedBody& b) { b.lambda[1] = -infinity; }},
          {"'integrals/S2'",
           [&](ReducedBody& b) { b.integrals.S2[3](2, 1) = nan; }},
          {"'rows/Phi_B'", [&](ReducedBody& b) { b.rows.Phi_B(8, 1) = nan; }},
          {"'groups/0001/weights'",
           [&](ReducedBody& b) { b.groups[1].weights[0] = nan; }},
          {"'interfaces/0000/flexibility'",
           [&](ReducedBody& b) { b.interfaces[0].flexibility(5, 5) = nan; }},
      };
  for (const auto& [name, damage] : damages) {
    ReducedBody body = make_small_body(1);
    damage(body);
    write_body(body, file());
    EXPECT_THAT(reading_error(), HasSubstr(name + " is not finite"));
  }
}

TEST_F(BodyFile, WithSizesThatDoNotFitNamesTheDataset) {
  const std::vector<std::pair<std::string, std::function<void(ReducedBody&)>>>
      damages = {
          {"'integrals/S1'", [](ReducedBody& b) { b.integrals.S1.pop_back(); }},
          {"'integrals/S2'", [](ReducedBody& b) { b.integrals.S2.pop_back(); }},
          {"'rows/x_B'", [](ReducedBody& b) { b.rows.tags.pop_back(); }},
          {"'rows/Phi_B'",
           [](ReducedBody& b) { b.rows.Phi_B = MatrixX::Zero(8, 2); }},
          {"'rows/triangles'", [](ReducedBody& b) { b.triangles[1][2] = 3; }},
          {"'groups/0000/weights'",
           [](ReducedBody& b) { b.groups[0].weights = VectorX::Zero(3); }},
          {"'interfaces/0000/Psi_B'",
           [](ReducedBody& b) {
             b.interfaces[0].Psi_B = Matrix3X::Zero(3, 1);
           }},
      };
  for (const auto& [name, damage] : damages) {
    ReducedBody body = make_small_body(1);
    damage(body);
    write_body(body, file());
    EXPECT_THAT(reading_error(), HasSubstr(name));
  }
}

TEST_F(BodyFile, InAFolderThatDoesNotExistIsAnInputErrorThatNamesIt) {
  const auto elsewhere = folder_.path() / "missing" / "body.h5";
  EXPECT_THAT(
      find_input_error([&] { write_body(make_small_body(1), elsewhere); }),
      HasSubstr(elsewhere.string()));
}

// For a child process: writes where no file may grow beyond `size` bytes, and
// exits with 0 if that is an InputError that names the file. HDF5 leaks what it
// cannot write, and must not crash on it at exit.
// Before the first use of HDF5, as in a program that writes files.
[[maybe_unused]] const bool kIsLeftAlone = (leave_hdf5_alone_at_exit(), true);

[[noreturn]] void write_on_full_disk(rlim_t size,
                                     const std::filesystem::path& file) {
  if (__lsan_disable) __lsan_disable();
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{size, size};
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string text =
      find_input_error([&] { write_body(make_small_body(2), file); });
  std::exit(text.find(file.string()) != std::string::npos ? 0 : 1);
}

TEST_F(BodyFile, OnAFullDiskIsAnInputErrorAndKeepsTheOldOne) {
  const ReducedBody old = make_small_body(1);
  write_body(old, file());
  const auto whole = std::filesystem::file_size(file());
  for (std::uintmax_t size = 0; size < whole; size += whole / 20) {
    EXPECT_EXIT(write_on_full_disk(size, file()), ::testing::ExitedWithCode(0),
                "")
        << size;
  }
  EXPECT_EQ(find_difference(read_body(file()), old), "");
  EXPECT_EQ(folder_.count_files(), 1);
}

// Each of two writers has its own body; who reads finds one of the two.
void write_many_times(unsigned seed, const std::filesystem::path& file) {
  for (int i = 0; i < 20; ++i) write_body(make_small_body(seed), file);
}

void expect_one_of_two(const std::filesystem::path& file) {
  const ReducedBody body = read_body(file);
  const unsigned seed = body.clamped ? 1 : 2;
  EXPECT_EQ(find_difference(body, make_small_body(seed)), "");
}

TEST_F(BodyFile, WrittenByThreadsAtOnceIsAlwaysWhole) {
  write_body(make_small_body(1), file());
  std::vector<std::thread> threads;
  for (const unsigned seed : {1U, 2U, 1U, 2U}) {
    threads.emplace_back([this, seed] { write_many_times(seed, file()); });
  }
  for (int i = 0; i < 40; ++i) expect_one_of_two(file());
  for (std::thread& thread : threads) thread.join();
  expect_one_of_two(file());
  EXPECT_EQ(folder_.count_files(), 1);
}

TEST_F(BodyFile, WrittenByProcessesAtOnceIsAlwaysWhole) {
  write_body(make_small_body(1), file());
  std::vector<pid_t> children;
  for (const unsigned seed : {1U, 2U}) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      write_many_times(seed, file());
      _exit(0);
    }
    children.push_back(child);
  }
  for (int i = 0; i < 40; ++i) expect_one_of_two(file());
  for (const pid_t child : children) {
    int status = -1;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  expect_one_of_two(file());
  EXPECT_EQ(folder_.count_files(), 1);
}

}  // namespace
}  // namespace limber::flexbody::test::body_file_test
