// A film on disk, filled picture by picture at a constant rate. While it is recorded it stands
// beside its file, whole up to the last half second (unfinished_film.h). An older film is replaced
// only by one that is whole and was read back. By its ending: .mp4 and .mkv hold H.264, .avi Motion
// JPEG. A decoded picture differs from the one that was given, mostly in colour at sharp edges,
// which both keep at half the resolution. Only its owner may read it.
#pragma once

#include <filesystem>
#include <memory>

#include "app/recording/film_stream.h"
#include "simulation/scene/image.h"

namespace arthro::app {

constexpr int kMinVideoSize = 16, kMaxVideoSize = 4096;   // px a side
constexpr double kMinVideoRate = 1, kMaxVideoRate = 240;  // pictures a second

// Throws Error(kBadArgument) for an ending that is not known, a size or a rate that a film cannot
// have; before any long work.
void CheckVideo(const std::filesystem::path& file, VideoSize size, double rate);

class VideoFile {
 public:
  // Throws Error: as CheckVideo, or kFile where it cannot be written there.
  VideoFile(const std::filesystem::path& file, VideoSize size, double rate);
  // Removes an unfinished file.
  ~VideoFile();
  VideoFile(VideoFile&&) noexcept;
  VideoFile& operator=(VideoFile&&) noexcept;

  // Throws Error(kBadArgument) for a picture of another size. Throws Error(kFile) where it cannot
  // be written: what was whole by then is put in place, but never over another file, and the
  // sentence says where.
  void Add(const ColourImage& picture);
  int count() const;

  // Closes it, reads it back and puts it in place. Throws Error(kFile): nothing was added, or as
  // Add.
  void Finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace arthro::app
