// EXT_meshopt_compression: buffer views whose bytes stand compressed in another buffer. Their counts and
// strides are proved like those of plain views, and the decoded bytes pass for plain ones afterwards.
// Before: gltf_checks (buffers and views are objects with proved lengths), gltf_bytes. After: read_gltf.
// Source: EXT_meshopt_compression (Khronos); the streams are decoded by meshoptimizer.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "sessions/files/strict_json.h"

namespace herr {

// Throws InputError for a compressed view whose parameters contradict the extension or its own view.
void check_meshopt_views(const std::vector<JsonObject>& buffers, const std::vector<JsonObject>& views);

// Takes the compressed form from views whose own buffer holds bytes, where the document may be shown without
// it: for a document whose streams cannot be read. False: there are none.
bool use_plain_views(nlohmann::json& document, bool binary);

// Which buffers hold bytes that someone reads. A buffer for readers without the extension need not be there.
// Throws InputError for one without data that a plain view reads.
std::vector<bool> needed_buffers(const std::vector<JsonObject>& buffers, const std::vector<JsonObject>& views,
                                 bool binary);

// The bytes of each compressed view, decoded; empty for plain views. Together they may have `bytes_left`,
// which is taken before memory is. Throws InputError for streams that are damaged.
std::vector<std::vector<unsigned char>> decoded_views(const std::vector<JsonObject>& views,
                                                      const std::vector<std::vector<unsigned char>>& buffers,
                                                      std::int64_t bytes_left);

}  // namespace herr
