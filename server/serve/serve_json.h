// The JSON documents of the HTTP interface, from a snapshot alone. Before: ServeSnapshot. After: endpoints.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "server/serve/serve_board.h"
#include "server/settings/replay_options.h"

namespace herr {

// Most frames in one answer of GET /v1/frames; "more" says that there are others.
inline constexpr std::size_t kMostFramesInAnswer = 1000;

// Share of the session that was replayed in this lap, in [0, 1]; 0 before the first frame.
double session_progress(const ServeSnapshot& snapshot);

nlohmann::ordered_json status_json(const ServeSnapshot& snapshot, const ReplayOptions& options,
                                   TimeNs now_ns);
nlohmann::ordered_json latency_reply_json(const ServeSnapshot& snapshot, ReplayClock clock, TimeNs now_ns);
// Frames whose sequence is greater than `since`, oldest first; of these those alone that missed.
nlohmann::ordered_json frames_json(const ServeSnapshot& snapshot, std::int64_t since,
                                   bool missed_only = false);
// `encoder_bytes`: LatestPicture::bytes_held().
nlohmann::ordered_json plan_reply_json(const ServeSnapshot& snapshot, std::int64_t encoder_bytes);
// What the snapshot has of memory, and the encoders' part.
MemoryUse served_memory(const ServeSnapshot& snapshot, std::int64_t encoder_bytes);

}  // namespace herr
