# cmake -P: the program's ELF headers and strings; any that should not be so
# fails the test. PROGRAM and SOURCE_DIR are paths.
function(read variable)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  set(${variable} "${output}" PARENT_SCOPE)
endfunction()
function(expect text pattern meaning)
  if(NOT text MATCHES "${pattern}")
    message(SEND_ERROR "${PROGRAM}: no ${meaning}")
  endif()
endfunction()

read(header readelf -hW ${PROGRAM})
read(segments readelf -lW ${PROGRAM})
read(dynamic readelf -dW ${PROGRAM})
read(symbols readelf -W --dyn-syms ${PROGRAM})
expect("${header}" "Type: +DYN" "position-independent executable")
expect("${segments}" "GNU_RELRO" "read-only relocations")
expect("${segments}" "GNU_STACK[^\n]* RW " "stack without execution")
expect("${dynamic}" "FLAGS[^\n]*BIND_NOW|Flags:[^\n]*NOW" "binding at the start")
expect("${symbols}" "__stack_chk_fail" "stack protector")
expect("${symbols}" "__(memcpy|memmove|memset|read|fprintf|snprintf|vsnprintf|printf)_chk"
  "checks of sizes")
# The command starts fast: what links these starts when it is needed.
if(NAME STREQUAL "limber" AND
   dynamic MATCHES "NEEDED[^\n]*lib(gmsh|cholmod|[a-z]*blas|lapack|SimTK)[^\n]*")
  message(SEND_ERROR "${PROGRAM}: starts with a library that few commands need: ${CMAKE_MATCH_0}")
endif()

execute_process(COMMAND strings -a ${PROGRAM} COMMAND grep -F ${SOURCE_DIR}/
  OUTPUT_VARIABLE paths)
if(paths)
  message(SEND_ERROR "${PROGRAM}: holds paths of the machine that built it:\n${paths}")
endif()
