#include "server/http/query_names.h"

#include <algorithm>
#include <cstddef>

namespace herr {
namespace {

constexpr std::size_t kLongestShown = 40;

std::string shown(const std::string& name) {
  std::string text = name.substr(0, kLongestShown);
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        return !letter && !(c >= '0' && c <= '9') && c != '_' && c != '-';
      },
      '?');
  return "\"" + text + (name.size() > kLongestShown ? "..." : "") + "\"";
}

std::string what_there_is(const std::vector<std::string>& names) {
  if (names.empty()) return "this path has no query parameters";
  std::string text = "the query parameters of this path: ";
  for (const std::string& name : names) text += (&name == names.data() ? "" : ", ") + name;
  return text;
}

}  // namespace

std::string query_problem(const HttpRequest& request, const std::vector<std::string>& names) {
  for (const auto& [name, value] : request.query) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      return "no query parameter " + shown(name) + "; " + what_there_is(names);
    if (request.query.count(name) > 1)
      return "the query parameter " + shown(name) + " is there twice; " + what_there_is(names);
  }
  return {};
}

}  // namespace herr
