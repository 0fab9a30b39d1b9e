// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/hdf5_rows.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_dataset.hpp"

namespace limber {
namespace {

using hdf5::checked;
using hdf5::Handle;

// Rows of 128 KiB, so divided that the last part is about as long as the
// others: HDF5 fills it up.
std::uint64_t choose_chunk(std::uint64_t rows, std::uint64_t columns) {
  constexpr std::uint64_t kBytes = std::uint64_t{1} << 17;
  const std::uint64_t row = sizeof(double) * columns;
  const std::uint64_t most = std::max<std::uint64_t>(1, kBytes / row);
  const std::uint64_t parts = (rows + most - 1) / most;
  return (rows + parts - 1) / parts;
}

}  // namespace

struct Hdf5Rows::Set {
  std::filesystem::path file;
  std::string name;
  std::optional<Handle> handle;

  template <typename Work>
  void attempt(const Work& work) {
    hdf5::with_path(file, [&] {
      try {
        work();
      } catch (const hdf5::Failure&) {
        throw hdf5::cannot_write(name);
      }
    });
  }
};

Hdf5Rows::Hdf5Rows(Hdf5File& out, const std::string& name, Eigen::Index rows,
                   Eigen::Index columns, const std::string& unit,
                   const std::string& meaning)
    : set_(new Set{out.file_, name, {}}),
      columns_(columns),
      most_(rows == 0 || columns == 0
                ? 1
                : choose_chunk(static_cast<std::uint64_t>(rows),
                               static_cast<std::uint64_t>(columns))),
      left_(static_cast<std::uint64_t>(rows)) {
  rows_.resize(most_ * static_cast<std::uint64_t>(columns));
  const std::vector<hsize_t> shape = {static_cast<hsize_t>(rows),
                                      static_cast<hsize_t>(columns)};
  const hdf5::Dataset set = {name, H5T_NATIVE_DOUBLE, shape, unit, meaning};
  set_->attempt([&] {
    set_->handle.emplace(hdf5::create_dataset(out.handle_, set, most_));
    hdf5::add_attributes(*set_->handle, set);
  });
}

Hdf5Rows::Hdf5Rows(Hdf5Rows&& other) noexcept = default;

// HDF5 prints what fails while a dataset is closed.
Hdf5Rows::~Hdf5Rows() {
  const hdf5::Quiet quiet;
  set_.reset();
}

Eigen::Map<Eigen::RowVectorXd> Hdf5Rows::next() {
  LIMBER_EXPECT(left_ > 0);
  if (held_ == most_) write();
  --left_;
  return {rows_.data() + static_cast<Eigen::Index>(held_++) * columns_,
          columns_};
}

void Hdf5Rows::write() {
  const hsize_t rows = std::exchange(held_, 0);
  const std::array<hsize_t, 2> start = {
      std::exchange(written_, written_ + rows), 0};
  const std::array<hsize_t, 2> count = {rows, static_cast<hsize_t>(columns_)};
  if (rows == 0 || columns_ == 0) return;
  set_->attempt([&] {
    const hid_t set = set_->handle->get();
    const Handle memory(H5Screate_simple(2, count.data(), nullptr), H5Sclose);
    const Handle file(H5Dget_space(set), H5Sclose);
    checked(H5Sselect_hyperslab(file.get(), H5S_SELECT_SET, start.data(),
                                nullptr, count.data(), nullptr));
    checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, memory.get(), file.get(),
                     H5P_DEFAULT, rows_.data()));
  });
}

void Hdf5Rows::close() {
  LIMBER_EXPECT(left_ == 0);
  write();
  set_->attempt([&] { set_->handle->close(); });
}

}  // namespace limber
