// The frames of a clip, one after the other: a video file, a folder of pictures, a printf pattern
// ("frames/%04d.png") or one picture. Whatever the file holds (grey, alpha, 16 bit), a frame comes
// out as 8-bit RGB; the one place in authoring where a video's BGR is swapped.
//
// A frame that cannot be read does not end the clip: it comes out empty, with the reason. Frames
// may differ in size; who needs one size has to look.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <opencv2/core.hpp>

namespace arthro::authoring {

struct FootageInfo {
  std::string name;              // of the file or folder, without its path
  int frames = -1;               // as the container claims; -1: unknown until read
  int width = 0, height = 0;     // of the first readable frame, px
  double frames_per_second = 0;  // 0: pictures, or not known
  bool is_video = false;
};

class Footage {
 public:
  // Throws Error: nothing there, no picture in it, a video that no decoder takes, nothing readable.
  static Footage Open(const std::filesystem::path& path);
  Footage(Footage&&) noexcept;
  Footage& operator=(Footage&&) noexcept;
  ~Footage();

  const FootageInfo& info() const;

  // The next frame; false at the end. `rgb` is empty where it could not be read: see fault().
  bool Next(cv::Mat& rgb);
  // Passes over the next frame at the least cost; false at the end.
  bool Skip();
  void Rewind();

  int index() const;                 // of the frame that Next or Skip passed last; -1: none yet
  const std::string& fault() const;  // why the last frame is empty; "" when it is not
  std::string NameOf(int index) const;

  // After the end: a sentence when a video ended well before the length it claims; else "".
  std::string CutShort() const;

 private:
  struct Source;
  explicit Footage(std::unique_ptr<Source> source);
  std::unique_ptr<Source> source_;
};

}  // namespace arthro::authoring
