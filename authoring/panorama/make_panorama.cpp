#include "authoring/panorama/make_panorama.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "authoring/panorama/assemble_report.h"
#include "authoring/panorama/clip/prepared_clip.h"
#include "authoring/panorama/clip/text_boxes.h"
#include "authoring/panorama/clip_reports.h"
#include "authoring/panorama/compose/layout.h"
#include "authoring/panorama/compose_pieces.h"
#include "authoring/panorama/graph/register.h"
#include "authoring/panorama/known_places.h"
#include "authoring/panorama/plain_picture.h"
#include "authoring/panorama/ties/place_ties.h"
#include "simulation/core/error.h"
#include "simulation/core/options_json.h"
#include "simulation/core/process_cost.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// Limit on corrections: a focal length far from the right one is estimated less well than a nearby
// one.
constexpr int kMostCorrections = 3;

ColourImage PlainColour(const cv::Mat& picture) {
  ColourImage image(picture.cols, picture.rows);
  if (picture.empty()) return image;
  cv::Mat rgb(picture.rows, picture.cols, CV_8UC3, image.rgb.data());
  if (picture.channels() == 1)
    cv::cvtColor(picture, rgb, cv::COLOR_GRAY2RGB);
  else
    picture.copyTo(rgb);
  return image;
}

// Text of everything that a stage's product depends on.
template <class Options>
std::string KeyOf(const Options& options) {
  return OptionsText(options);
}

std::string KeyOf(const fs::path& footage) {
  std::error_code ignored;
  const auto changed = fs::last_write_time(footage, ignored).time_since_epoch().count();
  return fmt::format("{}@{}", footage.string(), changed);
}

std::string KeyOf(const PanoramaRequest& request) {
  std::string key;
  for (const fs::path& clip : ClipsOf(request)) key += KeyOf(clip) + " ";
  for (const PixelBox& box : request.masked)
    key += fmt::format("[{} {} {} {}]", box.x, box.y, box.width, box.height);
  return key;
}

std::string KeyOf(const FrameTie& tie) {
  std::string key = fmt::format(" tie {} {} {}", tie.frame, tie.pixel.x, tie.pixel.y);
  if (tie.other)
    key += fmt::format(" f {} {} {}", tie.other->frame, tie.other->pixel.x, tie.other->pixel.y);
  if (tie.panorama) key += fmt::format(" p {} {}", tie.panorama->pixel.x, tie.panorama->pixel.y);
  return key;
}

std::string KeyOf(const std::optional<Lens>& lens) {
  if (!lens) return "none";
  const Lens& l = *lens;
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(l.model),
                     l.width, l.height, l.focal_px, l.cx, l.cy, l.aspect, l.k[0], l.k[1], l.k[2],
                     l.k[3], l.field_of_view, l.circle.cx, l.circle.cy, l.circle.r);
}

// A product is valid as long as its key is unchanged.
struct Keys {
  std::string clip, places, tied, pieces;
};

Keys KeysOf(const PanoramaRequest& request) {
  const PanoramaOptions& options = request.options;
  Keys keys;
  keys.clip = KeyOf(request) + KeyOf(request.lens) + KeyOf(options.choose) +
              KeyOf(options.rectify) + KeyOf(options.prepare) +
              fmt::format("{}", options.working_scale);
  keys.places = keys.clip + KeyOf(options.registration);
  for (const int index : request.excluded) keys.places += fmt::format(" -{}", index);
  if (request.known) keys.places += fmt::format(" known {}", fmt::ptr(request.known.get()));
  keys.tied = keys.places;
  for (const FrameTie& tie : request.ties) keys.tied += KeyOf(tie);
  keys.tied += fmt::format(" {}", options.mask_text);
  keys.pieces = keys.tied + KeyOf(options.compose) + fmt::format("{}", options.least_piece);
  return keys;
}

// Cost of registration by its parts; the remainder belongs to the graph.
std::vector<StageCost> RegisterCosts(const RegisterReport& report, double whole_ms) {
  std::vector<StageCost> costs = {
      {"features", report.features_ms}, {"pairs", report.pairs_ms}, {"refine", report.refine_ms}};
  double named = 0;
  for (const StageCost& cost : costs) named += cost.cpu_ms;
  costs.push_back({"graph", std::max(0.0, whole_ms - named)});
  return costs;
}

// Rectifier by which frames are drawn.
Rectifier DrawnRectifier(const PanoramaRequest& request, const PreparedClip& clip) {
  Rectifier rectifier(clip.lens.lens, request.options.rectify, 1.0);
  rectifier.Exclude(BoxesIn(request.masked, clip.lens.part));
  // Matching leaves these marks out already (clip_look.h).
  if (request.options.mask_text) rectifier.Exclude(BoxesIn(clip.text_boxes, clip.lens.part));
  return rectifier;
}

std::string FirstReason(const std::vector<FrameResult>& frames) {
  for (const FrameResult& frame : frames)
    if (!frame.reason.empty()) return fmt::format(" (frame {}: {})", frame.index, frame.reason);
  return "";
}

}  // namespace

Clips ClipsOf(const PanoramaRequest& request) {
  Clips clips = {request.footage};
  clips.insert(clips.end(), request.joined.begin(), request.joined.end());
  return clips;
}

struct PanoramaSession::Products {
  PanoramaRequest request;  // the last request
  std::string clip_key, register_key, tie_key, compose_key;
  PreparedClip clip;
  std::vector<StageCost> clip_costs, register_costs, compose_costs;
  std::vector<FrameResult> registered, placed;  // without and with the frames of tie points
  std::vector<TiedFrame> tied;
  RegisterReport registration;
  std::vector<ComposedPiece> pieces;  // the panorama first
};

PanoramaSession::PanoramaSession() : products_(std::make_unique<Products>()) {}
PanoramaSession::PanoramaSession(PanoramaSession&&) noexcept = default;
PanoramaSession& PanoramaSession::operator=(PanoramaSession&&) noexcept = default;
PanoramaSession::~PanoramaSession() = default;

PanoramaResult PanoramaSession::Run(const PanoramaRequest& request,
                                    const PanoramaObserver& observer, const Progress& progress) {
  PanoramaResult result = RunOnce(request, observer, progress, kMostCorrections);
  if (request.options.self_calibrate && request.lens &&
      result.report.lens.focal_px != request.lens->focal_px)
    result.report.warnings.insert(
        result.report.warnings.begin(),
        fmt::format("the lens file's focal length of {:.1f} px was replaced by {:.1f} px, on which "
                    "the frames agree; calibrate the lens anew",
                    request.lens->focal_px, result.report.lens.focal_px));
  return result;
}

PanoramaResult PanoramaSession::RunOnce(const PanoramaRequest& request,
                                        const PanoramaObserver& observer, const Progress& progress,
                                        int corrections_left) {
  CheckOptions(request.options);
  Products& made = *products_;
  const PanoramaOptions& options = request.options;
  made.request = request;

  // Products that are still valid.
  const Keys keys = KeysOf(request);
  const bool has_clip = made.clip_key == keys.clip,
             has_places = has_clip && made.register_key == keys.places,
             has_tied = has_places && made.tie_key == keys.tied,
             has_pieces = has_tied && made.compose_key == keys.pieces;
  // Processor ms per frame, approximate; only the ratios matter.
  StageClock clock(progress, {{"read", has_clip ? 0 : 20},
                              {"prepare", has_clip ? 0 : 10},
                              {"register", has_places || request.known ? 0 : 60},
                              {"compose", has_pieces ? 0 : 80}});

  if (!has_clip) {
    made.clip_key = made.register_key = made.tie_key = made.compose_key = "";
    made.clip = {};
    made.registered.clear();
    made.placed.clear();
    made.pieces.clear();
    FrameObserver on_frame;
    if (observer.frame)
      on_frame = [&](const FrameReport& row, const cv::Mat& small) {
        observer.frame(row, PlainColour(small));
      };
    made.clip =
        PrepareClip(ClipsOf(request), request.lens, request.masked, options, on_frame, clock);
    made.clip_costs = clock.costs();
    made.clip_key = keys.clip;
  }
  const PreparedClip& clip = made.clip;

  if (!has_places) {
    made.register_key = made.tie_key = made.compose_key = "";
    made.pieces.clear();
    std::vector<WorkingFrame> frames;  // shares the pictures
    for (const WorkingFrame& frame : clip.frames)
      if (!request.excluded.contains(frame.index)) frames.push_back(frame);
    if (frames.size() < 2)
      throw Error(Code::kBadImage,
                  fmt::format("only {} frame{} left in; a panorama needs two", frames.size(),
                              frames.size() == 1 ? " is" : "s are"),
                  request.footage);
    made.registration = {};
    if (request.known) {
      made.registered = KnownPlaces(*request.known, clip, request.excluded);
      made.registration.drift_px = request.known->drift_px;
      made.register_costs.clear();
    } else {
      // A guessed focal length gives no constraint on the views of a plane.
      RegisterOptions registration = options.registration;
      if (clip.lens.is_guessed) registration.refine.camera_deviation = 0;
      made.registered =
          Register(frames, clip.view, clip.mask, registration, &made.registration,
                   clock.Begin("register"), clip.lens.is_guessed ? nullptr : &clip.lens.lens);
      clock.End();
      made.register_costs = RegisterCosts(made.registration, clock.costs().back().cpu_ms);
    }
    made.register_key = keys.places;
  }
  // Registers again with the focal length that the frames agree on.
  const FocalFit focal = made.registration.focal;
  if (options.self_calibrate && request.lens && focal.is_determined && corrections_left > 0 &&
      std::abs(focal.factor - 1) > kFocalIsWrong) {
    PanoramaRequest corrected = request;
    Lens& lens = *corrected.lens;
    lens.focal_px *= focal.factor;
    if (const auto field_of_view = FieldOfViewOf(lens)) lens.field_of_view = *field_of_view;
    return RunOnce(corrected, observer, progress, corrections_left - 1);
  }
  const auto counts = FramesByComponent(made.registered);
  if (const auto main = counts.find(0); main == counts.end() || main->second < 2)
    throw Error(Code::kBadImage,
                fmt::format("no two of its {} usable frames could be aligned{}; take footage that "
                            "moves slowly over tissue with some texture",
                            made.registered.size(), FirstReason(made.registered)),
                request.footage);

  if (!has_tied) {
    made.tie_key = made.compose_key = "";
    made.pieces.clear();
    made.placed = made.registered;
    made.tied.clear();
    if (!request.ties.empty()) {
      const cv::Matx33d composed_from_plane =
          LayOut(DrawnRectifier(request, clip).mask(), clip.view, made.registered, options.compose)
              .composed_from_panorama;
      made.tied = PlaceTies(clip, request.ties, request.excluded, composed_from_plane,
                            options.registration, made.placed, progress);
    }
    made.tie_key = keys.tied;
  }

  // Reports the position of every frame before the panorama is drawn.
  if (observer.frame && !has_pieces)
    for (const FrameReport& row :
         AssembleReport(clip, made.placed, made.registration, {}, request.excluded).frames)
      observer.frame(row, {});

  if (!has_pieces) {
    made.compose_key = "";
    made.pieces.clear();
    const Rectifier rectifier = DrawnRectifier(request, clip);
    ComposeObserver on_mosaic;
    if (observer.mosaic)
      on_mosaic = [&](const cv::Mat& small, double) { observer.mosaic(PlainPicture(small)); };
    made.pieces =
        ComposePieces(ClipsOf(request), clip.lens.part, rectifier, made.placed, options.least_piece,
                      options.compose, clock.Begin("compose"), on_mosaic);
    if (made.pieces.front().composed.rgba.empty())
      throw Error(Code::kBadImage,
                  "its frames were placed, but none of them could be drawn; check the lens",
                  request.footage);
    clock.End();
    made.compose_costs = {clock.costs().back()};
    made.compose_key = keys.pieces;
  }

  PanoramaResult result;
  PanoramaReport& report = result.report;
  report = AssembleReport(clip, made.placed, made.registration, made.pieces, request.excluded);
  report.footage = request.footage.string();
  report.tied = made.tied;
  report.clips = ClipReports(ClipsOf(request), report.frames);
  for (const std::string& sentence : ClipWarnings(report.clips))
    report.warnings.push_back(sentence);
  const auto chosen = JsonFromOptions(options);
  report.options = chosen.dump();
  const std::string method = chosen.value("method", "");
  report.detector = method == "direct" ? method : chosen.value("detector", method);
  report.seed = chosen.value("seed", 0);
  for (const auto& costs : {made.clip_costs, made.register_costs, made.compose_costs})
    report.stages.insert(report.stages.end(), costs.begin(), costs.end());
  report.peak_memory_mb = PeakMemoryMb();
  for (const ComposedPiece& piece : made.pieces)
    if (piece.component == 0) result.picture = PlainPicture(piece.composed.rgba);
  // One entry per piece of the report, empty for a piece of too few frames.
  for (const PieceReport& row : report.pieces) {
    RgbaPicture& picture = result.pieces.emplace_back();
    for (const ComposedPiece& piece : made.pieces)
      if (piece.component == row.component) picture = PlainPicture(piece.composed.rgba);
  }
  if (observer.frame)
    for (const FrameReport& row : result.report.frames) observer.frame(row, {});
  return result;
}

std::string PanoramaSession::NextStage(const PanoramaRequest& request) const {
  const Keys keys = KeysOf(request);
  if (products_->clip_key != keys.clip) return "read";
  if (products_->register_key != keys.places) return "register";
  if (products_->tie_key != keys.tied) return "tie";
  return products_->compose_key != keys.pieces ? "compose" : "";
}

std::optional<ColourImage> PanoramaSession::PictureOf(int index, FrameStage stage) const {
  const PreparedClip& clip = products_->clip;
  if (stage == FrameStage::kEvenLight) {
    for (const WorkingFrame& frame : clip.frames)
      if (frame.index == index) return PlainColour(frame.grey);
    return std::nullopt;
  }
  if (index < 0 || index >= static_cast<int>(clip.reports.size())) return std::nullopt;
  Footage footage = Footage::Open(ClipsOf(products_->request));
  for (int i = 0; i < index; ++i)
    if (!footage.Skip()) return std::nullopt;
  cv::Mat rgb, rectified;
  if (!footage.Next(rgb) || rgb.empty()) return std::nullopt;
  if (stage == FrameStage::kRaw) return PlainColour(rgb);
  if (rgb.cols != clip.info.width || rgb.rows != clip.info.height) return std::nullopt;
  Rectifier(clip.lens.lens, products_->request.options.rectify, clip.scale)
      .Rectify(rgb(clip.lens.part), rectified);
  return PlainColour(rectified);
}

PanoramaResult MakePanorama(const PanoramaRequest& request, const Progress& progress) {
  return PanoramaSession().Run(request, {}, progress);
}

}  // namespace arthro::authoring
