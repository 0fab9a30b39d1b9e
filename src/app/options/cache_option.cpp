// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/cache_option.hpp"

namespace limber::app {

CLI::Option* add_cache_option(CLI::App& command, std::string& folder) {
  return command
      .add_option("--cache", folder,
                  "Folder of reduced bodies (default: LIMBER_CACHE, else "
                  "XDG_CACHE_HOME/limber, else HOME/.cache/limber)")
      ->type_name("FOLDER");
}

}  // namespace limber::app
