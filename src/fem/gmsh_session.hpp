// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <string>
#include <vector>

namespace limber::fem {

/// Gmsh, opened and closed. Gmsh keeps its model in process-wide variables,
/// so one session at a time: a second one waits.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// What Gmsh complained of since the session began (errors only).
  [[nodiscard]] std::vector<std::string> errors() const;

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace limber::fem
