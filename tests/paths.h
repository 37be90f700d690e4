// Where the tests of this build find the source tree and the program.
// Compiled into paths.cpp alone, so that objects of tests are the same in every checkout and a compiler cache
// can share them.
#pragma once

#include <string>

namespace herr::test {

std::string source_dir();    // the folder of CMakeLists.txt, absolute
std::string program_path();  // build/.../server/herr, absolute

}  // namespace herr::test
