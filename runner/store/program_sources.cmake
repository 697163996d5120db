# Hashes the sources that decide figures, folder by folder: `cmake -DROOT=DIR -DOUT=FILE -P program_sources.cmake`. Documents, writers and commands
# print what was found and are left out, as is what is read as data.
set(rooms scenarios metrics renderer runner/play runner/findings runner/files runner/experiments/run runner/experiments/accuracy runner/judge)
set(rows "")
foreach(room ${rooms})
  file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/${room}/*.cpp ${ROOT}/${room}/*.h ${ROOT}/${room}/*.glsl)
  list(FILTER sources EXCLUDE REGEX "^scenarios/library/|_document\\.|^runner/experiments/.*_(plots|sheet)\\.|^runner/experiments/accuracy/studies/")
  if(room STREQUAL runner/judge) # the rest judges what was kept
    list(FILTER sources INCLUDE REGEX "/(repeats|input_hashes)\\.")
  endif()
  list(SORT sources)
  set(hashes "")
  foreach(source ${sources})
    file(SHA256 ${ROOT}/${source} hash)
    string(APPEND hashes "${source} ${hash}\n")
  endforeach()
  string(SHA256 hash "${hashes}")
  string(SUBSTRING ${hash} 0 32 hash)
  string(APPEND rows "        {\"${room}\", \"${hash}\"},\n")
endforeach()
foreach(folder . scenarios metrics renderer runner) # flags of targets and of single sources
  file(SHA256 ${ROOT}/${folder}/CMakeLists.txt hash)
  string(APPEND FLAGS " ${hash}")
endforeach()
string(SHA256 hash "${FLAGS}")
string(SUBSTRING ${hash} 0 32 hash)
string(APPEND rows "        {\"compiler flags\", \"${hash}\"},\n")
file(CONFIGURE OUTPUT ${OUT} CONTENT "#include \"runner/store/cell_key.h\"

const std::vector<std::pair<std::string, std::string>>& fernlicht::program_sources() {
    static const char* const rows[][2] = {
${rows}    };
    static const std::vector<std::pair<std::string, std::string>> sources = [] {
        std::vector<std::pair<std::string, std::string>> all;
        for (const auto& row : rows)
            all.emplace_back(row[0], row[1]);
        return all;
    }();
    return sources;
}
" @ONLY)
