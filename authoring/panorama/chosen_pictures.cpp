#include "authoring/panorama/chosen_pictures.h"

namespace arthro::authoring {

bool ChosenPictures::operator()(int& index, cv::Mat& rgb) {
  while (!wanted_.empty() && footage_.index() < *wanted_.rbegin()) {
    if (!wanted_.contains(footage_.index() + 1)) {
      if (!footage_.Skip()) break;
      continue;
    }
    if (!footage_.Next(rgb)) break;
    if (rgb.empty()) continue;  // the file has changed since the first reading
    index = footage_.index();
    return true;
  }
  footage_.Rewind();
  return false;
}

}  // namespace arthro::authoring
