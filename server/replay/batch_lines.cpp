#include "server/replay/batch_lines.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "server/settings/quality_target.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

// Names with what is told of each, and how many there are.
struct Listed {
  void add(const std::string& name, const std::string& told = {}) {
    ++count;
    names += (names.empty() ? "" : ", ") + printable(name) + (told.empty() ? "" : " (" + told + ")");
  }
  // ", 2 failed: a, b", or nothing.
  std::string text(const std::string& what) const {
    return count == 0 ? "" : ", " + std::to_string(count) + " " + what + ": " + names;
  }
  std::size_t count = 0;
  std::string names;
};

std::string exit_text(const SessionReport& report) {
  return "exit " + std::to_string(report.exit_code);
}

// "1 row and 2 images left out, exit 5"
std::string left_out(const SessionReport& report) {
  const std::int64_t rows = report.findings.skipped_rows, images = report.findings.skipped_images;
  std::string text = rows > 0 ? counted(rows, "row", "rows") : "";
  if (images > 0) text += (text.empty() ? "" : " and ") + counted(images, "image", "images");
  return (text.empty() ? "" : text + " left out, ") + exit_text(report);
}

bool is_below(const std::string& warning, const std::filesystem::path& path) {
  const std::string folder = printable(path.string());
  if (folder.empty() || !warning.starts_with(folder)) return false;
  return warning.size() == folder.size() || folder.ends_with("/") ||
         std::string("/:").find(warning[folder.size()]) != std::string::npos;
}

// The same for one scene that several sessions name from their own folders: "walk/../room/lamp.glb: ...".
std::string wherever_named(const std::string& warning, const std::filesystem::path& scene_file) {
  const std::filesystem::path folder = scene_file.parent_path();
  if (!is_below(warning, folder)) return warning;
  return std::filesystem::absolute(folder).lexically_normal().string() +
         warning.substr(printable(folder.string()).size());
}

}  // namespace

std::string refused_line(const std::vector<SessionReport>& checked) {
  Listed refused;
  for (const SessionReport& report : checked) {
    if (report.unopened) refused.add(report.name, exit_text(report));
  }
  if (refused.count == 0) return {};
  const std::size_t left = checked.size() - refused.count;
  return std::to_string(refused.count) + " of " + std::to_string(checked.size()) +
         " sessions refused: " + refused.names + "; " +
         (left == 0   ? "none is left to replay"
          : left == 1 ? "the other one is replayed"
                      : "the other " + std::to_string(left) + " are replayed");
}

std::string closing_line(const std::vector<SessionReport>& reports, const std::vector<std::string>& unbegun,
                         const ReplayOptions& options) {
  Listed in_part, failed, interrupted, waiting;
  for (const SessionReport& report : reports) {
    if (report.state == ReplayState::failed)
      failed.add(report.name, report.error + ", " + exit_text(report));
    else if (report.state == ReplayState::interrupted)
      interrupted.add(report.name);
    else if (report.exit_code != kExitDone)
      in_part.add(report.name, left_out(report));
  }
  for (const std::string& name : unbegun) waiting.add(name);
  const bool unfinished = interrupted.count + waiting.count > 0;
  if (!unfinished && failed.count + in_part.count == 0) return {};
  const std::size_t done = reports.size() - failed.count - interrupted.count;
  std::string line = std::to_string(done) + " of " + std::to_string(reports.size() + unbegun.size()) +
                     " sessions done" + in_part.text("of them in part") + failed.text("failed") +
                     interrupted.text("interrupted") + waiting.text("not begun");
  if (!unfinished || !is_reproducible(options)) return line;
  return line + (options.resume      ? "; the same command goes on"
                 : options.overwrite ? "; the same command with --resume in place of --overwrite goes on"
                                     : "; the same command with --resume goes on");
}

std::vector<std::string> batch_warnings(const SessionReport& report, const std::vector<std::string>& of_scene,
                                        std::set<std::string>& said) {
  std::vector<std::string> lines;
  for (const std::string& warning : report.warnings) {
    const bool scene = is_below(warning, report.scene_file) ||
                       std::find(of_scene.begin(), of_scene.end(), warning) != of_scene.end();
    if (scene) {
      if (said.insert(wherever_named(warning, report.scene_file)).second) lines.push_back(warning);
    } else {
      const bool named = is_below(warning, report.session_folder);
      lines.push_back(named ? warning : printable(report.name) + ": " + warning);
    }
  }
  return lines;
}

}  // namespace herr
