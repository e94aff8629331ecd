// What the window knows of the clip that a panorama is made from: its frames as small pictures and
// where each of them ended up, which frames and options the next run will use, and what the last
// run made. Plain values; pictures are shared since they are handed to textures and never changed.
// Frames are counted as in the report of `arthroscene panorama`: from 0.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "app/steps/panorama/lens_choice.h"
#include "app/steps/panorama/picture_zoom.h"
#include "authoring/panorama/make_panorama.h"
#include "simulation/scene/image.h"
#include "simulation/scene/projection.h"

namespace arthro::app {

class FootageMail;

using SharedPicture = std::shared_ptr<const ColourImage>;

// What became of a frame. Unused: it was never tried, being blank, unreadable or one of too many.
enum class FrameStatus { kNotYet, kPlaced, kRejected, kSeparate, kUnused, kExcluded };

struct FrameNote {
  FrameStatus status = FrameStatus::kNotYet;
  std::string reason;                        // of one that is not placed
  double rms_px = 0, expected_error_px = 0;  // of a placed one
};

enum class FrameView { kRaw, kRectified, kEvenLight };

// One frame at full size, each step of its preparation; null where there is none (yet).
struct LargeFrame {
  int frame = -1;
  SharedPicture raw, rectified, even_light;
  std::string problem;  // why one is missing
};

// A finished run.
struct MadePanorama {
  SharedPicture picture;  // black where nothing was imaged
  SharedPicture shown;    // the same, small enough for the board
  Projection projection;  // of `picture`
  authoring::PanoramaReport report;
  std::set<int> excluded;  // when it was made
};

// The stages' products, which the next run goes on from. Lent to one thread at a time: the run's,
// or the one that fetches a frame's picture.
struct LentSession {
  std::timed_mutex mutex;
  authoring::PanoramaSession session;
};

struct FootageBoard {
  // The clip.
  std::filesystem::path file;
  std::string name;
  int width = 0, height = 0;  // of a frame, px
  double frames_per_second = 0;
  std::vector<SharedPicture> thumbs;  // one a frame; null until it was read

  // What the next run will use.
  std::vector<LensChoice> lenses;  // the first one is "none"
  int lens = 0;
  authoring::PanoramaOptions options;
  std::set<int> excluded;
  std::string next_stage;  // that it begins with; empty when it would change nothing

  // What the last run, or the one that goes on, said.
  std::vector<FrameNote> notes;          // one a frame
  SharedPicture mosaic;                  // as it grows
  std::shared_ptr<LentSession> session;  // null before the first run; shared with the jobs
  std::shared_ptr<const MadePanorama> made;

  // What is looked at.
  int selected = -1;  // -1: the mosaic
  FrameView view = FrameView::kRaw;
  bool compares = false;  // beside it, what it was before
  PictureZoom zoom;
  LargeFrame large;
  bool wants_focus = true;  // so that keys walk through the frames at once
  bool scroll_to_selected = false;

  int frames() const { return static_cast<int>(thumbs.size()); }
};

// The note of a report's row.
FrameNote NoteOf(const authoring::FrameReport& report, bool is_excluded);

// Reading a clip or making its panorama, while the job goes on.
struct FootageJob {
  std::shared_ptr<FootageMail> mail;  // shared with the job's thread
  bool makes_panorama = false;
};

// As it will be shown: what the user left out is left out at once.
FrameStatus StatusOf(const FootageBoard& board, int frame);

}  // namespace arthro::app
