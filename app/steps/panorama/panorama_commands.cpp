// Import a panorama, or make one from footage.
#include <vector>

#include <GLFW/glfw3.h>

#include "app/steps/panorama/footage_work.h"

namespace arthro::app {
namespace {

using State = EditorState;

const std::vector<FileFilter>& PictureFilters() {
  static const std::vector<FileFilter> filters = {
      {"Pictures", {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp"}}, {"All files", {}}};
  return filters;
}

constexpr Command kPanoramaCommands[] = {
    {"import-panorama",
     "Import a panorama…",
     "Make a picture the backdrop.",
     "Scene",
     {GLFW_KEY_I, true},
     {},
     Idle,
     [](State& state) {
       Browse(state, BrowseFor::kOpenFile, "Import a panorama", "Import", PictureFilters(),
              ImportPanorama);
     }},
    {"make-panorama",
     "Make one from a video…",
     "Make a panorama from the frames of a video, or from a folder of pictures.",
     "Scene",
     {GLFW_KEY_M, true},
     {},
     Idle,
     BrowseForFootage},
    {"phantom-footage",
     "Footage of a digital knee…",
     "Make the footage of a computed knee, with its lens, and open it. It takes half a minute.",
     "Scene",
     {},
     {},
     Idle,
     BrowseForPhantom},
    {"run-footage",
     "Run",
     "Make the panorama. The last one is kept until this one is complete.",
     "Scene",
     {GLFW_KEY_R, true},
     {},
     [](const State& state) { return InEditor(state) && CanRun(state); },
     RunFootage,
     "Nothing has changed since the last run, or no footage is chosen."},
    {"use-panorama",
     "Use this panorama",
     "Make it the backdrop of the scene, and go to the Depth step.",
     "Scene",
     {},
     {},
     [](const State& state) {
       return Idle(state) && state.steps.panorama->footage && state.steps.panorama->footage->made;
     },
     UseMadePanorama,
     "First make a panorama from footage."},
    {"use-measured-part",
     "Use the measured part",
     "Make the part that was measured the backdrop of the scene; the rest is estimated.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && HasMeasuredPart(state); },
     UseMeasuredPart,
     "No part of the relief was measured."},
    {"measure-relief",
     "Measure the relief",
     "Measure the relief from the motion of the scope before the panorama is made, or do not.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && state.steps.panorama->footage; },
     [](State& state) {
       SetMeasuresRelief(state, !state.steps.panorama->footage->measures_relief);
     },
     "First choose a video or a folder of pictures."},
    {"mirror-scene",
     "Mirror for the other knee",
     "Mirror picture, depth, tissues, cuts, incisions and side: the same scene of the other knee.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state); },
     MirrorForOtherKnee},
    {"read-report",
     "Read its report…",
     "Read the middle and focal length of the panorama from its report.",
     "Scene",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state); },
     [](State& state) {
       Browse(state, BrowseFor::kOpenFile, "Read a panorama's report", "Read",
              {{"Reports", {".json"}}, {"All files", {}}}, ReadPanoramaReport);
     }},
};

}  // namespace

std::span<const Command> PanoramaCommands() { return kPanoramaCommands; }

}  // namespace arthro::app
