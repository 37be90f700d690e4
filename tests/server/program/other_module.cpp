// A picture module that herr must refuse before it calls any function of it: there is none.
#include "sessions/pictures/picture_module.h"

namespace {

#ifdef OTHER_MODULE_interface
constexpr std::uint32_t kVersion = herr::kPictureModuleVersion + 1;
#else
constexpr std::uint32_t kVersion = herr::kPictureModuleVersion;
#endif
constexpr herr::PictureModule kModule{kVersion, sizeof(herr::PictureModule), "0.0.1", nullptr, nullptr,
                                      nullptr};

}  // namespace

extern "C" __attribute__((visibility("default"))) const herr::PictureModule* herr_picture_module() noexcept {
  return &kModule;
}
