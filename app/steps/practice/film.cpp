#include "app/steps/practice/film.h"

#include <fmt/format.h>

#include "app/files/scene_files.h"

namespace arthro::app {

bool MayToggleFilm(const EditorState& state) {
  return state.practice && !(state.film && state.film->is_ending());
}

void ToggleFilm(EditorState& state) {
  if (state.film) return state.film->End(FilmSeconds(state));
  Browse(
      state, BrowseFor::kSaveFile,
      "Record the scope's picture as a film, or as frame-%04d.png in an empty folder", "Record",
      {{"Films", {".mp4", ".mkv", ".avi"}}, {"Pictures", {".png"}}},
      [](EditorState& now, const std::filesystem::path& file) {
        if (now.practice && !now.film) BeginFilm(now, file);
      },
      "practice.mp4");
}

void BeginFilm(EditorState& state, const std::filesystem::path& file) {
  FilmForm form;
  form.shape = state.frame_shape;
  state.film_words.clear();
  state.film = std::make_unique<LiveFilm>(file, form, state.wake);
  state.film_begin = state.practice->snapshot().t;
  state.film_seconds = 0;
}

double FilmSeconds(const EditorState& state) {
  return state.practice ? state.practice->snapshot().t - state.film_begin : state.film_seconds;
}

bool FinishFilm(EditorState& state) {
  if (!state.film) return false;
  LiveFilm& film = *state.film;
  state.film_seconds = FilmSeconds(state);
  if (!state.practice && !film.is_ending()) film.End(state.film_seconds);
  if (!film.HasEnded()) return false;
  state.film_words = film.fault();
  if (film.fault().empty()) {
    state.film_words = fmt::format("The {} in {}", film.is_pictures() ? "pictures are" : "film is",
                                   film.file().string());
    state.film_words += film.left_out() == 0
                            ? "."
                            : fmt::format("; {} of its pictures were left out.", film.left_out());
  }
  state.is_film_lost = !film.fault().empty();
  state.message = state.film_words;
  state.film.reset();
  return true;
}

}  // namespace arthro::app
