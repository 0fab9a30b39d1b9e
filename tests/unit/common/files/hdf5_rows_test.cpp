// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/hdf5_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "support/temporary_folder.hpp"

namespace limber::hdf5_rows_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

fs::path name_file(const char* name) { return test::own_folder() / name; }

void write_rows(Hdf5File& out, const std::string& name, const MatrixX& values) {
  Hdf5Rows rows(out, name, values.rows(), values.cols(), "m", "values");
  for (const auto& row : values.rowwise()) rows.next() = row;
  rows.close();
}

TEST(Hdf5Rows, AreTheMatrixThatIsWrittenWhole) {
  int count = 0;
  for (const auto& [rows, columns] :
       std::vector<std::pair<int, int>>{{0, 0},
                                        {0, 3},
                                        {5, 0},
                                        {1, 1},
                                        {7, 3},
                                        {16384, 1},
                                        {16385, 1},
                                        {40000, 3},
                                        {3, 20000},
                                        {100003, 1}}) {
    const MatrixX values = MatrixX::Random(rows, columns);
    const fs::path file = name_file(("m" + std::to_string(count++)).c_str());
    {
      Hdf5File out = Hdf5File::create(file);
      write_rows(out, "a/b", values);
      out.close();
    }
    const Hdf5File in = Hdf5File::open(file);
    EXPECT_EQ(in.read_matrix("a/b"), values) << rows << ' ' << columns;
    EXPECT_EQ(in.read_unit("a/b"), "m");
  }
}

TEST(Hdf5Rows, OfSeveralMatricesMayAlternate) {
  const MatrixX a = MatrixX::Random(30000, 2);
  const MatrixX b = MatrixX::Random(30000, 5);
  {
    Hdf5File out = Hdf5File::create(name_file("two"));
    std::vector<Hdf5Rows> rows;
    rows.emplace_back(out, "a", 30000, 2, "1", "a");
    rows.emplace_back(out, "b", 30000, 5, "1", "b");
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      rows[0].next() = a.row(i);
      rows[1].next() = b.row(i);
    }
    for (Hdf5Rows& each : rows) each.close();
    out.close();
  }
  const Hdf5File in = Hdf5File::open(name_file("two"));
  EXPECT_EQ(in.read_matrix("a"), a);
  EXPECT_EQ(in.read_matrix("b"), b);
}

// HDF5 fills the last part of a matrix up to the length of the others.
TEST(Hdf5Rows, TakeLittleMoreRoomThanTheirNumbers) {
  const MatrixX values = MatrixX::Random(16390, 1);  // just beyond one part
  {
    Hdf5File out = Hdf5File::create(name_file("size"));
    write_rows(out, "a", values);
    out.close();
  }
  EXPECT_LT(fs::file_size(name_file("size")), 16390 * sizeof(double) + 8000);
}

TEST(Hdf5Rows, AreAllFilledOrAContractIsBroken) {
  Hdf5File out = Hdf5File::create(name_file("few"));
  Hdf5Rows rows(out, "a", 2, 1, "1", "a");
  rows.next().setZero();
  EXPECT_THROW(rows.close(), ContractError);
  rows.next().setZero();
  EXPECT_THROW((void)rows.next(), ContractError);
}

// The limit of a file's size stands for the disk's.
TEST(Hdf5RowsOnAFullDisk, NameTheFileAndTheMatrix) {
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  rlimit limit = old;
  limit.rlim_cur = 300000;
  Hdf5File out = Hdf5File::create(name_file("full"));
  setrlimit(RLIMIT_FSIZE, &limit);
  try {
    write_rows(out, "the/matrix", MatrixX::Random(100000, 1));
    ADD_FAILURE() << "it was written";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("full"));
    EXPECT_THAT(error.what(), HasSubstr("'the/matrix' cannot be written"));
  }
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, old_handler);
}

}  // namespace
}  // namespace limber::hdf5_rows_test
