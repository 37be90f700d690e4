#include "scenes/gltf/format/known_extensions.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace herr {
namespace {

constexpr std::array<std::string_view, 17> kReadExtensions{
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",
    "KHR_lights_punctual",        "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",    "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",        "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_materials_variants",     "KHR_materials_volume",
    "KHR_mesh_quantization",      "KHR_node_visibility",
    "KHR_texture_transform"};

constexpr const char* kNothingSeen = "nothing that is seen is lost";
constexpr const char* kNoPicture = "the texture is left out";
constexpr const char* kNoMotion = "it stands still";
constexpr const char* kNoSound = "it makes no sound";
constexpr const char* kNoPhysics = "it does not fall or collide";
constexpr const char* kNoDeeds = "it does nothing when it is touched or told to";

struct Loss {
  std::string_view name;
  const char* text;
};

constexpr Loss kLosses[] = {
    // Surfaces.
    {"KHR_materials_iridescence", "shown without the colours of thin films"},
    {"KHR_materials_dispersion", "shown without dispersion: glass bends all colours alike"},
    {"KHR_materials_diffuse_transmission", "shown without the light that shines through thin surfaces"},
    {"KHR_materials_volume_scatter", "shown without scattering inside"},
    {"KHR_materials_subsurface", "shown without scattering below its surface"},
    {"KHR_materials_diffuse_roughness", "shown with smooth diffuse light"},
    {"KHR_materials_common", "shown by glTF's own factors alone"},
    {"KHR_techniques_webgl", "its shaders do not run: shown by glTF's own factors alone"},
    {"KHR_texture_procedurals", "shown without its computed textures"},
    {"EXT_texture_procedurals_mx_1_0", "shown without its computed textures"},
    {"EXT_materials_bump", "shown without its bumps"},
    {"ADOBE_materials_clearcoat_specular", "its coat has the index of refraction 1.5"},
    {"ADOBE_materials_clearcoat_tint", "shown without the tint of its coat"},
    {"ADOBE_materials_thin_transparency", "shown opaque where only this extension makes it transparent"},
    {"MSFT_packing_normalRoughnessMetallic", "its packed texture is left out"},
    {"MSFT_packing_occlusionRoughnessMetallic", "its packed texture is left out"},
    {"MSFT_minecraftMesh", "shown by glTF's own factors alone"},
    {"NV_materials_mdl", "its MDL material is left out: shown by glTF's own factors alone"},
    {"VRM", "cartoon shading, swinging hair and cloth are left out"},
    {"VRMC_materials_mtoon", "shown without cartoon shading"},
    {"VRMC_materials_hdr_emissiveMultiplier", "its emission has glTF's own strength"},
    {"BENTLEY_materials_line_style", "shown without patterns of its lines"},
    {"BENTLEY_materials_point_style", "shown without sizes of its points"},
    // Meshes.
    {"KHR_draco_mesh_compression", "its uncompressed form is shown"},
    {"KHR_meshopt_compression", "its uncompressed form is shown"},
    {"KHR_gaussian_splatting", "its splats are left out"},
    {"EXT_mesh_primitive_restart", "strips that restart within a primitive are left out"},
    {"EXT_mesh_primitive_edge_visibility", "shown without its edges"},
    {"CESIUM_primitive_outline", "shown without its outlines"},
    {"MSFT_lod", "shown in its finest form alone; coarser forms are left out"},
    {"CESIUM_RTC", "shown around its own origin, not around its place on the globe"},
    {"WEB3D_quantized_attributes", "its vertices have wrong places"},
    // Lights and sky.
    {"EXT_lights_image_based", "its environment picture is left out"},
    {"EXT_lights_ies", "its lamps shine alike in all directions"},
    {"KHR_lights_area", "its lamps with an area do not shine"},
    {"KHR_environment_map", "its environment picture is left out"},
    {"EXT_texture_video", "its video is left out"},
    {"MPEG_texture_video", "its video is left out"},
    // What happens over time.
    {"KHR_animation_pointer", kNoMotion},
    {"AGI_articulations", kNoMotion},
    {"VRMC_node_constraint", kNoMotion},
    {"VRMC_springBone", kNoMotion},
    {"VRMC_vrm_animation", kNoMotion},
    {"KHR_audio", kNoSound},
    {"KHR_audio_emitter", kNoSound},
    {"KHR_audio_graph", kNoSound},
    {"MSFT_audio_emitter", kNoSound},
    {"OMI_audio_emitter", kNoSound},
    {"KHR_physics_rigid_bodies", kNoPhysics},
    {"OMI_physics_body", kNoPhysics},
    {"OMI_physics_joint", kNoPhysics},
    {"OMI_physics_shape", kNoPhysics},
    {"OMI_collider", kNoPhysics},
    {"KHR_interactivity", kNoDeeds},
    {"KHR_node_hoverability", kNoDeeds},
    {"KHR_node_selectability", kNoDeeds},
    // Words about what is shown.
    {"AGI_stk_metadata", kNothingSeen},
    {"EXT_feature_metadata", kNothingSeen},
    {"EXT_instance_features", kNothingSeen},
    {"EXT_mesh_features", kNothingSeen},
    {"EXT_mesh_manifold", kNothingSeen},
    {"EXT_structural_metadata", kNothingSeen},
    {"FB_geometry_metadata", kNothingSeen},
    {"GODOT_single_root", kNothingSeen},
    {"GRIFFEL_bim_data", kNothingSeen},
    {"KHR_implicit_shapes", kNothingSeen},
    {"KHR_xmp", kNothingSeen},
    {"KHR_xmp_json_ld", kNothingSeen},
    {"VRMC_vrm", kNothingSeen},
};

constexpr std::string_view kPictures[] = {"EXT_texture_avif", "EXT_texture_webp", "KHR_texture_basisu",
                                          "MSFT_texture_dds", "GOOGLE_texture_basis"};

template <class List>
bool holds(const List& list, std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

}  // namespace

bool is_read_extension(std::string_view name) {
  return holds(kReadExtensions, name);
}

bool is_known_extension(std::string_view name) {
  const auto has_name = [&](const Loss& loss) { return loss.name == name; };
  return is_read_extension(name) || holds(kPictures, name) ||
         std::any_of(std::begin(kLosses), std::end(kLosses), has_name);
}

std::string extension_loss(std::string_view name, bool has_picture) {
  if (holds(kPictures, name)) return has_picture ? "the PNG or JPEG beside its picture is shown" : kNoPicture;
  for (const Loss& loss : kLosses) {
    if (loss.name == name) return loss.text;
  }
  return "it is not known; what it adds is left out";
}

bool requires_extension(const nlohmann::json& document, std::string_view name) {
  const auto list = document.find("extensionsRequired");
  return list != document.end() && std::find(list->begin(), list->end(), name) != list->end();
}

std::string extension_remedy(const std::string& name) {
  if (name == "KHR_draco_mesh_compression")
    return "export the model without Draco, or pack it with gltfpack -c";
  if (name == "KHR_meshopt_compression")
    return "its streams are newer than those of EXT_meshopt_compression, which is read: pack the model with "
           "gltfpack -c, or leave it unpacked";
  if (holds(kPictures, name)) return "export the model with PNG or JPEG textures";
  return "export the model without " + name;
}

}  // namespace herr
