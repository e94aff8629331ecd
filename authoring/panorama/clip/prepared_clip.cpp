#include "authoring/panorama/clip/prepared_clip.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "authoring/footage/frame_look.h"
#include "authoring/panorama/clip/text_boxes.h"
#include "authoring/panorama/preparation/prepare.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr std::size_t kMostBuffered = 200'000'000;  // bytes of working pictures kept while reading
constexpr int kThumbWidth = 120;                    // px

// Rectified working pictures of the usable frames: from memory as far as they fit, otherwise read
// again.
class WorkingPictures {
 public:
  WorkingPictures(Footage& footage, const cv::Rect& part, const Rectifier& rectifier)
      : footage_(footage), part_(part), rectifier_(rectifier) {}

  void Keep(int index, const cv::Mat& working) {
    if (overflowed_) return;
    bytes_ += working.total() * working.elemSize();
    kept_.emplace(index, working);
    if (bytes_ <= kMostBuffered) return;
    overflowed_ = true;
    kept_.clear();
  }

  // Begins at the first frame; `wanted` must be in order.
  void Start(std::vector<int> wanted) {
    wanted_ = std::move(wanted);
    next_ = 0;
    if (overflowed_) footage_.Rewind();
  }
  // Returns false at the end. With `release` a kept picture is moved out.
  bool Next(int& index, cv::Mat& working, bool release) {
    if (next_ >= wanted_.size()) return false;
    index = wanted_[next_++];
    if (!overflowed_) {
      const auto entry = kept_.find(index);
      working = entry->second;
      if (release) kept_.erase(entry);
      return true;
    }
    while (footage_.index() + 1 < index)
      if (!footage_.Skip()) return false;
    cv::Mat raw;
    if (!footage_.Next(raw) || raw.empty()) return false;
    working = cv::Mat();
    rectifier_.Rectify(raw(part_), working);
    return true;
  }

 private:
  Footage& footage_;
  cv::Rect part_;
  const Rectifier& rectifier_;
  bool overflowed_ = false;
  std::size_t bytes_ = 0, next_ = 0;
  std::map<int, cv::Mat> kept_;
  std::vector<int> wanted_;
};

cv::Mat SmallOf(const cv::Mat& working) {
  cv::Mat small;
  const double scale = std::min(1.0, static_cast<double>(kThumbWidth) / working.cols);
  cv::resize(working, small, {}, scale, scale, cv::INTER_AREA);
  return small;
}

// Reads the clip once: report rows, measures of the frames, and working pictures as far as they
// fit.
std::vector<FrameLook> ReadAll(Footage& footage, const Rectifier& rectifier,
                               const PanoramaOptions& options, const FrameObserver& observer,
                               const Progress& progress, PreparedClip& clip,
                               WorkingPictures& pictures) {
  const FootageInfo& info = clip.info;
  FrameLooker looker(clip.lens.lens.circle);
  std::vector<FrameLook> looks;
  cv::Mat raw;
  for (int i = 0;; ++i) {
    const double frames = info.frames > 0 ? std::max(info.frames, i) : i + 100.0;
    progress.Step(info.frames > 0 ? fmt::format("reading frame {} of {}", i + 1, info.frames)
                                  : fmt::format("reading frame {}", i + 1),
                  i / frames);
    FrameReport row;
    row.index = i;
    FrameLook look;
    cv::Mat working;
    if (i % options.choose.every != 0) {
      if (!footage.Skip()) break;  // its reason is set by the choice
    } else {
      if (!footage.Next(raw)) break;
      if (raw.empty()) {
        row.reason = "unreadable: " + footage.fault();
      } else if (raw.cols != info.width || raw.rows != info.height) {
        row.reason = fmt::format("it is {} x {} px, the first frame {} x {}", raw.cols, raw.rows,
                                 info.width, info.height);
      } else {
        const cv::Mat lit = raw(clip.lens.part);
        look = looker.Look(lit);
        rectifier.Rectify(lit, working);
        if (!options.choose.skip_blank || look.blank.empty()) pictures.Keep(i, working);
      }
    }
    row.source = footage.NameOf(i);
    row.clip = footage.clip();
    if (observer) observer(row, working.empty() ? cv::Mat() : SmallOf(working));
    looks.push_back(look);
    clip.reports.push_back(std::move(row));
  }
  if (const std::string cut = footage.CutShort(); !cut.empty()) clip.warnings.push_back(cut);
  return looks;
}

// Marks the usable frames and returns their indices.
std::vector<int> Choose(std::vector<FrameLook>& looks, const PanoramaOptions& options,
                        PreparedClip& clip) {
  if (options.choose.skip_blank) MarkBlanks(looks);
  // An unreadable frame must not be chosen for its stretch.
  for (std::size_t i = 0; i < looks.size(); ++i)
    if (!clip.reports[i].reason.empty()) looks[i].sharpness = -1;
  const auto reasons = ReasonsAgainst(looks, options.choose);
  std::vector<int> chosen;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    FrameReport& row = clip.reports[i];
    if (row.reason.empty()) row.reason = reasons[i];
    row.is_usable = row.reason.empty();
    if (row.is_usable) chosen.push_back(static_cast<int>(i));
  }
  return chosen;
}

// Text such as "12 blank, 3 unreadable": the parts of the reasons before the colon, counted.
std::string CountedReasons(const std::vector<FrameReport>& rows) {
  std::map<std::string, int> counts;
  for (const FrameReport& row : rows)
    if (!row.is_usable)
      ++counts[row.reason.starts_with("it is ") ? "of another size"
                                                : row.reason.substr(0, row.reason.find(':'))];
  std::string words;
  for (const auto& [reason, count] : counts)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, reason);
  return words;
}

}  // namespace

double WorkingScaleOf(const RectifiedView& view) {
  // Half scale, as in the measurements of accuracy and cost (600 to 1100 px). Large pictures are
  // reduced to the same size, and small ones enlarged to the size that the search for pairs needs
  // (224 px were too few).
  constexpr double kLeast = 400, kSmall = 480, kLarge = 1100, kMostEnlarged = 2;
  const double side = std::max(view.width, view.height);
  if (side < kLeast) return std::min(kMostEnlarged, kLeast / side);
  if (side <= kSmall) return 1.0;
  return side <= kLarge ? 0.5 : std::max(0.1, 0.5 * kLarge / side);
}

PreparedClip PrepareClip(const Clips& clips, const std::optional<Lens>& lens,
                         const std::vector<PixelBox>& masked, const PanoramaOptions& options,
                         const FrameObserver& observer, StageClock& clock) {
  PreparedClip clip;
  const Progress reading = clock.Begin("read");
  Footage footage = Footage::Open(clips);
  clip.info = footage.info();
  clip.lens = LensOf(footage, lens, reading);
  clip.warnings = clip.lens.warnings;
  clip.view = ViewOf(clip.lens.lens, options.rectify);
  clip.scale = options.working_scale > 0 ? options.working_scale : WorkingScaleOf(clip.view);
  Rectifier rectifier(clip.lens.lens, options.rectify, clip.scale);
  rectifier.Exclude(BoxesIn(masked, clip.lens.part));
  if (cv::countNonZero(rectifier.mask()) == 0)
    throw Error(Code::kBadArgument,
                "the masked rectangles cover the whole picture; remove one of them", clips.front());
  clip.mask = rectifier.mask();
  WorkingPictures pictures(footage, clip.lens.part, rectifier);
  auto looks = ReadAll(footage, rectifier, options, observer, reading, clip, pictures);
  const std::vector<int> chosen = Choose(looks, options, clip);
  if (chosen.size() < 2) {
    const std::string why = CountedReasons(clip.reports);
    throw Error(
        Code::kBadImage,
        fmt::format("{} of its {} frame{} can be used, and a panorama needs two{}; choose "
                    "other footage",
                    chosen.empty() ? "none" : "only one", clip.reports.size(),
                    clip.reports.size() == 1 ? "" : "s", why.empty() ? "" : " (" + why + ")"),
        clips.front());
  }

  const Progress preparing = clock.Begin("prepare");
  ClipLookBuilder builder;
  int index = 0;
  cv::Mat working;
  const double steps = 2.0 * static_cast<double>(chosen.size());
  pictures.Start(chosen);
  for (int i = 0; pictures.Next(index, working, false); ++i) {
    preparing.Step("learning the light of the clip", i / steps);
    builder.Add(working, rectifier.mask());
  }
  const ClipLook look = builder.Finish();
  clip.text_boxes = TextBoxes(look.static_cores, clip);

  // A few at a time, in parallel.
  constexpr std::size_t kBatch = 4;
  pictures.Start(chosen);
  for (bool has_more = true; has_more;) {
    std::vector<std::pair<int, cv::Mat>> batch;
    while (batch.size() < kBatch && (has_more = pictures.Next(index, working, true)))
      batch.emplace_back(index, std::exchange(working, cv::Mat()));
    const std::size_t first = clip.frames.size();
    preparing.Step("evening out the light", 0.5 + static_cast<double>(first) / steps);
    clip.frames.resize(first + batch.size());
    cv::parallel_for_(cv::Range(0, static_cast<int>(batch.size())), [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i) {
        auto& [frame, picture] = batch[static_cast<std::size_t>(i)];
        clip.frames[first + static_cast<std::size_t>(i)] =
            Prepare(frame, picture, clip.scale, rectifier.mask(), look, options.prepare);
        picture.release();
      }
    });
  }
  clock.End();
  return clip;
}

}  // namespace arthro::authoring
