// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/verifier.hpp"

#ifdef LIMBER_HAS_REFERENCE
#include "limber/common/process/helper_program.hpp"
#else
#include "limber/common/errors.hpp"
#endif

namespace limber::app {

#ifdef LIMBER_HAS_REFERENCE

void become_verifier(char** argv) {
  become(find_helper("the verifier", "limber-verify",
                     "Install it (Debian's package limber-verifier)."),
         argv);
}

#else

void become_verifier(char** /*argv*/) {
  throw InputError(
      "verify: this limber was built without Simbody (LIMBER_REFERENCE=OFF); "
      "build with -DLIMBER_REFERENCE=ON");
}

#endif

}  // namespace limber::app
