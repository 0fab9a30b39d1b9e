// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace limber::fem {

/// Gmsh, opened and closed, or a caller's own session of it, in which models
/// are ours for a while. Gmsh keeps all in process-wide variables, so one
/// session at a time: a second one waits.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Reads the file into a model of this session's own.
  void open(const std::filesystem::path& file);

  /// From now on Gmsh also prints what it does.
  void speak();

  /// What Gmsh complained of since the session began (errors only).
  [[nodiscard]] std::vector<std::string> errors() const;

 private:
  std::unique_lock<std::mutex> lock_;
  bool is_guest_ = false;       ///< in a session of the caller's
  std::string host_model_;      ///< current before we came
  std::size_t host_lines_ = 0;  ///< of its log
  double host_terminal_ = 0.0;
};

}  // namespace limber::fem
