// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/study/design.hpp"
#include "limber/study/study_file.hpp"

namespace limber::app {

/// The first run of a study, against which the study is checked.
struct StudyBase {
  scene::Scene scene;
  scene::BuiltScene built;
  std::string manifest;  ///< of the study and of these
};

/// Loads and builds it, and checks the study against it: the paths of all
/// factors, and the responses.
/// @throws InputError naming what is wrong
[[nodiscard]] StudyBase make_base(const study::Study& study,
                                  const study::Design& design,
                                  const std::filesystem::path& cache);

struct StudyOptions {
  std::filesystem::path cache;
  int jobs = 1;  ///< threads
};

/// Counts and times of one call of run_study.
struct StudyCost {
  std::size_t runs = 0;
  double seconds = 0.0;        ///< wall time [s]
  double seconds_steps = 0.0;  ///< sum over the runs [s]
};

/// Makes the runs that the file lacks, in threads, and writes rows as they
/// finish. Scenes are loaded one at a time, because the libraries for it are
/// not thread-safe; each distinct reduction is done once.
/// @throws Interrupted after SIGINT or SIGTERM; finished runs are in the file.
StudyCost run_study(const study::Design& design, const StudyBase& base,
                    const StudyOptions& options, study::StudyFile& file);

}  // namespace limber::app
