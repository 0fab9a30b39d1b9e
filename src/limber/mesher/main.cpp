// SPDX-License-Identifier: BSD-3-Clause
// limber-mesh FILE SIZE ORDER UNIT FORCE SURFACES: meshes one file by Gmsh; the
// only program that links it. Started by Limber; writes the mesh to descriptor
// 3, see fem/mesh/mesher.hpp.
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/process/child_process.hpp"
#include "limber/fem/gmsh/gmsh_reader.hpp"
#include "limber/fem/gmsh/gmsh_session.hpp"
#include "limber/fem/gmsh/raw_block.hpp"
#include "limber/fem/mesh/mesher.hpp"
#include "limber/mesher/sandbox.hpp"
#include "limber/mesher/trace.hpp"

namespace {

using limber::fem::MeshReply;

constexpr int kUsage = 64;

[[noreturn]] void end_out_of_memory() {
  _exit(limber::fem::kMesherOutOfMemory);
}

template <typename Number>
Number read_number(const char* text) {
  Number value{};
  const char* end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, value);
  if (error != std::errc() || rest != end) {
    std::fprintf(stderr, "limber-mesh: '%s' is not a number\n", text);
    std::exit(kUsage);
  }
  return value;
}

/// Limber shows it while it waits.
void print_count(double elements) {
  if (elements < 1.0) return;
  std::printf("%s%.0f\n", limber::fem::kExpectedElements.data(), elements);
}

MeshReply make_reply(limber::fem::GmshSession& session, const char* file,
                     const limber::fem::MeshOptions& options) {
  MeshReply reply;
  try {
    limber::fem::RawMesh raw =
        limber::fem::make_mesh(session, file, options, print_count);
    reply.mesh = std::move(raw.mesh);
    reply.notices = std::move(raw.notices);
  } catch (const limber::InputError& error) {
    reply.problems = error.problems();
  } catch (const std::bad_alloc&) {
    end_out_of_memory();
  }
  return reply;
}

bool send(const std::string& bytes) {
  const char* next = bytes.data();
  std::size_t left = bytes.size();
  while (left > 0) {
    const ssize_t count = write(limber::kReplyDescriptor, next, left);
    if (count <= 0) return false;
    next += count;
    left -= static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 7) {
    std::fprintf(
        stderr,
        "usage: limber-mesh FILE SIZE ORDER UNIT FORCE SURFACES [IGNORED ...], "
        "mesh to descriptor %d\n",
        limber::kReplyDescriptor);
    return kUsage;
  }
  std::set_new_handler(end_out_of_memory);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const limber::fem::MeshOptions options{
      read_number<double>(argv[2]), read_number<int>(argv[3]),
      read_number<double>(argv[4]), read_number<double>(argv[5]),
      {argv + 7, argv + argc},      read_number<int>(argv[6]) != 0};
  // A geometry's relative paths start at its own folder.
  const std::string folder = std::filesystem::path(argv[1]).parent_path();
  if (!folder.empty() && chdir(folder.c_str()) != 0) std::perror("chdir");
  const limber::mesher::Sandbox sandbox = limber::mesher::enter_sandbox();
  // Gmsh's window library tries to write preferences.
  limber::fem::GmshSession session;
  session.enable_output();  // its last output may be the only diagnosis
  limber::mesher::report_violations();
  limber::mesher::start_trace(sandbox);
  MeshReply reply = make_reply(session, argv[1], options);
  limber::mesher::Trace trace = limber::mesher::finish_trace();
  reply.files = std::move(trace.files);
  reply.is_repeatable = trace.is_repeatable;
  const bool is_sent = send(limber::fem::pack_reply(reply));
  std::fflush(nullptr);
  _exit(is_sent ? 0 : 1);  // without the exit handlers of libraries
}
