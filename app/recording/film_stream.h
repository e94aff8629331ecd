// Encodes pictures into a film file that can be played up to its last half second at any moment,
// whatever ends the program: a fragmented MP4, a Matroska file, an AVI file. CopyFilm makes an
// ordinary film of it, with an index. H.264 or Motion JPEG, by FFmpeg's libraries: OpenCV's writer
// neither writes fragments nor reports a short write.
// H.264 states its colours (BT.709, limited range) and has a key picture every 2 s.
// The same pictures give the same bytes on every machine with the same libraries.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <sys/types.h>

#include "simulation/scene/image.h"

namespace arthro::app {

struct VideoSize {
  int width = 0, height = 0;  // px, both even
};

enum class FilmFormat { kMp4, kMatroska, kAvi };

// The ending selects the format, in any case of letters: .mp4, .mkv (H.264), .avi (Motion JPEG).
std::optional<FilmFormat> FilmFormatOf(const std::filesystem::path& file);

// Result of writing a film's bytes. `error` is an errno; 0 with is_good false: the codec failed.
struct FilmResult {
  bool is_good = true;
  int error = 0;
};

class FilmStream {
 public:
  static constexpr double kFlushEvery = 0.5;  // s; pictures since then are not yet in the file

  // `descriptor`: an empty file, open for reading and writing, which must outlive this.
  FilmStream(int descriptor, FilmFormat format, VideoSize size, double rate);
  ~FilmStream();
  FilmStream(const FilmStream&) = delete;
  FilmStream& operator=(const FilmStream&) = delete;

  FilmResult Begin();
  FilmResult Add(const ColourImage& picture);  // size as in the form
  FilmResult End();

  // Up to there the file is whole: bytes, and the pictures in them.
  off_t whole_bytes() const;
  int whole_pictures() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

struct FilmContent {
  VideoSize size;
  double rate = 0;   // pictures per second
  int pictures = 0;  // whole ones
};

// Reads all packets, and decodes none. None: the file is no film of this format.
std::optional<FilmContent> ReadFilmContent(int descriptor, FilmFormat format);

// Writes the whole pictures of `from` into `to`, an empty file, as an ordinary film. A picture that
// is cut short at the end is left out. `copied`: pictures.
FilmResult CopyFilm(int from, FilmFormat format, int to, int& copied);

}  // namespace arthro::app
