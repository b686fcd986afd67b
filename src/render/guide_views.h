// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"
#include "render/estimator.h"

#include <map>
#include <string>
#include <vector>

namespace tyndall::render {

/// What the store of a guided estimator says of the first vertex of each pixel that does not scatter by a mirror or
/// smooth glass: channels of an image over the film's window. All are 0 where there is no such vertex or no cell.
///
/// guide.cell.R/G/B       colour of the cell, no component 0
/// guide.level            of its grid, 0 is the finest; -1: the coarse grid
/// guide.states           whose lobes may draw directions
/// guide.weight           sum of theirs
/// guide.direction.X/Y/Z  mean of the strongest one's lobe, unit, in the world
/// guide.cosine           its mean cosine
/// guide.N                samples that it rests on
/// guide.share            of directions that scattering draws
std::map<std::string, std::vector<float>> guideViews(Estimator& estimator, const film::Film& film);

} // namespace tyndall::render
