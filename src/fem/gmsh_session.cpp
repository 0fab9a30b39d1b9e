// SPDX-License-Identifier: BSD-3-Clause
#include "fem/gmsh_session.hpp"

#include <gmsh.h>

namespace limber::fem {
namespace {
std::mutex& gmsh_mutex() {
  static std::mutex mutex;
  return mutex;
}
}  // namespace

GmshSession::GmshSession() : lock_(gmsh_mutex()) {
  // A user's ~/.gmshrc must not change what a body is.
  constexpr bool kReadConfigFiles = false;
  gmsh::initialize(0, nullptr, kReadConfigFiles);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::logger::start();
}

GmshSession::~GmshSession() {
  try {
    gmsh::logger::stop();
    gmsh::finalize();
  } catch (...) {  // NOLINT: nothing is left to be done with it
  }
}

std::vector<std::string> GmshSession::errors() const {
  constexpr std::string_view kPrefix = "Error: ";
  // Gmsh says so of third-order prisms. Closures tell how the faces of two
  // elements match in Gmsh's own solvers; nothing here uses them.
  constexpr std::string_view kHarmless = "Error: FaceClosureFull";
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::vector<std::string> errors;
  for (const std::string& line : log)
    if (line.starts_with(kPrefix) && !line.starts_with(kHarmless))
      errors.push_back(line.substr(kPrefix.size()));
  return errors;
}

}  // namespace limber::fem
