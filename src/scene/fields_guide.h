// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/field_names.h"

/// The keys of path guiding. See fields.h.
namespace tyndall::scene {

template <class V>
void fields(V& v, GuideLevels& levels) {
  v.number("angle", levels.angle, Range{0.0, 10.0, "", true}, "width of a cell per distance from the camera");
  v.number("finest", levels.finest, Range{0.0, 1e9, "guide units", true}, "width of the finest cells");
  v.number("ratio", levels.ratio, Range{1.0, 16.0, "", true}, "of the widths from level to level");
  v.number("spread", levels.spread, Range{0.0, 64.0},
           "a cell k levels coarser is taken with probability 2^(-spread k); 0 for never");
}

template <class V>
void fields(V& v, GuideSettings& guide) {
  const Range share{0.0, 1.0};
  const Range units{0.0, 1e9, "guide units"};
  v.number("unit", guide.unit, Range{0.0, kLargestLength, "scene units"},
           "length that the others are given in; 0 for the scene's diagonal / 1000");
  v.choice("score", guide.score, Names<GuideScore>(kGuideScores), "what a direction is judged by");
  v.whole("loads", guide.loads, WholeRange{1, 16}, "cells loaded at a vertex; loads times states is 16 at most");
  v.whole("states", guide.states, WholeRange{1, 16}, "of a cell");
  v.flag("static_grid", guide.staticGrid, "a coarse grid beside the one that follows the camera");
  v.flag("normals", guide.normals, "cells of the grid that follows the camera differ by normal");
  v.flag("learn_share", guide.learnShare, "of scattering's own directions");
  v.choice("weight", guide.weight, Names<GuideWeight>(kGuideWeights), "what a state's weight is the mean of");
  v.flag("fit", guide.fit, "the states of a cell are fitted together");
  v.number("newborn_share", guide.newbornShare, share, "of a fitted cell");
  v.whole("fit_samples", guide.fitSamples, WholeRange{0, 1u << 20}, "of a fitted cell before it is read");
  v.flag("learn", guide.learn, "false: the store is read alone");
  v.flag("watch", guide.watch, "measure what guiding gains, and leave it away where it does not pay");
  v.object("cells", guide.cells, "how the cells of chains grow with the distance from the camera");
  v.object("radiance", guide.radiance, "likewise those of the radiance cache (score \"cache\")");
  v.number("static_width", guide.staticWidth, Range{0.0, 1e9, "guide units", true}, "of the coarse grid's cells");
  v.number("adaptive_share", guide.adaptiveShare, share, "of the loads, where there is a coarse grid");
  v.number("prior_radius", guide.priorRadius, units, "a lobe of one sample covers about this radius at the light");
  v.number("prior_least", guide.priorLeast, Range{0.0, 2.0}, "1 - cos that it has at least");
  v.number("most_kappa", guide.mostKappa, Range{0.0, 1e6, "", true}, "concentration of a lobe of one sample at most");
  v.number("kappa_growth", guide.kappaGrowth, Range{0.0, 4.0}, "... times the number of samples to this power");
  v.number("scatter_share", guide.scatterShare, Range{0.0, 1.0, "", true},
           "of directions that scattering draws; where it is learnt, until then");
  v.number("least_share", guide.leastShare, Range{0.0, 1.0, "", true}, "lower bound of what is learnt");
  v.number("most_share", guide.mostShare, share, "upper bound");
  v.whole("share_samples", guide.shareSamples, WholeRange{1, 1u << 20}, "before what is learnt counts");
  v.number("least_rate", guide.leastRate, Range{0.0, 1.0, "", true}, "of a chain's means: 1 / their memory in samples");
  v.number("forget_below", guide.forgetBelow, share, "a miss is a score below this part of the state's weight");
  v.number("forget_rate", guide.forgetRate, share, "of the weight that a miss takes away");
  v.number("radiance_limit", guide.radianceLimit, Range{1.0, 1e9},
           "a sample of the radiance cache counts for at most this many times the mean");
  v.number("most_time", guide.mostTime, Range{0.0, 1e9, "s"}, "that a target is moved ahead for");
  v.flag("previous_lookup", guide.previousLookup,
         "in a frame's first round cells are looked up where their surface was in the frame before, by its camera");
  v.whole("round_samples", guide.roundSamples, WholeRange{0, 1u << 16},
          "samples of a pixel in a round of the picture, after which the next ones learn; 0 for a batch's");
  v.whole("records", guide.records, WholeRange{1, 64}, "vertices of a path that learn");
  v.whole("window", guide.window, WholeRange{1, 64}, "cells that a place may be kept in");
  v.whole("slots", guide.slots, WholeRange{0, 1u << 27}, "cells of the store; 0 for by the picture and the memory");
  v.number("distance_share", guide.distanceShare, Range{0.0, 0.99},
           "of distances on camera rays that chains draw; where it is learnt, at most; 0 for none");
  v.number("distance_width", guide.distanceWidth, Range{1.0, 1e5, "pixels"}, "between the vertices of their chains");
  v.whole("distance_states", guide.distanceStates, WholeRange{1, 1024}, "of a vertex");
  v.whole("distance_loads", guide.distanceLoads, WholeRange{1, 8}, "states that a camera ray loads");
  v.number("distance_sigma", guide.distanceSigma, Range{0.0, 1e9, "guide units", true},
           "standard deviation of a chain that knows nothing");
}

} // namespace tyndall::scene
