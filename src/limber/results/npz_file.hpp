// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::results {

/// Named arrays as NumPy's `numpy.load` reads them: a zip archive, not
/// compressed, of arrays in its .npy format 1.0.
///
/// Source     NumPy Enhancement Proposal 1; PKWARE APPNOTE 6.3
/// Limits     4 GB in all
class NpzFile {
 public:
  void add(const std::string& name, const MatrixX& matrix);
  /// An array of strings, UTF-8 [-].
  void add(const std::string& name, const std::vector<std::string>& texts);

  /// All bytes of the archive.
  /// @throws ContractError if it is larger than 4 GB.
  [[nodiscard]] std::string bytes() const;

 private:
  struct Member {
    std::string name;
    std::string data;
  };
  void add_array(const std::string& name, const std::string& type,
                 const std::string& shape, std::string data);

  std::vector<Member> members_;
};

}  // namespace limber::results
