// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/exit_status.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

#include "limber/app/console/interruption.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"

namespace limber::app {
namespace {

ExitStatus fail(const std::string& text, ExitStatus status) {
  print_error(text);
  return status;
}

int refuse(const InputError& error) {
  for (const std::string& text : error.problems()) print_error(text);
  return kBadInput;
}

int fail_output(const std::string& why) {
  return fail(fmt::format("standard output cannot be written ({}); the "
                          "requested files are complete",
                          why),
              kBadInput);
}

// Output is buffered: flush to detect errors.
bool has_written_output() {
  return std::cout.flush() && std::fflush(stdout) == 0 &&
         std::ferror(stdout) == 0;
}

bool lacks_resources(const std::exception& error) {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return system != nullptr &&
         (system->code() == std::errc::resource_unavailable_try_again ||
          system->code() == std::errc::not_enough_memory ||
          system->code() == std::errc::too_many_files_open);
}

int find_status(const std::function<void()>& work) {
  try {
    work();
    return kSuccess;
  } catch (const InputError& error) {
    return refuse(error);
  } catch (const dynamics::Interrupted& end) {
    print_notice(end.what());
    return 128 + find_received_signal();
  } catch (const NumericalError& error) {
    return fail(error.what(), kNoSolution);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; a coarser mesh or fewer outputs need less",
                kNoSolution);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(error.what(), kBadInput);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return fail_output(error.what());
    if (lacks_resources(error)) {
      return fail(
          fmt::format("no more threads, files or memory: {}", error.what()),
          kNoSolution);
    }
    return fail(
        fmt::format("a defect of limber, not of your input: {}", error.what()),
        kDefect);
  }
}

}  // namespace

int run_guarded(const std::function<void()>& work) {
  const int status = find_status(work);
  errno = 0;
  if (!has_written_output() && status == kSuccess) {
    // A full buffer was written before: its error number is gone.
    return fail_output(errno == 0 ? "a write failed" : describe_errno());
  }
  if (status != kSuccess || find_received_signal() == 0) return status;
  print_notice(fmt::format("{} arrived after the end; all files are complete",
                           name_signal(find_received_signal())));
  return 128 + find_received_signal();
}

}  // namespace limber::app
