// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tyndall::microbench {

/// A scene file's text, which stands at another moment in each frame.
struct Sequence {
  std::string name;
  std::string text;
  std::filesystem::path folder; ///< of the files that it names
};

/// What happens in the room after frame kEventFrame.
enum class RoomEvent {
  Out,       ///< the brighter lamp goes out
  Moves,     ///< it starts to move, 1.7 lengths a second
  Teleports, ///< it jumps to the other side of the room
  Cut        ///< the camera looks from the opposite corner
};
inline constexpr RoomEvent kRoomEvents[] = {RoomEvent::Out, RoomEvent::Moves, RoomEvent::Teleports, RoomEvent::Cut};
inline constexpr int kEventFrame = 12;
const char* roomEventName(RoomEvent event);

/// A closed room of 4 by 2.5 by 4 with two lamps of a radius of 0.12, one three times as bright as the other; depth 2,
/// lights found by directions alone. @param always what happens has been so from the first frame on.
Sequence roomSequence(RoomEvent event, bool always);

} // namespace tyndall::microbench
