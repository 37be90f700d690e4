// URIs as glTF files write them: names of files with percent escapes, and data that stand in the URI itself.
// Before: strict_json. After: gltf/file/gltf_bytes. Source: RFC 3986 section 2.1, RFC 2397, RFC 4648.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace herr {

// Escapes such as %20 become the byte that they stand for; a '+' is a plus, and a '%' that starts no escape
// is itself.
std::string percent_decoded(std::string_view uri);

bool is_data_uri(std::string_view uri);

// What a data URI holds, of whatever kind it says that they are: base64 or escaped text.
struct UriData {
  std::vector<unsigned char> bytes;
  const char* problem = nullptr;  // why there are none
};
UriData data_of_uri(std::string_view uri);

}  // namespace herr
