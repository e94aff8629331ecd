// The clip that a panorama is made from: thumbnails of its frames and the status of each, the
// frames and options of the next run, and the result of the last run. Plain values; pictures are
// shared since they are handed to textures and never changed. Frames are counted as in the report
// of `arthroscene panorama`: from 0.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/state/owned.h"
#include "app/state/settings/picture_zoom.h"
#include "app/steps/panorama/board/lens_choice.h"
#include "authoring/footage/pixel_box.h"
#include "authoring/panorama/ties/frame_tie.h"
#include "simulation/scene/image.h"

namespace arthro::authoring {
struct FootageRecord;
struct PanoramaOptions;
struct ReliefSoFar;
}  // namespace arthro::authoring

namespace arthro::app {

class FootageMail;
struct LentSession;   // panorama_run.h
struct MadePanorama;  // the same

using SharedPicture = std::shared_ptr<const ColourImage>;

// Status of a frame. Unused: it was never tried, because it is blank, unreadable or one of too
// many.
enum class FrameStatus { kNotYet, kPlaced, kRejected, kSeparate, kUnused, kExcluded };

struct FrameNote {
  FrameStatus status = FrameStatus::kNotYet;
  std::string reason;                        // why the frame is not placed
  double rms_px = 0, expected_error_px = 0;  // errors of a placed frame
  // Standard deviation of the camera's position, m; 0 where the frame was placed without a pose.
  double pose_sigma = 0;
};

enum class FrameView { kRaw, kRectified, kEvenLight };

// One frame at full size, each step of its preparation; null where there is none (yet).
struct LargeFrame {
  int frame = -1;
  SharedPicture raw, rectified, even_light;
  std::string problem;  // why one is missing
};

// Meaning of a click on the large picture.
enum class BoardTool { kLook, kTie, kMask };

struct FootageBoard {
  // The clip, and further ones that are joined to it.
  std::filesystem::path file;
  std::vector<std::filesystem::path> joined;
  std::string missing;  // a clip that is gone, in a sentence; empty: all are there
  // How the scene's panorama was made, where the board shows that; null: another clip.
  std::shared_ptr<const authoring::FootageRecord> record;
  bool wants_thumbs = false;  // the clip of a reopened scene, which was not read yet
  std::string name;
  int width = 0, height = 0;  // size of a frame, px
  double frames_per_second = 0;
  std::vector<SharedPicture> thumbs;  // one per frame; null until it was read

  // Settings of the next run.
  std::vector<LensChoice> lenses;  // the first one is "none"
  int lens = 0;
  Owned<authoring::PanoramaOptions> options;  // never empty
  std::set<int> excluded;
  std::vector<authoring::FrameTie> ties;
  std::vector<authoring::PixelBox> masked;  // px of the raw pictures
  bool measures_relief = true;              // before the panorama, where the lens is known
  double view_angle = 0;                    // rad, of the scene's scope
  std::string next_stage;  // first stage of the next run; empty when it would change nothing

  // Report of the last run, or of the one under way.
  std::vector<FrameNote> notes;                          // one per frame
  SharedPicture mosaic;                                  // grows during a run
  std::shared_ptr<const authoring::ReliefSoFar> motion;  // poses and points; the same
  std::shared_ptr<LentSession> session;  // null before the first run; shared with the jobs
  std::shared_ptr<const MadePanorama> made;

  // Selection.
  int selected = -1;  // -1: the mosaic
  FrameView view = FrameView::kRaw;
  bool compares = false;  // beside it, what it was before
  PictureZoom zoom;
  BoardTool tool = BoardTool::kLook;
  std::optional<glm::dvec2> picked;  // raw pixel of the first point of a pair, or corner of a box
  LargeFrame large;
  bool wants_focus = true;  // so that keys walk through the frames at once
  bool scroll_to_selected = false;

  int frames() const { return static_cast<int>(thumbs.size()); }
};

// Reading a clip or making its panorama, while the job goes on.
struct FootageJob {
  std::shared_ptr<FootageMail> mail;  // shared with the job's thread
  bool makes_panorama = false;
};

// Status as it is shown: a frame that the user left out counts at once.
FrameStatus StatusOf(const FootageBoard& board, int frame);

}  // namespace arthro::app
