// Silences readers and writers of video, which otherwise print to stderr beside the program's own
// message. OpenCV reads FFmpeg's log level from the environment when it first opens a video, so
// call this before. A level that the user has set is kept.
#pragma once

namespace arthro::authoring {

void QuietDecoders();

}  // namespace arthro::authoring
