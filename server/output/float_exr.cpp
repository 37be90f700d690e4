#include "server/output/float_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "server/output/memory_stream.h"

namespace herr {

void encode_float_exr(const FloatPlanes& planes, std::vector<std::uint8_t>& out) {
  Imf::Header header(planes.width_px, planes.height_px);
  header.compression() = Imf::ZIPS_COMPRESSION;
  for (const auto& [name, text] : planes.notes) header.insert(name, Imf::StringAttribute(text));
  Imf::FrameBuffer buffer;
  for (const auto& [name, values] : planes.channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // OpenEXR's reading and writing slices share one type, hence the cast: an output file
    // never writes through it.
    char* base = const_cast<char*>(reinterpret_cast<const char*>(values.data()));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float),
                                   sizeof(float) * static_cast<std::size_t>(planes.width_px)));
  }
  MemoryOutput stream(out);
  Imf::OutputFile file(stream, header, 0);
  file.setFrameBuffer(buffer);
  file.writePixels(planes.height_px);
}

}  // namespace herr
