// SPDX-License-Identifier: BSD-3-Clause
#include "common/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "common/errors.hpp"

namespace limber {
namespace {

using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Closes an HDF5 identifier of any kind.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool is_valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

// HDF5 prints its own error stack otherwise; ours is the one clear text.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

void add_text_attribute(hid_t object, const char* name,
                        const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(1, text.size()));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type.get(), space.get(),
                                    H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  H5Awrite(attribute.get(), type.get(), text.c_str());
}

// Creates, fills and describes one dataset. @returns false on any failure.
bool write_dataset(hid_t file, const std::string& name, hid_t type,
                   const std::vector<hsize_t>& shape, const void* data,
                   const std::string& unit, const std::string& meaning) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.get(), 1);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const bool is_empty =
      std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end();
  if (!shape.empty() && !is_empty) {
    // A checksum needs chunks: one for the whole, up to HDF5's size limit.
    std::vector<hsize_t> chunk = shape;
    const hsize_t most = hsize_t{1} << 26;
    const hsize_t row = std::accumulate(chunk.begin() + 1, chunk.end(),
                                        hsize_t{8}, std::multiplies<>());
    chunk[0] = std::clamp(most / row, hsize_t{1}, chunk[0]);
    H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_fletcher32(creation.get());
  }
  const Handle space(shape.empty()
                         ? H5Screate(H5S_SCALAR)
                         : H5Screate_simple(static_cast<int>(shape.size()),
                                            shape.data(), nullptr),
                     H5Sclose);
  const Handle set(H5Dcreate2(file, name.c_str(), type, space.get(),
                              links.get(), creation.get(), H5P_DEFAULT),
                   H5Dclose);
  if (!set.is_valid()) return false;
  if (!is_empty &&
      H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    return false;
  }
  if (!unit.empty()) add_text_attribute(set.get(), "unit", unit);
  add_text_attribute(set.get(), "meaning", meaning);
  return true;
}

std::vector<hsize_t> shape_of(hid_t set) {
  const Handle space(H5Dget_space(set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) {
    H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  }
  return shape;
}

bool has_class(hid_t set, H5T_class_t expected) {
  const Handle type(H5Dget_type(set), H5Tclose);
  return H5Tget_class(type.get()) == expected;
}

}  // namespace

Hdf5File::Hdf5File(std::int64_t handle, std::filesystem::path file)
    : handle_(handle), file_(std::move(file)) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : handle_(std::exchange(other.handle_, -1)),
      file_(std::move(other.file_)) {}

Hdf5File::~Hdf5File() {
  if (handle_ >= 0) H5Fclose(handle_);
}

void Hdf5File::fail(const std::string& what) const {
  throw InputError(fmt::format("'{}': {}", file_.string(), what));
}

Hdf5File Hdf5File::create(const std::filesystem::path& file) {
  silence();
  const hid_t id =
      H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (id < 0) {
    throw InputError(fmt::format(
        "'{}' cannot be written; does its folder exist, and may you write "
        "there?",
        file.string()));
  }
  return {id, file};
}

Hdf5File Hdf5File::open(const std::filesystem::path& file) {
  silence();
  if (!std::filesystem::exists(file)) {
    throw InputError(fmt::format("'{}' does not exist", file.string()));
  }
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) {
    throw InputError(fmt::format("'{}' is not an HDF5 file, or it is truncated",
                                 file.string()));
  }
  return {id, file};
}

void Hdf5File::write(const std::string& name, const MatrixX& values,
                     const std::string& unit, const std::string& meaning) {
  const RowMajor rows = values;
  if (!write_dataset(handle_, name, H5T_NATIVE_DOUBLE,
                     {static_cast<hsize_t>(rows.rows()),
                      static_cast<hsize_t>(rows.cols())},
                     rows.data(), unit, meaning)) {
    fail(fmt::format("'{}' cannot be written; is the disk full?", name));
  }
}

void Hdf5File::write(const std::string& name,
                     const std::vector<std::int64_t>& values,
                     const std::string& unit, const std::string& meaning) {
  if (!write_dataset(handle_, name, H5T_NATIVE_INT64, {values.size()},
                     values.data(), unit, meaning)) {
    fail(fmt::format("'{}' cannot be written; is the disk full?", name));
  }
}

void Hdf5File::write(const std::string& name, const std::string& text,
                     const std::string& meaning) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), text.size() + 1);
  if (!write_dataset(handle_, name, type.get(), {}, text.c_str(), "",
                     meaning)) {
    fail(fmt::format("'{}' cannot be written; is the disk full?", name));
  }
}

void Hdf5File::write_array(const std::string& name,
                           const std::vector<double>& values,
                           const std::vector<std::uint64_t>& shape,
                           const std::string& unit,
                           const std::string& meaning) {
  LIMBER_EXPECT(values.size() == std::accumulate(shape.begin(), shape.end(),
                                                 std::uint64_t{1},
                                                 std::multiplies<>()));
  if (!write_dataset(handle_, name, H5T_NATIVE_DOUBLE,
                     {shape.begin(), shape.end()}, values.data(), unit,
                     meaning)) {
    fail(fmt::format("'{}' cannot be written; is the disk full?", name));
  }
}

bool Hdf5File::has(const std::string& name) const {
  return H5Lexists(handle_, name.c_str(), H5P_DEFAULT) > 0;
}

MatrixX Hdf5File::read_matrix(const std::string& name) const {
  const Handle set(H5Dopen2(handle_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.is_valid() || !has_class(set.get(), H5T_FLOAT)) {
    fail(fmt::format("it has no matrix '{}'", name));
  }
  const std::vector<hsize_t> shape = shape_of(set.get());
  if (shape.size() != 2) fail(fmt::format("'{}' is not a matrix", name));
  RowMajor rows(static_cast<Eigen::Index>(shape[0]),
                static_cast<Eigen::Index>(shape[1]));
  if (rows.size() > 0 && H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL,
                                 H5P_DEFAULT, rows.data()) < 0) {
    fail(fmt::format("'{}' is damaged (its checksum does not match)", name));
  }
  return rows;
}

std::vector<std::int64_t> Hdf5File::read_integers(
    const std::string& name) const {
  const Handle set(H5Dopen2(handle_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.is_valid() || !has_class(set.get(), H5T_INTEGER)) {
    fail(fmt::format("it has no integers '{}'", name));
  }
  const std::vector<hsize_t> shape = shape_of(set.get());
  if (shape.size() != 1) fail(fmt::format("'{}' is not a list", name));
  std::vector<std::int64_t> values(shape[0]);
  if (!values.empty() && H5Dread(set.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL,
                                 H5P_DEFAULT, values.data()) < 0) {
    fail(fmt::format("'{}' is damaged (its checksum does not match)", name));
  }
  return values;
}

std::string Hdf5File::read_text(const std::string& name) const {
  const Handle set(H5Dopen2(handle_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.is_valid() || !has_class(set.get(), H5T_STRING)) {
    fail(fmt::format("it has no text '{}'", name));
  }
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  std::string text(H5Tget_size(type.get()), '\0');
  if (H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
              text.data()) < 0) {
    fail(fmt::format("'{}' is damaged", name));
  }
  text.resize(std::min(text.size(), text.find('\0')));
  return text;
}

std::vector<std::string> Hdf5File::list(const std::string& group) const {
  std::vector<std::string> names;
  if (!has(group)) return names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*,
                      void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  const Handle id(H5Gopen2(handle_, group.c_str(), H5P_DEFAULT), H5Gclose);
  H5Literate(id.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
  return names;
}

void Hdf5File::close() {
  const std::int64_t handle = std::exchange(handle_, -1);
  if (handle >= 0 && H5Fclose(handle) < 0) {
    fail("cannot be closed; is the disk full?");
  }
}

}  // namespace limber
