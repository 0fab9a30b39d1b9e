// SPDX-License-Identifier: BSD-3-Clause
#include "raw_hdf5.hpp"

#if __has_include(<hdf5.h>)
#include <hdf5.h>
#else  // Debian's path, beside the parallel variants
#include <hdf5/serial/hdf5.h>
#endif

#include <stdexcept>

namespace limber::results::test {
namespace {

template <typename Answer>
Answer checked(Answer answer) {
  if (answer < 0) throw std::runtime_error("HDF5 reports an error");
  return answer;
}

std::string read_text_attribute(hid_t set, const std::string& name) {
  const hid_t attribute = checked(H5Aopen(set, name.c_str(), H5P_DEFAULT));
  const hid_t type = checked(H5Aget_type(attribute));
  std::string text(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, text.data()));
  H5Tclose(type);
  H5Aclose(attribute);
  return text.substr(0, text.find('\0'));
}

RawDataset read_dataset(hid_t set) {
  RawDataset data;
  const hid_t space = checked(H5Dget_space(set));
  data.shape.resize(
      static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space))));
  std::vector<hsize_t> shape(data.shape.size());
  if (!shape.empty()) {
    checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
  }
  data.shape.assign(shape.begin(), shape.end());
  const auto entries =
      static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space)));
  H5Sclose(space);
  const hid_t type = checked(H5Dget_type(set));
  const H5T_class_t kind = H5Tget_class(type);
  H5Tclose(type);
  if (kind == H5T_FLOAT) {
    data.numbers.resize(entries);
    checked(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                    data.numbers.data()));
  } else if (kind == H5T_INTEGER) {
    data.integers.resize(entries);
    checked(H5Dread(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                    data.integers.data()));
  }
  for (const char* name : {"unit", "meaning"}) {
    if (checked(H5Aexists(set, name)) > 0) {
      data.attributes[name] = read_text_attribute(set, name);
    }
  }
  return data;
}

}  // namespace

std::map<std::string, RawDataset> read_all_datasets(
    const std::filesystem::path& file) {
  const hid_t id = checked(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*,
                      void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  checked(H5Lvisit(id, H5_INDEX_NAME, H5_ITER_INC, add, &names));
  std::map<std::string, RawDataset> all;
  for (const std::string& name : names) {
    const hid_t object = checked(H5Oopen(id, name.c_str(), H5P_DEFAULT));
    if (H5Iget_type(object) == H5I_DATASET) all[name] = read_dataset(object);
    H5Oclose(object);
  }
  H5Fclose(id);
  return all;
}

}  // namespace limber::results::test
