// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_dataset.hpp"
#include "limber/common/files/hdf5_exit.hpp"
#include "limber/common/files/hdf5_handle.hpp"
#include "limber/common/files/hdf5_inside.hpp"
#include "limber/common/files/input_file.hpp"

namespace limber {
namespace {

using hdf5::checked;
using hdf5::create_dataset;
using hdf5::Dataset;
using hdf5::Failure;
using hdf5::Handle;
using hdf5::leave_out_times;
using hdf5::Quiet;
using hdf5::with_path;

// Generous, since histories of many bodies are large.
constexpr InputKind kHdf5 = {"HDF5 file", std::uint64_t{1} << 38};

using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void write_checked(hid_t file, const Dataset& values, const void* data) {
  Handle set = create_dataset(file, values);
  if (!values.is_empty()) {
    checked(
        H5Dwrite(set.get(), values.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
  }
  hdf5::add_attributes(set, values);
  set.close();
}

void write_dataset(hid_t file, const Dataset& values, const void* data) {
  try {
    write_checked(file, values, data);
  } catch (const Failure&) {
    throw hdf5::cannot_write(values.name);
  }
}

Handle open_dataset(hid_t file, const std::string& name) {
  const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  if (set < 0) throw Failure(fmt::format("it has no '{}'", name));
  return {set, H5Dclose};
}

void check_class(hid_t set, H5T_class_t expected, const std::string& name,
                 const char* kind) {
  const Handle type(H5Dget_type(set), H5Tclose);
  if (H5Tget_class(type.get()) != expected) {
    throw Failure(fmt::format("'{}' is not {}", name, kind));
  }
}

std::vector<hsize_t> shape_of(hid_t set, const std::string& name) {
  const Handle space(H5Dget_space(set), H5Sclose);
  const int rank = checked(H5Sget_simple_extent_ndims(space.get()));
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  if (rank > 0) {
    checked(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr));
  }
  // With one extent 0 the others may be too large for a matrix index.
  for (const hsize_t n : shape) {
    if (n > hsize_t{std::numeric_limits<Eigen::Index>::max()}) {
      throw Failure(
          fmt::format("'{}' claims {} entries along one axis; it is "
                      "damaged",
                      name, n));
    }
  }
  return shape;
}

// Bytes of a shape's elements; the largest value on overflow.
hsize_t bytes_of(const std::vector<hsize_t>& shape, hsize_t element) {
  const hsize_t limit = std::numeric_limits<hsize_t>::max();
  if (std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end()) {
    return 0;
  }
  hsize_t bytes = element;
  for (const hsize_t n : shape) {
    if (bytes > limit / n) return limit;
    bytes *= n;
  }
  return bytes;
}

// Allocates only what the file can contain: a damaged shape may have any size.
// (Compression filters would need another bound; we use none.)
void check_fits(hid_t set, const std::vector<hsize_t>& shape,
                const std::string& name) {
  const Handle type(H5Dget_type(set), H5Tclose);
  const Handle file(H5Iget_file_id(set), H5Fclose);
  hsize_t file_size = 0;
  checked(H5Fget_filesize(file.get(), &file_size));
  const hsize_t stored = std::min(file_size, H5Dget_storage_size(set));
  const hsize_t claimed = bytes_of(shape, H5Tget_size(type.get()));
  if (claimed > stored) {
    throw Failure(
        fmt::format("'{}' claims {} bytes, but the file holds {} of it; it is "
                    "damaged",
                    name, claimed, stored));
  }
}

void read_dataset(hid_t set, hid_t type, void* out, const std::string& name) {
  if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) < 0) {
    throw Failure(
        fmt::format("'{}' is damaged (its checksum does not match)", name));
  }
}

MatrixX read_matrix_of(hid_t file, const std::string& name) {
  const Handle set = open_dataset(file, name);
  check_class(set.get(), H5T_FLOAT, name, "a matrix of numbers");
  const std::vector<hsize_t> shape = shape_of(set.get(), name);
  if (shape.size() != 2) {
    throw Failure(fmt::format("'{}' is not a matrix", name));
  }
  check_fits(set.get(), shape, name);
  RowMajor rows(static_cast<Eigen::Index>(shape[0]),
                static_cast<Eigen::Index>(shape[1]));
  if (rows.size() > 0) {
    read_dataset(set.get(), H5T_NATIVE_DOUBLE, rows.data(), name);
  }
  return rows;
}

std::vector<std::int64_t> read_integers_of(hid_t file,
                                           const std::string& name) {
  const Handle set = open_dataset(file, name);
  check_class(set.get(), H5T_INTEGER, name, "a list of integers");
  const std::vector<hsize_t> shape = shape_of(set.get(), name);
  if (shape.size() != 1) {
    throw Failure(fmt::format("'{}' is not a list", name));
  }
  check_fits(set.get(), shape, name);
  std::vector<std::int64_t> values(shape[0]);
  if (!values.empty()) {
    read_dataset(set.get(), H5T_NATIVE_INT64, values.data(), name);
  }
  return values;
}

std::string read_text_of(hid_t file, const std::string& name) {
  const Handle set = open_dataset(file, name);
  check_class(set.get(), H5T_STRING, name, "a text");
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const std::vector<hsize_t> shape = shape_of(set.get(), name);
  if (!shape.empty() || checked(H5Tis_variable_str(type.get())) > 0) {
    throw Failure(fmt::format("'{}' is not one text of fixed length", name));
  }
  check_fits(set.get(), shape, name);
  std::string text(H5Tget_size(type.get()), '\0');
  read_dataset(set.get(), type.get(), text.data(), name);
  // `write` appends one zero to a text, which may contain others.
  if (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

std::string read_unit_of(hid_t file, const std::string& name) {
  const Handle set = open_dataset(file, name);
  if (H5Aexists(set.get(), "unit") <= 0) {
    throw Failure(fmt::format("'{}' has no unit", name));
  }
  const Handle attribute(H5Aopen(set.get(), "unit", H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  constexpr std::size_t kMostBytes = 1000;
  if (H5Tget_class(type.get()) != H5T_STRING ||
      checked(H5Tis_variable_str(type.get())) > 0 ||
      H5Tget_size(type.get()) > kMostBytes) {
    throw Failure(fmt::format("'{}' has no unit as text", name));
  }
  std::string text(H5Tget_size(type.get()), '\0');
  checked(H5Aread(attribute.get(), type.get(), text.data()));
  return text.substr(0, text.find('\0'));
}

std::vector<std::string> list_of(hid_t file, const std::string& group) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*,
                      void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  const Handle id(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose);
  checked(
      H5Literate(id.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names));
  return names;
}

hid_t create_file(const std::filesystem::path& file, std::uint64_t user_block) {
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  checked(H5Pset_userblock(creation.get(), user_block));
  leave_out_times(creation.get());
  return H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.get(), H5P_DEFAULT);
}

std::uint64_t count_entries(const std::vector<std::uint64_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1},
                         std::multiplies<>());
}

}  // namespace

void leave_hdf5_alone_at_exit() { H5dont_atexit(); }

Hdf5File::Hdf5File(std::int64_t handle, std::filesystem::path file)
    : handle_(handle), file_(std::move(file)) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : handle_(std::exchange(other.handle_, -1)),
      file_(std::move(other.file_)) {}

Hdf5File::~Hdf5File() {
  if (handle_ < 0) return;
  const Quiet quiet;
  H5Fclose(handle_);
}

Hdf5File Hdf5File::create(const std::filesystem::path& file,
                          std::uint64_t user_block) {
  LIMBER_EXPECT(user_block == 0 ||
                (user_block >= 512 && std::has_single_bit(user_block)));
  const hid_t id =
      with_path(file, [&] { return create_file(file, user_block); });
  if (id < 0) {
    throw InputError(fmt::format(
        "'{}' cannot be written; does its folder exist, and is it writable?",
        file.string()));
  }
  return {id, file};
}

Hdf5File Hdf5File::open(const std::filesystem::path& file) {
  check_input(file, kHdf5);
  const Quiet quiet;
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) {
    throw InputError(fmt::format("'{}' is not an HDF5 file, or it is truncated",
                                 file.string()));
  }
  Hdf5File opened(id, file);
  with_path(file, [&] { hdf5::check_inside(id); });
  return opened;
}

void Hdf5File::write(const std::string& name, const MatrixX& values,
                     const std::string& unit, const std::string& meaning) {
  const RowMajor rows = values;
  const std::vector<hsize_t> shape = {static_cast<hsize_t>(rows.rows()),
                                      static_cast<hsize_t>(rows.cols())};
  with_path(file_, [&] {
    write_dataset(handle_, {name, H5T_NATIVE_DOUBLE, shape, unit, meaning},
                  rows.data());
  });
}

void Hdf5File::write_single(const std::string& name, const MatrixX& values,
                            const std::string& unit,
                            const std::string& meaning) {
  using Singles =
      Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Singles rows = values.cast<float>();
  const std::vector<hsize_t> shape = {static_cast<hsize_t>(rows.rows()),
                                      static_cast<hsize_t>(rows.cols())};
  with_path(file_, [&] {
    write_dataset(handle_, {name, H5T_NATIVE_FLOAT, shape, unit, meaning},
                  rows.data());
  });
}

void Hdf5File::write(const std::string& name,
                     const std::vector<std::int64_t>& values,
                     const std::string& unit, const std::string& meaning) {
  const std::vector<hsize_t> shape = {values.size()};
  with_path(file_, [&] {
    write_dataset(handle_, {name, H5T_NATIVE_INT64, shape, unit, meaning},
                  values.data());
  });
}

void Hdf5File::write(const std::string& name, const std::string& text,
                     const std::string& meaning) {
  with_path(file_, [&] {
    const Handle type = hdf5::make_text_type(text);
    write_dataset(handle_, {name, type.get(), {}, "", meaning}, text.c_str());
  });
}

void Hdf5File::write_array(const std::string& name,
                           const std::vector<double>& values,
                           const std::vector<std::uint64_t>& shape,
                           const std::string& unit,
                           const std::string& meaning) {
  LIMBER_EXPECT(values.size() == count_entries(shape));
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  with_path(file_, [&] {
    write_dataset(handle_, {name, H5T_NATIVE_DOUBLE, extents, unit, meaning},
                  values.data());
  });
}

void Hdf5File::write_array(const std::string& name,
                           const std::vector<std::int64_t>& values,
                           const std::vector<std::uint64_t>& shape,
                           const std::string& unit,
                           const std::string& meaning) {
  LIMBER_EXPECT(values.size() == count_entries(shape));
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  with_path(file_, [&] {
    write_dataset(handle_, {name, H5T_NATIVE_INT64, extents, unit, meaning},
                  values.data());
  });
}

bool Hdf5File::has(const std::string& name) const {
  // An error here means that a parent group does not exist.
  const Quiet quiet;
  return H5Lexists(handle_, name.c_str(), H5P_DEFAULT) > 0;
}

MatrixX Hdf5File::read_matrix(const std::string& name) const {
  return with_path(file_, [&] { return read_matrix_of(handle_, name); });
}

std::vector<std::int64_t> Hdf5File::read_integers(
    const std::string& name) const {
  return with_path(file_, [&] { return read_integers_of(handle_, name); });
}

std::string Hdf5File::read_text(const std::string& name) const {
  return with_path(file_, [&] { return read_text_of(handle_, name); });
}

std::string Hdf5File::read_unit(const std::string& name) const {
  return with_path(file_, [&] { return read_unit_of(handle_, name); });
}

std::vector<std::string> Hdf5File::list(const std::string& group) const {
  if (!has(group)) return {};
  return with_path(file_, [&] { return list_of(handle_, group); });
}

void Hdf5File::close() {
  const Quiet quiet;
  const std::int64_t handle = std::exchange(handle_, -1);
  if (handle >= 0 && H5Fclose(handle) < 0) {
    throw InputError(fmt::format("'{}': cannot be closed; is the disk full?",
                                 file_.string()));
  }
}

}  // namespace limber
