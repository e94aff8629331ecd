// Real footage and reference values that lie beside a developer's checkout and are not part of the
// project. A test that uses them says loudly when it skips.
#pragma once

#include <filesystem>

#include "tests/support/build_paths.h"

#define ARTHRO_REQUIRE_SHARED(variable, relative)                                     \
  const std::filesystem::path variable =                                              \
      std::filesystem::path(ARTHRO_SOURCE_DIR).parent_path() / "shared" / (relative); \
  if (!std::filesystem::exists(variable))                                             \
  GTEST_SKIP() << "SKIPPED: " << variable                                             \
               << " is not on this machine, so this claim is not tested here"
