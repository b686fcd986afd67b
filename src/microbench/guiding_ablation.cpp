// SPDX-License-Identifier: Apache-2.0
#include "microbench/guiding_ablation.h"

namespace tyndall::microbench {
namespace {

// Left out: what changes nothing where cells are fitted, nothing moves and no radiance is cached; and the unit, which is
// a factor of all lengths.
constexpr Variation kVariations[] = {
    {"guide.score", "cache"},
    {"guide.loads", "1"},
    {"guide.states", "1"},
    {"guide.states", "2"},
    {"guide.states", "8"},
    {"guide.fit", "false"},
    {"guide.newborn_share", "0.02"},
    {"guide.newborn_share", "0.3"},
    {"guide.fit_samples", "4"},
    {"guide.fit_samples", "64"},
    {"guide.static_grid", "false"},
    {"guide.static_width", "50"},
    {"guide.static_width", "200"},
    {"guide.normals", "true"},
    {"guide.cells.angle", "0.03"},
    {"guide.cells.angle", "0.3"},
    {"guide.cells.finest", "0.1"},
    {"guide.cells.finest", "10"},
    {"guide.cells.ratio", "1.5"},
    {"guide.cells.ratio", "4"},
    {"guide.cells.spread", "0"},
    {"guide.cells.spread", "2"},
    {"guide.prior_radius", "50"},
    {"guide.prior_radius", "450"},
    {"guide.prior_least", "0.001"},
    {"guide.most_kappa", "30"},
    {"guide.most_kappa", "1000"},
    {"guide.kappa_growth", "0.5"},
    {"guide.learn_share", "false"},
    {"guide.scatter_share", "0.3"},
    {"guide.scatter_share", "0.8"},
    {"guide.least_share", "0.1"},
    {"guide.most_share", "0.85"},
    {"guide.share_samples", "32"},
    {"guide.least_rate", "0.1"},
    {"guide.least_rate", "0.001"},
    {"guide.round_samples", "1"},
    {"guide.round_samples", "16"},
    {"guide.records", "2"},
    {"guide.records", "16"},
    {"guide.window", "1"},
    {"guide.window", "8"},
    {"guide.slots", "4096"},
    {"guide.watch", "false"},
    {"guide.learn", "false"}, // of an empty store: what guiding costs where it guides nothing
    {"render.deterministic", "true"},
};

} // namespace

std::span<const Variation> guideVariations() { return kVariations; }

} // namespace tyndall::microbench
