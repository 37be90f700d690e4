// The words of column maps and what they stand for; reading and writing use the same tables.
// Before: the types of column_map.h. After: the parse_*.cpp files, column_map_text.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "sessions/import/map/column_map.h"

namespace herr {

template <typename Meaning>
struct MapWord {
  const char* word;
  Meaning meaning;
};

inline constexpr MapWord<double> kLengthWords[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}};
inline constexpr MapWord<double> kAngleUnitWords[] = {{"deg", 0.01745329251994329577}, {"rad", 1}};
inline constexpr MapWord<char> kSeparatorWords[] = {
    {",", ','}, {";", ';'}, {"tab", '\t'}, {"spaces", ' '}, {"auto", '\0'}};
inline constexpr MapWord<char> kDecimalWords[] = {{".", '.'}, {",", ','}, {"auto", '\0'}};
inline constexpr MapWord<bool> kMajorWords[] = {{"row", false}, {"column", true}};
inline constexpr MapWord<bool> kHandWords[] = {{"right", false}, {"left", true}};
inline constexpr MapWord<AngleKind> kConventionWords[] = {{"tangents", AngleKind::tangents},
                                                          {"spherical", AngleKind::spherical},
                                                          {"helmholtz", AngleKind::helmholtz}};
inline constexpr MapWord<GazeSpace> kSpaceWords[] = {
    {"head", GazeSpace::head}, {"eye", GazeSpace::eye}, {"world", GazeSpace::world}};
inline constexpr MapWord<RowCondition::Kind> kTestWords[] = {
    {"is", RowCondition::Kind::is},         {"is_not", RowCondition::Kind::is_not},
    {"one_of", RowCondition::Kind::one_of}, {"above", RowCondition::Kind::above},
    {"below", RowCondition::Kind::below},   {"has_bits", RowCondition::Kind::has_bits},
    {"finite", RowCondition::Kind::finite}};

// The key of each kind of rotation and how many numbers it has.
struct RotationWord {
  const char* word;
  RotationKind meaning;
  std::size_t numbers;
};
inline constexpr RotationWord kRotationWords[] = {{"quaternion_xyzw", RotationKind::quaternion_xyzw, 4},
                                                  {"quaternion_wxyz", RotationKind::quaternion_wxyz, 4},
                                                  {"quaternion_xyz", RotationKind::quaternion_xyz, 3},
                                                  {"euler_xyz", RotationKind::euler_xyz, 3},
                                                  {"matrix_3x3", RotationKind::matrix_3x3, 9},
                                                  {"matrix_3x4", RotationKind::matrix_3x4, 12},
                                                  {"matrix_4x4", RotationKind::matrix_4x4, 16},
                                                  {"rotation_vector", RotationKind::rotation_vector, 3},
                                                  {"forward", RotationKind::forward_up, 3},
                                                  {"fixed", RotationKind::fixed, 0}};

inline bool is_matrix(RotationKind kind) {
  return kind == RotationKind::matrix_3x3 || kind == RotationKind::matrix_3x4 ||
         kind == RotationKind::matrix_4x4;
}
// The matrix has the position too.
inline bool holds_position(RotationKind kind) {
  return kind == RotationKind::matrix_3x4 || kind == RotationKind::matrix_4x4;
}

// "a, b or c", each between quotes.
inline std::string either_of(std::span<const char* const> words, const std::string& quote) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += quote + words[i] + quote;
  }
  return text;
}

// The word for a meaning; the first one where none has it.
template <typename Word, std::size_t n, typename Meaning>
const char* word_of(const Word (&words)[n], const Meaning& meaning) {
  for (const Word& word : words)
    if (word.meaning == meaning) return word.word;
  return words[0].word;
}

}  // namespace herr
