// Areas of a clip's pictures that never change while the tissue moves, such as burned-in text,
// logos and dirt on the lens, as rectangles for a person to accept.
#pragma once

#include <vector>

#include "authoring/footage/pixel_box.h"
#include "authoring/panorama/clip/prepared_clip.h"

namespace arthro::authoring {

// `marks`: ClipLook::static_marks; empty: none. Raw pixels; boxes that nearly touch are joined; the
// largest first.
std::vector<PixelBox> TextBoxes(const cv::Mat& marks, const PreparedClip& clip);

// The boxes that lie in `whole`, in the pixels of that part of the picture.
std::vector<cv::Rect> BoxesIn(const std::vector<PixelBox>& boxes, const cv::Rect& whole);

}  // namespace arthro::authoring
