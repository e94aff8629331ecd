// The footage and its panorama in words, for people who do not program, and what of them is large
// on the board.
#pragma once

#include <string>
#include <vector>

#include "app/steps/panorama/board/footage_board.h"

namespace arthro::app {

std::string WordsOfClip(const FootageBoard& board);  // "75 frames · 800 × 640 px · 30 a second"
// "Placed: …", "Not placed: …", "Left out by you", …
std::string WordsOfFrame(const FootageBoard& board, int frame);
// Result of the last run, one line each; the first line counts frames. Empty before a run.
std::vector<std::string> WordsOfResult(const FootageBoard& board);
std::vector<std::string> WarningsOfResult(const FootageBoard& board);
// States where the next run begins, or that it would change nothing; "" before the first run.
std::string WordsOfNextRun(const FootageBoard& board);
// Stage of a run as the job reports it, with the time left.
std::string WordsOfStage(const std::string& stage);

struct Showing {
  SharedPicture picture;     // null: nothing there yet
  SharedPicture before;      // the picture before that step, shown beside it; may be null
  bool is_stand_in = false;  // not the step that was asked for
};
Showing ShowingOf(const FootageBoard& board);

}  // namespace arthro::app
