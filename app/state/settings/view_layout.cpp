#include "app/state/settings/view_layout.h"

#include <algorithm>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/option_fields.h"

namespace arthro::app {

ViewLayout ReadViewLayout(const std::filesystem::path& file) {
  std::error_code ignored;
  if (file.empty() || !std::filesystem::exists(file, ignored)) return {};
  try {
    ViewLayout layout;
    ReadOptionsText(ReadWholeFile(file, kMostJsonBytes), file, layout);
    layout.overview_share =
        std::clamp(layout.overview_share, ViewLayout::kLeastShare, ViewLayout::kMostShare);
    return layout;
  } catch (const std::exception&) {
    return {};
  }
}

void WriteViewLayout(const std::filesystem::path& file, const ViewLayout& layout) {
  if (file.empty()) return;
  try {
    std::filesystem::create_directories(file.parent_path());
    WriteAtomically(file, OptionsText(layout, 2) + "\n");
  } catch (const std::exception&) {
    // The next start has the defaults.
  }
}

}  // namespace arthro::app
