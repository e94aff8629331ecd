#include "app/panels/option_words.h"

#include <algorithm>

#include "app/state/capital.h"

namespace arthro::app {
namespace {

struct FieldLabel {
  std::string_view name;
  const char* label;
};

constexpr FieldLabel kFields[] = {
    // Frames of a clip.
    {"working_scale", "Scale of the pictures that are compared"},
    {"least_piece", "Fewest frames of a separate part"},
    {"self_calibrate", "Take the focal length from the frames"},
    {"mask_text", "Leave out text in the panorama"},
    {"every", "Use every n-th frame"},
    {"most_frames", "Most frames used"},
    {"skip_blank", "Leave out empty frames"},
    {"method", "Alignment of two frames"},
    {"detector", "Finder of points"},
    {"threads", "Frames worked on at once"},
    // Points.
    {"features", "Points per frame"},
    {"ratio", "Nearest to second nearest match, at most"},
    {"max_error", "Largest error of a match"},
    {"max_trials", "Most random trials"},
    {"fewest_inliers", "Fewest matches that agree"},
    {"seed", "Start of the random numbers"},
    // Direct alignment.
    {"direct_rotation_reach", "Largest rotation without prediction"},
    {"direct_rotation_step", "Step between rotations"},
    {"direct_predicted_rotation_reach", "Largest rotation around a prediction"},
    {"direct_zoom_reach", "Largest change of size"},
    {"direct_candidates", "Starts that are refined"},
    {"direct_most_points", "Most pixels that are aligned"},
    {"direct_most_iterations", "Most steps per resolution"},
    {"direct_smallest_overlap", "Smallest overlap"},
    {"direct_least_certainty", "Least certainty of the overlap"},
    {"direct_least_part_certainty", "Least certainty of a part of the overlap"},
    {"direct_least_part_share", "Least share of a part in the certainty"},
    {"direct_most_corner_sigma", "Largest error at the corners"},
    // Choice of pairs.
    {"graph_stages", "Extent of the alignment"},
    {"graph_loop_rounds", "Searches for loops"},
    {"graph_loops_per_frame", "Loops tried per frame"},
    {"graph_least_gain", "Least gain of a loop"},
    {"graph_loop_overlap", "Least overlap of a loop"},
    {"graph_searches_per_gap", "Pairs tried across a gap"},
    {"graph_bridge_similarity", "Least similarity of a pair that joins two parts"},
    {"graph_most_surprise", "Largest contradiction of a pair, times its error"},
    {"graph_most_misfit", "Largest contradiction of a pair"},
    {"cycles_most_closure", "Largest gap of a loop"},
    {"cycles_closure_deviations", "Largest gap of a loop, times its error"},
    {"refine_pair_floor", "Least error of a pair"},
    {"refine_loss_scale", "Error at which a pair loses weight"},
    {"refine_camera_deviation", "Freedom of a frame from the lens"},
    {"refine_refine_iterations", "Most steps"},
    // Straightening and matching.
    {"rectify_rim_margin", "Rim that is left out"},
    {"rectify_largest_half_angle", "Largest angle off the axis"},
    {"prepare_even_light", "Even out the light"},
    {"prepare_surround", "Size of structure that counts as light"},
    {"prepare_contrast", "Contrast of texture"},
    {"prepare_contrast_reach", "Distance over which contrast is measured"},
    {"prepare_most_noise", "Largest noise"},
    {"prepare_smoothing", "Smoothing of a clip without noise"},
    {"prepare_most_smoothing", "Smoothing of a noisy clip"},
    {"prepare_rim_margin", "Rim that is not compared"},
    {"prepare_mask_highlights", "Leave out highlights"},
    {"prepare_mask_tool", "Leave out instruments"},
    {"prepare_mask_static", "Leave out text and dirt on the lens"},
    // Drawing.
    {"compose_most_megapixels", "Largest panorama"},
    {"compose_most_stretch", "Largest stretch of a frame"},
    {"compose_even_light", "Even out the light of the panorama"},
    {"compose_estimate_response", "Estimate the camera's bright tones"},
    {"compose_light_reach", "Freedom of the light per frame"},
    {"compose_outlier", "Difference that is left out"},
    {"compose_averaging", "Averaging of frames"},
    {"compose_feather", "Width of the soft border"},
    {"compose_preview_every", "Frames between two previews"},
    // Depth.
    {"law", "Fall of brightness with distance"},
    {"low_percentile", "Darkest share that counts as furthest"},
    {"high_percentile", "Share up to which brightness counts"},
    {"median_radius", "Radius of noise removal"},
    {"texture_size", "Size of texture that counts as noise"},
    {"surround_threshold", "Brightness of the surround"},
    {"border_margin", "Rim without depth"},
    {"border_taper", "Band along the border"},
    {"correct_tissue", "Correct for the colour of tissue"},
    {"field_of_view", "Angle across the picture"},
    {"vignette", "Loss of light at the rim"},
    {"iterations", "Steps of the shading"},
    // Forces.
    {"smoothing_passes", "Smoothing of the depth map"},
    {"quantised_passes", "Smoothing of an 8-bit depth map"},
    {"fade_px", "Fade towards holes and borders"},
    {"noise_slope", "Slope that noise may have"},
    {"widest_smoothing", "Widest smoothing"},
    {"soft_error", "Error of depth that halves the stiffness"},
    {"damping", "Damping while approaching"},
    {"damping_onset", "Depth at which damping is whole"},
    {"static_friction", "Friction at rest"},
    {"sliding_friction", "Friction in motion"},
    {"tip_radius", "Radius of the tip"},
    {"velocity_cutoff", "Filter of the speed"},
    {"fade_begin", "Force fades from"},
    {"fade_end", "Force is gone at"},
    {"max_stiffness", "Largest stiffness at the hand"},
    {"guard_damping", "Largest damping against vibration"},
    {"guard_allowance", "Energy that may come back"},
    {"guard_delay", "Delay of the device, in ticks"},
    {"guard_quantum", "Least motion that is damped"},
    {"continuous_force", "Force for any time"},
    {"thermal_memory", "Time of the mean force"},
    {"max_force", "Largest force"},
    {"max_rise", "Largest rise of force"},
    {"max_hand_speed", "Largest speed of the hand"},
    {"ramp_time", "Time to full force"},
    {"max_sample_age", "Oldest position that gives force"},
    {"lost_after", "Silence after which a device is lost"},
    {"sleep_speed", "Speed below which tissue rests"},
    {"refresh_iterations", "Steps before a new factor is made"},
    {"coupling_tolerance", "Error of the stiffness felt"},
    {"cut_spacing", "Resolution of cuts"},
    // Solution of a step of the tissue.
    {"max_iterations", "Most iterations of a system"},
    {"max_newton", "Most Newton iterations of a step"},
    {"max_speed", "Largest speed of the tissue"},
    {"max_work", "Most work of a step"},
};

struct ChoiceLabel {
  std::string_view field, word;
  const char* label;
};

constexpr ChoiceLabel kChoices[] = {
    {"method", "features_then_direct", "by points, then by brightness"},
    {"method", "direct", "by brightness"},
    {"method", "features", "by points"},
    {"detector", "surf", "SURF"},
    {"detector", "sift", "SIFT"},
    {"detector", "akaze", "AKAZE"},
    {"detector", "orb", "ORB"},
    {"graph_stages", "pairs", "neighbours only"},
    {"graph_stages", "loops", "with loops"},
    {"graph_stages", "refinement", "all frames together"},
    {"estimator", "paper", "grey"},
    {"estimator", "inverse-square-red", "red light"},
    {"law", "inverse-square", "inverse square"},
    {"interface_scale", "auto", "automatic"},
    {"language", "auto", "automatic"},
    {"language", "english", "English"},
    {"language", "german", "Deutsch"},
    {"moving_picture", "auto", "automatic"},
};

}  // namespace

std::string WordsOfField(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return Capital(std::move(words));
}

std::string LabelOfField(std::string_view name) {
  for (const FieldLabel& entry : kFields)
    if (entry.name == name) return entry.label;
  return WordsOfField(name);
}

std::string LabelOfChoice(std::string_view field, std::string_view word) {
  for (const ChoiceLabel& entry : kChoices)
    if (entry.field == field && entry.word == word) return entry.label;
  return std::string(word);
}

std::vector<std::string_view> LabelledFields() {
  std::vector<std::string_view> names;
  for (const FieldLabel& entry : kFields) names.push_back(entry.name);
  return names;
}

std::vector<std::pair<std::string_view, std::string_view>> LabelledChoices() {
  std::vector<std::pair<std::string_view, std::string_view>> names;
  for (const ChoiceLabel& entry : kChoices) names.emplace_back(entry.field, entry.word);
  return names;
}

}  // namespace arthro::app
