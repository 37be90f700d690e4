#include "server/output/exr_encoder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "server/output/memory_stream.h"
#include "tests/paths.h"
#include "tests/server/output/pictures.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

struct Frame {
  DisplayProfile profile = small_profile();
  std::vector<ViewportImage> pictures;
  FrameSample sample;
  PictureMetadata metadata;
};

Frame test_frame() {
  Frame frame;
  unsigned seed = 1;
  for (const Viewport& viewport : frame.profile.viewports) {
    frame.pictures.push_back(random_picture(viewport.width_px, viewport.height_px, seed++));
    frame.pictures.back().exposure = 0.25f;  // -2 EV: named, not multiplied
  }
  frame.sample.t_ns = 1'234'567'890'123'456'789;
  frame.sample.head.world_from_head.position = {1.0, 1.5, -2.25};
  frame.sample.gaze.head_direction[1] = {0.6, 0.0, -0.8};
  frame.metadata.frame = 60;
  frame.metadata.program = "herr 1.2.3";
  frame.metadata.isa = "avx2";
  frame.metadata.settings = "polar 1576x768";
  return frame;
}

std::vector<std::uint8_t> encoded(const Frame& frame, const ParallelFor& parallel_for = one_after_another) {
  std::vector<std::uint8_t> file;
  encode_exr(pointers_to(frame.pictures), pictures_of_frame(frame.profile, {}), frame.sample, frame.metadata,
             parallel_for, file);
  return file;
}

// The half bits of one part, interleaved as RGBA.
std::vector<std::uint16_t> texels_of(Imf::MultiPartInputFile& file, int part_number, int width, int height) {
  std::vector<std::uint16_t> texels(4 * static_cast<std::size_t>(width * height));
  Imf::InputPart part(file, part_number);
  Imf::FrameBuffer buffer;
  const std::array<const char*, 4> channels{"R", "G", "B", "A"};
  for (std::size_t c = 0; c < 4; ++c) {
    char* base = reinterpret_cast<char*>(texels.data()) + 2 * c;
    buffer.insert(channels[c], Imf::Slice(Imf::HALF, base, 8, 8 * static_cast<std::size_t>(width)));
  }
  part.setFrameBuffer(buffer);
  part.readPixels(0, height - 1);
  return texels;
}

TEST(ExrEncoder, EveryPartComesBackBitForBit) {
  const Frame frame = test_frame();
  const std::vector<std::uint8_t> bytes = encoded(frame);
  MemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  ASSERT_EQ(file.parts(), 4);
  for (int i = 0; i < 4; ++i) {
    const ViewportImage& picture = frame.pictures[static_cast<std::size_t>(i)];
    const auto texels = texels_of(file, i, picture.width_px, picture.height_px);
    for (int y = 0; y < picture.height_px; ++y) {
      const auto row = texels.begin() + 4L * y * picture.width_px;
      EXPECT_TRUE(std::equal(row, row + 4L * picture.width_px, picture.row(y)))
          << "part " << i << " row " << y;
    }
  }
}

TEST(ExrEncoder, PartsAreNamedAfterTheirViewportsAndSayWhatTheHeadsetKnew) {
  const Frame frame = test_frame();
  const std::vector<std::uint8_t> bytes = encoded(frame);
  MemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  const Imf::Header& header = file.header(2);
  EXPECT_EQ(header.name(), "right_context");
  EXPECT_EQ(header.view(), "right");
  EXPECT_EQ(header.typedAttribute<Imf::IntAttribute>("herr.frame").value(), 60);
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("herr.time_ns").value(), "1234567890123456789");
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("herr.program").value(), "herr 1.2.3");
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("herr.isa").value(), "avx2");
  EXPECT_EQ(header.typedAttribute<Imf::DoubleAttribute>("herr.exposure_ev").value(), -2.0);
  EXPECT_EQ(header.typedAttribute<Imf::V3dAttribute>("herr.head_position_m").value(),
            Imath::V3d(1.0, 1.5, -2.25));
  EXPECT_EQ(header.typedAttribute<Imf::V3dAttribute>("herr.gaze_in_head").value(),
            Imath::V3d(0.6, 0.0, -0.8));
  EXPECT_EQ(header.typedAttribute<Imf::DoubleAttribute>("herr.tan_left").value(), -1.0);
}

TEST(ExrEncoder, APartSaysWhatItsValuesMean) {
  Frame frame = test_frame();
  ViewportImage& opaque = frame.pictures[1];
  for (int y = 0; y < opaque.height_px; ++y)
    for (int x = 0; x < opaque.width_px; ++x) opaque.row(y)[4 * x + 3] = 0x3C00;
  const std::vector<std::uint8_t> bytes = encoded(frame);
  MemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  const auto text = [&](int part, const char* name) {
    return file.header(part).typedAttribute<Imf::StringAttribute>(name).value();
  };
  EXPECT_EQ(text(0, "herr.unit").find("W/(sr m^2)"), 0u);
  EXPECT_EQ(text(0, "herr.alpha"), "premultiplied");
  EXPECT_EQ(text(1, "herr.alpha"), "1 everywhere");
  // ITU-R BT.709: the primaries and the white, D65, that sRGB has.
  const Imf::Chromaticities found = Imf::chromaticities(file.header(0));
  EXPECT_EQ(found.red, Imath::V2f(0.64f, 0.33f));
  EXPECT_EQ(found.green, Imath::V2f(0.30f, 0.60f));
  EXPECT_EQ(found.blue, Imath::V2f(0.15f, 0.06f));
  EXPECT_EQ(found.white, Imath::V2f(0.3127f, 0.3290f));
  EXPECT_EQ(Imf::adoptedNeutral(file.header(0)), found.white);
  EXPECT_FALSE(Imf::hasWhiteLuminance(file.header(0))) << "nobody knows it";
}

// One with a part of each kind: viewports of both eyes, and a camera outside, 50 x 7 pixels.
std::vector<std::uint8_t> encoded_with_outside(Frame& frame) {
  std::vector<PictureOutline> outlines = pictures_of_frame(frame.profile, {});
  PictureOutline outside;
  outside.name = "overview";
  outside.kind = PictureKind::outside;
  outside.width_px = 50;
  outside.height_px = 7;
  outside.tan_left = outside.tan_down = -0.5;
  outside.tan_right = outside.tan_up = 0.5;
  outlines.push_back(outside);
  frame.pictures.push_back(random_picture(50, 7, 9));
  std::vector<std::uint8_t> bytes;
  encode_exr(pointers_to(frame.pictures), outlines, frame.sample, frame.metadata, one_after_another, bytes);
  return bytes;
}

// The README's table is the list that users look into: it names what is written, all of it and nothing else.
TEST(ExrEncoder, TheReadmesTableNamesTheAttributesThatAreWritten) {
  Frame frame = test_frame();
  frame.metadata.world_from_outside = Pose();
  const std::vector<std::uint8_t> bytes = encoded_with_outside(frame);
  MemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  std::set<std::string> written;
  for (int part = 0; part < file.parts(); ++part) {
    for (auto attribute = file.header(part).begin(); attribute != file.header(part).end(); ++attribute) {
      if (std::string(attribute.name()).starts_with("herr.")) written.insert(attribute.name());
    }
  }
  std::istringstream readme(
      content_of(std::filesystem::path(test::source_dir()) / "server/output/README.md"));
  std::set<std::string> told;
  for (std::string line; std::getline(readme, line);) {
    if (!line.starts_with("| `herr.")) continue;
    const std::string names = line.substr(0, line.find(" | "));
    for (std::size_t at = names.find("`herr."); at != std::string::npos; at = names.find("`herr.", at + 1))
      told.insert(names.substr(at + 1, names.find('`', at + 1) - at - 1));
  }
  EXPECT_EQ(told, written);
  EXPECT_GE(written.size(), 25u);
}

// A head turned left by 90 degrees about +Y looks along -X; its right is forward x up = (-1, 0, 0) x (0, 1,
// 0) = (0, 0, -1). The right eye lies 0.03 m to its right, so at z - 0.03; the recording stands 10 m along
// +X.
TEST(ExrEncoder, AnEyesPartSaysWhereInTheSceneItsCameraIs) {
  Frame frame = test_frame();
  frame.sample.head.world_from_head.orientation = {std::sqrt(0.5), 0, std::sqrt(0.5), 0};
  frame.sample.head_from_eye[1].position = {0.03, 0, 0};
  frame.metadata.world_from_session.position = {10, 0, 0};
  const std::vector<std::uint8_t> bytes = encoded(frame);
  MemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  const Imf::Header& header = file.header(2);
  const Imath::V3d at = header.typedAttribute<Imf::V3dAttribute>("herr.camera_position_m").value();
  EXPECT_TRUE(at.equalWithAbsError({11, 1.5, -2.28}, 1e-12)) << at;
  EXPECT_EQ(header.typedAttribute<Imf::V3dAttribute>("herr.world_from_session_position_m").value(),
            Imath::V3d(10, 0, 0));
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("herr.world_from_session_orientation_xyzw").value(),
            "0 0 0 1");
  // x to the right, y up, z into the picture.
  const Imath::M44f matrix = Imf::worldToCamera(header);
  const Imath::V3f eye(11, 1.5f, -2.28f);
  EXPECT_TRUE(((eye + Imath::V3f(-2, 0.5f, 0)) * matrix).equalWithAbsError({0, 0.5f, 2}, 1e-5f));
  EXPECT_TRUE(((eye + Imath::V3f(0, 0, -1)) * matrix).equalWithAbsError({1, 0, 0}, 1e-5f));
}

TEST(ExrEncoder, ThePartFromOutsideHasItsOwnCamera) {
  Frame frame = test_frame();
  frame.metadata.world_from_outside = Pose{{3, 4, 5}, {1, 0, 0, 0}};
  const std::vector<std::uint8_t> bytes = encoded_with_outside(frame);
  MemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  const Imf::Header& header = file.header(4);
  EXPECT_EQ(header.typedAttribute<Imf::V3dAttribute>("herr.camera_position_m").value(), Imath::V3d(3, 4, 5));
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("herr.camera_orientation_xyzw").value(), "0 0 0 1");
  // 6 m ahead of a camera that looks along -Z.
  EXPECT_EQ(Imath::V3f(3, 4, -1) * Imf::worldToCamera(header), Imath::V3f(0, 0, 6));
}

// The display window is 40 x 40, a context viewport as large, its tangents -1 ... 1. A focus viewport has 32
// x 18 pixels over the same tangents: the window is 40 * 2 / 32 = 2.5 wide and 40 * 2 / 18 = 4.444 high, its
// left upper corner at (-1, 1), its middle at (-1 + 1.25, 1 - 2.222).
TEST(ExrEncoder, TheScreenWindowIsWhatTheDisplayWindowCoversAtDistanceOne) {
  const std::vector<std::uint8_t> bytes = encoded(test_frame());
  MemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  EXPECT_EQ(file.header(0).screenWindowWidth(), 2.0f);
  EXPECT_EQ(file.header(0).screenWindowCenter(), Imath::V2f(0, 0));
  EXPECT_EQ(file.header(1).screenWindowWidth(), 2.5f);
  EXPECT_TRUE(file.header(1).screenWindowCenter().equalWithAbsError({0.25f, -1.2222222f}, 1e-6f));
}

TEST(ExrEncoder, AFurtherViewIsAPartAndWhatNoEyeSeesNamesNone) {
  Frame frame = test_frame();
  std::vector<PictureOutline> outlines = pictures_of_frame(frame.profile, {});
  PictureOutline outside;
  outside.name = "seen-from-outside";
  outside.kind = PictureKind::blended;
  outside.width_px = 50;
  outside.height_px = 7;
  outside.tan_up = 0.25;
  outlines.push_back(outside);
  frame.pictures.push_back(random_picture(50, 7, 9));
  std::vector<std::uint8_t> bytes;
  encode_exr(pointers_to(frame.pictures), outlines, frame.sample, frame.metadata, one_after_another, bytes);
  MemoryInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  ASSERT_EQ(file.parts(), 5);
  const Imf::Header& header = file.header(4);
  EXPECT_EQ(header.name(), "seen-from-outside");
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("herr.viewport_kind").value(), "blended");
  EXPECT_EQ(header.typedAttribute<Imf::DoubleAttribute>("herr.tan_up").value(), 0.25);
  EXPECT_EQ(header.typedAttribute<Imf::V3dAttribute>("herr.head_position_m").value(),
            Imath::V3d(1.0, 1.5, -2.25));
  EXPECT_FALSE(header.hasView());
  EXPECT_EQ(header.findTypedAttribute<Imf::DoubleAttribute>("herr.edge_blend_deg"), nullptr);
  EXPECT_EQ(header.findTypedAttribute<Imf::V3dAttribute>("herr.gaze_in_head"), nullptr);
  const auto texels = texels_of(file, 4, 50, 7);
  EXPECT_TRUE(std::equal(texels.begin(), texels.begin() + 4L * 50, frame.pictures[4].row(0)));
}

TEST(ExrEncoder, SameFrameGivesSameBytesAlsoWhenPartsAreEncodedAtOnce) {
  const Frame frame = test_frame();
  const ParallelFor all_at_once = [](int count, const std::function<void(int)>& work) {
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back(work, i);
    for (std::thread& thread : threads) thread.join();
  };
  EXPECT_EQ(encoded(frame), encoded(frame, all_at_once));
}

TEST(ExrEncoder, CountsNanAndInf) {
  Frame frame = test_frame();
  frame.pictures[1].row(3)[5] = 0x7E01;
  frame.pictures[3].row(0)[0] = 0xFC00;
  std::vector<std::uint8_t> file;
  EXPECT_EQ(encode_exr(pointers_to(frame.pictures), pictures_of_frame(frame.profile, {}), frame.sample,
                       frame.metadata, one_after_another, file),
            2);
}

TEST(ExrEncoder, AFileThatWasCutOffDoesNotDecode) {
  const Frame frame = test_frame();
  std::vector<std::uint8_t> bytes = encoded(frame);
  bytes.resize(bytes.size() / 2);
  MemoryInput stream(bytes);
  const auto read_last_part = [&] {
    Imf::MultiPartInputFile file(stream, 0, false);
    texels_of(file, 3, frame.pictures[3].width_px, frame.pictures[3].height_px);
  };
  EXPECT_THROW(read_last_part(), std::exception);
}

}  // namespace
}  // namespace herr
