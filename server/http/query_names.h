// Which query parameters a path has. Before: HttpRequest. After: a handler reads the values, each there once.
#pragma once

#include <string>
#include <vector>

#include "server/http/http_message.h"

namespace herr {

// One line that says what is wrong with the names in the request's query: one that is none of `names`, or one
// that is there twice; it ends with the names that the path has. Empty: nothing is. Bytes of a name that are
// no letters, digits, '_' or '-' are shown as '?', and 40 of it at most.
std::string query_problem(const HttpRequest& request, const std::vector<std::string>& names);

}  // namespace herr
