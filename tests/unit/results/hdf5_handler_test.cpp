// SPDX-License-Identifier: BSD-3-Clause
// A program that uses HDF5 itself finds its error handler as it left it.
#include <gtest/gtest.h>
#if __has_include(<hdf5.h>)
#include <hdf5.h>
#else
#include <hdf5/serial/hdf5.h>
#endif

#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "unit/results/temporary_folder.hpp"

namespace limber::results::hdf5_handler_test {
namespace {

herr_t count_call(hid_t /*stack*/, void* data) {
  ++*static_cast<int*>(data);
  return 0;
}

TEST(Hdf5Handler, IsTheProgramsOwnAfterEveryCallOfOurs) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "f.h5";
  int calls = 0;
  H5Eset_auto2(H5E_DEFAULT, count_call, &calls);
  {
    Hdf5File out = Hdf5File::create(file);
    EXPECT_FALSE(out.has("no/such/group"));
    EXPECT_THROW((void)out.read_matrix("nothing"), InputError);
    out.close();
  }
  std::ofstream(file) << "no HDF5";
  EXPECT_THROW((void)Hdf5File::open(file), InputError);
  EXPECT_EQ(calls, 0);  // ours are reported by exceptions
  EXPECT_LT(H5Fopen("/no/such/file", H5F_ACC_RDONLY, H5P_DEFAULT), 0);
  EXPECT_EQ(calls, 1);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace
}  // namespace limber::results::hdf5_handler_test
