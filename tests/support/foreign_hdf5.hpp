// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if __has_include(<hdf5.h>)
#include <hdf5.h>
#else  // Debian's path, beside the parallel variants
#include <hdf5/serial/hdf5.h>
#endif

#include <filesystem>
#include <stdexcept>
#include <string>

namespace limber::test {

/// Files as somebody else may make them, with the HDF5 library alone: an object
/// of a file is replaced by one whose values are elsewhere.
class ForeignHdf5 {
 public:
  explicit ForeignHdf5(const std::filesystem::path& file)
      : file_(checked(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT))) {}
  ForeignHdf5(const ForeignHdf5&) = delete;
  ForeignHdf5& operator=(const ForeignHdf5&) = delete;
  ~ForeignHdf5() { H5Fclose(file_); }

  /// By a link to `target` of another file.
  void link_outside(const std::string& name, const std::string& other,
                    const std::string& target) const {
    checked(H5Ldelete(file_, name.c_str(), H5P_DEFAULT));
    checked(H5Lcreate_external(other.c_str(), target.c_str(), file_,
                               name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  }
  /// By a soft link to `target` of the same file.
  void link_inside(const std::string& name, const std::string& target) const {
    checked(H5Ldelete(file_, name.c_str(), H5P_DEFAULT));
    checked(H5Lcreate_soft(target.c_str(), file_, name.c_str(), H5P_DEFAULT,
                           H5P_DEFAULT));
  }
  /// A second, hard link to an object.
  void link_again(const std::string& name, const std::string& also) const {
    checked(H5Lcreate_hard(file_, name.c_str(), file_, also.c_str(),
                           H5P_DEFAULT, H5P_DEFAULT));
  }
  void move(const std::string& name, const std::string& to) const {
    checked(H5Lmove(file_, name.c_str(), file_, to.c_str(), H5P_DEFAULT,
                    H5P_DEFAULT));
  }
  /// By bytes of another file of any kind.
  void store_outside(const std::string& name, const std::string& other) const {
    replace(name, [&](hid_t creation, hid_t space) {
      (void)space;
      checked(H5Pset_external(creation, other.c_str(), 0, H5F_UNLIMITED));
    });
  }
  /// By a view of the data set `source`; "." is this file.
  void map_virtually(const std::string& name, const std::string& other,
                     const std::string& source) const {
    replace(name, [&](hid_t creation, hid_t space) {
      checked(H5Pset_virtual(creation, space, other.c_str(), source.c_str(),
                             space));
    });
  }

 private:
  template <typename Answer>
  static Answer checked(Answer answer) {
    if (answer < 0) throw std::runtime_error("HDF5 reports an error");
    return answer;
  }

  // With the type and shape of the old one.
  template <typename Layout>
  void replace(const std::string& name, const Layout& lay_out) const {
    const hid_t old = checked(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
    const hid_t type = checked(H5Dget_type(old));
    const hid_t space = checked(H5Dget_space(old));
    H5Dclose(old);
    checked(H5Ldelete(file_, name.c_str(), H5P_DEFAULT));
    const hid_t creation = checked(H5Pcreate(H5P_DATASET_CREATE));
    lay_out(creation, space);
    H5Dclose(checked(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT,
                                creation, H5P_DEFAULT)));
    H5Pclose(creation);
    H5Sclose(space);
    H5Tclose(type);
  }

  hid_t file_;
};

}  // namespace limber::test
