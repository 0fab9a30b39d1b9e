# The sources of the module of playgrounds, and their digest: a page takes no module of
# other sources than the command's (src/limber/view/play_page.cpp).
#
#   cmake -D ROOT=... -D FILE=... -P: writes it, for C++, to FILE
#   include() with ROOT set: sets playground_sources
set(patterns ${ROOT}/playground/*)
foreach(layer IN ITEMS common flexbody joints contact dynamics results scene runs view)
  list(APPEND patterns ${ROOT}/src/limber/${layer}/*.?pp)
endforeach()
if(CMAKE_SCRIPT_MODE_FILE)
  file(GLOB_RECURSE playground_sources ${patterns})
else()
  file(GLOB_RECURSE playground_sources CONFIGURE_DEPENDS ${patterns})
endif()
list(APPEND playground_sources ${ROOT}/CMakeLists.txt ${ROOT}/cmake/options.cmake)
if(CMAKE_SCRIPT_MODE_FILE)
  set(digests)
  foreach(source IN LISTS playground_sources)
    file(SHA256 ${source} digest)
    file(RELATIVE_PATH name ${ROOT} ${source})
    string(APPEND digests "${digest} ${name}\n")
  endforeach()
  string(SHA256 digest "${digests}")
  configure_file(${ROOT}/src/limber/view/playground_sources.hpp.in ${FILE} @ONLY)
endif()
