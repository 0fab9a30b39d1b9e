// SPDX-License-Identifier: BSD-3-Clause
#include "app/exit_status.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <new>

#include "common/errors.hpp"

namespace limber::app {
namespace {

int fail(const char* text, ExitStatus status) {
  fmt::print(stderr, "limber: error: {}\n", text);
  return status;
}

}  // namespace

int run_guarded(const std::function<void()>& work) {
  try {
    work();
    return kSuccess;
  } catch (const InputError& error) {
    for (const std::string& text : error.problems()) {
      fmt::print(stderr, "limber: error: {}\n", text);
    }
    return kBadInput;
  } catch (const NumericalError& error) {
    return fail(error.what(), kNoSolution);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; a coarser mesh or fewer outputs need less",
                kNoSolution);
  } catch (const std::exception& error) {
    fmt::print(stderr,
               "limber: error: a defect of limber, not of your input: {}\n",
               error.what());
    return kDefect;
  }
}

}  // namespace limber::app
