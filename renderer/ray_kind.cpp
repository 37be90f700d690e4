#include "renderer/ray_kind.h"

namespace herr {

const char* name_of(RayKind kind) {
  switch (kind) {
    case RayKind::primary:
      return "primary";
    case RayKind::shadow:
      return "shadow";
    case RayKind::catcher_shadow:
      return "catcher_shadow";
    case RayKind::mirror:
      return "mirror";
    case RayKind::mirror_shadow:
      return "mirror_shadow";
    case RayKind::refraction:
      return "refraction";
    case RayKind::refraction_shadow:
      return "refraction_shadow";
    case RayKind::occlusion:
      return "occlusion";
    case RayKind::catcher_occlusion:
      return "catcher_occlusion";
    case RayKind::probe:
      return "probe";
    case RayKind::probe_shadow:
      return "probe_shadow";
    case RayKind::catcher_probe:
      return "catcher_probe";
    case RayKind::catcher_probe_shadow:
      return "catcher_probe_shadow";
    case RayKind::behind:
      return "behind";
    case RayKind::edge:
      return "edge";
    case RayKind::edge_shadow:
      return "edge_shadow";
  }
  return "unknown";
}

}  // namespace herr
