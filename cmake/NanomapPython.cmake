# The private Python environment of the build: liblcm 1.5 and its tools, numpy and matplotlib for reports and oracles.
find_program(NANOMAP_PYTHON python3 PATHS "${NANOMAP_VENV}/bin" NO_DEFAULT_PATH)
if(NOT NANOMAP_PYTHON)
  message(FATAL_ERROR "No Python environment at ${NANOMAP_VENV}. Run tools/setup/setup once: it makes it.")
endif()
execute_process(COMMAND "${NANOMAP_PYTHON}" -c "import sysconfig; print(sysconfig.get_path('purelib'))"
                OUTPUT_VARIABLE NANOMAP_SITE_PACKAGES OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
