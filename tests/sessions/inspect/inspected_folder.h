// Inspecting the folders of recorded_folder.h.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sessions/inspect/session_inspection.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {

inline SessionInspection inspected(const RecordedFolder& folder, bool strict = false, bool decode = false) {
  return inspect_session({folder.path(), strict, decode});
}

// The finding whose problem holds `part`.
inline Finding finding_with(const SessionInspection& inspection, const std::string& part) {
  for (const Finding& finding : inspection.findings.sorted())
    if (test::holds(finding.first.problem(), part)) return finding;
  ADD_FAILURE() << "no finding about " << part;
  return {Severity::note, InputError("", 0, "", "")};
}

// One camera, three pictures.
inline void write_camera_session(const RecordedFolder& folder) {
  test::write_good_session(folder);
  folder.write("session.json", test::header_json(test::cameras_json(1, 6, 4)));
  for (const char* name : {"a.png", "b.png", "c.png"})
    folder.write_image(std::string("cam0/data/") + name, 6, 4);
  folder.write("cam0/data.csv", test::kCameraHeader + "0,a.png\n40000000,b.png\n80000000,c.png\n");
}

}  // namespace herr::test
