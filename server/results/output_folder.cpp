#include "server/results/output_folder.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include "server/process/exit_code.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFrameDigits = 6;

// As far as it exists, with links resolved; the rest as it is written. No slash at the end.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  fs::path result = fs::weakly_canonical(fs::absolute(path), error);
  if (error) result = fs::absolute(path).lexically_normal();
  return result.has_filename() ? result : result.parent_path();
}

bool is_inside(const fs::path& inner, const fs::path& outer) {
  const auto [mismatch, rest] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return mismatch == outer.end();
}

std::string frame_text(std::int64_t frame) {
  const std::string digits = std::to_string(frame);
  return std::string(digits.size() < kFrameDigits ? kFrameDigits - digits.size() : 0, '0') + digits;
}

std::string shown(const fs::path& path) {
  return printable(path.string());
}

bool starts_with_digits_after(const std::string& name, const std::string& prefix) {
  const auto digits = static_cast<std::ptrdiff_t>(prefix.size() + kFrameDigits);
  return name.starts_with(prefix) && name.size() > prefix.size() + kFrameDigits &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(prefix.size()), name.begin() + digits,
                     [](char c) { return c >= '0' && c <= '9'; });
}

// Of a session that failed before its first frame: a summary of anything else names its frames.
bool is_refusal(const fs::path& file) {
  if (file.filename() != "summary.json") return false;
  try {
    const JsonDocument summary(file);
    return summary.root().text("state") == "failed" && !summary.root().has("frames");
  } catch (const InputError&) {
    return false;
  }
}

[[noreturn]] void refuse_folder(const fs::path& folder, const std::error_code& error) {
  // What is short now may be there later; everything else is a wrong --out.
  if (error == std::errc::no_space_on_device || error.value() == EDQUOT) {
    throw WriteError(folder, "create", error.value());
  }
  throw UsageError("--out: cannot use " + shown(folder) + ": " + error.message() + "; choose another folder");
}

}  // namespace

std::string session_folder_name(const fs::path& session) {
  return resolved(session).filename().string();
}

OutputFolder::OutputFolder(const fs::path& out, const fs::path& session)
    : session_(resolved(session)), path_(out / session_folder_name(session)) {}

fs::path OutputFolder::picture(std::int64_t frame, const std::string& suffix) const {
  return frames_folder() / ("frame_" + frame_text(frame) + suffix);
}

fs::path OutputFolder::contact_sheet(std::int64_t frame) const {
  return path_ / ("contact_sheet_" + frame_text(frame) + ".png");
}

void OutputFolder::check(EarlierResults earlier) const {
  if (is_inside(resolved(path_), session_)) {
    throw UsageError("--out: " + shown(path_) +
                     " lies inside the session itself; choose a folder outside it");
  }
  const FileKind kind = facts_of(path_).kind;
  if (kind == FileKind::missing) return;
  if (kind != FileKind::folder) {
    throw UsageError("--out: " + shown(path_) + " exists and is not a folder; choose another folder");
  }
  const bool free = is_free();
  if (!free && earlier == EarlierResults::refuse) {
    throw UsageError("--out: " + shown(path_) +
                     " is not empty; give --resume to go on with an interrupted replay, or --overwrite to "
                     "replace the results in it");
  }
  if (free || earlier != EarlierResults::resume || path_exists(checkpoint_json())) return;
  for (const fs::path& file : earlier_results()) {
    if (is_replay_leftover(file.filename().string())) continue;
    throw UsageError("--resume: " + shown(path_) +
                     " has results but no checkpoint.json to go on from; give --overwrite to replace them");
  }
}

bool OutputFolder::is_free() const {
  if (facts_of(path_).kind == FileKind::missing) return true;
  std::error_code error;
  const std::vector<std::string> names = list_folder(path_, error);
  if (error) refuse_folder(path_, error);
  return names.empty() || (names.size() == 1 && is_refusal(path_ / names.front()));
}

FolderLock OutputFolder::prepare(PictureFormats formats, EarlierResults earlier) const {
  if (const std::error_code error = make_folders(path_)) refuse_folder(path_, error);
  std::optional<FolderLock> lock = FolderLock::take(path_);
  if (!lock) {
    throw TemporaryError("--out: another process is writing into " + shown(path_) +
                         "; wait for its end or choose another folder");
  }
  for (const fs::path& file : earlier_results()) {
    if (earlier == EarlierResults::resume && !is_replay_leftover(file.filename().string())) continue;
    if (const std::error_code error = remove_path(file)) refuse_folder(file, error);
  }
  // Only when it is empty: whatever else lies there belongs to somebody.
  remove_path(frames_folder());
  if (formats.empty()) return std::move(*lock);
  if (const std::error_code error = make_folders(frames_folder())) refuse_folder(frames_folder(), error);
  return std::move(*lock);
}

std::vector<fs::path> OutputFolder::earlier_results() const {
  std::vector<fs::path> results;
  for (const fs::path& folder : {path_, frames_folder()}) {
    std::error_code error;
    for (const std::string& name : list_folder(folder, error))
      if (is_replay_result(name) && !is_folder(folder / name)) results.push_back(folder / name);
    if (error && error != std::errc::no_such_file_or_directory) refuse_folder(folder, error);
  }
  return results;
}

bool is_replay_leftover(const std::string& name) {
  return temporary_file_pid(name) != 0 && is_replay_result(name);
}

bool is_replay_result(const std::string& name) {
  if (const long pid = temporary_file_pid(name); pid != 0) {
    // Our own number on a file that we did not make: in containers every run has the same one.
    const bool runs = pid != ::getpid() && (::kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM);
    return !runs && is_replay_result(name.substr(0, name.rfind(".tmp.")));
  }
  if (name == "frames.csv" || name == "summary.json" || name == "checkpoint.json") return true;
  const bool png = name.ends_with(".png");
  return (starts_with_digits_after(name, "frame_") && (png || name.ends_with(".exr"))) ||
         (starts_with_digits_after(name, "contact_sheet_") && png);
}

}  // namespace herr
