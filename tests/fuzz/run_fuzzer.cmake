# Runs FUZZER over CORPUS, then on new inputs of up to MAX_BYTES. What it keeps and finds goes to FOUND.
set(seconds 10)
if(DEFINED ENV{NANOMAP_FUZZ_SECONDS})
  set(seconds "$ENV{NANOMAP_FUZZ_SECONDS}")
endif()
file(MAKE_DIRECTORY "${FOUND}/inputs")
execute_process(
  COMMAND "${FUZZER}" "-max_total_time=${seconds}" "-max_len=${MAX_BYTES}" -timeout=10 -rss_limit_mb=2048
          -print_final_stats=1 -verbosity=0 "-artifact_prefix=${FOUND}/" "${FOUND}/inputs" "${CORPUS}"
  RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "A finding: the input is the newest file in ${FOUND}. Mend what it shows, and keep it as "
                      "${CORPUS}/regression-WHAT.")
endif()
