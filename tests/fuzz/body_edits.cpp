// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/body_edits.hpp"

#include <hdf5.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <map>
#include <numeric>
#include <sstream>
#include <vector>

#include "limber/flexbody/file/body_file.hpp"
#include "unit/flexbody/files.hpp"
#include "unit/flexbody/small_body.hpp"

namespace limber::fuzz {
namespace {

constexpr hsize_t kMostEntries = 4096;

// "3x0x2" to its numbers; ends at anything that is not a number.
std::vector<hsize_t> parse_shape(const std::string& text) {
  std::vector<hsize_t> shape;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end && shape.size() < H5S_MAX_RANK) {
    hsize_t extent = 0;
    const auto [after, error] = std::from_chars(at, end, extent);
    if (error != std::errc()) break;
    shape.push_back(extent);
    at = after + 1;
  }
  return shape;
}

bool is_small(const std::vector<hsize_t>& shape) {
  hsize_t entries = 1;
  for (const hsize_t n : shape) {
    if (n > kMostEntries) return false;
    entries *= n;
    if (entries > kMostEntries) return false;
  }
  return true;
}

// All but the seal, which no reader of HDF5 minds.
class Editor {
 public:
  explicit Editor(const std::filesystem::path& file)
      : file_(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)),
        links_(H5Pcreate(H5P_LINK_CREATE)) {
    H5Pset_create_intermediate_group(links_, 1);
  }
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;
  ~Editor() {
    H5Pclose(links_);
    H5Fclose(file_);
  }

  void edit(const std::string& line) {
    std::istringstream words(line);
    std::string name;
    std::string kind;
    if (!(words >> name >> kind)) return;
    H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
    if (kind == "text") {
      std::string text;
      std::getline(words >> std::ws, text);
      write_text(name, text);
    } else if (types_.count(kind) != 0) {
      std::string shape;
      words >> shape;
      write_numbers(name, types_.at(kind), parse_shape(shape), words);
    }
  }

 private:
  void write_text(const std::string& name, const std::string& text) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, text.size() + 1);
    write(name, type, {}, text.c_str(), type);
    H5Tclose(type);
  }

  void write_numbers(const std::string& name, hid_t type,
                     const std::vector<hsize_t>& shape,
                     std::istringstream& words) {
    std::vector<double> values;
    for (std::string word; values.size() < kMostEntries && words >> word;) {
      values.push_back(std::strtod(word.c_str(), nullptr));
    }
    values.resize(kMostEntries, 0.0);
    write(name, type, shape, values.data(), H5T_NATIVE_DOUBLE);
  }

  void write(const std::string& name, hid_t type,
             const std::vector<hsize_t>& shape, const void* data,
             hid_t data_type) {
    const hid_t space = shape.empty()
                            ? H5Screate(H5S_SCALAR)
                            : H5Screate_simple(static_cast<int>(shape.size()),
                                               shape.data(), nullptr);
    const hid_t set = H5Dcreate2(file_, name.c_str(), type, space, links_,
                                 H5P_DEFAULT, H5P_DEFAULT);
    if (set >= 0) {
      if (is_small(shape)) {
        H5Dwrite(set, data_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
      }
      H5Dclose(set);
    }
    if (space >= 0) H5Sclose(space);
  }

  hid_t file_;
  hid_t links_;
  const std::map<std::string, hid_t> types_ = {{"f64", H5T_NATIVE_DOUBLE},
                                               {"f32", H5T_NATIVE_FLOAT},
                                               {"i64", H5T_NATIVE_INT64},
                                               {"u64", H5T_NATIVE_UINT64},
                                               {"i8", H5T_NATIVE_INT8}};
};

std::string make_body_bytes() {
  const flexbody::test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "body.h5";
  flexbody::write_body(flexbody::test::make_small_body(2), file);
  return flexbody::test::read_bytes(file);
}

}  // namespace

const std::string& find_body_bytes() {
  static const std::string bytes = make_body_bytes();
  return bytes;
}

void apply_edits(std::string_view edits, const std::filesystem::path& file) {
  Editor editor(file);
  std::istringstream lines{std::string(edits)};
  for (std::string line; std::getline(lines, line);) editor.edit(line);
}

}  // namespace limber::fuzz
