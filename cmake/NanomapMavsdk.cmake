# MAVSDK from the `mavsdk` wheel: the library itself behind a C ABI, prebuilt for x86_64 and aarch64, so that nobody has
# to build it. The wheel names the file libcmavsdk.so, but its SONAME is libcmavsdk.so.3, and that is what a program
# linked against it looks for.
set(wheel_library "${NANOMAP_SITE_PACKAGES}/mavsdk/lib/libcmavsdk.so")
if(NOT EXISTS "${wheel_library}")
  message(FATAL_ERROR "No ${wheel_library}. Run tools/setup/setup once: it installs MAVSDK.")
endif()
set(NANOMAP_CMAVSDK "${PROJECT_BINARY_DIR}/lib/libcmavsdk.so.3")
configure_file("${wheel_library}" "${NANOMAP_CMAVSDK}" COPYONLY)
add_library(nanomap::cmavsdk SHARED IMPORTED GLOBAL)
set_target_properties(nanomap::cmavsdk PROPERTIES IMPORTED_LOCATION "${NANOMAP_CMAVSDK}" IMPORTED_SONAME libcmavsdk.so.3)
