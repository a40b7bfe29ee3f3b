# cmake -D OUT=folder -D VERSION=0.2.0-1 -D SUITE=bookworm -D RELEASED=2026-11-24 -D MAINTAINER=... -D CHANGELOG=CHANGELOG.md
#       -D GZIP=gzip -P Changelog.cmake
# Writes changelog.gz, ours, and changelog.Debian.gz, the package's. Both are the same bytes every time.
string(REPLACE "-" ";" date ${RELEASED})
list(GET date 0 year)
list(GET date 1 month)
list(GET date 2 day)
set(months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)
math(EXPR index "${month} - 1")
list(GET months ${index} month_name)
# The weekday, by Sakamoto (1992).
set(shifts 0 3 2 5 0 3 5 1 4 6 2 4)
list(GET shifts ${index} shift)
set(y ${year})
if(month LESS 3)
  math(EXPR y "${year} - 1")
endif()
math(EXPR weekday "(${y} + ${y} / 4 - ${y} / 100 + ${y} / 400 + ${shift} + ${day}) % 7")
set(weekdays Sun Mon Tue Wed Thu Fri Sat)
list(GET weekdays ${weekday} weekday)

file(WRITE ${OUT}/changelog.Debian "parity (${VERSION}) ${SUITE}; urgency=medium

  * changelog.gz says what this version brings.

 -- ${MAINTAINER}  ${weekday}, ${day} ${month_name} ${year} 00:00:00 +0000
")
configure_file(${CHANGELOG} ${OUT}/changelog COPYONLY)
foreach(file changelog changelog.Debian)
  execute_process(COMMAND ${GZIP} -9nf ${OUT}/${file} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
