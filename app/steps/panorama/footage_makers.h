// What the window asks of authoring/panorama, as a function, so that tests can give their own.
#pragma once

#include <functional>

#include "authoring/panorama/make_panorama.h"

namespace arthro::app {

struct FootageMakers {
  std::function<authoring::PanoramaResult(authoring::PanoramaSession&,
                                          const authoring::PanoramaRequest&,
                                          const authoring::PanoramaObserver&, const Progress&)>
      run = [](authoring::PanoramaSession& session, const authoring::PanoramaRequest& request,
               const authoring::PanoramaObserver& observer,
               const Progress& progress) { return session.Run(request, observer, progress); };
};

}  // namespace arthro::app
