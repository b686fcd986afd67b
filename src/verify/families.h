// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verify/check.h"

/// The checks themselves, a file for each family; checks.cpp lists them.
namespace tyndall::verify {

MomentOptions by(render::Method method, MomentOptions options = {});
/// For media alone and one event, which all three methods render. The march, far less noisy, takes 16 samples.
std::vector<MomentOptions> everyMethod(const MomentOptions& options = {});
/// "march", "tracking", "path".
std::string nameOf(const MomentOptions& options);

// check_light.cpp: light that scatters once
void checkAirlight(Trial& trial);
void checkLitBox(Trial& trial);
void checkLitGrid(Trial& trial);
void checkEnvironment(Trial& trial);
void checkSphereLight(Trial& trial);

// check_depth.cpp: transmittance and emission
void checkRamp(Trial& trial);
void checkVoxels(Trial& trial);
void checkEmission(Trial& trial);

// check_transport.cpp: light that scatters any number of times
void checkFurnace(Trial& trial);
void checkGridFurnace(Trial& trial);
void checkRoomFurnace(Trial& trial);
void checkHalfSpace(Trial& trial);
void checkGridHalfSpace(Trial& trial);

// check_agreement.cpp: different ways to the same picture
void checkMarchAgrees(Trial& trial);
void checkPathAgrees(Trial& trial);
void checkGuided(Trial& trial);
void checkGuidedAsPublished(Trial& trial);
void checkRayQueries(Trial& trial);

// check_bits.cpp: determinism
void checkMarchBits(Trial& trial);
void checkTrackingBits(Trial& trial);
void checkPathBits(Trial& trial);

} // namespace tyndall::verify
