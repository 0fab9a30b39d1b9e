// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/verbosity.hpp"

namespace limber::app {
namespace {

Verbosity chosen = Verbosity::usual;

}  // namespace

void set_verbosity(Verbosity verbosity) { chosen = verbosity; }
Verbosity find_verbosity() { return chosen; }

}  // namespace limber::app
