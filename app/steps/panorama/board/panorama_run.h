// A run from footage to panorama: what the window asks of authoring/panorama, and the result.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <set>

#include "app/steps/panorama/board/footage_board.h"
#include "app/steps/panorama/board/relief_run.h"
#include "authoring/panorama/make_panorama.h"
#include "simulation/scene/projection.h"

namespace arthro::app {

// The panorama and relief jobs as functions, so that tests can replace them.
struct FootageMakers {
  std::function<authoring::PanoramaResult(authoring::PanoramaSession&,
                                          const authoring::PanoramaRequest&,
                                          const authoring::PanoramaObserver&, const Progress&)>
      run = [](authoring::PanoramaSession& session, const authoring::PanoramaRequest& request,
               const authoring::PanoramaObserver& observer,
               const Progress& progress) { return session.Run(request, observer, progress); };
  ReliefMaker relief = authoring::MakeRelief;
};

// A finished run. Where the relief was measured, picture and projection are those of the relief,
// and no frame was placed on a plane.
struct MadePanorama {
  SharedPicture picture;  // black where nothing was imaged
  SharedPicture shown;    // the same, small enough for the board
  Projection projection;  // projection of `picture`
  authoring::PanoramaReport report;
  std::set<int> excluded;                                  // when it was made
  std::shared_ptr<const authoring::FootageRecord> record;  // part that a scene keeps
  std::shared_ptr<const MadeRelief> relief;  // result of the measurement; null: none was tried
  bool is_measured() const { return relief && relief->is_measured(); }
};

// The stages' products, which the next run goes on from. Lent to one thread at a time: the run's,
// or the one that fetches a frame's picture.
struct LentSession {
  std::timed_mutex mutex;
  authoring::PanoramaSession session;
  // The last measurement and its settings.
  std::shared_ptr<const MadeRelief> relief;
  std::optional<ReliefSettings> relief_settings;
};

// The note of a report's row.
FrameNote NoteOf(const authoring::FrameReport& report, bool is_excluded);

}  // namespace arthro::app
