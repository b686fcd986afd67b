// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

/// What the frames of sequences say about how fast chains learn and forget.
namespace tyndall::microbench {

/// Of the pixels of a frame, those of most error: at a few samples a pixel single paths would be all that is seen.
inline constexpr double kTrimmedFrameShare = 0.005;

/// relMSE of pictures of one frame against its reference, mean over the pictures, without the pixels where their error
/// is largest.
double frameError(const std::vector<std::vector<double>>& pictures, const std::vector<double>& reference);

/// A frame counts as recovered with errors of at most this many times those of a sequence that has never been
/// otherwise,
inline constexpr double kRecoveredWithin = 1.25;
/// ... as means over so many frames.
inline constexpr std::size_t kRecoveryWindow = 3;

/// Frames after an event until the error has recovered: before the first window whose mean is within kRecoveredWithin
/// of the mean of `steady`. Empty: it has not.
/// @param errors of the frames after the event. @param steady of the same frames, where what happened has always been
/// so.
std::optional<std::size_t> framesToRecover(std::span<const double> errors, std::span<const double> steady);

} // namespace tyndall::microbench
