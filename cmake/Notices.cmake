# cmake -D OUT=copyright -D LICENCE=LICENSE [-D PAGE=report/dashboard] [-D BASIS=ON] -P Notices.cmake
# Writes our licence and those of all that our files hold of others: not of the shared libraries that they load.
# PAGE: the folder of the page, whose packages are part of the program. BASIS: there is a parity_basis.so. A licence that is
# missing is an error.

# Packages of Debian: what of them ends up inside.
set(packages
  libdraco-dev "Draco, linked into libparity_draco.so"
  spirv-tools "SPIRV-Tools, linked into the program"
  libvulkan-dev "Vulkan-Hpp and Vulkan-Headers, headers"
  glslang-dev "glslang, linked into the program"
  libhwy-dev "Highway, headers"
  libglm-dev "GLM, headers"
  libcli11-dev "CLI11, headers"
  nlohmann-json3-dev "JSON for Modern C++, headers"
  libtomlplusplus-dev "toml++, headers"
  libfmt-dev "{fmt}, headers"
  libxxhash-dev "xxHash, a header"
  libtbb-dev "oneTBB, headers"
  libtinygltf-dev "tinygltf, a header"
  libfilament-dev "Filament, headers"
  libkissfft-dev "KISS FFT, a header"
  fonts-dejavu-core "DejaVu Sans, whose letters stand in the pictures of `parity plot`")

if(BASIS)
  list(APPEND packages wabt "WABT, whose wasm2c wrote the C code of parity_basis.so"
       libzstd1 "Zstandard, whose decoder is a part of that code")
endif()

file(READ ${LICENCE} text)
set(out "parity\n\n${text}\n\nThis program holds parts of the following works. Each is under the licence that stands below its name.\n")

function(add_notice title text)
  set(out "${out}\n${line}\n${title}\n${line}\n\n${text}\n" PARENT_SCOPE)
endfunction()
string(REPEAT "=" 80 line)

while(packages)
  list(POP_FRONT packages package what)
  set(file /usr/share/doc/${package}/copyright)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${file}: not found; it holds the licence of ${what}, which the package ${package} brings")
  endif()
  file(READ ${file} text)
  add_notice("${what}" "${text}")
endwhile()

if(BASIS)
  set(file /usr/share/common-licenses/Apache-2.0) # of the package base-files, which every Debian has
  file(READ ${file} text)
  add_notice("Basis Universal's transcoder, copyright Binomial LLC, in parity_basis.so"
             "${text}")
endif()

if(PAGE)
  file(READ ${PAGE}/package-lock.json lock)
  string(JSON count LENGTH "${lock}" packages)
  math(EXPR last "${count} - 1")
  foreach(index RANGE ${last})
    string(JSON folder MEMBER "${lock}" packages ${index})
    string(JSON package GET "${lock}" packages "${folder}")
    string(JSON dev ERROR_VARIABLE none GET "${package}" dev)
    # Not the page itself, what only builds and tests it, nor types, which no bundle holds.
    if(folder STREQUAL "" OR dev STREQUAL "ON" OR folder MATCHES "/@types/")
      continue()
    endif()
    string(REPLACE "node_modules/" "" name "${folder}")
    string(JSON version GET "${package}" version)
    string(JSON licence GET "${package}" license)
    file(GLOB files ${PAGE}/${folder}/LICENSE* ${PAGE}/${folder}/LICENCE* ${PAGE}/${folder}/license*)
    if(files)
      list(GET files 0 file)
      file(READ ${file} text)
    elseif(EXISTS ${PAGE}/${folder}/package.json)
      file(READ ${PAGE}/${folder}/package.json own)
      string(JSON author ERROR_VARIABLE none GET "${own}" author)
      set(text "${licence}, by ${author}. The package holds no text of it.\n")
    else()
      message(FATAL_ERROR "${PAGE}/${folder}: not found; npm ci brings it")
    endif()
    add_notice("${name} ${version} (${licence}), in the report's page" "${text}")
  endforeach()
endif()
file(WRITE ${OUT} "${out}")
