#include "app/steps/practice/film.h"

#include <fmt/format.h>

namespace arthro::app {

bool MayToggleFilm(const EditorState& state) {
  return state.practice && !(state.steps.practice->film && state.steps.practice->film->is_ending());
}

std::filesystem::path NumberedPictures(const std::filesystem::path& file) {
  if (file.extension() != ".png" || file.filename().string().find('%') != std::string::npos)
    return file;
  return file.parent_path() / (file.stem().string() + "-%04d.png");
}

void ToggleFilm(EditorState& state) {
  if (state.steps.practice->film) return state.steps.practice->film->End(FilmSeconds(state));
  Browse(
      state, BrowseFor::kSaveFile, "Record a film (.mp4), or numbered pictures (.png)", "Record",
      {{"Films", {".mp4", ".mkv", ".avi"}}, {"Pictures", {".png"}}},
      [](EditorState& now, const std::filesystem::path& file) {
        if (now.practice && !now.steps.practice->film) BeginFilm(now, NumberedPictures(file));
      },
      "practice.mp4");
}

void BeginFilm(EditorState& state, const std::filesystem::path& file) {
  FilmForm form;
  form.shape = state.steps.practice->frame_shape;
  state.steps.practice->film_words.clear();
  state.steps.practice->film = std::make_unique<LiveFilm>(file, form, state.wake);
  state.steps.practice->film_begin = state.practice->snapshot().t;
  state.steps.practice->film_seconds = 0;
}

double FilmSeconds(const EditorState& state) {
  return state.practice ? state.practice->snapshot().t - state.steps.practice->film_begin
                        : state.steps.practice->film_seconds;
}

bool FinishFilm(EditorState& state) {
  if (!state.steps.practice->film) return false;
  LiveFilm& film = *state.steps.practice->film;
  state.steps.practice->film_seconds = FilmSeconds(state);
  if (!state.practice && !film.is_ending()) film.End(state.steps.practice->film_seconds);
  if (!film.HasEnded()) return false;
  state.steps.practice->film_words = film.fault();
  if (film.fault().empty()) {
    const std::string file = film.file().string();
    state.steps.practice->film_words = film.is_pictures()
                                           ? fmt::format("The pictures are in {}", file)
                                           : fmt::format("The film is in {}", file);
    state.steps.practice->film_words +=
        film.left_out() == 0 ? "." : fmt::format("; {} pictures were left out.", film.left_out());
  }
  state.steps.practice->is_film_lost = !film.fault().empty();
  state.message = state.steps.practice->film_words;
  state.steps.practice->film.reset();
  return true;
}

}  // namespace arthro::app
