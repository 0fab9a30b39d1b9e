// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/mesh/mesher.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/common/process/child_process.hpp"
#include "limber/common/process/helper_program.hpp"

namespace limber::fem {
namespace {

constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;
constexpr double kSeconds = 300.0;
constexpr const char* kName = "limber-mesh";

// The mesher is built as this library is, and sanitizers take terabytes.
#ifdef LIMBER_SANITIZED
constexpr bool kIsAddressSpaceLimited = false;
#else
constexpr bool kIsAddressSpaceLimited = true;
#endif

std::optional<double> read_positive(const char* name) {
  const char* text = std::getenv(name);
  if (!text) return std::nullopt;
  double value = 0.0;
  const char* end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, value);
  if (error == std::errc() && rest == end && value > 0.0 &&
      std::isfinite(value)) {
    return value;
  }
  throw InputError(
      fmt::format("{} is '{:.200}'; expected a positive number.", name, text));
}

double find_half_of_memory() {
  return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(sysconf(_SC_PAGESIZE));
}

std::filesystem::path find_program() {
  if (const char* named = std::getenv("LIMBER_MESHER")) {
    if (can_run(named)) return std::filesystem::absolute(named);
    throw InputError(fmt::format(
        "LIMBER_MESHER names '{}', which is not an executable program.",
        named));
  }
  return find_helper("the mesher", kName,
                     "Install it (Debian's package limber-mesher), or name it "
                     "by LIMBER_MESHER.");
}

/// A geometry gets no environment, so that its mesh cannot depend on one.
std::vector<std::string> make_environment() {
  std::vector<std::string> environment = {
      "HOME=/nonexistent",  "LC_ALL=C",          "OMP_NUM_THREADS=1",
      "OMP_THREAD_LIMIT=1", "OMP_STACKSIZE=16M", "OPENBLAS_NUM_THREADS=1"};
  if (const char* libraries = std::getenv("LD_LIBRARY_PATH")) {
    environment.push_back(fmt::format("LD_LIBRARY_PATH={}", libraries));
  }
  return environment;
}

/// The end of the mesher's output, in one line, without control characters.
std::string describe_output(const ChildEnd& end) {
  constexpr std::size_t kMost = 300;
  std::string output;
  for (const char c : end.output) {
    const bool is_plain = static_cast<unsigned char>(c) >= ' ';
    if (is_plain) output += c;
    if (c == '\n' && !output.empty() && !output.ends_with("; ")) output += "; ";
  }
  while (output.ends_with("; ")) output.resize(output.size() - 2);
  if (output.size() > kMost) {
    output = "..." + output.substr(output.size() - kMost);
  }
  return output.empty() ? "It printed nothing." : "Its last output: " + output;
}

/// The number of elements that the mesher expects, if it has said so.
std::optional<double> find_expected(std::string_view output) {
  const std::size_t at = output.rfind(kExpectedElements);
  if (at == std::string_view::npos) return std::nullopt;
  output.remove_prefix(at + kExpectedElements.size());
  return parse_number(output.substr(0, output.find('\n')));
}

void report_count(std::string_view output, const Progress& progress) {
  const std::optional<double> count = find_expected(output);
  if (!count) return;
  report(progress, fmt::format("meshing up to {:.2g} elements", *count), 0.0);
}

/// What a mesh of its size needs, and which size has a tenth of it.
std::string describe_count(const ChildEnd& end, const MeshOptions& options) {
  const std::optional<double> count = find_expected(end.output);
  if (!count) return "";
  std::string text =
      fmt::format(" Up to {:.2g} elements were expected", *count);
  if (options.size > 0.0) {
    text += fmt::format("; a size of {:.2g} in place of {:g} has a tenth",
                        options.size * std::cbrt(10.0), options.size);
  }
  return text + '.';
}

/// Why there is no mesh.
std::string explain(const Mesher& mesher, const MeshOptions& options,
                    const ChildEnd& end) {
  const std::string memory = fmt::format(
      "more than the {:.3g} GiB of memory that it may take. Correct the file, "
      "or "
      "allow more by LIMBER_MESH_MEMORY (in GiB)",
      static_cast<double>(mesher.memory) / kGibibyte);
  const std::string output =
      describe_output(end) + describe_count(end, options);
  if (end.is_out_of_time) {
    return fmt::format(
        "meshing did not finish within {:.6g} s and was stopped. Correct the "
        "file, or allow more by LIMBER_MESH_SECONDS. {}",
        mesher.seconds, output);
  }
  if (end.is_reply_too_long) {
    return "its mesh needs " + memory + "." + describe_count(end, options);
  }
  if (end.exit_status == kMesherOutOfMemory) {
    return fmt::format("meshing needs {}. {}", memory, output);
  }
  if (end.exit_status == kMesherRefused) {
    const std::size_t at = end.output.rfind("it tries to ");
    return at == std::string::npos ? output : end.output.substr(at);
  }
  // A library blocks signals while it starts a process, so no message is
  // printed.
  if (end.signal == SIGSYS) {
    return "it tries to run a program. A geometry may read files, and do "
           "nothing else here.";
  }
  if (end.signal != 0) {
    return fmt::format("the mesher was ended by signal {} ({}). {}", end.signal,
                       strsignal(end.signal), output);
  }
  return fmt::format(
      "Gmsh left with status {} before there was a mesh, as Exit or Abort in a "
      "geometry do. {}",
      end.exit_status, output);
}

/// Messages begin with the file's absolute path; replaces it by the user's
/// path.
std::vector<std::string> rename(std::vector<std::string> texts,
                                const std::filesystem::path& place,
                                const std::filesystem::path& file) {
  for (std::string& text : texts) {
    if (text.starts_with(place.string())) {
      text.replace(0, place.string().size(), file.string());
    }
  }
  return texts;
}

}  // namespace

Mesher find_mesher() {
  const double gibibytes = read_positive("LIMBER_MESH_MEMORY")
                               .value_or(find_half_of_memory() / kGibibyte);
  constexpr double kMost = 1e6;
  return {find_program(),
          read_positive("LIMBER_MESH_SECONDS").value_or(kSeconds),
          static_cast<std::uint64_t>(std::min(gibibytes, kMost) * kGibibyte)};
}

std::string identify_mesher() {
  std::string identity;
  try {
    identity = find_program().string();
  } catch (const InputError&) {
    return "";
  }
  for (const std::string& variable : make_environment()) {
    identity += '\n' + variable;
  }
  return identity;
}

MeshReply run_mesher(const Mesher& mesher, const std::filesystem::path& file,
                     const MeshOptions& options, const Progress& progress) {
  const std::filesystem::path place = std::filesystem::absolute(file);
  std::vector<std::string> arguments = {place.string(),
                                        fmt::format("{}", options.size),
                                        fmt::format("{}", options.order),
                                        fmt::format("{}", options.unit),
                                        fmt::format("{}", options.force),
                                        options.with_surfaces ? "1" : "0"};
  arguments.insert(arguments.end(), options.ignored.begin(),
                   options.ignored.end());
  const ChildEnd end = run_child(
      {mesher.program, std::move(arguments), make_environment(), mesher.seconds,
       mesher.memory, kIsAddressSpaceLimited,
       [&](std::string_view output) { report_count(output, progress); }});
  if (end.exit_status != 0 || end.signal != 0 || end.is_out_of_time ||
      end.is_reply_too_long || end.reply.empty()) {
    throw InputError(
        fmt::format("{}: {}", file.string(), explain(mesher, options, end)));
  }
  MeshReply reply;
  try {
    reply = unpack_reply(end.reply);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}. {}", file.string(), error.what(),
                                 describe_output(end)));
  }
  if (!reply.problems.empty()) {
    throw InputError(rename(reply.problems, place, file));
  }
  if (reply.mesh.element_count() == 0 && !options.with_surfaces)
    throw InputError(
        fmt::format("{}: the mesher's answer has no solids", file.string()));
  reply.notices = rename(reply.notices, place, file);
  reply.mesh.source = file.string();
  return reply;
}

}  // namespace limber::fem
