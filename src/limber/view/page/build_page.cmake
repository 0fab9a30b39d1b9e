# Bundles the page in WORK: npm fetches what package-lock.json names, esbuild
# joins it. A failure is reported, and leaves no page, but does not fail the
# build: nothing else needs it.
get_filename_component(beside ${PAGE} DIRECTORY)
file(REMOVE ${PAGE} ${beside}/play.html)
file(GLOB sources ${SOURCE}/*.js ${SOURCE}/*.mjs ${SOURCE}/*.html
  ${SOURCE}/*.css ${SOURCE}/*.json)
file(COPY ${sources} DESTINATION ${WORK})
file(SHA256 ${SOURCE}/package-lock.json wanted)
set(installed "")
if(EXISTS ${WORK}/node_modules/.limber-lock)
  file(READ ${WORK}/node_modules/.limber-lock installed)
endif()
if(NOT installed STREQUAL wanted)
  execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund
    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE status
    OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    message(NOTICE "limber view: its page is not built, as npm could not fetch "
      "its packages:\n${text}")
    return()
  endif()
  file(WRITE ${WORK}/node_modules/.limber-lock ${wanted})
endif()
execute_process(COMMAND ${NODE} build.mjs ${PAGE}
  WORKING_DIRECTORY ${WORK} RESULT_VARIABLE status ERROR_VARIABLE text)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "limber view: its page cannot be bundled:\n${text}")
endif()
