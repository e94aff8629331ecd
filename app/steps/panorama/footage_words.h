// The footage and its panorama in words, for people who do not program, and what of them is large
// on the board.
#pragma once

#include <string>
#include <vector>

#include "app/steps/panorama/footage_board.h"

namespace arthro::app {

std::string WordsOfClip(const FootageBoard& board);  // "75 frames · 800 × 640 px · 30 a second"
// "Placed: …", "Not placed: …", "Left out by you", …
std::string WordsOfFrame(const FootageBoard& board, int frame);
// What the last run made, a line each; the first one counts frames. Nothing before a run.
std::vector<std::string> WordsOfResult(const FootageBoard& board);
std::vector<std::string> WarningsOfResult(const FootageBoard& board);
// Where the next run begins, or that it would change nothing; "" before the first one.
std::string WordsOfNextRun(const FootageBoard& board);
// What a run is about, as the job tells it: with the time left.
std::string WordsOfStage(const std::string& stage);

struct Showing {
  SharedPicture picture;     // null: nothing there yet
  SharedPicture before;      // beside it, what it was before that step; may be null
  bool is_stand_in = false;  // not the step that was asked for
};
Showing ShowingOf(const FootageBoard& board);

}  // namespace arthro::app
