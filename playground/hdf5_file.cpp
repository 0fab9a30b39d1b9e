// SPDX-License-Identifier: BSD-3-Clause
// Hdf5File without HDF5: the same datasets in flat files, in place of
// src/limber/common/files/hdf5_file.cpp. A file that is written is one map
// until it is closed.
#include "limber/common/files/hdf5_file.hpp"

#include <fmt/format.h>

#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/files/flat_file.hpp"
#include "limber/flexbody/file/body_seal.hpp"

namespace limber {
namespace {

struct OpenFile {
  FlatFile content;
  bool is_new = false;
};

// Hdf5File holds a handle alone.
std::map<std::int64_t, OpenFile>& open_files() {
  static std::map<std::int64_t, OpenFile> files;
  return files;
}

std::int64_t add_file(OpenFile file) {
  static std::int64_t next = 0;
  open_files().emplace(next, std::move(file));
  return next++;
}

[[noreturn]] void refuse(const std::filesystem::path& file,
                         const std::string& why) {
  throw InputError(fmt::format("'{}': {}", file.string(), why));
}

const FlatDataset& find_dataset(std::int64_t handle,
                                const std::filesystem::path& file,
                                const std::string& name) {
  const auto& sets = open_files().at(handle).content.datasets;
  const auto found = sets.find(name);
  if (found == sets.end()) refuse(file, fmt::format("it has no '{}'", name));
  return found->second;
}

template <typename T>
void store(std::int64_t handle, const std::string& name, FlatKind kind,
           std::uint64_t rows, std::uint64_t columns, const T* values,
           const std::string& unit) {
  const auto size = static_cast<std::size_t>(rows * columns) * sizeof(T);
  FlatDataset set{unit, kind, rows, columns, std::string(size, '\0')};
  if (size > 0) std::memcpy(set.bytes.data(), values, size);
  open_files().at(handle).content.datasets[name] = std::move(set);
}

template <typename T>
using RowsOf =
    Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <typename T>
MatrixX to_matrix(const FlatDataset& set) {
  RowsOf<T> rows(static_cast<Eigen::Index>(set.rows),
                 static_cast<Eigen::Index>(set.columns));
  if (!set.bytes.empty()) {
    std::memcpy(rows.data(), set.bytes.data(), set.bytes.size());
  }
  return rows.template cast<double>();
}

}  // namespace

Hdf5File::Hdf5File(std::int64_t handle, std::filesystem::path file)
    : handle_(handle), file_(std::move(file)) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : handle_(std::exchange(other.handle_, -1)),
      file_(std::move(other.file_)) {}

Hdf5File::~Hdf5File() { open_files().erase(handle_); }

Hdf5File Hdf5File::create(const std::filesystem::path& file,
                          std::uint64_t user_block) {
  const std::string block(static_cast<std::size_t>(user_block), '\0');
  return {add_file({{block, {}}, true}), file};
}

Hdf5File Hdf5File::open(const std::filesystem::path& file) {
  const std::size_t user_block = is_flat(file, 0) ? 0 : flexbody::kBodySealSize;
  return {add_file({read_flat(file, user_block), false}), file};
}

void Hdf5File::write(const std::string& name, const MatrixX& values,
                     const std::string& unit, const std::string&) {
  const RowsOf<double> rows = values;
  store(handle_, name, FlatKind::doubles, rows.rows(), rows.cols(), rows.data(),
        unit);
}

void Hdf5File::write_single(const std::string& name, const MatrixX& values,
                            const std::string& unit, const std::string&) {
  const RowsOf<float> rows = values.cast<float>();
  store(handle_, name, FlatKind::singles, rows.rows(), rows.cols(), rows.data(),
        unit);
}

void Hdf5File::write(const std::string& name,
                     const std::vector<std::int64_t>& values,
                     const std::string& unit, const std::string&) {
  store(handle_, name, FlatKind::integers, values.size(), 1, values.data(),
        unit);
}

void Hdf5File::write(const std::string& name, const std::string& text,
                     const std::string&) {
  store(handle_, name, FlatKind::text, text.size(), 1, text.data(), "");
}

void Hdf5File::write_array(const std::string& name,
                           const std::vector<double>& values,
                           const std::vector<std::uint64_t>& shape,
                           const std::string& unit, const std::string&) {
  const std::uint64_t rows = shape.empty() ? 1 : shape[0];
  store(handle_, name, FlatKind::doubles, rows,
        rows > 0 ? values.size() / rows : 0, values.data(), unit);
}

void Hdf5File::write_array(const std::string& name,
                           const std::vector<std::int64_t>& values,
                           const std::vector<std::uint64_t>&,
                           const std::string& unit, const std::string&) {
  store(handle_, name, FlatKind::integers, values.size(), 1, values.data(),
        unit);
}

bool Hdf5File::has(const std::string& name) const {
  const auto& sets = open_files().at(handle_).content.datasets;
  const auto inside = sets.lower_bound(name + "/");
  return sets.contains(name) ||
         (inside != sets.end() && inside->first.starts_with(name + "/"));
}

MatrixX Hdf5File::read_matrix(const std::string& name) const {
  const FlatDataset& set = find_dataset(handle_, file_, name);
  if (set.kind == FlatKind::doubles) return to_matrix<double>(set);
  if (set.kind == FlatKind::singles) return to_matrix<float>(set);
  refuse(file_, fmt::format("'{}' is not a matrix of numbers", name));
}

std::vector<std::int64_t> Hdf5File::read_integers(
    const std::string& name) const {
  const FlatDataset& set = find_dataset(handle_, file_, name);
  if (set.kind != FlatKind::integers) {
    refuse(file_, fmt::format("'{}' is not a list of integers", name));
  }
  std::vector<std::int64_t> values(set.bytes.size() / sizeof(std::int64_t));
  if (!values.empty()) {
    std::memcpy(values.data(), set.bytes.data(), set.bytes.size());
  }
  return values;
}

std::string Hdf5File::read_text(const std::string& name) const {
  const FlatDataset& set = find_dataset(handle_, file_, name);
  if (set.kind != FlatKind::text) {
    refuse(file_, fmt::format("'{}' is not a text", name));
  }
  return set.bytes;
}

std::string Hdf5File::read_unit(const std::string& name) const {
  return find_dataset(handle_, file_, name).unit;
}

std::vector<std::string> Hdf5File::list(const std::string& group) const {
  const std::string start = group + "/";
  std::set<std::string> names;
  for (const auto& [name, set] : open_files().at(handle_).content.datasets) {
    if (!name.starts_with(start)) continue;
    const std::size_t end = name.find('/', start.size());
    names.insert(name.substr(start.size(), end - start.size()));
  }
  return {names.begin(), names.end()};
}

void Hdf5File::close() {
  const auto found = open_files().find(std::exchange(handle_, -1));
  if (found == open_files().end()) return;
  const OpenFile file = std::move(found->second);
  open_files().erase(found);
  if (file.is_new) write_flat(file_, file.content);
}

}  // namespace limber
