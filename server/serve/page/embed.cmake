# Writes OUT, a C++ source that holds the bytes of files: cmake -DOUT=... -DFILES=name=path;... -P embed.cmake
set(arrays "")
set(entries "")
set(number 0)
foreach(file IN LISTS FILES)
  string(REGEX MATCH "^([^=]+)=(.+)$" matched "${file}")
  set(name "${CMAKE_MATCH_1}")
  file(READ "${CMAKE_MATCH_2}" bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "(([^,]+,){24})" "\\1\n" bytes "${bytes}")
  string(APPEND arrays "const unsigned char kFile${number}[] = {\n${bytes}};\n")
  string(APPEND entries "    {\"${name}\", text_of(kFile${number}, sizeof kFile${number})},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUT}" "#include \"server/serve/page_files.h\"

namespace herr {
namespace {

${arrays}
std::string_view text_of(const unsigned char* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

std::string_view page_file(std::string_view name) {
  static const struct {
    std::string_view name, bytes;
  } kFiles[] = {
${entries}  };
  for (const auto& file : kFiles) {
    if (file.name == name) return file.bytes;
  }
  return {};
}

}  // namespace herr
")
