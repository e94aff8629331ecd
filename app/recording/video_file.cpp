#include "app/recording/video_file.h"

#include <cctype>
#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <string>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "authoring/footage/quiet_decoders.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Measured at 512 px, ms a picture on one slow core: H.264 7, MJPEG 6. WebM is left out: OpenCV
// writes it with a complaint on stderr, and VP8 takes 17 ms, VP9 75.
struct Ending {
  const char* ending;
  const char* fourcc;
};
constexpr Ending kEndings[] = {{".mp4", "avc1"}, {".mkv", "H264"}, {".avi", "MJPG"}};

// Room is looked for after so many pictures; below it the film is given up while it can be told.
constexpr int kLookEvery = 30;
constexpr std::uintmax_t kLeastRoom = 1 << 20;  // bytes

const Ending* EndingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Ending& known : kEndings)
    if (ending == known.ending) return &known;
  return nullptr;
}

// Writers of video do not say that they could not write, let alone why; but what hindered them
// hinders a few bytes more, which are taken back. Empty: nothing does.
std::string WhyNoMore(const fs::path& beside) {
  const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT, 0666);
  if (descriptor < 0) return WhyNotWritten(errno);
  int error = 0;
  const off_t end = ::lseek(descriptor, 0, SEEK_END);
  const std::string bytes(1 << 16, '\0');
  for (std::size_t done = 0; done < bytes.size() && error == 0;) {
    const ssize_t wrote = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (wrote < 0)
      error = errno;
    else
      done += static_cast<std::size_t>(wrote);
  }
  if (::ftruncate(descriptor, end) != 0 && error == 0) error = errno;
  ::close(descriptor);
  return error != 0 ? WhyNotWritten(error) : "";
}

// Says what of the film is not as it was written; empty: it is whole. Packets are counted, not
// decoded. A container's own count is written last of all, so it tells of everything before it.
std::string FaultOf(const fs::path& beside, int count, VideoSize size) {
  try {
    cv::VideoCapture film(fs::absolute(beside).string(), cv::CAP_FFMPEG);
    if (!film.isOpened()) return "it cannot be opened";
    const int width = static_cast<int>(film.get(cv::CAP_PROP_FRAME_WIDTH)),
              height = static_cast<int>(film.get(cv::CAP_PROP_FRAME_HEIGHT));
    if (width != size.width || height != size.height)
      return fmt::format("its pictures are {}x{}", width, height);
    const double told = film.get(cv::CAP_PROP_FRAME_COUNT);
    film.set(cv::CAP_PROP_FORMAT, -1);
    int found = 0;
    while (film.grab()) ++found;
    if (found != count || !(std::abs(told - count) <= 1.0))
      return fmt::format("only {} of its {} pictures are there", found, count);
  } catch (const cv::Exception&) {
    return "it cannot be read";
  }
  return "";
}

}  // namespace

void CheckVideo(const fs::path& file, VideoSize size, double rate) {
  if (EndingOf(file) == nullptr)
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
  PartialFile file;  // first: the writer closes it before it is removed
  VideoSize size;
  int count = 0;
  cv::VideoWriter writer;
  cv::Mat bgr;

  Parts(const fs::path& target, VideoSize of_size) : file(target), size(of_size) {}
  [[noreturn]] void Fail(const std::string& what) const {
    const std::string why = WhyNoMore(file.beside());
    throw Error(Code::kFile,
                fmt::format("this film was not written ({}): {}", what,
                            why.empty() ? "the encoder failed; try another ending" : why),
                file.target());
  }
};

VideoFile::VideoFile(const fs::path& file, VideoSize size, double rate) {
  CheckVideo(file, size, rate);
  authoring::QuietDecoders();
  parts_ = std::make_unique<Parts>(file, size);
  const char* code = EndingOf(file)->fourcc;
  bool is_open = false;
  try {
    // FFmpeg only: others would begin a camera's or a network's pipeline.
    is_open = parts_->writer.open(fs::absolute(parts_->file.beside()).string(), cv::CAP_FFMPEG,
                                  cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]), rate,
                                  {size.width, size.height});
  } catch (const cv::Exception&) {
  }
  if (!is_open) parts_->Fail("it could not be begun");
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
      p.Fail(fmt::format("there is no room after {} pictures", p.count));
  }
  // OpenCV takes no const data, and does not write to it.
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::cvtColor(rgb, p.bgr, cv::COLOR_RGB2BGR);
  try {
    p.writer.write(p.bgr);
  } catch (const cv::Exception&) {
    p.Fail(fmt::format("picture {} could not be encoded", p.count));
  }
  ++p.count;
}

void VideoFile::Finish() {
  Parts& p = *parts_;
  p.writer.release();
  if (p.count == 0)
    throw Error(Code::kFile, "this film has no picture, so it was not written", p.file.target());
  if (!WhyNoMore(p.file.beside()).empty()) p.Fail("its end may be missing");
  if (const std::string fault = FaultOf(p.file.beside(), p.count, p.size); !fault.empty())
    p.Fail(fault);
  p.file.PutInPlace();
}

}  // namespace arthro::app
