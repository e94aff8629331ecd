#include "app/state/settings/view_layout.h"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"

namespace arthro::app {
namespace {

using Shown = ViewLayout::Shown;
constexpr std::array<std::pair<Shown, const char*>, 3> kShown = {
    {{Shown::kBoth, "both"}, {Shown::kScope, "scope"}, {Shown::kOverview, "overview"}}};

}  // namespace

ViewLayout ReadViewLayout(const std::filesystem::path& file) {
  std::error_code ignored;
  if (file.empty() || !std::filesystem::exists(file, ignored)) return {};
  try {
    const auto json = ParseJson(ReadWholeFile(file, kMostJsonBytes), Code::kBadData, file);
    ViewLayout layout;
    layout.overview_share = std::clamp(json.at("overview_share").get<double>(),
                                       ViewLayout::kLeastShare, ViewLayout::kMostShare);
    layout.is_swapped = json.at("swapped").get<bool>();
    const auto words = json.at("shown").get<std::string>();
    for (const auto& [shown, word] : kShown)
      if (words == word) layout.shown = shown;
    return layout;
  } catch (const std::exception&) {
    return {};
  }
}

void WriteViewLayout(const std::filesystem::path& file, const ViewLayout& layout) {
  if (file.empty()) return;
  nlohmann::json json = {{"overview_share", layout.overview_share}, {"swapped", layout.is_swapped}};
  for (const auto& [shown, word] : kShown)
    if (layout.shown == shown) json["shown"] = word;
  try {
    std::filesystem::create_directories(file.parent_path());
    WriteAtomically(file, json.dump(2) + "\n");
  } catch (const std::exception&) {
    // The next start has the defaults.
  }
}

}  // namespace arthro::app
