// All options of registration (register.h): pairs, their graph, the check of its triangles, and the
// refinement of all frames together.
#pragma once

#include "authoring/panorama/graph/refinement/refine_options.h"
#include "authoring/panorama/pairs/direct_options.h"
#include "authoring/panorama/pairs/feature_options.h"
#include "simulation/core/options.h"
#include "simulation/core/part_visitor.h"

namespace arthro::authoring {

enum class GraphStages { kPairs, kLoops, kRefinement };

struct GraphOptions {
  GraphStages stages = GraphStages::kRefinement;
  int loop_rounds = 2;
  double loops_per_frame = 0.7;
  double least_gain = 0.3;
  double loop_overlap = 0.25;
  int searches_per_gap = 6;
  double bridge_similarity = 0.3;
  double most_surprise = 4.0;
  double most_misfit = 3.0;
  template <class V>
  void Visit(V&& v) {
    v("stages", stages,
      Choices<GraphStages>{{{GraphStages::kPairs, "pairs"},
                            {GraphStages::kLoops, "loops"},
                            {GraphStages::kRefinement, "refinement"}}},
      "",
      "Extent of registration: neighbours only, with loops, or with the refinement of all frames "
      "together.");
    v("loop_rounds", loop_rounds, Range{0, 10}, "",
      "Number of searches for loops, each with the positions of the one before.");
    v("loops_per_frame", loops_per_frame, Range{0.0, 20.0}, "",
      "Pairs besides the neighbours that are tried, per frame and round.");
    v("least_gain", least_gain, Range{0.0, 100.0}, "",
      "A loop is tried when the variance that it would check is at least this multiple of its "
      "own.");
    v("loop_overlap", loop_overlap, Range{0.1, 1.0}, "",
      "Share of the window that two frames must have in common to be tried as a loop.");
    v("searches_per_gap", searches_per_gap, Range{0, 100}, "",
      "Pairs tried without prediction where neighbours do not agree.");
    v("bridge_similarity", bridge_similarity, Range{0.0, 1.0}, "",
      "A pair that alone joins two pieces must be at least this similar.");
    v("most_surprise", most_surprise, Range{1.0, 100.0}, "",
      "A pair that the places contradict by more than this times its error is false.");
    v("most_misfit", most_misfit, Range{0.1, 100.0}, "px",
      "The contradiction must also exceed this.");
  }
};

struct CycleOptions {
  double most_closure = 4.0;
  double closure_deviations = 5.0;
  template <class V>
  void Visit(V&& v) {
    v("most_closure", most_closure, Range{0.1, 100.0}, "px",
      "A loop of pairs that misses its beginning by more is inconsistent.");
    v("closure_deviations", closure_deviations, Range{1.0, 100.0}, "",
      "The same, times the error that the pairs' covariances expect; the larger one counts.");
  }
};

enum class PairMethod { kFeaturesThenDirect, kDirect, kFeatures };

struct RegisterOptions {
  PairMethod method = PairMethod::kDirect;
  int threads = 2;
  FeatureOptions features;
  DirectOptions direct;
  GraphOptions graph;
  CycleOptions cycles;
  RefineOptions refine;
  template <class V>
  void Visit(V&& v) {
    v("method", method,
      Choices<PairMethod>{{{PairMethod::kFeaturesThenDirect, "features_then_direct"},
                           {PairMethod::kDirect, "direct"},
                           {PairMethod::kFeatures, "features"}}},
      "", "Method of aligning pairs of frames.");
    v("threads", threads, Range{1, 64}, "", "Frames and pairs worked on at once.");
    features.Visit(v);
    direct.Visit(PartVisitor<V>{v, "direct_"});
    graph.Visit(PartVisitor<V>{v, "graph_"});
    cycles.Visit(PartVisitor<V>{v, "cycles_"});
    refine.Visit(PartVisitor<V>{v, "refine_"});
  }
};

}  // namespace arthro::authoring
