// How a function of the module fails: by filling in the program's PictureProblem; nothing is thrown across
// the border. Used by the files of this folder.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "sessions/pictures/picture_module.h"

namespace herr {

inline void report(PictureProblem& problem, PictureProblem::Kind kind, const std::string& text) noexcept {
  problem.kind = kind;
  problem.text[text.copy(problem.text, sizeof problem.text - 1)] = '\0';
}

// Runs `body` and returns what it does; an exception becomes `problem`, and the result of its type's default.
template <typename Body>
auto guarded(PictureProblem& problem, const Body& body) noexcept -> decltype(body()) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    problem.kind = PictureProblem::out_of_memory;
  } catch (const std::exception& error) {
    report(problem, PictureProblem::library, error.what());
  } catch (...) {
    problem.kind = PictureProblem::library;
  }
  return {};
}

}  // namespace herr
