// Reads the frames of a clip in order: a video file, a folder of pictures, a printf pattern
// ("frames/%04d.png") or one picture. Several clips are read as one, each after the one before, and
// their frames are counted on. Every frame is returned as 8-bit RGB, whatever the file holds
// (grey, alpha, 16 bit). This is the only place in authoring that converts a video's BGR.
//
// An unreadable frame does not end the clip: it is returned empty, with a reason. Frames may differ
// in size; a caller that needs one size must check.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cv {
class Mat;
}

namespace arthro::authoring {

struct FootageInfo {
  std::string name;              // file or folder, without its path
  int frames = -1;               // number that the container claims; -1: unknown until read
  int width = 0, height = 0;     // px, size of the first readable frame
  double frames_per_second = 0;  // 0: pictures, or unknown
  bool is_video = false;
};

// First the main clip, then those that are joined to it.
using Clips = std::vector<std::filesystem::path>;

class Footage {
 public:
  // Throws Error when nothing is there, no picture is in it, no decoder takes the video or no frame
  // can be read.
  static Footage Open(const std::filesystem::path& path);
  // Errors name the clip. `info` describes the first one, with the number of frames of all.
  static Footage Open(const Clips& clips);
  Footage(Footage&&) noexcept;
  Footage& operator=(Footage&&) noexcept;
  ~Footage();

  const FootageInfo& info() const;

  // Reads the next frame; false at the end. `rgb` is empty when the frame is unreadable: see
  // fault().
  bool Next(cv::Mat& rgb);
  // Skips the next frame at the least cost; false at the end.
  bool Skip();
  void Rewind();

  int index() const;                 // last frame that Next or Skip passed; -1: none yet
  const std::string& fault() const;  // why the last frame is empty; "" when it is not
  std::string NameOf(int index) const;
  // Clip of the last frame that was passed; of several clips a frame is named CLIP:FRAME.
  int clip() const;

  // After the end: a sentence when a video ended well before its claimed length, otherwise "".
  std::string CutShort() const;

 private:
  struct Source;
  struct Joined;
  explicit Footage(std::unique_ptr<Source> source);
  // Passes one frame of the clip that is read, or the first one of the next clip.
  template <class Pass>
  bool PassFrame(const Pass& pass);
  std::unique_ptr<Source> source_;  // the clip that is read
  std::unique_ptr<Joined> joined_;  // null for one clip
};

}  // namespace arthro::authoring
