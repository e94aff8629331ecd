#include "authoring/footage/footage.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <opencv2/videoio/registry.hpp>

#include "authoring/footage/picture_list.h"
#include "authoring/footage/quiet_decoders.h"
#include "authoring/footage/video_container.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/scene/image_io.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

constexpr double kMostFrames = 1e7;              // a larger count comes from a broken header
constexpr double kMostPixels = 8192.0 * 8192.0;  // pixels in a frame of a video

// A frame above the limit takes minutes and gigabytes.
void RequireSize(const cv::VideoCapture& video, const fs::path& file) {
  const double width = video.get(cv::CAP_PROP_FRAME_WIDTH);
  const double height = video.get(cv::CAP_PROP_FRAME_HEIGHT);
  if (width * height <= kMostPixels) return;
  throw Error(
      Code::kBadImage,
      fmt::format("the frames of this video are {:.0f} x {:.0f} pixels; at most 8192 x 8192 "
                  "can be used, so export it smaller",
                  width, height),
      file);
}

// Opens files only: a name must never open a camera or a network address. OpenCV's own AVI reader
// prints to stderr and reads nothing that FFmpeg does not, so it is used only without FFmpeg.
cv::VideoCapture OpenVideo(const fs::path& file) {
  RequireVideoContainer(file);
  QuietDecoders();
  const int backend =
      cv::videoio_registry::hasBackend(cv::CAP_FFMPEG) ? cv::CAP_FFMPEG : cv::CAP_OPENCV_MJPEG;
  try {
    cv::VideoCapture video(fs::absolute(file).string(), backend);
    if (video.isOpened()) {
      RequireSize(video, file);
      return video;
    }
  } catch (const cv::Exception&) {  // the format is unknown
  }
  throw Error(Code::kBadImage,
              "this video cannot be opened: it is cut off, empty or in a format that is not known; "
              "export it again as MP4, or as a folder of pictures",
              file);
}

}  // namespace

struct Footage::Source {
  fs::path path;
  FootageInfo info;
  std::vector<fs::path> pictures;  // empty for a video
  cv::VideoCapture video;
  int index = -1;
  bool has_ended = false;
  std::string fault;

  bool Grab() {
    fault.clear();
    if (has_ended) return false;
    bool has_next = false;
    if (!info.is_video) {
      has_next = index + 1 < static_cast<int>(pictures.size());
    } else {
      try {
        has_next = video.grab();
      } catch (const cv::Exception&) {
        has_next = false;
      }
    }
    if (has_next) {
      ++index;
    } else {
      has_ended = true;
    }
    return has_next;
  }

  bool Read(cv::Mat& rgb) {
    if (!Grab()) return false;
    rgb.release();  // never write into a frame that the caller still holds
    try {
      if (info.is_video) {
        cv::Mat bgr;
        if (video.retrieve(bgr) && bgr.type() == CV_8UC3)
          cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
        else
          fault = "frame cannot be decoded";
      } else {
        ColourImage picture = ReadColourImage(pictures[static_cast<std::size_t>(index)]);
        cv::Mat(picture.height, picture.width, CV_8UC3, picture.rgb.data()).copyTo(rgb);
      }
    } catch (const Error& error) {
      fault = error.sentence();
    } catch (const cv::Exception&) {
      fault = "frame cannot be decoded";
    }
    return true;
  }

  std::string NameOf(int frame) const {
    if (!info.is_video && frame >= 0 && frame < static_cast<int>(pictures.size()))
      return pictures[static_cast<std::size_t>(frame)].filename().string();
    return fmt::format("{}#{}", info.name, frame);
  }

  std::string CutShort() const {
    if (!info.is_video || !has_ended || info.frames < 0) return "";
    // Frame counts that a container derives from its duration may be a few frames off in a sound
    // file.
    constexpr int kTolerated = 3;
    constexpr double kToleratedShare = 0.02;
    const int read = index + 1;
    if (read + kTolerated + static_cast<int>(kToleratedShare * info.frames) >= info.frames)
      return "";
    return fmt::format("the video ends after {} of {} frames; it was cut off", read, info.frames);
  }

  void Rewind() {
    if (info.is_video) video = OpenVideo(path);  // seeking is not exact in every container
    index = -1;
    has_ended = false;
    fault.clear();
  }
};

Footage::Footage(std::unique_ptr<Source> source) : source_(std::move(source)) {}
Footage::Footage(Footage&&) noexcept = default;
Footage& Footage::operator=(Footage&&) noexcept = default;
Footage::~Footage() = default;

Footage Footage::Open(const fs::path& path) {
  auto source = std::make_unique<Source>();
  source->path = path;
  FootageInfo& info = source->info;
  const fs::path plain = path.filename().empty() ? path.parent_path() : path;
  info.name = plain.filename().string();

  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    source->pictures = PicturesIn(path);
  } else if (fs::exists(path, ignored)) {
    RequireRegularFile(path);
    if (fs::file_size(path, ignored) == 0)
      throw Error(Code::kBadImage, "this file is empty (0 bytes); copy or export it again", path);
    if (IsPictureName(path)) source->pictures = {path};
    info.is_video = source->pictures.empty();
  } else if (path.filename().string().find('%') != std::string::npos) {
    source->pictures = PicturesOf(path);
  } else {
    throw Error(Code::kFile,
                "there is no such file or folder; name a video, a folder of pictures or a pattern "
                "such as frames/%04d.png",
                path);
  }

  if (info.is_video) {
    source->video = OpenVideo(path);
    const double count = source->video.get(cv::CAP_PROP_FRAME_COUNT);
    if (count >= 1 && count < kMostFrames) info.frames = static_cast<int>(std::lround(count));
    const double rate = source->video.get(cv::CAP_PROP_FPS);
    if (rate > 0 && rate < 1e4) info.frames_per_second = rate;
  } else {
    info.frames = static_cast<int>(source->pictures.size());
  }

  // The first readable frame gives the size and shows that the footage can be read at all.
  cv::Mat first;
  while (source->Read(first) && first.empty()) {
  }
  if (first.empty())
    throw Error(Code::kBadImage,
                source->fault.empty() && info.is_video
                    ? "this video holds no frame that can be read; export it again"
                    : "none of its pictures can be read; export them again as PNG or JPEG",
                path);
  info.width = first.cols;
  info.height = first.rows;
  source->Rewind();
  return Footage(std::move(source));
}

// Clips after the first one are opened when the one before has ended.
struct Footage::Joined {
  Clips clips;
  FootageInfo info;
  std::vector<std::string> names;
  std::vector<int> first;  // index of the first frame of each clip that was begun
  std::vector<std::string> cut_short;
};

Footage Footage::Open(const Clips& clips) {
  if (clips.empty()) throw Error(Code::kBadArgument, "no footage was named; name a clip");
  Footage footage = Open(clips.front());
  if (clips.size() == 1) return footage;
  auto own = std::make_unique<Joined>();
  Joined& joined = *own;
  joined.clips = clips;
  joined.info = footage.info();
  joined.first = {0};
  joined.names = {joined.info.name};
  for (std::size_t i = 1; i < clips.size(); ++i) {
    const FootageInfo info = Open(clips[i]).info();
    joined.names.push_back(info.name);
    joined.info.name += " + " + info.name;
    joined.info.frames =
        joined.info.frames < 0 || info.frames < 0 ? -1 : joined.info.frames + info.frames;
  }
  footage.joined_ = std::move(own);
  return footage;
}

template <class Pass>
bool Footage::PassFrame(const Pass& pass) {
  while (!pass(*source_)) {
    if (!joined_ || joined_->first.size() >= joined_->clips.size()) return false;
    joined_->cut_short.push_back(source_->CutShort());
    joined_->first.push_back(joined_->first.back() + source_->index + 1);
    source_ = std::move(Open(joined_->clips[joined_->first.size() - 1]).source_);
  }
  return true;
}

const FootageInfo& Footage::info() const { return joined_ ? joined_->info : source_->info; }
bool Footage::Next(cv::Mat& rgb) {
  return PassFrame([&](Source& source) { return source.Read(rgb); });
}
bool Footage::Skip() {
  return PassFrame([](Source& source) { return source.Grab(); });
}

void Footage::Rewind() {
  if (!joined_ || joined_->first.size() == 1) return source_->Rewind();
  joined_->first = {0};
  joined_->cut_short.clear();
  source_ = std::move(Open(joined_->clips.front()).source_);
}

int Footage::index() const {
  return joined_ ? joined_->first.back() + source_->index : source_->index;
}
int Footage::clip() const { return joined_ ? static_cast<int>(joined_->first.size()) - 1 : 0; }
const std::string& Footage::fault() const { return source_->fault; }

std::string Footage::NameOf(int index) const {
  if (!joined_) return source_->NameOf(index);
  std::size_t clip = joined_->first.size() - 1;
  while (clip > 0 && joined_->first[clip] > index) --clip;
  return fmt::format("{}:{}", joined_->names[clip], index - joined_->first[clip]);
}

std::string Footage::CutShort() const {
  if (!joined_) return source_->CutShort();
  std::vector<std::string> faults = joined_->cut_short;
  faults.push_back(source_->CutShort());
  std::string words;
  for (std::size_t i = 0; i < faults.size(); ++i)
    if (!faults[i].empty())
      words += fmt::format("{}{}: {}", words.empty() ? "" : "; ", joined_->names[i], faults[i]);
  return words;
}

}  // namespace arthro::authoring
