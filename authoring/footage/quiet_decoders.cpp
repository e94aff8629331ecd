#include "authoring/footage/quiet_decoders.h"

#include <cstdlib>
#include <mutex>

#include <opencv2/core/utils/logger.hpp>

namespace arthro::authoring {

void QuietDecoders() {
  static std::once_flag once;
  std::call_once(once, [] {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    // NOLINTNEXTLINE(concurrency-mt-unsafe): only FFmpeg reads it
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  });
}

}  // namespace arthro::authoring
