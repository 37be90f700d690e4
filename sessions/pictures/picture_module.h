// What the program and its picture module (herr_pictures.so) agree on. The module alone links OpenImageIO,
// whose 260 shared libraries cost 0.3 s of CPU; it is loaded by the first EXR picture that is decoded, or
// JPEG of a rare kind (loaded_module.h). Plain data and function pointers only: no exception and no standard
// container crosses the border, so that neither allocators nor type information need to agree.
#pragma once

#include <cstddef>
#include <cstdint>

namespace herr {

// Goes up with every change of this file. A module of another version is refused.
inline constexpr std::uint32_t kPictureModuleVersion = 3;

// How samples are stored in a file, or wanted in memory.
enum class SampleType : std::int32_t { u8, u16, half, f32, other };

struct PictureHeader {
  std::int32_t width_px = 0, height_px = 0, channels = 0;
  SampleType stored = SampleType::other;
};

struct PictureProblem {
  enum Kind : std::int32_t {
    none,
    bad_picture,    // the bytes are at fault
    out_of_memory,  // the machine is
    library         // OpenImageIO or its caller is
  };
  Kind kind = none;
  char text[256] = "";  // what the library says; ends with NUL
};

struct OpenPicture;  // a picture between open and close; used by one thread at a time

// Every function is thread-safe and reports failure by its result and `problem`.
struct PictureModule {
  std::uint32_t version;        // kPictureModuleVersion, first for ever
  std::uint32_t table_bytes;    // sizeof(PictureModule)
  const char* program_version;  // of the build that the module belongs to

  // Reads the header of `format` ("jpeg" or "openexr", nothing else). The bytes must outlive the picture.
  // Null on failure.
  OpenPicture* (*open)(const char* format, const void* bytes, std::size_t count, PictureHeader* header,
                       PictureProblem* problem) noexcept;
  // All samples as u8, u16 or f32: rows from the top, channels R G B or grey first, alpha unassociated.
  // `capacity_bytes` is the room at `samples`; a picture that needs another number is refused.
  bool (*read)(OpenPicture* picture, SampleType as, void* samples, std::size_t capacity_bytes,
               PictureProblem* problem) noexcept;
  void (*close)(OpenPicture* picture) noexcept;
};

// The one function that the module exports, under this name.
inline constexpr const char* kPictureModuleEntry = "herr_picture_module";
using PictureModuleEntry = const PictureModule* (*)() noexcept;

}  // namespace herr
