// A film on disk, filled picture by picture at a constant rate. It stands under a name of its own
// beside its file until it is whole and was read back, so that an older film is kept when anything
// fails. By its ending: .mp4 and .mkv hold H.264, .avi Motion JPEG, both of OpenCV's videoio. A
// decoded picture differs from the one that was given, mostly in colour at sharp edges, which both
// keep at half the resolution.
#pragma once

#include <filesystem>
#include <memory>

#include "simulation/scene/image.h"

namespace arthro::app {

struct VideoSize {
  int width = 0, height = 0;  // px, both even
};

constexpr int kMinVideoSize = 16, kMaxVideoSize = 4096;   // px a side
constexpr double kMinVideoRate = 1, kMaxVideoRate = 240;  // pictures a second

// Throws Error(kBadArgument) for an ending that is not known, a size or a rate that a film cannot
// have; before any long work.
void CheckVideo(const std::filesystem::path& file, VideoSize size, double rate);

class VideoFile {
 public:
  // Throws Error: as CheckVideo, or kFile where it cannot be written there.
  VideoFile(const std::filesystem::path& file, VideoSize size, double rate);
  // What was not finished is gone.
  ~VideoFile();
  VideoFile(VideoFile&&) noexcept;
  VideoFile& operator=(VideoFile&&) noexcept;

  // Throws Error(kBadArgument) for a picture of another size, Error(kFile) where there is no room
  // left on the disk.
  void Add(const ColourImage& picture);
  int count() const;

  // Closes it, reads it back and puts it in place. Throws Error(kFile): nothing was added, or not
  // all of it is on the disk.
  void Finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace arthro::app
