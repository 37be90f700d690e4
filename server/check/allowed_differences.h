// What may differ between two builds or days that are compared all the same: a heavier scene is then slower.
// Before: --allow-different. After: the comparison goes on, and reports say what differs.
#pragma once

#include <string>
#include <vector>

#include "server/check/report/check_report.h"
#include "server/results/fingerprint.h"

namespace herr {

// Which part of what a run depends on a difference lies in.
enum class DifferentPart { scene, settings, session, never };
// Those that may be allowed, in the order of help and reports.
inline constexpr DifferentPart kAllowableParts[] = {DifferentPart::scene, DifferentPart::settings,
                                                    DifferentPart::session};
// "scene", "settings", "session"; "instruction set" of what never may differ.
const char* name_of(DifferentPart part);

// scene: the scene document, its files, whether it moves. settings: every flag that shapes pictures, the
// display profile and the view. session: the files of the session's folder, and which frames of it are
// measured (settings as well). Never: the instruction set; the rest of the machine is no part of the work.
class AllowedDifferences {
 public:
  void add(DifferentPart part);
  bool has(DifferentPart part) const;
  bool empty() const { return parts_.empty(); }

 private:
  std::vector<DifferentPart> parts_;
};

// Names in any order, separated by single commas. Throws std::invalid_argument for an unknown (with the
// nearest known), an empty or a repeated one, and for what is of the machine.
AllowedDifferences allowed_differences_from(const std::string& text);

// Sorts out `found`: those that are allowed, by part. Throws NotComparable where one is not, "WHAT: --polar
// was 32x16, is 64x32", with the flag that would allow it where one can; `what` says in words what does not
// fit.
std::vector<AllowedDifference> told_differences(const std::vector<FingerprintDifference>& found,
                                                const AllowedDifferences& allowed, const std::string& what);

}  // namespace herr
