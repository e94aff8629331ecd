// The editor's two views beside the controls, as their user has set them: which are shown, on which
// side, how wide. Kept between runs in the user's configuration folder; a file that cannot be read
// gives the defaults.
#pragma once

#include <filesystem>

#include "simulation/core/options.h"

namespace arthro::app {

struct ViewLayout {
  static constexpr double kLeastShare = 0.15, kMostShare = 0.85;
  enum class Shown { kBoth, kScope, kOverview };

  Shown shown = Shown::kBoth;
  double overview_share = 0.38;  // share of the width beside the controls
  bool is_swapped = false;       // the overview stands on the left

  template <class V>
  void Visit(V&& v) {
    v("shown", shown,
      Choices<Shown>{
          {{Shown::kBoth, "both"}, {Shown::kScope, "scope"}, {Shown::kOverview, "overview"}}},
      "", "Views beside the controls.");
    v("overview_share", overview_share, Any{}, "", "Share of the overview in their width.");
    v("swapped", is_swapped, Any{}, "", "The overview stands on the left.");
  }
  friend bool operator==(const ViewLayout&, const ViewLayout&) = default;
};

ViewLayout ReadViewLayout(const std::filesystem::path& file);
// Not being able to write is not worth a word.
void WriteViewLayout(const std::filesystem::path& file, const ViewLayout& layout);

}  // namespace arthro::app
