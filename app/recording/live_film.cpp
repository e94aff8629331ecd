#include "app/recording/live_film.h"

#include <cmath>
#include <new>
#include <utility>

#include "authoring/footage/resized_picture.h"
#include "simulation/core/crash_stack.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

ColourImage AtSize(const ColourImage& picture, int size) {
  const bool is_so = picture.width == size && picture.height == size;
  return is_so ? picture : authoring::Resized(picture, size, size);
}

std::variant<VideoFile, PictureSequence> FramesOf(const std::filesystem::path& file,
                                                  const FilmForm& form) {
  if (auto names = PictureNamesOf(file)) return PictureSequence(std::move(*names));
  return VideoFile(file, {FrameWidth(form.shape, form.size), form.size}, form.rate);
}

}  // namespace

void CheckFilm(const std::filesystem::path& file, const FilmForm& form) {
  if (const auto names = PictureNamesOf(file)) return CheckPictureFolder(*names);
  CheckVideo(file, {FrameWidth(form.shape, form.size), form.size}, form.rate);
}

LiveFilm::LiveFilm(const std::filesystem::path& file, const FilmForm& form,
                   std::function<void()> wake)
    : file_(file),
      form_(form),
      wake_(std::move(wake)),
      frames_(FramesOf(file, form)),
      thread_([this] { Encode(); }) {}

LiveFilm::~LiveFilm() {
  if (!is_ending_) End(static_cast<double>(last_offered_ + 1) / form_.rate);
}

std::int64_t LiveFilm::FrameAt(double t) const {
  return static_cast<std::int64_t>(std::floor(t * form_.rate + 1e-6));
}

void LiveFilm::Offer(double t, ColourImage picture) {
  if (is_ending_ || !IsDue(t)) return;
  last_offered_ = FrameAt(t);
  {
    const std::lock_guard lock(mutex_);
    if (has_ended_) return;
    if (queue_.size() >= kQueue) {
      ++left_out_;
      return;
    }
    queue_.push_back({last_offered_, std::move(picture)});
  }
  has_item_.notify_one();
}

void LiveFilm::End(double t) {
  is_ending_ = true;
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back({std::max(FrameAt(t), last_offered_ + 1), {}});
  }
  has_item_.notify_one();
}

bool LiveFilm::HasEnded() const {
  const std::lock_guard lock(mutex_);
  return has_ended_;
}

void LiveFilm::Write() {
  ColourImage frame;
  for (;;) {
    Item item;
    {
      std::unique_lock lock(mutex_);
      has_item_.wait(lock, [this] { return !queue_.empty(); });
      item = std::move(queue_.front());
      queue_.pop_front();
    }
    const bool is_end = item.picture.empty();
    ColourImage next;
    if (!is_end) next = LaidOut(AtSize(item.picture, form_.size), form_.shape);
    if (frame.empty()) frame = next;  // the first picture also fills the time before it
    std::visit(
        [&](auto& frames) {
          while (!frame.empty() && frames.count() < item.frame) frames.Add(frame);
          if (is_end) frames.Finish();
        },
        frames_);
    if (is_end) return;
    frame = std::move(next);
  }
}

void LiveFilm::Encode() noexcept {  // NOLINT(bugprone-exception-escape): as declared
  const CrashStack crash_stack;
  std::string fault;
  try {
    Write();
  } catch (const Error& error) {
    fault = error.what();
  } catch (const std::bad_alloc&) {
    fault = file_.string() + ": there is not enough memory for this film, so it was not written";
  }
  {
    const std::lock_guard lock(mutex_);
    fault_ = std::move(fault);
    has_ended_ = true;
    queue_.clear();
  }
  if (wake_) wake_();
}

}  // namespace arthro::app
