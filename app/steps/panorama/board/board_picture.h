// Pictures of the pipeline as the window's: the one place in the program's own rooms that sees
// OpenCV's.
#pragma once

#include "app/steps/panorama/board/footage_board.h"
#include "authoring/panorama/clip/panorama_report.h"

namespace cv {
class Mat;
}

namespace arthro::app {

inline constexpr int kThumbEdge = 160;   // px, the longer edge of a small picture
inline constexpr int kBoardEdge = 2048;  // px, of what fills the board

// 8-bit grey, RGB or RGBA (straight alpha, laid on black) as RGB, averaged down so that its longer
// edge is at most `longest` (0: as it is). Null for an empty picture.
SharedPicture PictureFromMat(const cv::Mat& picture, int longest = 0);
SharedPicture PictureFromColour(const ColourImage& picture, int longest = 0);
SharedPicture PictureFromRgba(const authoring::RgbaPicture& picture, int longest = 0);

}  // namespace arthro::app
