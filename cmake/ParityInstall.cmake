# What `cmake --install` puts where, and the .deb that CPack makes of it (scripts/package, docs/install.md).
#
# The program reads no file of the source or build folder: shaders, the page, letters and built-in scenes are inside it.
# What it loads at run time lies in lib/parity, which it finds from its own place: so the whole tree may be moved.
include(GNUInstallDirs)
set(modules lib/parity) # base/module_file.cpp looks for it beside bin/
set(data ${CMAKE_INSTALL_DATADIR}/parity)
set(documents ${CMAKE_INSTALL_DATADIR}/doc/parity)

set_target_properties(parity PROPERTIES INSTALL_RPATH "$ORIGIN/../${modules}")
install(TARGETS parity RUNTIME DESTINATION bin)
set(libraries parity_draco parity_imageio parity_etc2)
if(TARGET parity_basis)
  list(APPEND libraries parity_basis)
endif()
install(TARGETS ${libraries} LIBRARY DESTINATION ${modules})

# Suites and budgets to start from. A copy of the demo's suite bakes into a folder beside itself.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS scenes/data/demo.toml)
file(READ scenes/data/demo.toml demo)
string(REPLACE "../../out/baked/" "baked/" demo "${demo}")
string(REPLACE "which scripts/demo makes first" "which 'parity bake --suite' makes first" demo "${demo}")
string(REPLACE "What scripts/demo compares" "A demo" demo "${demo}")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/install/demo.toml CONTENT "${demo}" @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/install/demo.toml DESTINATION ${data}/suites)
install(FILES scenes/data/nightly.example.toml DESTINATION ${data}/suites RENAME nightly.toml)
install(FILES compare/verdict/budgets.example.toml DESTINATION ${data})
install(FILES report/report.schema.json integrations/contract.schema.json DESTINATION ${data})

# What other machines' schedulers run, and adapters of other engines; the GitHub Action comes from the repository.
install(DIRECTORY integrations/slurm integrations/kubernetes integrations/gitlab integrations/threejs integrations/blender
  DESTINATION ${data}/integrations USE_SOURCE_PERMISSIONS PATTERN README.md EXCLUDE PATTERN node_modules EXCLUDE
  PATTERN .gitignore EXCLUDE)
install(FILES integrations/github/nightly.yml DESTINATION ${data}/integrations/github)

# The documents keep their places to one another, so that their links hold.
install(FILES README.md CONTRIBUTING.md CHANGELOG.md Containerfile DESTINATION ${documents})
install(DIRECTORY docs DESTINATION ${documents} FILES_MATCHING PATTERN *.md PATTERN *.png PATTERN *.svg)
install(FILES scenes/README.md DESTINATION ${documents}/scenes)
install(DIRECTORY integrations DESTINATION ${documents} FILES_MATCHING PATTERN README.md PATTERN github/install EXCLUDE
  PATTERN node_modules EXCLUDE)
install(FILES compare/verdict/budgets.example.toml DESTINATION ${documents}/compare/verdict)
install(FILES integrations/contract.schema.json DESTINATION ${documents}/integrations)

# The licence and those of what is inside our files: static libraries, headers, letters, packages of the page.
set(notices ${CMAKE_BINARY_DIR}/install/copyright)
set(page)
if(PARITY_DASHBOARD)
  set(page ${CMAKE_SOURCE_DIR}/report/dashboard)
endif()
add_custom_command(
  OUTPUT ${notices}
  COMMAND ${CMAKE_COMMAND} -D OUT=${notices} -D LICENCE=${CMAKE_SOURCE_DIR}/LICENSE -D PAGE=${page}
          -D BASIS=$<TARGET_EXISTS:parity_basis>
          -P ${CMAKE_SOURCE_DIR}/cmake/Notices.cmake
  DEPENDS LICENSE cmake/Notices.cmake $<$<BOOL:${PARITY_DASHBOARD}>:${page}/node_modules/.package-lock.json>
  COMMENT "Licences of what the program holds"
  VERBATIM)
add_custom_target(parity_notices ALL DEPENDS ${notices})
if(PARITY_DASHBOARD)
  add_dependencies(parity_notices parity_report) # which runs npm: not twice at once
endif()
install(FILES ${notices} DESTINATION ${documents})

# The log of changes, as Debian has it: ours, and the package's own, which needs no more than a line.
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(PARITY_MAINTAINER "The parity authors <maintainers@parity.example>" CACHE STRING "Who the Debian package names as its maintainer")
file(STRINGS CHANGELOG.md released REGEX "^## ${PROJECT_VERSION} - [0-9-]+$")
string(REGEX MATCH "[0-9-]+$" released "${released}")
set(suite bookworm)
if(NOT released) # a version that is still being made
  string(TIMESTAMP released "%Y-%m-%d" UTC)
  set(suite UNRELEASED)
endif()
find_program(GZIP_PROGRAM gzip REQUIRED)
add_custom_command(
  OUTPUT ${CMAKE_BINARY_DIR}/install/changelog.gz ${CMAKE_BINARY_DIR}/install/changelog.Debian.gz
  COMMAND ${CMAKE_COMMAND} -D OUT=${CMAKE_BINARY_DIR}/install -D VERSION=${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}
          -D SUITE=${suite} -D RELEASED=${released} -D "MAINTAINER=${PARITY_MAINTAINER}" -D CHANGELOG=${CMAKE_SOURCE_DIR}/CHANGELOG.md
          -D GZIP=${GZIP_PROGRAM} -P ${CMAKE_SOURCE_DIR}/cmake/Changelog.cmake
  DEPENDS CHANGELOG.md cmake/Changelog.cmake
  COMMENT "The log of changes"
  VERBATIM)
add_custom_target(parity_changelog ALL
  DEPENDS ${CMAKE_BINARY_DIR}/install/changelog.gz ${CMAKE_BINARY_DIR}/install/changelog.Debian.gz)
install(FILES ${CMAKE_BINARY_DIR}/install/changelog.gz ${CMAKE_BINARY_DIR}/install/changelog.Debian.gz DESTINATION ${documents})

# Manual pages and shell completion, which the program writes itself.
set(guide ${CMAKE_BINARY_DIR}/install/guide)
add_custom_command(
  OUTPUT ${guide}/done
  COMMAND ${CMAKE_COMMAND} -D OUT=${guide} -D PARITY=$<TARGET_FILE:parity> -D GZIP=${GZIP_PROGRAM} -P ${CMAKE_SOURCE_DIR}/cmake/Guide.cmake
  DEPENDS parity cmake/Guide.cmake
  COMMENT "Manual pages and shell completion"
  VERBATIM)
add_custom_target(parity_guide ALL DEPENDS ${guide}/done)
install(DIRECTORY ${guide}/man1 DESTINATION ${CMAKE_INSTALL_DATADIR}/man)
install(FILES ${guide}/parity.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME parity)
install(FILES ${guide}/parity.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _parity)
install(FILES ${guide}/parity.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# All that is installed: what scripts/package builds.
add_custom_target(parity_installed
  DEPENDS parity ${libraries} parity_notices parity_changelog parity_guide)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME parity)
set(CPACK_PACKAGE_CONTACT "${PARITY_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "compares how a material looks on two shading paths")
set(CPACK_PACKAGE_DESCRIPTION "parity renders a glTF scene by a high-end shading path and by a mobile one,
compares them per material by FLIP, and judges the difference against
budgets: in CI, in a browser, or as a table in a terminal.
.
No GPU is needed: Mesa's software Vulkan device is the default.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}) # libparity_draco.so
# What dpkg-shlibdeps cannot see: the program opens the Vulkan loader by its name, and that the driver. Vulkan 1.3 by
# software with 16-bit floats: tested with Mesa 22.3, Debian 12's.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libvulkan1 (>= 1.3), mesa-vulkan-drivers (>= 22.3)")
include(CPack)
