// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace limber::fem {

/// Initialises and finalises Gmsh, or borrows the caller's session. Gmsh's
/// state is process-wide, so there is one session at a time: a second one
/// waits.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Reads the file into a new model of this session.
  void open(const std::filesystem::path& file);

  /// Lets Gmsh print its log from now on.
  void enable_output();

  /// Gmsh's error messages since the session began.
  [[nodiscard]] std::vector<std::string> errors() const;
  /// Its warnings, likewise.
  [[nodiscard]] std::vector<std::string> warnings() const;
  /// Files that it has read, likewise, as they were named.
  [[nodiscard]] std::vector<std::string> files_read() const;

 private:
  /// What follows `prefix` in the lines of the log that begin with it.
  [[nodiscard]] std::vector<std::string> find_lines(
      std::string_view prefix) const;

  std::unique_lock<std::mutex> lock_;
  bool is_guest_ = false;       ///< whether the session is the caller's
  std::string host_model_;      ///< the caller's current model
  std::size_t host_lines_ = 0;  ///< of its log
  double host_terminal_ = 0.0;
};

}  // namespace limber::fem
