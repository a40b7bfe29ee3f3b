# Manual pages (gzip, as Debian has them) and shell completion, as the built program writes them:
#   cmake -D OUT=FOLDER -D PARITY=PROGRAM -D GZIP=PROGRAM -P Guide.cmake
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(ENV{ASAN_OPTIONS} detect_leaks=0) # of a build with sanitizers
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT}/man1)
run(${PARITY} man --output ${OUT}/man1)
file(GLOB pages ${OUT}/man1/*.1)
run(${GZIP} -9n ${pages})
foreach(shell IN ITEMS bash zsh fish)
  run(${PARITY} completion ${shell} OUTPUT_FILE ${OUT}/parity.${shell})
endforeach()
file(TOUCH ${OUT}/done)
