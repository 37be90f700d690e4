// Whether a page is sound as HTML, for tests of pages.
#pragma once

#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

namespace herr {

inline std::size_t times_in(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// What is wrong with the tags: each one closed by its like, attributes in quotes. Empty: nothing.
inline std::string tag_problem(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at)) {
    if (html.compare(at, 9, "<!DOCTYPE") == 0) {
      ++at;
      continue;
    }
    const bool closes = html[at + 1] == '/';
    std::size_t end = at + (closes ? 2 : 1);
    const std::size_t name_at = end;
    while (end < html.size() && std::isalnum(static_cast<unsigned char>(html[end]))) ++end;
    const std::string name = html.substr(name_at, end - name_at);
    if (name.empty()) return "a < that is no tag: " + html.substr(at, 40);
    bool quoted = false;
    while (end < html.size() && (quoted || html[end] != '>')) {
      if (html[end] == '"') quoted = !quoted;
      if (html[end] == '<') return "a < within a tag: " + html.substr(at, 60);
      ++end;
    }
    if (closes) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
    } else if (html[end - 1] != '/' && name != "meta" && name != "img") {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

}  // namespace herr
