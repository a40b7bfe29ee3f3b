# One INTERFACE target for language level, warnings and sanitizers.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# -O2 vectorises on this compiler; NDEBUG off in release: an assert guards numbers that users trust.
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

# Unity builds (the presets turn them on): all sources of a target are one unit. A build takes two thirds of the time that units of
# 24 sources, or of 8 tests, take, and up to 2.5 GB for each compiler. Whoever changes one source compiles all of them again: the
# preset no-unity is theirs.
if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 0)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()
find_program(LLD_PROGRAM ld.lld)

add_library(parity_flags INTERFACE)
target_compile_options(parity_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  # One flag for libraries and programs alike, so that both can use the same precompiled header.
  -fPIC
  # The single-source maths must round alike on CPU and GPU (docs/design.md 5b): no silent fused multiply-add.
  -ffp-contract=off)
if(PARITY_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 follows inlined strings wrongly at -O1 (its bugs 105329 and 105651): what it says of them stays a warning where the
  # presets take warnings for errors.
  target_compile_options(parity_flags INTERFACE -Wno-error=array-bounds -Wno-error=restrict -Wno-error=stringop-overflow
                                                -Wno-error=stringop-overread -Wno-error=maybe-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC collects its garbage at every 128 MiB and doubling: a tenth of its time. Rarer costs a quarter more memory: 2.6 GB for
  # the largest unit.
  target_compile_options(parity_flags INTERFACE --param=ggc-min-expand=1000 --param=ggc-min-heapsize=1000000)
endif()
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC takes a source that another one includes for a header, where a type of an anonymous namespace would be a fault.
  target_compile_options(parity_flags INTERFACE -Wno-subobject-linkage)
endif()
if(CCACHE_PROGRAM AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(parity_flags INTERFACE -fpch-preprocess)
endif()
if(LLD_PROGRAM)
  target_link_options(parity_flags INTERFACE -fuse-ld=lld)
endif()
if(PARITY_SANITIZE STREQUAL "address")
  # vptr is off: the driver and the image library are not built with RTTI that the check could follow.
  target_compile_options(parity_flags INTERFACE -fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(parity_flags INTERFACE -fsanitize=address,undefined)
elseif(PARITY_SANITIZE STREQUAL "thread")
  target_compile_options(parity_flags INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(parity_flags INTERFACE -fsanitize=thread)
elseif(PARITY_SANITIZE)
  message(FATAL_ERROR "PARITY_SANITIZE: '${PARITY_SANITIZE}' is neither 'address' nor 'thread'")
endif()

if(PARITY_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang" OR NOT PARITY_SANITIZE STREQUAL "address")
    message(FATAL_ERROR "PARITY_FUZZ needs clang and PARITY_SANITIZE=address: use the preset 'fuzz'")
  endif()
  # What libFuzzer follows; the main function of it belongs to the targets alone.
  target_compile_options(parity_flags INTERFACE -fsanitize=fuzzer-no-link -fsanitize=float-cast-overflow
                                                -fno-sanitize-recover=float-cast-overflow)
  target_link_options(parity_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
