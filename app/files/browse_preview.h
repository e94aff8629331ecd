// Small picture and title of the file that is chosen in the file browser, read beside the window: a
// scene's panorama, a picture, the first frame of a video.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "app/state/editor_state.h"
#include "simulation/scene/image.h"

namespace arthro::app {

// Picture and words of a file.
struct FilePreview {
  std::filesystem::path file;
  std::shared_ptr<const ColourImage> picture;  // null: none
  std::string words;  // title of a scene, size of a picture; or why there is nothing to see
};

struct BrowsePreview {
  static constexpr int kPictureSide = 256;  // px, of the longer side

  explicit BrowsePreview(std::function<void()> wake) : jobs(std::move(wake)) {}
  FilePreview shown;  // preview of the chosen entry, once it was read
  Jobs jobs;          // reads the entry
};

// Nothing but its path for a file that no preview is made of.
FilePreview ReadFilePreview(const std::filesystem::path& file);

// Takes over what was read and reads the entry that is chosen. Once a frame. True where there is
// something new.
bool KeepBrowsePreviewFresh(EditorState& state);

}  // namespace arthro::app
