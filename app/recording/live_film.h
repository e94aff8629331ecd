// A film of what the window shows while somebody practises, or its frames as numbered pictures.
// Pictures come when the window has drawn them and at any size; the film has one size and a
// constant rate, and a picture stands in it until the next one's time, so that it runs at true
// speed. Encoded in a thread of its own behind a short queue: who offers a picture never waits, and
// one that finds the queue full is left out and counted.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <variant>

#include "app/recording/frame_shape.h"
#include "app/recording/picture_sequence.h"
#include "app/recording/video_file.h"

namespace arthro::app {

struct FilmForm {
  FrameShape shape = FrameShape::kSquare;
  int size = 720;      // px, height
  double rate = 30.0;  // pictures a second
};

// Throws Error where no recording of this form can be there: CheckVideo, CheckPictureFolder.
void CheckFilm(const std::filesystem::path& file, const FilmForm& form);

class LiveFilm {
 public:
  static constexpr std::size_t kQueue = 8;  // pictures

  // `file`: of a film, or as PictureNamesOf takes it. `wake` is called from its thread when it has
  // ended. Throws Error as VideoFile and PictureSequence.
  LiveFilm(const std::filesystem::path& file, const FilmForm& form,
           std::function<void()> wake = {});
  ~LiveFilm();  // ends it, and waits until it is written
  LiveFilm(const LiveFilm&) = delete;
  LiveFilm& operator=(const LiveFilm&) = delete;

  const std::filesystem::path& file() const { return file_; }
  bool is_pictures() const { return std::holds_alternative<PictureSequence>(frames_); }

  // ---- One thread, the window's. `t` in s since the film began. ----
  // A picture of this time is due: reading it back would not be in vain.
  bool IsDue(double t) const { return FrameAt(t) > last_offered_; }
  void Offer(double t, ColourImage picture);  // square
  // The last picture stands until then; what is there is written.
  void End(double t);
  int left_out() const { return left_out_; }
  bool is_ending() const { return is_ending_; }

  // Its thread is done: by End or by a fault.
  bool HasEnded() const;
  // Once it has ended: what hindered it, a sentence; empty: all of it is there.
  const std::string& fault() const { return fault_; }

 private:
  struct Item {
    std::int64_t frame = 0;
    ColourImage picture;  // empty: the film's end
  };
  std::int64_t FrameAt(double t) const;
  void Encode() noexcept;  // NOLINT(bugprone-exception-escape): ends the program with its stack
  void Write();

  std::filesystem::path file_;
  FilmForm form_;
  std::function<void()> wake_;
  std::variant<VideoFile, PictureSequence> frames_;  // its thread's
  std::int64_t last_offered_ = -1;
  int left_out_ = 0;
  bool is_ending_ = false;
  mutable std::mutex mutex_;  // held to put in and to take out, never while a picture is encoded
  std::condition_variable has_item_;
  std::deque<Item> queue_;
  bool has_ended_ = false;
  std::string fault_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace arthro::app
