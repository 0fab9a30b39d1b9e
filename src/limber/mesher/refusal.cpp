// SPDX-License-Identifier: BSD-3-Clause
#include "limber/mesher/refusal.hpp"

#include <unistd.h>

#include "limber/fem/mesh/mesher.hpp"

namespace limber::mesher {

void refuse(std::string_view what) {
  constexpr std::string_view kBefore = "it tries to ";
  constexpr std::string_view kAfter =
      ". A geometry may read files, and do nothing else here.";
  for (const std::string_view part : {kBefore, what, kAfter}) {
    static_cast<void>(!write(STDERR_FILENO, part.data(), part.size()));
  }
  _exit(fem::kMesherRefused);
}

}  // namespace limber::mesher
