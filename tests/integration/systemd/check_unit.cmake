# Has systemd read the unit, complain about nothing, and rate how exposed the service is.
# cmake -DSYSTEMD_ANALYZE=<program> -DUNIT=<template> -DWORK=<scratch> -P ...
if(NOT SYSTEMD_ANALYZE)
  message(STATUS "skipped: there is no systemd-analyze on this machine")
  return()
endif()

# In systemd-analyze's own words: tenths of its scale from 0 (safe) to 10 (unsafe). A service without hardening has 96.
set(most_exposed 25)

set(unit "${WORK}/nanomap-flight.service")
set(NANOMAP_FLIGHT_PROGRAM "${CMAKE_COMMAND}")  # systemd wants a program that is there
file(REMOVE_RECURSE "${WORK}")
configure_file("${UNIT}" "${unit}" @ONLY)

function(verify result)
  execute_process(COMMAND "${SYSTEMD_ANALYZE}" verify --man=no --recursive-errors=no "${unit}"
                  OUTPUT_VARIABLE complaints ERROR_VARIABLE complaints RESULT_VARIABLE status)
  if(status EQUAL 0 AND complaints STREQUAL "")
    set(${result} "" PARENT_SCOPE)
  else()
    set(${result} "status ${status}: ${complaints}" PARENT_SCOPE)
  endif()
endfunction()

verify(complaints)
if(complaints)
  message(FATAL_ERROR "systemd does not take the unit, ${complaints}")
endif()

execute_process(COMMAND "${SYSTEMD_ANALYZE}" security --offline=true "--threshold=${most_exposed}" --no-pager "${unit}"
                OUTPUT_VARIABLE report ERROR_VARIABLE report RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the service is more exposed than ${most_exposed} tenths, status ${status}:\n${report}")
endif()
string(REGEX MATCH "Overall exposure level[^\n]*" level "${report}")
message(STATUS "${level}")

# It can fail: a key that systemd does not know.
file(APPEND "${unit}" "\n[Service]\nWatchdogSek=2\n")
verify(complaints)
if(NOT complaints)
  message(FATAL_ERROR "systemd does not notice a misspelt key: this test is blind")
endif()
