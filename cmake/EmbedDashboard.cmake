# cmake -D OUT=x.cpp [-D SCRIPT=dashboard.js -D STYLE=dashboard.css] -P EmbedDashboard.cmake
# Writes what report/dashboard_files.h declares: both files as they are, with their hashes. Without files they are empty.
foreach(kind SCRIPT STYLE)
  set(text "")
  set(hash "")
  if(${kind})
    file(READ ${${kind}} text)
    string(SHA256 hash "${text}")
    # One page of all inlines both between tags; a browser would end them early, and reads CR as LF, so that the hash fails.
    string(TOLOWER "${text}" lower)
    foreach(forbidden "</script" "</style" "\r" ")parity\"")
      string(FIND "${lower}" "${forbidden}" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "${${kind}}: holds '${forbidden}', which cannot be inlined")
      endif()
    endforeach()
    string(FIND "${lower}" "<!--" comment)
    string(FIND "${lower}" "<script" tag)
    if(NOT comment EQUAL -1 AND NOT tag EQUAL -1)
      message(FATAL_ERROR "${${kind}}: holds '<!--' and '<script', which inlined hide the end of the script")
    endif()
  endif()
  set(${kind}_TEXT "${text}")
  set(${kind}_HASH "${hash}")
endforeach()
file(WRITE ${OUT} "// Made by cmake/EmbedDashboard.cmake.
#include \"report/dashboard_files.h\"

#pragma GCC diagnostic ignored \"-Woverlength-strings\"

namespace parity::report {

using namespace std::string_view_literals; // whose length the compiler knows: it counts no more than 262,144 characters

const DashboardFile& dashboardScript() {
  static constexpr DashboardFile file = {R\"parity(${SCRIPT_TEXT})parity\"sv, \"${SCRIPT_HASH}\"};
  return file;
}

const DashboardFile& dashboardStyle() {
  static constexpr DashboardFile file = {R\"parity(${STYLE_TEXT})parity\"sv, \"${STYLE_HASH}\"};
  return file;
}

} // namespace parity::report
")
