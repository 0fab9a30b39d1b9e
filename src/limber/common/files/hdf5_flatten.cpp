// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/hdf5_flatten.hpp"

#include <hdf5.h>

#include <string>
#include <vector>

#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/files/hdf5_handle.hpp"

namespace limber {
namespace {

using hdf5::checked;
using hdf5::Failure;
using hdf5::Handle;

struct NamedDataset {
  std::string name;
  H5T_class_t type;
  std::size_t value_size;
};

std::vector<NamedDataset> list_datasets(hid_t file) {
  std::vector<NamedDataset> found;
  // No exception may pass through HDF5; a negative answer ends the visit.
  const auto look = [](hid_t root, const char* name, const H5L_info_t*,
                       void* out) -> herr_t {
    try {
      const Handle object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
      if (H5Iget_type(object.get()) != H5I_DATASET) return 0;
      const Handle type(H5Dget_type(object.get()), H5Tclose);
      static_cast<std::vector<NamedDataset>*>(out)->push_back(
          {name, H5Tget_class(type.get()), H5Tget_size(type.get())});
      return 0;
    } catch (const Failure&) {
      return -1;
    }
  };
  checked(H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, look, &found));
  return found;
}

std::vector<NamedDataset> list_datasets(const std::filesystem::path& file) {
  return hdf5::with_path(file, [&] {
    const Handle id(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                    H5Fclose);
    return list_datasets(id.get());
  });
}

std::string to_bytes(const void* values, std::size_t size) {
  return size == 0 ? "" : std::string(static_cast<const char*>(values), size);
}

template <typename T>
FlatDataset flatten_matrix(const MatrixX& values, FlatKind kind) {
  const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows =
      values.cast<T>();
  const auto size = static_cast<std::size_t>(rows.size()) * sizeof(T);
  return {"", kind, static_cast<std::uint64_t>(rows.rows()),
          static_cast<std::uint64_t>(rows.cols()), to_bytes(rows.data(), size)};
}

FlatDataset flatten_dataset(const Hdf5File& in, const NamedDataset& set) {
  if (set.type == H5T_STRING) {
    const std::string text = in.read_text(set.name);
    return {"", FlatKind::text, text.size(), 1, text};
  }
  FlatDataset flat;
  if (set.type == H5T_INTEGER) {
    const std::vector<std::int64_t> list = in.read_integers(set.name);
    flat = {"", FlatKind::integers, list.size(), 1,
            to_bytes(list.data(), list.size() * sizeof(std::int64_t))};
  } else if (set.value_size == sizeof(float)) {
    flat = flatten_matrix<float>(in.read_matrix(set.name), FlatKind::singles);
  } else {
    flat = flatten_matrix<double>(in.read_matrix(set.name), FlatKind::doubles);
  }
  flat.unit = in.read_unit(set.name);
  return flat;
}

}  // namespace

FlatFile flatten_hdf5(const std::filesystem::path& file) {
  const Hdf5File in = Hdf5File::open(file);
  FlatFile flat;
  for (const NamedDataset& set : list_datasets(file)) {
    flat.datasets[set.name] = flatten_dataset(in, set);
  }
  return flat;
}

}  // namespace limber
