// Readers and writers of video talk on stderr, where our one sentence belongs. OpenCV reads
// FFmpeg's level from the environment when it first opens a video, so call this before; a level
// that the user has set stays.
#pragma once

namespace arthro::authoring {

void QuietDecoders();

}  // namespace arthro::authoring
