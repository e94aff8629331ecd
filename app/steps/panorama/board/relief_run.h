// Relief measured from the clip on the board, as parts of a scene, and the settings that it depends
// on, so that the measurement is not repeated when they stay.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>

#include "app/state/footage/measured_backdrop.h"
#include "app/steps/panorama/board/footage_board.h"
#include "authoring/relief/make/make_relief.h"

namespace arthro::app {

struct LentSession;

// Settings of a measurement.
struct ReliefSettings {
  Lens lens;
  std::set<int> excluded;
  double view_angle = 0;  // rad, of the scene's scope
  friend bool operator==(const ReliefSettings&, const ReliefSettings&) = default;
};
// Nothing where the next run does not measure: the author chose so, or there is no lens.
std::optional<ReliefSettings> ReliefSettingsOf(const FootageBoard& board);

// Result of a measurement. Without a picture there is nothing that a scene can use.
struct MadeRelief {
  MeasuredBackdrop backdrop;
  SharedPicture shown;  // the picture, small enough for the board
  authoring::ReliefReport report;
  bool is_measured() const { return backdrop.panorama && report.verdict.is_measured(); }
  // The clip does not determine depth everywhere, and a part was measured all the same.
  bool is_partial() const { return backdrop.panorama && !report.verdict.is_measured(); }
};
MadeRelief MadeReliefOf(authoring::ReliefResult result);

// Measures, or returns the measurement of the same settings. A clip or lens that cannot be used
// gives a verdict with the reason. Throws Error(kCancelled).
using ReliefMaker = std::function<authoring::ReliefResult(
    const authoring::ReliefRequest&, const Progress&, const authoring::ReliefObserver&)>;
std::shared_ptr<const MadeRelief> MeasureOnce(LentSession& session, const ReliefMaker& make,
                                              const std::filesystem::path& footage,
                                              const ReliefSettings& settings,
                                              const std::shared_ptr<FootageMail>& mail,
                                              const Progress& progress);

// The note of a frame, by its pose.
FrameNote NoteOf(const authoring::PosedFrame& frame, bool is_excluded);

// ---- Sentences about the measurement. ----
// One line each; the first one is the finding.
std::vector<std::string> WordsOfRelief(const MadeRelief& relief);
// Test behind a verdict with its value and limit: "share of frames with a pose: 0.21, limit 0.5".
std::string WordsOfTest(const authoring::ReliefVerdict& verdict);

}  // namespace arthro::app
