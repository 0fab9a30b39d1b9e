# cmake -P: install, configure, build, run; any failure fails the test.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
  -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
  -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/spin)
if(EXISTS ${WORK_DIR}/build/reduce)
  run(${WORK_DIR}/build/reduce)
endif()
if(EXISTS ${WORK_DIR}/build/simbody)
  run(${WORK_DIR}/build/simbody)
endif()
run(${WORK_DIR}/prefix/bin/limber --version)
foreach(page man/man1/limber.1 man/man1/limber-run.1 man/man1/limber-cache-clean.1
    bash-completion/completions/limber zsh/site-functions/_limber
    fish/vendor_completions.d/limber.fish)
  if(NOT EXISTS ${WORK_DIR}/prefix/share/${page})
    message(SEND_ERROR "share/${page} is not installed")
  endif()
endforeach()
# Its helpers are found where they were installed.
if(EXISTS ${WORK_DIR}/build/simbody)
  run(${WORK_DIR}/prefix/bin/limber verify ${EXAMPLE} --duration 0.01)
endif()
