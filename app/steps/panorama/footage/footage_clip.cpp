// The clip: which it is, its frames as small pictures, which of them and what options count.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "app/state/edits.h"
#include "app/state/footage/footage_source.h"
#include "app/steps/panorama/board/board_picture.h"
#include "app/steps/panorama/board/footage_mail.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "authoring/footage/find_circle.h"
#include "authoring/footage/footage.h"
#include "authoring/footage/picture_list.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 13> kVideos = {".mp4",  ".m4v", ".mov", ".avi",  ".mkv",
                                                 ".webm", ".wmv", ".mpg", ".mpeg", ".mts",
                                                 ".m2ts", ".ts",  ".mxf"};
// Beyond so many frames of a clip only every second one, every third one … is shown small, so that
// an hour of video does not fill the memory (60 kB a picture).
constexpr int kMostThumbs = 2000;

bool IsVideoName(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kVideos.begin(), kVideos.end(), extension) != kVideos.end();
}

std::vector<std::string> FootageEndings() {
  std::vector<std::string> endings(kVideos.begin(), kVideos.end());
  for (const char* picture : {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".webp"})
    endings.emplace_back(picture);
  return endings;
}

// Throws Error(kBadData) for a clip that is another one than the scene's panorama was made from.
void RequireSameClips(const authoring::Clips& files, const authoring::FootageRecord& record) {
  for (std::size_t i = 0; i < files.size() && i < record.clips.size(); ++i) {
    const std::string& known = record.clips[i].fingerprint;
    if (known != kUnknownClip && authoring::ClipFingerprint(files[i]) != known)
      throw Error(Code::kBadData,
                  "this is not the clip that the panorama was made from: its content differs; "
                  "choose that clip, or make a new panorama from this one",
                  files[i]);
  }
}

// The places of the clips become part of the document, if it is news.
void KeepPlaces(EditorState& state, const authoring::Clips& files) {
  authoring::FootageRecord record = *state.steps.panorama->footage->record;
  bool is_news = false;
  for (std::size_t i = 0; i < files.size() && i < record.clips.size(); ++i) {
    authoring::ClipFile& clip = record.clips[i];
    const fs::path file = fs::absolute(files[i]).lexically_normal();
    is_news = is_news || clip.file != file.string();
    clip.file = file.string();
    clip.name = file.filename().string();
  }
  if (!is_news || state.document().footage != state.steps.panorama->footage->record) return;
  const auto found = std::make_shared<const authoring::FootageRecord>(std::move(record));
  state.steps.panorama->footage->record = state.steps.panorama->seen = found;
  Edit(state, "Find the clip", "", [&](auto& next) { next.footage = found; });
}

bool HasPictures(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (authoring::IsPictureName(it->path())) return true;
  return false;
}

// One picture of a folder of frames stands for all of them.
fs::path ClipOf(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored) || !authoring::IsPictureName(file)) return file;
  const fs::path folder = fs::absolute(file, ignored).parent_path();
  return authoring::PicturesIn(folder).size() > 1 ? folder : file;
}

// Reads the clip once; every frame goes into the mail as a small picture, and at the end where the
// round window lies in them.
void ReadClip(authoring::Footage& footage, FootageMail& mail, const Progress& progress) {
  constexpr int kFramesForCircle = 12, kUnknownLength = 250;
  const int count = footage.info().frames;
  const int stride = count > kMostThumbs ? (count + kMostThumbs - 1) / kMostThumbs : 1;
  const int circle_stride = std::max(1, (count > 0 ? count : kUnknownLength) / kFramesForCircle);
  authoring::CircleFinder circle;
  const auto put_circle = [&] { mail.PutCircle(circle.Find().circle); };
  cv::Mat frame;
  try {
    for (int i = 0;; ++i) {
      progress.Step("Read the frames",
                    count > 0 ? std::min(1.0, static_cast<double>(i) / count) : 0);
      const bool is_thumb = i % stride == 0, is_for_circle = i % circle_stride == 0;
      if (!(is_thumb || is_for_circle ? footage.Next(frame) : footage.Skip())) break;
      mail.PutThumb(i, is_thumb ? PictureFromMat(frame, kThumbEdge) : nullptr);
      if (is_for_circle) circle.Add(frame);
    }
  } catch (const Error&) {
    put_circle();  // stopped: of what was seen
    throw;
  }
  put_circle();
}

FootageBoard NewBoard(const authoring::Clips& files, const authoring::FootageInfo& info) {
  FootageBoard board;
  board.options.emplace();
  board.file = files.front();
  board.joined.assign(files.begin() + 1, files.end());
  board.name = info.name;
  board.width = info.width, board.height = info.height;
  board.frames_per_second = info.frames_per_second;
  board.selected = 0;  // there is no mosaic yet
  board.thumbs.resize(static_cast<std::size_t>(std::max(1, info.frames)));
  board.notes.resize(board.thumbs.size());
  return board;
}

}  // namespace

bool LooksLikeFootage(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_directory(file, ignored)) return IsVideoName(file);
  return !fs::exists(file / "scene.json", ignored) && HasPictures(file);
}

void BrowseForFootage(EditorState& state) {
  Browse(state, BrowseFor::kOpenFileOrFolder, "A video, or a folder of its frames", "Open",
         {{"Footage", FootageEndings()}, {"All files", {}}}, OpenFootage);
}

namespace {

void OpenClips(EditorState& state, const authoring::Clips& files) {
  // The board of the document before is closed first; afterwards it would take this one with it.
  KeepBoardOfScene(state);
  auto mail = std::make_shared<FootageMail>();
  const std::string name = "Read " + files.back().filename().string();
  state.jobs.Start(name, [files, mail](const Progress& progress) {
    // A clip that cannot be opened ends here; the board only changes once there is a clip.
    auto footage = authoring::Footage::Open(files);
    mail->PutClip({files, footage.info()});
    ReadClip(footage, *mail, progress);
    return [count = footage.index() + 1](EditorState& now) {
      TakeFootageMail(now);
      if (!now.steps.panorama->footage) return;
      now.steps.panorama->footage->thumbs.resize(static_cast<std::size_t>(std::max(1, count)));
      now.steps.panorama->footage->notes.resize(now.steps.panorama->footage->thumbs.size());
      now.message = "The clip is read. Choose its lens and run.";
    };
  });
  state.steps.panorama->footage_job = {std::move(mail), false};
}

}  // namespace

void OpenFootage(EditorState& state, const fs::path& chosen) { OpenClips(state, {ClipOf(chosen)}); }

void BrowseForJoined(EditorState& state) {
  Browse(state, BrowseFor::kOpenFileOrFolder, "A further clip of the same joint", "Add",
         {{"Footage", FootageEndings()}, {"All files", {}}}, JoinFootage);
}

void JoinFootage(EditorState& state, const fs::path& chosen) {
  if (!state.steps.panorama->footage) return;
  authoring::Clips files = ClipsOf(RequestOf(*state.steps.panorama->footage));
  files.push_back(ClipOf(chosen));
  OpenClips(state, files);
}

void ReadFootageAgain(EditorState& state) {
  FootageBoard& board = *state.steps.panorama->footage;
  board.wants_thumbs = false;
  auto mail = std::make_shared<FootageMail>();
  const authoring::Clips files = ClipsOf(RequestOf(board));
  state.jobs.Start("Read " + board.name,
                   [files, mail, record = board.record](const Progress& progress) {
                     std::string problem;
                     try {
                       RequireSameClips(files, *record);
                       auto footage = authoring::Footage::Open(files);
                       ReadClip(footage, *mail, progress);
                     } catch (const Error& error) {
                       if (error.code() == Code::kCancelled) throw;
                       problem = error.what();
                     }
                     return [problem, files, record](EditorState& now) {
                       TakeFootageMail(now);
                       auto& footage = now.steps.panorama->footage;
                       if (!footage || footage->record != record) return;
                       footage->missing = problem;
                       if (problem.empty())
                         KeepPlaces(now, files);
                       else
                         footage->file.clear();
                     };
                   });
  state.steps.panorama->footage_job = {std::move(mail), false};
}

void BrowseForMissing(EditorState& state) {
  Browse(state, BrowseFor::kOpenFileOrFolder, "Where the clip lies now", "Choose",
         {{"Footage", FootageEndings()}, {"All files", {}}}, FindFootage);
}

void FindFootage(EditorState& state, const fs::path& chosen) {
  if (!state.steps.panorama->footage) return;
  FootageBoard& board = *state.steps.panorama->footage;
  // The first clip that is not there, else the only one.
  std::error_code ignored;
  fs::path* place = &board.file;
  for (fs::path& file : board.joined)
    if (fs::exists(*place, ignored)) place = &file;
  *place = ClipOf(chosen);
  board.missing.clear();
  board.wants_thumbs = true;
}

void BeginBoard(EditorState& state, const FootageClip& clip) {
  FootageBoard board = NewBoard(clip.files, clip.info);
  // Lens and options are those of the clip before: most clips of a day are from one scope.
  board.lenses = state.steps.panorama->footage ? state.steps.panorama->footage->lenses
                                               : LensChoices(state.steps.panorama->lens_folder);
  if (state.steps.panorama->footage) {
    board.lens = state.steps.panorama->footage->lens;
    for (LensChoice& lens : board.lenses)
      if (lens.preset) lens.lens.reset();  // its round window is to be found
    *board.options = *state.steps.panorama->footage->options;
    board.measures_relief = state.steps.panorama->footage->measures_relief;
    // A clip was added to those that were there: their frames keep their numbers.
    if (!board.joined.empty() && state.steps.panorama->footage->file == board.file) {
      board.excluded = state.steps.panorama->footage->excluded;
      board.ties = state.steps.panorama->footage->ties;
      board.masked = state.steps.panorama->footage->masked;
    }
  }
  board.view_angle = state.document().scene.scope.view_angle;
  NoteNextRun(board);
  state.steps.panorama->footage = std::move(board);
  state.steps.panorama->shows_footage = true;
  state.step = Step::kPanorama;
}

void CloseFootage(EditorState& state) {
  if (FootageIsUnderWay(state)) return;
  state.steps.panorama->footage.reset();
  state.steps.panorama->shows_footage = false;
}

void SetFootageLens(EditorState& state, int choice) {
  if (!state.steps.panorama->footage || choice < 0 ||
      choice >= static_cast<int>(state.steps.panorama->footage->lenses.size()))
    return;
  const LensChoice& lens = state.steps.panorama->footage->lenses[static_cast<std::size_t>(choice)];
  if (!lens.problem.empty()) {
    state.dialogs.push_back(ErrorDialog{lens.words, lens.problem});
    return;
  }
  state.steps.panorama->footage->lens = choice;
  state.steps.panorama->footage->large = {};  // rectified by another lens
  NoteNextRun(*state.steps.panorama->footage);
}

void BrowseForLens(EditorState& state) {
  Browse(state, BrowseFor::kOpenFile, "The lens of the scope", "Take it",
         {{"Lenses", {".json"}}, {"All files", {}}}, [](EditorState& now, const fs::path& file) {
           if (!now.steps.panorama->footage) return;
           now.steps.panorama->footage->lenses.push_back(LensFromFile(file));
           SetFootageLens(now, static_cast<int>(now.steps.panorama->footage->lenses.size()) - 1);
         });
}

void SetPanoramaOptions(EditorState& state, const authoring::PanoramaOptions& options) {
  if (!state.steps.panorama->footage) return;
  *state.steps.panorama->footage->options = options;
  NoteNextRun(*state.steps.panorama->footage);
}

void SetFrameIncluded(EditorState& state, int frame, bool included) {
  if (!state.steps.panorama->footage || frame < 0 ||
      frame >= state.steps.panorama->footage->frames())
    return;
  if (included)
    state.steps.panorama->footage->excluded.erase(frame);
  else
    state.steps.panorama->footage->excluded.insert(frame);
  KeepChoices(state, fmt::format("{} frame {}", included ? "Use" : "Leave out", frame));
  NoteNextRun(*state.steps.panorama->footage);
}

}  // namespace arthro::app
