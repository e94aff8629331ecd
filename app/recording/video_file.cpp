#include "app/recording/video_file.h"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "app/recording/unfinished_film.h"
#include "authoring/footage/quiet_decoders.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Room is looked for after so many pictures; below it the film is given up while it can be told.
constexpr int kLookEvery = 30;
constexpr std::uintmax_t kLeastRoom = 1 << 20;  // bytes

}  // namespace

void CheckVideo(const fs::path& file, VideoSize size, double rate) {
  if (!FilmFormatOf(file))
    throw Error(Code::kBadArgument,
                "the ending of a film says its format; name it .mp4, .mkv or .avi", file);
  for (const int side : {size.width, size.height})
    if (side < kMinVideoSize || side > kMaxVideoSize || side % 2 != 0)
      throw Error(Code::kBadArgument,
                  fmt::format("a film of {}x{} pixels cannot be written; both sides must be even, "
                              "and from {} to {}",
                              size.width, size.height, kMinVideoSize, kMaxVideoSize),
                  file);
  if (!(rate >= kMinVideoRate && rate <= kMaxVideoRate))
    throw Error(Code::kBadArgument,
                fmt::format("a film of {} pictures a second cannot be written; ask for {} to {}",
                            rate, kMinVideoRate, kMaxVideoRate),
                file);
}

struct VideoFile::Parts {
  UnfinishedFilm file;  // first: the stream writes to it
  VideoSize size;
  double rate;
  int count = 0;
  FilmStream stream;

  Parts(const fs::path& target, VideoSize of_size, double of_rate)
      : file(target),
        size(of_size),
        rate(of_rate),
        stream(file.descriptor(), *FilmFormatOf(target), of_size, of_rate) {}
  // Keeps what is whole.
  [[noreturn]] void Fail(const std::string& what, int error) {
    const std::string why =
        error != 0 ? WhyNotWritten(error) : "the encoder failed; try another ending";
    if (stream.whole_pictures() == 0)
      throw Error(Code::kFile, fmt::format("this film was not written ({}): {}", what, why),
                  file.target());
    std::string where = fmt::format("{}, which the next start of this program puts in place",
                                    file.beside().string());
    try {
      where = file.PutWholeInPlace(stream.whole_bytes()).string();
    } catch (const Error&) {  // it stays there
    }
    throw Error(Code::kFile,
                fmt::format("this film was not written to its end ({}): {}; its first {:.1f} s are "
                            "in {}",
                            what, why, stream.whole_pictures() / rate, where),
                file.target());
  }
};

VideoFile::VideoFile(const fs::path& file, VideoSize size, double rate) {
  CheckVideo(file, size, rate);
  authoring::QuietDecoders();
  parts_ = std::make_unique<Parts>(file, size, rate);
  if (const FilmResult result = parts_->stream.Begin(); !result.is_good)
    parts_->Fail("it could not be begun", result.error);
}

VideoFile::~VideoFile() = default;
VideoFile::VideoFile(VideoFile&&) noexcept = default;
VideoFile& VideoFile::operator=(VideoFile&&) noexcept = default;

int VideoFile::count() const { return parts_->count; }

void VideoFile::Add(const ColourImage& picture) {
  Parts& p = *parts_;
  if (picture.width != p.size.width || picture.height != p.size.height)
    throw Error(Code::kBadArgument,
                fmt::format("a picture of {}x{} cannot go into a film of {}x{}; give all one size",
                            picture.width, picture.height, p.size.width, p.size.height),
                p.file.target());
  if (p.count % kLookEvery == 0) {
    std::error_code unknown;
    const fs::space_info room = fs::space(p.file.beside(), unknown);
    if (!unknown && room.available < kLeastRoom)
      p.Fail(fmt::format("there is no room after {} pictures", p.count), ENOSPC);
  }
  if (const FilmResult result = p.stream.Add(picture); !result.is_good)
    p.Fail(fmt::format("picture {} could not be written", p.count), result.error);
  ++p.count;
}

void VideoFile::Finish() {
  Parts& p = *parts_;
  if (p.count == 0)
    throw Error(Code::kFile, "this film has no picture, so it was not written", p.file.target());
  if (const FilmResult result = p.stream.End(); !result.is_good)
    p.Fail("its end is missing", result.error);
  const FilmFormat format = *FilmFormatOf(p.file.target());
  std::string fault;
  int error = 0;
  {
    PartialFile whole(p.file.target(), Access::kPrivate);
    const int to = ::open(whole.beside().c_str(), O_RDWR | O_CLOEXEC);
    if (to < 0) {
      fault = "its index is missing", error = errno;
    } else {
      int copied = 0;
      const FilmResult result = CopyFilm(p.file.descriptor(), format, to, copied);
      const auto content = ReadFilmContent(to, format);
      ::close(to);
      if (!result.is_good)
        fault = "its index is missing", error = result.error;
      else if (!content || content->pictures != p.count || content->size.width != p.size.width ||
               content->size.height != p.size.height)
        fault = fmt::format("only {} of its {} pictures are there", copied, p.count), error = EIO;
    }
    if (fault.empty()) {
      whole.PutInPlace();
      return p.file.Remove();
    }
  }
  p.Fail(fault, error);
}

}  // namespace arthro::app
