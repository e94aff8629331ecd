// Areas of a clip's pictures that never change while the tissue moves, such as burned-in text,
// logos and dirt on the lens, as rectangles for a person to accept.
#pragma once

#include <vector>

#include "authoring/footage/pixel_box.h"
#include "authoring/panorama/clip/prepared_clip.h"

namespace arthro::authoring {

// `cores`: ClipLook::static_cores; empty: none. Raw pixels, a working pixel wider than the strokes
// on each side; boxes that nearly touch are joined; the largest first.
std::vector<PixelBox> TextBoxes(const cv::Mat& cores, const PreparedClip& clip);

// The boxes that lie in `whole`, in the pixels of that part of the picture.
std::vector<cv::Rect> BoxesIn(const std::vector<PixelBox>& boxes, const cv::Rect& whole);

}  // namespace arthro::authoring
