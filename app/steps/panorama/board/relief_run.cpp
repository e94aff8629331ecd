#include "app/steps/panorama/board/relief_run.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "app/state/capital.h"
#include "app/steps/panorama/board/board_picture.h"
#include "app/steps/panorama/board/footage_mail.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

// The job's progress, with words that say which part of the run it is.
Progress Measuring(const Progress& whole) {
  Progress part;
  part.stop = whole.stop;
  if (whole.report)
    part.report = [&whole](std::string_view stage, double done) {
      whole.report(fmt::format("measuring the relief: {}", stage), done);
    };
  return part;
}

}  // namespace

std::optional<ReliefSettings> ReliefSettingsOf(const FootageBoard& board) {
  const auto chosen = static_cast<std::size_t>(board.lens);
  // A relief is measured from one clip, and knows no tie points.
  if (!board.joined.empty() || !board.ties.empty()) return std::nullopt;
  if (!board.measures_relief || chosen >= board.lenses.size() || !board.lenses[chosen].lens)
    return std::nullopt;
  return ReliefSettings{*board.lenses[chosen].lens, board.excluded, board.view_angle};
}

MadeRelief MadeReliefOf(authoring::ReliefResult result) {
  MadeRelief made;
  made.backdrop = BackdropOf(result);
  if (made.backdrop.panorama) made.shown = PictureFromRgba(result.picture, kBoardEdge);
  made.report = std::move(result.report);
  return made;
}

std::shared_ptr<const MadeRelief> MeasureOnce(LentSession& session, const ReliefMaker& make,
                                              const std::filesystem::path& footage,
                                              const ReliefSettings& settings,
                                              const std::shared_ptr<FootageMail>& mail,
                                              const Progress& progress) {
  if (session.relief && session.relief_settings == settings) return session.relief;
  authoring::ReliefRequest request;
  request.footage = footage;
  request.lens = settings.lens;
  request.excluded = settings.excluded;
  request.options.view_angle = settings.view_angle;
  MadeRelief made;
  const auto refuse = [&](const std::string& sentence) {
    made.report.verdict = {"unusable", sentence, "", 0, 0};
  };
  try {
    made = MadeReliefOf(make(request, Measuring(progress), [&](const authoring::ReliefSoFar& now) {
      mail->PutReliefSoFar(std::make_shared<const authoring::ReliefSoFar>(now));
    }));
  } catch (const Error& error) {
    if (error.code() == Code::kCancelled) throw;
    refuse(error.sentence());
  } catch (const cv::Exception& error) {
    refuse("its frames could not be worked on (" + error.err + ")");
  }
  session.relief = std::make_shared<const MadeRelief>(std::move(made));
  session.relief_settings = settings;
  return session.relief;
}

FrameNote NoteOf(const authoring::PosedFrame& frame, bool is_excluded) {
  FrameNote note;
  note.reason = frame.reason;
  note.rms_px = frame.rms_px;
  note.pose_sigma = frame.sigma_m;
  note.status = is_excluded        ? FrameStatus::kExcluded
                : frame.is_posed   ? FrameStatus::kPlaced
                : frame.tracks > 0 ? FrameStatus::kRejected
                                   : FrameStatus::kUnused;
  return note;
}

std::string WordsOfTest(const authoring::ReliefVerdict& verdict) {
  return verdict.test.empty() ? ""
                              : fmt::format("{}: {:.3g}, limit {:.3g}", Capital(verdict.test),
                                            verdict.value, verdict.limit);
}

std::vector<std::string> WordsOfRelief(const MadeRelief& relief) {
  const authoring::ReliefReport& report = relief.report;
  if (!report.verdict.is_measured())
    return {"The relief was not measured: " + report.verdict.sentence + "."};
  const auto posed = std::count_if(report.frames.begin(), report.frames.end(),
                                   [](const auto& frame) { return frame.is_posed; });
  std::vector<std::string> lines = {
      fmt::format("Relief measured over {:.0f} % of the tissue in view", 100 * report.coverage)};
  lines.push_back(fmt::format(
      "{} of {} frames have a camera pose; {} points fit to {:.2f} px. The scope's tip was {:.0f} "
      "mm inside the portal at the median, and the tissue lies within {:.0f} mm.",
      posed, report.frames.size(), report.points, report.rms_px,
      MmFromMetres(report.median_insertion), MmFromMetres(report.radius)));
  if (report.scale_source == "assumed")
    lines.push_back("Give a known length on the map of the Depth step: it sets the millimetres.");
  return lines;
}

}  // namespace arthro::app
