#include "server/output/exr_encoder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "server/output/memory_stream.h"
#include "server/output/srgb_table.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

// ZIPS at level 1: README.md of this folder says why.
constexpr Imf::Compression kCompression = Imf::ZIPS_COMPRESSION;
constexpr int kZipLevel = 1;

constexpr const char* kUnit =
    "W/(sr m^2) in each channel, linear, relative to the scene's lights; of a camera feed: its white is "
    "2^-herr.exposure_ev";

// What only a look at every pixel tells.
struct PixelFacts {
  std::int64_t nonfinite_values = 0;
  bool opaque = true;  // alpha is 1 everywhere
};

PixelFacts pixel_facts_of(const ViewportImage& image) {
  constexpr std::uint16_t kOpaque = 0x3C00;
  PixelFacts facts;
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint16_t* texel = image.row(y);
    for (int x = 0; x < image.width_px; ++x, texel += 4) {
      for (int c = 0; c < 4; ++c) facts.nonfinite_values += half_is_finite(texel[c]) ? 0 : 1;
      facts.opaque = facts.opaque && texel[3] == kOpaque;
    }
  }
  return facts;
}

Imath::V3d vec(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

std::string quaternion_text(const glm::dquat& q) {
  return shortest_text(q.x) + " " + shortest_text(q.y) + " " + shortest_text(q.z) + " " + shortest_text(q.w);
}

void describe_run(const PictureMetadata& metadata, Imf::Header& header) {
  header.insert("herr.frame", Imf::IntAttribute(static_cast<int>(metadata.frame)));
  header.insert("herr.session", Imf::StringAttribute(metadata.session));
  header.insert("herr.scene", Imf::StringAttribute(metadata.scene));
  header.insert("herr.program", Imf::StringAttribute(metadata.program));
  header.insert("herr.isa", Imf::StringAttribute(metadata.isa));
  header.insert("herr.settings", Imf::StringAttribute(metadata.settings));
}

// Values are those of the scene: a viewer multiplies by 2^exposure to see what an 8-bit picture shows.
void describe_exposure(const ViewportImage& picture, Imf::Header& header) {
  header.insert("herr.exposure_ev", Imf::DoubleAttribute(std::log2(double{picture.exposure})));
}

// Primaries and white of sRGB, as the scene's colours are stated: Chromaticities' own default. No luminance
// of white is stated: scenes state radiance, and how bright a camera's feed was is not known.
void describe_values(const PixelFacts& pixels, Imf::Header& header) {
  const Imf::Chromaticities srgb;
  Imf::addChromaticities(header, srgb);
  Imf::addAdoptedNeutral(header, srgb.white);
  header.insert("herr.unit", Imf::StringAttribute(kUnit));
  header.insert("herr.alpha", Imf::StringAttribute(pixels.opaque ? "1 everywhere" : "premultiplied"));
}

void describe_head(const FrameSample& sample, Imf::Header& header) {
  // OpenEXR has no 64-bit integer attribute: stamps are text.
  header.insert("herr.time_ns", Imf::StringAttribute(std::to_string(sample.t_ns)));
  header.insert("herr.pose_stamp_ns", Imf::StringAttribute(std::to_string(sample.head.stamp_ns)));
  header.insert("herr.pose_source", Imf::StringAttribute(name_of(sample.head.source)));
  header.insert("herr.head_position_m", Imf::V3dAttribute(vec(sample.head.world_from_head.position)));
  header.insert("herr.head_orientation_xyzw",
                Imf::StringAttribute(quaternion_text(sample.head.world_from_head.orientation)));
}

void describe_eye(const FrameSample& sample, Eye of, Imf::Header& header) {
  const auto eye = static_cast<std::size_t>(of);
  header.setView(of == Eye::left ? "left" : "right");
  header.insert("herr.eye_position_in_head_m", Imf::V3dAttribute(vec(sample.head_from_eye[eye].position)));
  header.insert("herr.eye_orientation_in_head_xyzw",
                Imf::StringAttribute(quaternion_text(sample.head_from_eye[eye].orientation)));
  header.insert("herr.gaze_in_head", Imf::V3dAttribute(vec(sample.gaze.head_direction[eye])));
  header.insert("herr.gaze_source", Imf::StringAttribute(name_of(sample.gaze.source[eye])));
}

// What stands for the camera of a part: the eye that sees it, or the camera outside. None: neither is known.
std::optional<Pose> world_from_camera(const PictureOutline& outline, const FrameSample& sample,
                                      const PictureMetadata& metadata) {
  if (outline.eye) {
    return metadata.world_from_session * sample.head.world_from_head *
           sample.head_from_eye[static_cast<std::size_t>(*outline.eye)];
  }
  return outline.kind == PictureKind::outside ? metadata.world_from_outside : std::nullopt;
}

// As OpenEXR states it (ImfStandardAttributes.h): row vectors, as all of Imath; the camera's space is
// left-handed, x to the right, y up, z into the picture.
Imath::M44f world_to_camera(const Pose& world_from_camera) {
  const Pose camera_from_world = inverse(world_from_camera);
  const glm::dmat3 turn = glm::mat3_cast(camera_from_world.orientation);  // [column][row], column vectors
  Imath::M44f matrix;
  for (int axis = 0; axis < 3; ++axis) {
    const double sign = axis == 2 ? -1 : 1;
    for (int of = 0; of < 3; ++of) matrix[of][axis] = static_cast<float>(sign * turn[of][axis]);
    matrix[3][axis] = static_cast<float>(sign * camera_from_world.position[axis]);
  }
  return matrix;
}

void describe_camera(const Pose& world_from_camera, Imf::Header& header) {
  header.insert("herr.camera_position_m", Imf::V3dAttribute(vec(world_from_camera.position)));
  header.insert("herr.camera_orientation_xyzw",
                Imf::StringAttribute(quaternion_text(world_from_camera.orientation)));
  Imf::addWorldToCamera(header, world_to_camera(world_from_camera));
}

void describe_place(const Pose& world_from_session, Imf::Header& header) {
  header.insert("herr.world_from_session_position_m", Imf::V3dAttribute(vec(world_from_session.position)));
  header.insert("herr.world_from_session_orientation_xyzw",
                Imf::StringAttribute(quaternion_text(world_from_session.orientation)));
}

// The rectangle that the display window covers at distance 1 before the camera, y up. The picture lies in its
// upper left corner; the window is as large as the largest part.
void describe_projection(const PictureOutline& outline, const Imath::Box2i& window, Imf::Header& header) {
  const double pixel_x = (outline.tan_right - outline.tan_left) / outline.width_px;
  const double pixel_y = (outline.tan_up - outline.tan_down) / outline.height_px;
  const double width = pixel_x * (window.max.x + 1), height = pixel_y * (window.max.y + 1);
  header.screenWindowWidth() = static_cast<float>(width);
  header.screenWindowCenter() = {static_cast<float>(outline.tan_left + width / 2),
                                 static_cast<float>(outline.tan_up - height / 2)};
}

// The display window: all parts must share one, so it is as large as the largest picture; the data window of
// a part is the picture's own.
Imath::Box2i display_window(const std::vector<PictureOutline>& outlines) {
  Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(0, 0));
  for (const PictureOutline& outline : outlines) {
    window.extendBy(Imath::V2i(outline.width_px - 1, outline.height_px - 1));
  }
  return window;
}

Imf::Header make_header(const PictureOutline& outline, const ViewportImage& picture, const PixelFacts& pixels,
                        const Imath::Box2i& window, const FrameSample& sample,
                        const PictureMetadata& metadata) {
  const Imath::V2i last(outline.width_px - 1, outline.height_px - 1);
  Imf::Header header(window, Imath::Box2i(Imath::V2i(0, 0), last));
  header.setName(outline.name);
  header.setType(Imf::SCANLINEIMAGE);
  header.compression() = kCompression;
  header.zipCompressionLevel() = kZipLevel;
  for (const char* channel : {"R", "G", "B", "A"}) header.channels().insert(channel, Imf::Channel(Imf::HALF));
  describe_run(metadata, header);
  describe_exposure(picture, header);
  describe_values(pixels, header);
  describe_head(sample, header);
  describe_place(metadata.world_from_session, header);
  if (outline.eye) describe_eye(sample, *outline.eye, header);
  if (const auto camera = world_from_camera(outline, sample, metadata)) describe_camera(*camera, header);
  describe_projection(outline, window, header);
  header.insert("herr.viewport_kind", Imf::StringAttribute(name_of(outline.kind)));
  header.insert("herr.tan_left", Imf::DoubleAttribute(outline.tan_left));
  header.insert("herr.tan_right", Imf::DoubleAttribute(outline.tan_right));
  header.insert("herr.tan_down", Imf::DoubleAttribute(outline.tan_down));
  header.insert("herr.tan_up", Imf::DoubleAttribute(outline.tan_up));
  if (outline.kind == PictureKind::context || outline.kind == PictureKind::focus) {
    header.insert("herr.edge_blend_deg", Imf::DoubleAttribute(outline.edge_blend_deg));
  }
  return header;
}

// The texels as OpenEXR wants them: four interleaved channels over the rows of the picture.
Imf::FrameBuffer frame_buffer_over(const ViewportImage& image) {
  Imf::FrameBuffer buffer;
  // OpenEXR's reading and writing slices share one type, hence the cast: an output file
  // never writes through it.
  char* base = const_cast<char*>(reinterpret_cast<const char*>(image.rgba_half.data()));
  const std::size_t texel = 4 * sizeof(std::uint16_t);
  const std::array<const char*, 4> channels{"R", "G", "B", "A"};
  for (std::size_t c = 0; c < channels.size(); ++c) {
    buffer.insert(channels[c],
                  Imf::Slice(Imf::HALF, base + c * sizeof(std::uint16_t), texel, texel * image.row_stride));
  }
  return buffer;
}

}  // namespace

std::int64_t encode_exr(const std::vector<const ViewportImage*>& pictures,
                        const std::vector<PictureOutline>& outlines, const FrameSample& sample,
                        const PictureMetadata& metadata, const ParallelFor& parallel_for,
                        std::vector<std::uint8_t>& out) {
  std::vector<PixelFacts> pixels(pictures.size());
  parallel_for(static_cast<int>(pictures.size()), [&](int i) {
    pixels[static_cast<std::size_t>(i)] = pixel_facts_of(*pictures[static_cast<std::size_t>(i)]);
  });
  std::vector<Imf::Header> headers;
  const Imath::Box2i window = display_window(outlines);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    headers.push_back(make_header(outlines[i], *pictures[i], pixels[i], window, sample, metadata));
  }

  // Compress each part as a file of its own, all at once.
  std::vector<std::vector<std::uint8_t>> parts(pictures.size());
  parallel_for(static_cast<int>(pictures.size()), [&](int i) {
    const auto part = static_cast<std::size_t>(i);
    MemoryOutput stream(parts[part]);
    Imf::OutputFile file(stream, headers[part], 0);
    file.setFrameBuffer(frame_buffer_over(*pictures[part]));
    file.writePixels(pictures[part]->height_px);
  });

  // Then bring the compressed chunks together, as they are.
  {
    MemoryOutput stream(out);
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()), false, 0);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      MemoryInput part_stream(parts[i]);
      Imf::InputFile part(part_stream, 0);
      Imf::OutputPart(file, static_cast<int>(i)).copyPixels(part);
    }
  }
  std::int64_t total = 0;
  for (const PixelFacts& facts : pixels) total += facts.nonfinite_values;
  return total;
}

}  // namespace herr
