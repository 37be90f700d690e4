#include "scenes/voxels/vox_file.h"

#include "scenes/voxels/vox_bytes.h"
#include "scenes/voxels/voxel_limits.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr const char* kExportAgain = "export it again from MagicaVoxel";

VoxDictionary dictionary(VoxBytes& in) {
  VoxDictionary entries;
  const std::size_t count = in.count(8, "the number of entries of a dictionary");
  for (std::size_t i = 0; i < count; ++i) {
    std::string key = in.text("a key of a dictionary");
    entries[std::move(key)] = in.text("a value of a dictionary");
  }
  return entries;
}

std::string entry_of(const VoxDictionary& dictionary, const char* key) {
  const auto found = dictionary.find(key);
  return found == dictionary.end() ? "" : found->second;
}

std::vector<std::int32_t> ids(VoxBytes& in, const char* what) {
  std::vector<std::int32_t> all(in.count(4, what));
  for (std::int32_t& id : all) id = in.int32(what);
  return all;
}

// Takes chunk after chunk and keeps what shows something.
class VoxParser {
 public:
  explicit VoxParser(VoxFile& out) : out_(out) {}

  void chunk(const std::string_view id, VoxBytes in) {
    if (id == "SIZE") return size(in);
    if (id == "XYZI") return voxels(in);
    if (id == "RGBA") return palette(in);
    if (id == "MATL") return material(in);
    if (id == "LAYR") return layer(in);
    if (id == "nTRN") return transform(in);
    if (id == "nGRP") return group(in);
    if (id == "nSHP") return shape(in);
    // IMAP orders the palette in MagicaVoxel's window and changes no colour; the others are cameras, notes
    // and settings of its renderer.
  }

  void finish(const VoxBytes& in) const {
    if (sized_) in.fail("SIZE has no XYZI behind it", kExportAgain);
    if (out_.models.empty()) in.fail("there is no model", kExportAgain);
  }

 private:
  void size(VoxBytes& in) {
    if (sized_) in.fail("SIZE follows SIZE, without voxels between", kExportAgain);
    VoxModel& model = out_.models.emplace_back();
    for (int* side : {&model.size_x, &model.size_y, &model.size_z}) {
      *side = in.int32("a side of SIZE");
      if (*side < 1 || *side > kMaxVoxSide) {
        in.fail("a side of SIZE is " + std::to_string(*side), "models have 1 to 256 voxels along each side");
      }
    }
    sized_ = true;
  }

  void voxels(VoxBytes& in) {
    if (!sized_) in.fail("XYZI has no SIZE before it", kExportAgain);
    sized_ = false;
    VoxModel& model = out_.models.back();
    const std::size_t count = in.count(4, "the number of voxels");
    if (in.left() != 4 * count) {
      in.fail("XYZI holds " + std::to_string(in.left()) + " bytes for " + std::to_string(count) + " voxels",
              kExportAgain);
    }
    const VoxBytes start = in;
    model.voxels = in.take(4 * count, "the voxels");
    for (std::size_t i = 0; i < model.voxels.size(); i += 4) {
      const auto coordinate = [&](std::size_t axis) {
        return int{static_cast<std::uint8_t>(model.voxels[i + axis])};
      };
      if (coordinate(0) < model.size_x && coordinate(1) < model.size_y && coordinate(2) < model.size_z)
        continue;
      VoxBytes at = start;
      at.take(i, "the voxels");
      at.fail("a voxel lies at (" + std::to_string(coordinate(0)) + ", " + std::to_string(coordinate(1)) +
                  ", " + std::to_string(coordinate(2)) + "), outside its model of " +
                  std::to_string(model.size_x) + " x " + std::to_string(model.size_y) + " x " +
                  std::to_string(model.size_z),
              kExportAgain);
    }
  }

  void palette(VoxBytes& in) {
    // The first entry is that of colour index 1. MagicaVoxel does not use its alpha.
    for (std::size_t i = 1; i <= 256; ++i) {
      const auto rgba = static_cast<std::uint32_t>(in.int32("a colour of the palette"));
      if (i < 256) out_.palette[i] = rgba | 0xff000000u;
    }
  }

  void material(VoxBytes& in) {
    const std::int32_t index = in.int32("the colour of a material");
    out_.materials[index & 255] = dictionary(in);
  }

  void layer(VoxBytes& in) {
    const std::int32_t id = in.int32("the number of a layer");
    out_.layer_hidden[id] = entry_of(dictionary(in), "_hidden") == "1";
  }

  // What all kinds of nodes begin with.
  VoxNode& node(VoxBytes& in, VoxNodeKind kind, VoxDictionary& attributes) {
    const std::size_t offset = in.offset();
    const std::int32_t id = in.int32("the number of a node");
    if (static_cast<std::int64_t>(out_.nodes.size()) >= kMaxVoxNodes) {
      in.fail("there are more than a million nodes", "merge some of the models");
    }
    const auto [entry, added] = out_.nodes.try_emplace(id);
    if (!added) in.fail("node " + std::to_string(id) + " is there twice", kExportAgain);
    entry->second.kind = kind;
    entry->second.offset = offset;
    attributes = dictionary(in);
    return entry->second;
  }

  void transform(VoxBytes& in) {
    VoxDictionary attributes;
    VoxNode& transform = node(in, VoxNodeKind::transform, attributes);
    transform.hidden = entry_of(attributes, "_hidden") == "1";
    transform.name = entry_of(attributes, "_name");
    transform.children.push_back(in.int32("the child of a node"));
    in.int32("a reserved number");
    transform.layer = in.int32("the layer of a node");
    transform.frames = in.count(4, "the number of frames");
    if (transform.frames == 0) in.fail("a transform has no frame", kExportAgain);
    transform.frame = dictionary(in);
  }

  void group(VoxBytes& in) {
    VoxDictionary attributes;
    VoxNode& group = node(in, VoxNodeKind::group, attributes);
    group.children = ids(in, "a child of a group");
  }

  void shape(VoxBytes& in) {
    VoxDictionary attributes;
    VoxNode& shape = node(in, VoxNodeKind::shape, attributes);
    const std::size_t models = in.count(8, "the number of models of a shape");
    for (std::size_t i = 0; i < models; ++i) {
      shape.children.push_back(in.int32("a model of a shape"));
      dictionary(in);
    }
  }

  VoxFile& out_;
  bool sized_ = false;  // a SIZE waits for its XYZI
};

}  // namespace

std::array<std::uint32_t, 256> default_vox_palette() {
  // A cube of six steps per channel from white down, blue fastest, without black; then ten dark steps each of
  // red, green, blue and grey.
  std::array<std::uint32_t, 256> palette{};
  constexpr std::uint32_t kCube[6] = {0xff, 0xcc, 0x99, 0x66, 0x33, 0x00};
  constexpr std::uint32_t kDark[10] = {0xee, 0xdd, 0xbb, 0xaa, 0x88, 0x77, 0x55, 0x44, 0x22, 0x11};
  std::size_t i = 1;
  for (const std::uint32_t r : kCube) {
    for (const std::uint32_t g : kCube) {
      for (const std::uint32_t b : kCube) {
        if ((r | g | b) != 0) palette[i++] = 0xff000000u | b << 16 | g << 8 | r;
      }
    }
  }
  for (const std::uint32_t channel : {0x000001u, 0x000100u, 0x010000u, 0x010101u}) {
    for (const std::uint32_t value : kDark) palette[i++] = 0xff000000u | channel * value;
  }
  return palette;
}

VoxFile parse_vox(std::string_view bytes, const std::filesystem::path& file) {
  VoxBytes in(bytes, file);
  if (in.take(4, "the signature") != "VOX ") {
    throw InputError(file, 0, "is not a MagicaVoxel file: it does not begin with \"VOX \"",
                     "name a .vox file");
  }
  const std::int32_t version = in.int32("the version");
  if (version != 150 && version != 200) {
    in.fail("the version is " + std::to_string(version) + ", 150 and 200 are known",
            "export the file from MagicaVoxel 0.98 or 0.99");
  }
  if (in.take(4, "the MAIN chunk") != "MAIN") in.fail("there is no MAIN chunk", kExportAgain);
  const std::size_t content = in.count(1, "the length of MAIN");
  const std::int32_t children = in.int32("the length of MAIN's children");
  in.take(content, "the content of MAIN");
  if (children < 0 || static_cast<std::size_t>(children) != in.left()) {
    in.fail("MAIN holds " + std::to_string(children) + " bytes of chunks where " + std::to_string(in.left()) +
                " follow",
            "the file is cut off or damaged: export it again");
  }

  VoxFile out;
  out.palette = default_vox_palette();
  VoxParser parser(out);
  while (in.left() > 0) {
    const std::string_view id = in.take(4, "the name of a chunk");
    const std::int32_t length = in.int32("the length of a chunk"),
                       nested = in.int32("the length of its children");
    if (length < 0 || nested < 0) in.fail("a chunk has a negative length", kExportAgain);
    parser.chunk(id, in.part(static_cast<std::size_t>(length), "a chunk"));
    in.take(static_cast<std::size_t>(nested), "the children of a chunk");
  }
  parser.finish(in);
  return out;
}

}  // namespace herr
