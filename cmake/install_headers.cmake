# Installs the public headers, and in limber/internal what they include: compilers need that,
# programs do not. Run at installation; cmake/install.cmake sets
#   source  src/limber
#   public  paths from there
#   folder  of headers, from the prefix
#   work    where the headers are written first
cmake_policy(VERSION 3.25)
list(APPEND public version.hpp)  # configured, installed by itself
set(ahead ${public})
set(seen version.hpp)
while(ahead)
  list(POP_FRONT ahead header)
  if(header IN_LIST seen)
    continue()
  endif()
  list(APPEND seen ${header})
  file(READ ${source}/${header} text)
  string(REPLACE "#include \"limber/" "#include \"limber/internal/" text "${text}")
  foreach(each IN LISTS public)
    string(REPLACE "#include \"limber/internal/${each}\"" "#include \"limber/${each}\""
      text "${text}")
  endforeach()
  set(place ${header})
  if(NOT header IN_LIST public)
    set(place internal/${header})
  endif()
  file(WRITE ${work}/${place} "${text}")
  get_filename_component(room ${place} DIRECTORY)
  cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE to)
  file(INSTALL ${work}/${place} DESTINATION ${to}/limber/${room})
  file(STRINGS ${source}/${header} includes REGEX "^#include \"limber/")
  list(TRANSFORM includes REPLACE "^#include \"limber/([^\"]+)\".*" "\\1")
  list(APPEND ahead ${includes})
endwhile()
