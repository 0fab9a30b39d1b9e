# Compiler settings that every target of the project shares.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(limber_options INTERFACE)
target_compile_features(limber_options INTERFACE cxx_std_20)
target_compile_options(limber_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
  -Woverloaded-virtual -Werror)
# GCC 12 sees overlaps and overflows in std::string that cannot be (its PRs 105651
# and 105329), after a precompiled header even where it would keep still.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND
   CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(limber_options INTERFACE
    -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endif()
# GCC's garbage collection looks through the whole precompiled header each time;
# without it a compilation takes a tenth less time, and up to a third more memory.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(limber_options INTERFACE --param=ggc-min-heapsize=900000)
endif()
# Gmsh exports its own copies of Eigen's templates: ours, if visible, would take
# their place inside it, built with other options. A shared library of ours exports
# what exports.map lists.
set(limber_is_shared $<STREQUAL:$<TARGET_PROPERTY:TYPE>,SHARED_LIBRARY>)
target_compile_options(limber_options INTERFACE
  -fvisibility=$<IF:${limber_is_shared},default,hidden>)
target_link_options(limber_options INTERFACE
  $<${limber_is_shared}:LINKER:--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map>)
# Overruns of the stack and of buffers end the program; the table of addresses
# that the loader fills is read-only from the start; messages and debug
# information name files from the source folder on, not where it stood.
target_compile_options(limber_options INTERFACE
  -ffile-prefix-map=${PROJECT_SOURCE_DIR}/= -fstack-protector-strong)
if(NOT LIMBER_SANITIZE AND NOT LIMBER_FUZZ)
  # The C library's checks of sizes need the optimiser.
  target_compile_options(limber_options INTERFACE
    "$<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=3>")
endif()
target_link_options(limber_options INTERFACE -Wl,-z,relro,-z,now)
if(LIMBER_SANITIZE MATCHES "^(ON|address)$")
  # A double that its integer cannot hold is of no sanitizer's default.
  set(limber_sanitizers address,undefined,float-cast-overflow)
elseif(LIMBER_SANITIZE STREQUAL "thread")
  set(limber_sanitizers thread)
elseif(LIMBER_SANITIZE)
  message(FATAL_ERROR "LIMBER_SANITIZE is '${LIMBER_SANITIZE}'; expected "
    "address (or ON), thread or OFF")
endif()
if(LIMBER_SANITIZE)
  # GCC's own advice: under sanitizers it takes set variables for unset ones.
  target_compile_options(limber_options INTERFACE
    -fsanitize=${limber_sanitizers}
    -fno-sanitize-recover=undefined,float-cast-overflow
    -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
    $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tests/overflow.ignore>)
  target_compile_definitions(limber_options INTERFACE LIMBER_SANITIZED)
  target_link_options(limber_options INTERFACE -fsanitize=${limber_sanitizers})
endif()
# libFuzzer follows the paths that an input takes.
if(LIMBER_FUZZ)
  target_compile_options(limber_options INTERFACE
    -fsanitize=fuzzer-no-link,float-cast-overflow
    -fno-sanitize-recover=float-cast-overflow)
  target_link_options(limber_options INTERFACE -fsanitize=float-cast-overflow)
endif()

# limber_precompile(TARGET header...): the compiler reads what nearly every file
# includes once, and not once for each file. Others share that by
# target_precompile_headers(... REUSE_FROM TARGET) if they have its options and
# at least its definitions.
# Files still include what they use: clang-tidy reads them without this.
function(limber_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory>
    <optional> <string> <variant> <vector> <Eigen/Dense> <fmt/format.h>
    ${ARGN})
endfunction()

# limber_light(TARGET): code that calls what takes time, and takes none itself.
function(limber_light target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>
    # At -O1 GCC 12 takes variables for unset ones that are not.
    $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
endfunction()

# limber_unity(TARGET): where CMAKE_UNITY_BUILD is set, compiles up to nine
# sources of a folder as one, since reading headers and instantiating templates
# takes most of the time. Their helpers then share one unnamed namespace, so no two
# sources of a folder may give different things the same name there. A folder whose
# sources take much memory sets a smaller LIMBER_UNITY_BATCH.
set(LIMBER_UNITY_BATCH 9)
function(limber_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  set(folders)
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY ABSOLUTE)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    list(APPEND folders ${folder})
    list(APPEND in_${folder} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    list(LENGTH in_${folder} count)
    math(EXPR batches "(${count} + ${LIMBER_UNITY_BATCH} - 1) / ${LIMBER_UNITY_BATCH}")
    set(position 0)
    foreach(source IN LISTS in_${folder})
      math(EXPR batch "${position} * ${batches} / ${count} + 1")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
      math(EXPR position "${position} + 1")
    endforeach()
  endforeach()
endfunction()

# limber_layer(NAME [ROOMS room...]): a library of all sources in the folder that
# calls it and below, or in those of its rooms that are named. Static, or shared if
# BUILD_SHARED_LIBS is set.
function(limber_layer name)
  cmake_parse_arguments(ARG "" "" "ROOMS" ${ARGN})
  if(ARG_ROOMS)
    list(TRANSFORM ARG_ROOMS APPEND "/*.cpp")
    file(GLOB sources CONFIGURE_DEPENDS ${ARG_ROOMS})
  else()
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  endif()
  add_library(limber_${name} ${sources})
  add_library(limber::${name} ALIAS limber_${name})
  target_include_directories(limber_${name} PUBLIC
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src;${PROJECT_BINARY_DIR}/include>"
    $<INSTALL_INTERFACE:include>)
  target_link_libraries(limber_${name} PRIVATE $<BUILD_INTERFACE:limber_options>)
  target_compile_features(limber_${name} PUBLIC cxx_std_20)
  set_target_properties(limber_${name} PROPERTIES
    POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name} DEFINE_SYMBOL ""
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if("${name}" STREQUAL "common")
    limber_precompile(limber_common)
  else()
    target_precompile_headers(limber_${name} REUSE_FROM limber_common)
  endif()
  limber_unity(limber_${name})
endfunction()
