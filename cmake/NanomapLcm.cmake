# liblcm 1.5 from the `lcm` wheel: distributions still ship 1.3.1, which loses data (lcm issues 167 and 342).
find_package(lcm 1.5 REQUIRED CONFIG PATHS "${NANOMAP_SITE_PACKAGES}/lib/lcm/cmake" NO_DEFAULT_PATH)
include(${LCM_USE_FILE})
set(NANOMAP_LCM_BIN "${NANOMAP_SITE_PACKAGES}/bin")
