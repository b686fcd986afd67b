// SPDX-License-Identifier: Apache-2.0
#include "bench/html.h"

#include "bench/svg.h"

#include <fmt/format.h>

namespace tyndall::bench {

std::string heading(const char* tag, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>\n", tag, escaped(text));
}

std::string note(const std::string& text) { return "<p class=\"note\">" + escaped(text) + "</p>\n"; }

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"wide\"><table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const char* cell = i == 0 ? "th" : "td";
    html += "<tr>";
    for (const std::string& text : rows[i]) {
      html += fmt::format("<{0}>{1}</{0}>", cell, escaped(text));
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

} // namespace tyndall::bench
