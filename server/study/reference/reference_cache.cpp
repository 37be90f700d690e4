#include "server/study/reference/reference_cache.h"

#include <zlib.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "server/output/srgb_table.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr int kCacheVersion = 1;
constexpr std::int64_t kLongestHead = 1 << 16;

std::string checksum_text(const void* bytes, std::size_t count) {
  return std::to_string(::crc32_z(0, static_cast<const Bytef*>(bytes), count));
}

// FNV-1a: names need not be secret, only apart; the key itself stands in the file.
std::string name_of_key(const std::string& key) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : key) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  constexpr char kDigits[] = "0123456789abcdef";
  std::string name;
  for (int shift = 60; shift >= 0; shift -= 4) name += kDigits[hash >> shift & 15];
  return name;
}

std::int64_t values_of(const DisplayProfile& profile) {
  std::int64_t pixels = 0;
  for (const Viewport& v : profile.viewports) pixels += std::int64_t{v.width_px} * v.height_px;
  return 2 * 3 * pixels;
}

ReferenceHalves halves_of(const std::vector<std::uint16_t>& values, const DisplayProfile& profile) {
  ReferenceHalves halves;
  std::size_t at = 0;
  for (auto& half : halves.half) {
    for (const Viewport& v : profile.viewports) {
      LinearPicture picture{v.width_px, v.height_px, {}};
      for (auto& plane : picture.plane) {
        plane.resize(picture.pixels());
        for (float& value : plane) value = float_from_half(values[at++]);
      }
      half.push_back(std::move(picture));
    }
  }
  return halves;
}

}  // namespace

std::filesystem::path ReferenceCache::file_of(const std::string& key) const {
  return folder_ / (name_of_key(key) + ".reference");
}

std::optional<ReferenceHalves> ReferenceCache::load(const std::string& key, const DisplayProfile& profile) {
  remark_.clear();
  const std::filesystem::path file = file_of(key);
  if (!path_exists(file)) return std::nullopt;
  try {
    const std::int64_t bytes = 2 * values_of(profile);
    const std::string text = read_whole_file(file, {bytes + kLongestHead, "remove it; it is made again"});
    const std::size_t head = text.find('\n');
    if (head == std::string::npos) throw InputError(file, 0, "has no head", "remove it");
    const JsonDocument document(std::string_view(text).substr(0, head), file, 1);
    const JsonObject root = document.root();
    if (root.integer("version", 0, 1000) != kCacheVersion || root.text("key") != key) return std::nullopt;
    if (static_cast<std::int64_t>(text.size() - head - 1) != bytes ||
        root.text("crc32") != checksum_text(text.data() + head + 1, static_cast<std::size_t>(bytes))) {
      throw InputError(file, 0, "is damaged", "it is made again");
    }
    std::vector<std::uint16_t> values(static_cast<std::size_t>(bytes) / 2);
    std::memcpy(values.data(), text.data() + head + 1, static_cast<std::size_t>(bytes));
    ReferenceHalves halves = halves_of(values, profile);
    halves.passes = static_cast<int>(root.integer("passes", 0, 1 << 20));
    halves.most_passes = static_cast<int>(root.integer("most_passes", 0, 1 << 20));
    halves.goal_met = root.boolean_or("goal_met", false);
    halves.seconds = root.number("seconds", 0, 1e9);
    return halves;
  } catch (const InputError& error) {
    remark_ = error.what();
    return std::nullopt;
  }
}

void ReferenceCache::store(const std::string& key, const ReferenceHalves& halves) const {
  std::vector<std::uint16_t> values;
  for (const auto& half : halves.half) {
    for (const LinearPicture& picture : half) {
      for (const auto& plane : picture.plane) {
        for (const float value : plane) values.push_back(half_from_float(value));
      }
    }
  }
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(values.data()),
                                            2 * values.size());
  const nlohmann::ordered_json head{{"format", "herr reference"},
                                    {"version", kCacheVersion},
                                    {"key", key},
                                    {"passes", halves.passes},
                                    {"most_passes", halves.most_passes},
                                    {"goal_met", halves.goal_met},
                                    {"seconds", halves.seconds},
                                    {"crc32", checksum_text(bytes.data(), bytes.size())}};
  AtomicFile file(file_of(key));
  file.write(head.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  file.write(bytes);
  file.commit();
  sync_folder(folder_);
}

}  // namespace herr
