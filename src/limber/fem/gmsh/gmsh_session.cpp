// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/gmsh_session.hpp"

#include <gmsh.h>

namespace limber::fem {
namespace {
std::mutex& gmsh_mutex() {
  static std::mutex mutex;
  return mutex;
}

// Gmsh 4.8 has no query. A function that needs it leaves its result unchanged.
bool is_initialized() {
  constexpr double kUntouched = -1.0;
  double value = kUntouched;
  try {
    gmsh::option::getNumber("General.Terminal", value);
  } catch (...) {
    return false;
  }
  return value != kUntouched;
}

std::vector<std::string> read_log() {
  std::vector<std::string> log;
  try {
    gmsh::logger::get(log);
  } catch (...) {  // not started
    log.clear();
  }
  return log;
}
}  // namespace

GmshSession::GmshSession() : lock_(gmsh_mutex()), is_guest_(is_initialized()) {
  if (is_guest_) {
    gmsh::model::getCurrent(host_model_);
    gmsh::option::getNumber("General.Terminal", host_terminal_);
    host_lines_ = read_log().size();
  } else {
    // A user's ~/.gmshrc must not change what a body is.
    constexpr bool kReadConfigFiles = false;
    gmsh::initialize(0, nullptr, kReadConfigFiles);
    gmsh::option::setNumber("General.AbortOnError", 0);
  }
  gmsh::option::setNumber("General.Terminal", 0);
  if (host_lines_ == 0) gmsh::logger::start();
}

GmshSession::~GmshSession() {
  try {
    if (host_lines_ == 0) gmsh::logger::stop();
    if (!is_guest_) {
      gmsh::finalize();
      return;
    }
    gmsh::model::remove();
    gmsh::model::setCurrent(host_model_);
    gmsh::option::setNumber("General.Terminal", host_terminal_);
  } catch (...) {  // NOLINT: nothing is left to be done with it
  }
}

void GmshSession::open(const std::filesystem::path& file) {
  if (!is_guest_) {
    gmsh::open(file.string());
    return;
  }
  gmsh::model::add("limber " + file.string());
  gmsh::merge(file.string());
}

void GmshSession::enable_output() {
  gmsh::option::setNumber("General.Terminal", 1);
}

std::vector<std::string> GmshSession::find_lines(
    std::string_view prefix) const {
  const std::vector<std::string> log = read_log();
  std::vector<std::string> found;
  for (std::size_t i = host_lines_; i < log.size(); ++i)
    if (log[i].starts_with(prefix))
      found.push_back(log[i].substr(prefix.size()));
  return found;
}

std::vector<std::string> GmshSession::errors() const {
  // Reported for third-order prisms. Closures match the faces of two elements
  // in Gmsh's own solvers; nothing here uses them.
  constexpr std::string_view kHarmless = "FaceClosureFull";
  std::vector<std::string> errors = find_lines("Error: ");
  std::erase_if(errors, [&](const std::string& line) {
    return line.starts_with(kHarmless);
  });
  return errors;
}

std::vector<std::string> GmshSession::warnings() const {
  return find_lines("Warning: ");
}

std::vector<std::string> GmshSession::files_read() const {
  std::vector<std::string> files;
  for (const std::string& rest : find_lines("Info: Reading '"))
    files.push_back(rest.substr(0, rest.find('\'')));
  return files;
}

}  // namespace limber::fem
