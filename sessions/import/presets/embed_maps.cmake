# Writes OUT, a source file that holds the column maps MAPS (a list of JSON files) as text. Run by the build.
set(entries "")
foreach(map ${MAPS})
  get_filename_component(name ${map} NAME_WE)
  file(READ ${map} text)
  string(APPEND entries "      {\"${name}\", R\"map(${text})map\"},\n")
endforeach()
file(WRITE ${OUT} "#include \"sessions/import/presets/built_in_maps.h\"

namespace herr {

const std::vector<BuiltInMap>& built_in_maps() {
  static const std::vector<BuiltInMap> maps{
${entries}  };
  return maps;
}

}  // namespace herr
")
