# parity_dashboard(TARGET)
#
# Builds the report's page, report/dashboard (TypeScript), by npm and Vite into one script and one style sheet, and embeds
# both in TARGET as report/dashboard_files.h declares them. Without PARITY_DASHBOARD they are empty, and npm is not
# needed.
function(parity_dashboard target)
  set(out ${CMAKE_BINARY_DIR}/dashboard)
  set(embedded ${out}/dashboard_files.cpp)
  file(MAKE_DIRECTORY ${out})
  set(embed ${CMAKE_COMMAND} -D OUT=${embedded} -P ${CMAKE_SOURCE_DIR}/cmake/EmbedDashboard.cmake)
  if(PARITY_DASHBOARD)
    find_program(NPM_PROGRAM npm)
    if(NOT NPM_PROGRAM)
      message(FATAL_ERROR "npm, which builds the report's page, is not on the PATH: scripts/install-deps installs it; "
                          "-DPARITY_DASHBOARD=OFF builds without the page")
    endif()
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/dashboard)
    file(GLOB_RECURSE page CONFIGURE_DEPENDS ${source}/src/*)
    file(GLOB settings CONFIGURE_DEPENDS ${source}/*.ts ${source}/*.json)
    add_custom_command(
      OUTPUT ${source}/node_modules/.package-lock.json
      COMMAND ${NPM_PROGRAM} ci --loglevel=error
      DEPENDS ${source}/package.json ${source}/package-lock.json ${source}/.npmrc
      WORKING_DIRECTORY ${source}
      COMMENT "Packages of the report's page"
      VERBATIM)
    add_custom_command(
      OUTPUT ${out}/bundle/dashboard.js ${out}/bundle/dashboard.css
      COMMAND ${source}/node_modules/.bin/vite build --outDir ${out}/bundle --emptyOutDir --logLevel warn
      DEPENDS ${page} ${settings} ${source}/node_modules/.package-lock.json
      WORKING_DIRECTORY ${source}
      COMMENT "The report's page"
      VERBATIM)
    set(bundle ${out}/bundle/dashboard.js ${out}/bundle/dashboard.css)
    list(INSERT embed 1 -D SCRIPT=${out}/bundle/dashboard.js -D STYLE=${out}/bundle/dashboard.css)
  else()
    set(bundle)
  endif()
  add_custom_command(
    OUTPUT ${embedded}
    COMMAND ${embed}
    DEPENDS ${bundle} ${CMAKE_SOURCE_DIR}/cmake/EmbedDashboard.cmake
    COMMENT "Embedding the report's page"
    VERBATIM)
  target_sources(${target} PRIVATE ${embedded})
endfunction()
