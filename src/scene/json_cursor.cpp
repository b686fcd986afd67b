// SPDX-License-Identifier: Apache-2.0
#include "scene/json_cursor.h"

#include <algorithm>

namespace tyndall::scene::json {

std::size_t characterLength(std::string_view text, std::size_t at) {
  if (at >= text.size()) {
    return 0;
  }
  const auto byte = [&](std::size_t i) { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u; };
  const auto tail = [&](std::size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
  const unsigned lead = byte(0);
  const unsigned second = byte(1);
  if (lead < 0x80u) {
    return 1;
  }
  if (lead >= 0xc2u && lead <= 0xdfu) {
    return tail(1) ? 2 : 0;
  }
  if (lead >= 0xe0u && lead <= 0xefu) {
    const bool overlong = lead == 0xe0u && second < 0xa0u;
    const bool surrogate = lead == 0xedu && second > 0x9fu;
    return tail(1) && tail(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (lead >= 0xf0u && lead <= 0xf4u) {
    const bool overlong = lead == 0xf0u && second < 0x90u;
    const bool tooLarge = lead == 0xf4u && second > 0x8fu;
    return tail(1) && tail(2) && tail(3) && !overlong && !tooLarge ? 4 : 0;
  }
  return 0;
}

void Cursor::advance() {
  if (atEnd()) {
    return;
  }
  if (text_[at_] == '\n') {
    ++position_.line;
    position_.column = 1;
    ++at_;
    return;
  }
  at_ += std::max<std::size_t>(characterLength(text_, at_), 1);
  ++position_.column;
}

} // namespace tyndall::scene::json
